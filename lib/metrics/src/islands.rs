//! Islands of adhesive in the slices of a stack.

use bondline::Placed;
use particle_file::BitGrid;

/// Adhesive without what hangs together, by edges and corners of pixels, to fewer than `least` pixels of a slice normal to z.
pub fn without_islands(adhesive: Placed, least: usize) -> BitGrid {
    let dims = adhesive.bits.dims();
    let [nx, ny, nz] = dims;
    let mut kept = BitGrid::new(dims);
    let mut island = Vec::new();
    for z in 0..nz {
        let mut left: Vec<bool> = vec![false; nx * ny];
        for y in 0..ny {
            let set = adhesive.bits.set_in_row(y, z);
            set.for_each(|x| left[x + nx * y] = true);
        }
        for start in 0..left.len() {
            if !std::mem::take(&mut left[start]) {
                continue;
            }
            island.clear();
            island.push(start);
            let mut next = 0;
            while let Some(&pixel) = island.get(next) {
                next += 1;
                let (x, y) = (pixel % nx, pixel / nx);
                for v in y.saturating_sub(1)..(y + 2).min(ny) {
                    for u in x.saturating_sub(1)..(x + 2).min(nx) {
                        if std::mem::take(&mut left[u + nx * v]) {
                            island.push(u + nx * v);
                        }
                    }
                }
            }
            if island.len() >= least {
                (island.iter()).for_each(|pixel| kept.set(pixel % nx, pixel / nx, z, true));
            }
        }
    }
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
