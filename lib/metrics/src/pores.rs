//! Sizes of pores and lumens.

use bondline::Placed;
use rayon::prelude::*;

use crate::distance::{FAR, Lattice, squared_distances};

/// Pores of one size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoreSize {
    /// Diameter, m.
    pub diameter_m: f64,
    /// Share of the open volume that has it.
    pub share: f64,
    /// Share of the open volume that has this or a smaller one.
    pub up_to: f64,
}

/// The open volume around `wood` by the diameter of the largest ball that fits between the wood and holds the voxel
/// (Hildebrand and Rüegsegger 1997, J. Microsc. 185, 67-75), from the smallest on; none where nothing is open, or nothing
/// is wood.
///
/// Balls stand at centres and corners of voxels; their diameters go by half voxels, beyond twenty by a fortieth. Slits come
/// out half a voxel too wide, round tubes up to a voxel too narrow, as voxels draw them. Beyond the sides of the box there
/// is no wood. `progress` is told which part is done.
pub fn pore_sizes(wood: Placed, mut progress: impl FnMut(f64)) -> Vec<PoreSize> {
    let dims = wood.bits.dims();
    let [nx, ny, _] = dims;
    let solid = |i: usize| wood.bits.get(i % nx, i / nx % ny, i / (nx * ny));
    let voxels = Lattice::centres(dims);
    let seats = [voxels, Lattice::corners(dims)];
    let room = seats.map(|seats| squared_distances(voxels, solid, seats));
    let widest = room.par_iter().flatten().copied().max().unwrap_or(0);
    if widest == 0 || widest == FAR {
        return Vec::new();
    }
    let mut open = vec![false; room[0].len()];
    let mut held = Vec::new();
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
        held.push((quarters, count as f64));
    }
    let all = held.last().map_or(0.0, |(_, count)| *count);
    let mut wider = 0.0;
    let mut sizes = Vec::new();
    for (quarters, count) in held {
        // Radii end half a voxel before the nearest centre in the wood at flat walls, at it where walls curve.
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

/// Distances (quarter voxels) to the wood that are told apart, from a voxel to the `widest`, whose square is in half voxels.
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
