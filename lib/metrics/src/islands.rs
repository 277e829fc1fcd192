//! Islands of adhesive in the slices of a stack.

use bondline::PlacedVoxels;
use particle_file::BitGrid;

/// Adhesive without islands: connected pixels, over edges and corners, that number fewer than `least` in a slice normal to z.
pub fn without_islands(adhesive: PlacedVoxels, least: usize) -> BitGrid {
    let [nx, ny, nz] = adhesive.bits.dims();
    let mut kept = BitGrid::new([nx, ny, nz]);
    for z in 0..nz {
        let set = |i| adhesive.bits.get(i % nx, i / nx, z);
        let section: Vec<bool> = (0..nx * ny).map(set).collect();
        let islands = voxels::pieces(&section, nx, true).into_iter();
        for (_, island) in islands.filter(|(set, island)| *set && island.len() >= least) {
            island
                .into_iter()
                .for_each(|i| kept.set(i % nx, i / nx, z, true));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn islands_are_of_a_slice_and_hang_together_by_corners() {
        // A diagonal of three pixels in the first slice, a column of one pixel per slice, and a single pixel.
        let set =
            |x, y, z| (x == y && y < 3 && z == 0) || (x, y) == (6, 5) || (x, y, z) == (0, 5, 2);
        let bits = BitGrid::from_fn([8, 7, 3], set);
        let adhesive = PlacedVoxels {
            origin_m: [0.0; 3],
            voxel_m: 1e-6,
            bits: bits.view(),
        };
        let counts = [1, 2, 3, 4].map(|least| without_islands(adhesive, least).count());
        assert_eq!(counts, [7, 3, 3, 0]);
    }
}
