//! The volume fraction of liquid in voxels, and the voxels that it fills.

use particle_file::BitGrid;

use crate::lattice::{Voxel, around, set_voxels};

/// Share of each open voxel that material points fill.
///
/// Every point spreads its volume by a trilinear hat of one voxel half-width, i.e. over the
/// voxels that a voxel-sized cube centred on it overlaps, as far as they are open: liquid is
/// not in wood. The cube of a point at a side of the grid is pushed inside.
pub struct VolumeFractions {
    open: BitGrid,
    fraction: Vec<f32>,
    volume: f64,
}

impl VolumeFractions {
    /// No liquid yet among the voxels of `open`, those that may hold some.
    pub fn new(open: BitGrid) -> Self {
        Self {
            fraction: vec![0.0; open.dims().iter().product()],
            open,
            volume: 0.0,
        }
    }

    /// Adds a point of `volume` (in voxels) at `place` (in voxels from the low corner).
    ///
    /// What is deeper in wood than the hat reaches has a volume but no voxel of its own.
    pub fn add(&mut self, place: [f64; 3], volume: f64) {
        self.volume += volume;
        let dims = self.open.dims();
        let place: [f64; 3] = std::array::from_fn(|a| place[a].max(0.5).min(dims[a] as f64 - 0.5));
        let low = place.map(|x| (x - 0.5).floor());
        let share: [f64; 3] = std::array::from_fn(|a| place[a] - 0.5 - low[a]);
        let low = low.map(|x| x as usize);
        let mut parts = [(0, 0.0); 8];
        for (corner, part) in parts.iter_mut().enumerate() {
            let up = [corner & 1, corner >> 1 & 1, corner >> 2];
            let along = |a: usize| [1.0 - share[a], share[a]][up[a]];
            let weight: f64 = (0..3).map(along).product();
            let voxel: Voxel = std::array::from_fn(|a| low[a] + up[a]);
            if self.is_open(voxel) {
                *part = (self.index(voxel), weight);
            }
        }
        let whole: f64 = parts.iter().map(|part| part.1).sum();
        if whole > 0.0 {
            for (at, weight) in parts {
                self.fraction[at] += (weight / whole * volume) as f32;
            }
        }
    }

    /// As many voxels as the points' volume makes: those that are fullest, each judged by its own
    /// fraction f (at most 1) and the mean fraction c (at most 1) of the open ones among the 27
    /// around it, by f + c^2.
    ///
    /// Points at voxel centres give exactly their voxels back: each of those has more than 1, any
    /// other at most (26/27)^2. A voxel that points drawn apart left empty has full neighbours and
    /// comes before one at the surface of the liquid, where both are one half. Of equals, the
    /// first in storage order. There are fewer voxels where points are squeezed into less room
    /// than their volume and the voxels next to it.
    pub fn fullest(&self) -> BitGrid {
        let reached = self.reached();
        let mut ranked: Vec<(f32, usize)> = set_voxels(reached.view())
            .map(|voxel| (self.rank(voxel), self.index(voxel)))
            .collect();
        let count = self.volume.round().max(0.0) as usize;
        if count < ranked.len() {
            ranked.select_nth_unstable_by(count, |a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            ranked.truncate(count);
        }
        let mut chosen = BitGrid::new(self.open.dims());
        let [nx, ny, _] = self.open.dims();
        for (_, at) in ranked {
            chosen.set(at % nx, at / nx % ny, at / nx / ny, true);
        }
        chosen
    }

    /// The open voxels that hold liquid or are beside one that does.
    fn reached(&self) -> BitGrid {
        let dims = self.open.dims();
        let mut reached = BitGrid::new(dims);
        for voxel in set_voxels(self.open.view()) {
            if self.fraction[self.index(voxel)] > 0.0 {
                let open = around(voxel, dims).filter(|&[x, y, z]| self.open.get(x, y, z));
                open.for_each(|[x, y, z]| reached.set(x, y, z, true));
            }
        }
        reached
    }

    fn rank(&self, voxel: Voxel) -> f32 {
        let (mut sum, mut count) = (0.0, 0.0);
        for [x, y, z] in around(voxel, self.open.dims()) {
            if self.open.get(x, y, z) {
                sum += self.fraction[self.index([x, y, z])];
                count += 1.0;
            }
        }
        let own = self.fraction[self.index(voxel)].min(1.0);
        own + (sum / count).min(1.0).powi(2)
    }

    fn is_open(&self, voxel: Voxel) -> bool {
        let [x, y, z] = voxel;
        (0..3).all(|a| voxel[a] < self.open.dims()[a]) && self.open.get(x, y, z)
    }

    fn index(&self, [x, y, z]: Voxel) -> usize {
        let [nx, ny, _] = self.open.dims();
        (z * ny + y) * nx + x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::voxels;

    fn all(dims: Voxel) -> BitGrid {
        BitGrid::from_fn(dims, |_, _, _| true)
    }

    /// Points at the centres of `voxels`, shifted.
    fn points(voxels: &BitGrid, shift: f64, into: BitGrid) -> VolumeFractions {
        let mut fractions = VolumeFractions::new(into);
        for voxel in set_voxels(voxels.view()) {
            fractions.add(voxel.map(|i| i as f64 + 0.5 + shift), 1.0);
        }
        fractions
    }

    #[test]
    fn points_at_voxel_centres_give_their_voxels_back() {
        for pattern in [2, 3, 5, 7] {
            let inside = |x: usize, y: usize, z: usize| {
                !(x + 2 * y + 3 * z).is_multiple_of(pattern) && y < 5
            };
            let voxels = BitGrid::from_fn([8, 8, 8], inside);
            // The places of a file are of single precision.
            let fractions = points(&voxels, 1e-6, all([8, 8, 8]));
            assert_eq!(fractions.fullest(), voxels, "{pattern}");
        }
    }

    #[test]
    fn a_cube_of_points_off_the_voxels_keeps_its_volume_and_its_place() {
        let cube = BitGrid::from_fn([10, 10, 10], |x, y, z| {
            [x, y, z].iter().all(|i| (3..7).contains(i))
        });
        let fractions = points(&cube, 0.25, all([10, 10, 10]));
        let total: f32 = fractions.fraction.iter().sum();
        assert!((total - 64.0).abs() < 1e-4);
        assert_eq!(fractions.fullest(), cube);
    }

    #[test]
    fn the_liquid_stays_out_of_wood_and_on_the_grid() {
        // A slab of 3 layers pressed half a layer into the floor and half over the end.
        let slab = BitGrid::from_fn([6, 8, 6], |_, y, _| (1..4).contains(&y));
        let open = BitGrid::from_fn([6, 8, 6], |_, y, _| y >= 1);
        let fractions = points(&slab, -0.5, open.clone());
        let total: f32 = fractions.fraction.iter().sum();
        assert!((total - 108.0).abs() < 1e-3, "{total}");
        let found = fractions.fullest();
        assert_eq!(found, slab);
        let deep = points(&slab, -2.5, open.clone());
        assert_eq!(deep.volume, 108.0);
        let found = deep.fullest();
        let in_wood = BitGrid::from_fn([6, 8, 6], |x, y, z| found.get(x, y, z) && y < 1).count();
        assert_eq!(in_wood, 0);
    }

    #[test]
    fn streaks_between_points_drawn_apart_are_filled_and_the_volume_kept() {
        // Points 1.4 voxels apart along x and 1/1.4 along z: the liquid's density is 1, but
        // whole planes of voxels hold no point.
        let mut fractions = VolumeFractions::new(all([28, 12, 20]));
        let mut holding = BitGrid::new([28, 12, 20]);
        for point in voxels([10, 6, 14]) {
            let [i, j, k] = point.map(|i| i as f64 + 0.5);
            let place = [7.0 + 1.4 * i, 3.0 + j, 5.0 + k / 1.4];
            let [x, y, z] = place.map(|x| x as usize);
            holding.set(x, y, z, true);
            fractions.add(place, 1.0);
        }
        let found = fractions.fullest();
        assert_eq!(found.count(), 840);
        assert!(holding.count() < 650, "{}", holding.count());
        // The box that the liquid fills, without its outermost voxels.
        for [x, y, z] in voxels([12, 4, 8]) {
            assert!(found.get(x + 8, y + 4, z + 6), "hole at {x}, {y}, {z}");
        }
    }
}
