/// The voxels that material points fill, as many as their volume makes.
///
/// Every point spreads its volume by a trilinear hat of one voxel half-width, i.e. over the
/// voxels that a voxel-sized cube centred on it overlaps; then the fullest voxels are taken
/// until they have the volume of the points. Points at voxel centres give exactly their
/// voxels back, and scattered points neither gain nor lose volume.
pub(crate) struct Voxeliser {
    dims: [usize; 3],
    fill: Vec<f32>,
}

impl Voxeliser {
    /// An empty grid of voxels.
    pub(crate) fn new(dims: [usize; 3]) -> Self {
        Self {
            dims,
            fill: vec![0.0; dims.iter().product()],
        }
    }

    /// Adds a point of `volume` (in voxels) at `place` (in voxels from the low corner).
    pub(crate) fn add(&mut self, place: [f64; 3], volume: f64) {
        let low = place.map(|x| (x - 0.5).floor());
        let share: [f64; 3] = std::array::from_fn(|a| place[a] - 0.5 - low[a]);
        for corner in 0..8_u8 {
            let up = [corner & 1, corner >> 1 & 1, corner >> 2];
            let weight: f64 = (0..3)
                .map(|a| match up[a] {
                    1 => share[a],
                    _ => 1.0 - share[a],
                })
                .product();
            let voxel = std::array::from_fn(|a| low[a] + f64::from(up[a]));
            if let Some(at) = self.index(voxel) {
                self.fill[at] += (weight * volume) as f32;
            }
        }
    }

    fn index(&self, voxel: [f64; 3]) -> Option<usize> {
        let inside = (0..3).all(|a| voxel[a] >= 0.0 && voxel[a] < self.dims[a] as f64);
        let [x, y, z] = voxel.map(|i| i as usize);
        inside.then(|| (z * self.dims[1] + y) * self.dims[0] + x)
    }

    /// The `count` fullest voxels among those that `open` admits; of equals, the first in
    /// storage order.
    pub(crate) fn fullest(
        &self,
        count: usize,
        open: impl Fn([usize; 3]) -> bool,
    ) -> Vec<[usize; 3]> {
        let [nx, ny, _] = self.dims;
        let place = |at: usize| [at % nx, at / nx % ny, at / nx / ny];
        let mut touched: Vec<usize> = (0..self.fill.len())
            .filter(|&at| self.fill[at] > 0.0 && open(place(at)))
            .collect();
        if count < touched.len() {
            touched.select_nth_unstable_by(count, |&a, &b| {
                self.fill[b].total_cmp(&self.fill[a]).then(a.cmp(&b))
            });
            touched.truncate(count);
        }
        touched.into_iter().map(place).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_at_voxel_centres_give_their_voxels_back() {
        let mut voxels = Voxeliser::new([8, 8, 8]);
        let inside = |x: usize, y: usize, z: usize| (x + y + z).is_multiple_of(3) && y < 5;
        let mut expected = Vec::new();
        for z in 0..8 {
            for y in 0..8 {
                for x in 0..8 {
                    if inside(x, y, z) {
                        voxels.add([x, y, z].map(|i| i as f64 + 0.5), 1.0);
                        expected.push([x, y, z]);
                    }
                }
            }
        }
        assert_eq!(voxels.fullest(expected.len(), |_| true), expected);
    }

    #[test]
    fn a_cube_of_points_off_the_voxels_keeps_its_volume_and_its_place() {
        // 4 x 4 x 4 points a quarter of a voxel beyond the centres.
        let mut voxels = Voxeliser::new([10, 10, 10]);
        for z in 0..4 {
            for y in 0..4 {
                for x in 0..4 {
                    voxels.add([x, y, z].map(|i| f64::from(i) + 3.75), 1.0);
                }
            }
        }
        let total: f32 = voxels.fill.iter().sum();
        assert!((total - 64.0).abs() < 1e-4);
        let mut found = voxels.fullest(64, |_| true);
        found.sort_unstable();
        assert_eq!(found.len(), 64);
        assert!(
            found.iter().flatten().all(|i| (3..7).contains(i)),
            "{found:?}"
        );
        assert!(voxels.fullest(64, |[x, ..]| x < 5).iter().all(|v| v[0] < 5));
    }
}
