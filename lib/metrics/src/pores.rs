//! Sizes of pores and lumens.

use bondline::PlacedVoxels;
use rayon::prelude::*;

use crate::distance::{NO_TARGET, PointLattice, squared_distances};

/// Pores of one size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoreSize {
    /// Diameter, m.
    pub diameter_m: f64,
    /// Fraction of the open volume with this diameter.
    pub share: f64,
    /// Fraction of the open volume with this or a smaller diameter.
    pub up_to: f64,
}

/// Pore sizes around `wood`, in ascending order. The size at a voxel is the diameter of the largest ball that contains the
/// voxel and no wood (Hildebrand and Rüegsegger 1997, J. Microsc. 185, 67-75). Empty if nothing is open or nothing is wood.
///
/// Balls are centred at centres and corners of voxels. Diameters are resolved to half a voxel, above twenty voxels to a
/// fortieth. Due to the voxels, slits come out half a voxel too wide and round tubes up to a voxel too narrow. Outside the box
/// there is no wood. `progress` receives the fraction done.
pub fn pore_sizes(wood: PlacedVoxels, mut progress: impl FnMut(f64)) -> Vec<PoreSize> {
    let dims = wood.bits.dims();
    let [nx, ny, _] = dims;
    let solid = |i: usize| wood.bits.get(i % nx, i / nx % ny, i / (nx * ny));
    let voxels = PointLattice::centres(dims);
    let seats = [voxels, PointLattice::corners(dims)];
    let room = seats.map(|seats| squared_distances(voxels, solid, seats));
    let widest = room.par_iter().flatten().copied().max().unwrap_or(0);
    if widest == 0 || widest == NO_TARGET {
        return Vec::new();
    }
    let mut open = vec![false; room[0].len()];
    let mut covered = Vec::new();
    let levels = levels(widest);
    for (done, &quarters) in levels.iter().rev().enumerate() {
        progress((done + 1) as f64 / (levels.len() + 1) as f64);
        for (seats, room) in seats.iter().zip(&room) {
            let within = |half_voxels: u32| 4 * u64::from(half_voxels) < quarters * quarters;
            let to_seat = squared_distances(*seats, |i| !within(room[i]), voxels);
            let pairs = open.par_iter_mut().zip(to_seat);
            pairs.for_each(|(open, to_seat)| *open |= within(to_seat));
        }
        let count = open.par_iter().filter(|open| **open).count();
        covered.push((quarters, count as f64));
    }
    let all = covered.last().map_or(0.0, |(_, count)| *count);
    let mut wider = 0.0;
    let mut sizes = Vec::new();
    for (quarters, count) in covered {
        // The wall lies half a voxel before the nearest wood centre if flat, and at that centre if curved.
        let middle = quarters as f64 + 0.5 * (step(quarters) - 1) as f64;
        sizes.push(PoreSize {
            diameter_m: (0.5 * middle - 0.5) * wood.voxel_m,
            share: (count - wider) / all,
            up_to: 1.0 - wider / all,
        });
        wider = count;
    }
    sizes.reverse();
    sizes
}

/// Resolved distances to the wood (quarter voxels), from one voxel to the widest; `widest` is a square in half voxels.
fn levels(widest: u32) -> Vec<u64> {
    let most = (4 * u64::from(widest)).isqrt();
    let next = |quarters: &u64| Some(quarters + step(*quarters));
    std::iter::successors(Some(4), next)
        .take_while(|quarters| *quarters <= most)
        .collect()
}

fn step(quarters: u64) -> u64 {
    (quarters / 40).max(1)
}
