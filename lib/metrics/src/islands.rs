//! Islands of adhesive in the slices of a stack.

use bondline::Placed;
use particle_file::BitGrid;

/// Adhesive without what hangs together, by edges and corners of pixels, to fewer than `least` pixels of a slice normal to z.
pub fn without_islands(adhesive: Placed, least: usize) -> BitGrid {
    let [nx, ny, nz] = adhesive.bits.dims();
    let mut kept = BitGrid::new([nx, ny, nz]);
    let mut left = BitGrid::new([nx, ny, nz]);
    adhesive.bits.for_each(|[x, y, z]| left.set(x, y, z, true));
    let mut island = Vec::new();
    adhesive.bits.for_each(|[x, y, z]| {
        island.clear();
        let mut next = 0;
        let mut take = |x, y, island: &mut Vec<[usize; 2]>| {
            if left.get(x, y, z) {
                left.set(x, y, z, false);
                island.push([x, y]);
            }
        };
        take(x, y, &mut island);
        while let Some(&[x, y]) = island.get(next) {
            next += 1;
            for v in y.saturating_sub(1)..(y + 2).min(ny) {
                (x.saturating_sub(1)..(x + 2).min(nx)).for_each(|u| take(u, v, &mut island));
            }
        }
        if island.len() >= least {
            island.iter().for_each(|&[x, y]| kept.set(x, y, z, true));
        }
    });
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn islands_are_of_a_slice_and_hang_together_by_corners() {
        // A diagonal of three in the first slice, a column of one pixel a slice, and one alone.
        let set =
            |x, y, z| (x == y && y < 3 && z == 0) || (x, y) == (6, 5) || (x, y, z) == (0, 5, 2);
        let bits = BitGrid::from_fn([8, 7, 3], set);
        let adhesive = Placed {
            origin_m: [0.0; 3],
            voxel_m: 1e-6,
            bits: bits.view(),
        };
        let counts = [1, 2, 3, 4].map(|least| without_islands(adhesive, least).count());
        assert_eq!(counts, [7, 3, 3, 0]);
    }
}
