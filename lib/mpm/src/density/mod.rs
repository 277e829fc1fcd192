//! Density projection: moves the points so that the liquid fills its cells evenly.
//!
//! Errors of the points' motion show as cells that hold more or less liquid than there is room.
//! After a given distance of motion a fraction kappa of that error is removed by the displacement of
//! least sum of squares,
//!
//! min sum_f a_f d_f^2/2 with sum_f s_f a_f d_f = kappa clip(r_c - 1) o_c,
//!
//! a_f the open area of a face, o_c the open volume of a cell and r_c its liquid over that. Its
//! solution is d = psi_low - psi_high on every open face, psi = 0 in the air. Velocities, J and
//! stress of the points stay as they are.

mod cells;
mod covered;
mod solve;

use rayon::prelude::*;

use crate::collide::{Fault, Obstacle, first_fault, move_points};
use crate::lanes::Lanes4;
use crate::lattice::Lattice;
use crate::tiles::Tile;
use cells::Cells;

/// When to project.
pub(crate) struct Projection {
    /// Cells of motion between two projections.
    every: f64,
    /// Cells the fastest point has moved since the last.
    moved: f64,
    /// Speed of the fastest point when it was last looked for, m/s.
    pub(crate) speed: f64,
    /// Projections so far.
    pub(crate) count: u64,
}

impl Projection {
    pub(crate) fn new(every: f64, speed: f64) -> Self {
        Self {
            every,
            moved: 0.0,
            speed,
            count: 0,
        }
    }

    /// The changing part, for checkpoints.
    pub(crate) fn state(&self) -> Vec<f64> {
        vec![self.moved, self.speed, self.count as f64]
    }

    pub(crate) fn set_state(&mut self, [moved, speed, count]: [f64; 3]) {
        (self.moved, self.speed, self.count) = (moved, speed, count as u64);
    }

    /// Whether a projection is due after a step of `cells` at unit speed.
    pub(crate) fn due(&mut self, cells: f64) -> bool {
        self.moved += self.speed * cells;
        let due = self.moved >= self.every;
        if due {
            self.moved = 0.0;
            self.count += 1;
        }
        due
    }
}

/// Moves the points of `tiles` to even density around `bodies`, which rest.
#[inline(never)] // `make leave-out` counts its instructions by its name
pub(crate) fn project(tiles: &mut [Tile], lattice: &Lattice, bodies: &[Obstacle]) -> Fault {
    let mut cells = Cells::new(tiles, lattice, bodies);
    solve::potential(&mut cells.list);
    tiles
        .par_iter_mut()
        .map_init(Vec::new, |shift, tile| {
            displace(tile, shift, &cells, lattice, bodies);
            move_points(tile, shift, lattice, bodies)
        })
        .reduce(|| None, first_fault)
}

/// Displacements of a tile's points. One that would lead into a body is left out, so
/// that the move stops no point and changes no velocity.
fn displace(
    tile: &Tile,
    shifts: &mut Vec<Lanes4>,
    cells: &Cells,
    lattice: &Lattice,
    bodies: &[Obstacle],
) {
    shifts.clear();
    for p in 0..tile.points.len() {
        let base = tile.points.base[p];
        let (node, d) = (tile.node_of(base), tile.points.place[p]);
        let mut shift = cells.displacement(node, &d);
        let target = Lanes4(std::array::from_fn(|l| d.0[l] + shift.0[l]));
        let mut near = bodies.iter().filter(|_| tile.near_wall[usize::from(base)]);
        if near.any(|body| body.contains(node, &target, lattice)) {
            shift = Lanes4::ZERO;
        }
        shifts.push(shift);
    }
}
