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
mod room;
mod solve;

use physics::Failure;
use rayon::prelude::*;

use crate::collide::{Obstacle, move_points};
use crate::explicit::Explicit;
use crate::lanes::Quad;
use crate::lattice::Lattice;
use crate::real::Real;
use crate::tiles::Tile;
use cells::Cells;

/// Fraction of the density error that one projection removes.
const KAPPA: f64 = 0.5;
/// Largest relative error that counts.
const CLIP: f64 = 0.3;
/// Liquid over room from which a cell resists; below, it is air with spray.
const FULL: f64 = 0.5;
/// Open part of a cell below which it counts as wall.
const SLIVER: f64 = 0.1;
/// Longest displacement, cells.
const LONGEST: f64 = 0.25;

/// When to project.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    fn due(&mut self, cells: f64) -> bool {
        self.moved += self.speed * cells;
        let due = self.moved >= self.every;
        if due {
            self.moved = 0.0;
            self.count += 1;
        }
        due
    }
}

impl Explicit {
    /// Projects after a step of `dt` (s) if it is due.
    pub(crate) fn project(&mut self, dt: f64) -> Result<(), Failure> {
        let cell = self.scene.grid.cell_m;
        if !(self.projection.as_mut()).is_some_and(|projection| projection.due(dt / cell)) {
            return Ok(());
        }
        let mut tiles = std::mem::take(&mut self.grid.tiles);
        let here = &self.state.displacement;
        let velocities: Vec<[Real; 3]> = (self.body_velocities(0.0).iter())
            .map(|v| v.map(|v| v as Real))
            .collect();
        let bodies = self.obstacles(here, here, &velocities);
        let lattice = &self.grid.lattice;
        let mut cells = Cells::new(&tiles, lattice, &bodies);
        cells.solve();
        let fault = tiles
            .par_iter_mut()
            .map(|tile| {
                displace(tile, &cells, lattice, &bodies);
                move_points(tile, lattice, &bodies)
            })
            .reduce(|| None, |a, b| a.or(b).map(|x| b.map_or(x, |b| b.min(x))));
        self.grid.tiles = tiles;
        self.state.lost += self.grid.tiles.iter().map(|tile| tile.lost).sum::<u64>();
        self.unseen |= self.grid.deliver();
        match fault {
            Some(id) => Err(Failure(format!(
                "step {}: the density projection moved liquid point {id} to a place that is not a number: the run is unstable",
                self.state.step
            ))),
            None => Ok(()),
        }
    }
}

/// Sets the displacement of a tile's points. One that would lead into a body is left out, so
/// that the move stops no point and changes no velocity.
fn displace(tile: &mut Tile, cells: &Cells, lattice: &Lattice, bodies: &[Obstacle]) {
    for p in 0..tile.points.len() {
        let base = tile.points.base[p];
        let (node, d) = (tile.node_of(base), tile.points.place[p]);
        let mut shift = cells.displacement(node, &d);
        let target = Quad(std::array::from_fn(|l| d.0[l] + shift.0[l]));
        let blocked = tile.near_wall[usize::from(base)]
            && bodies
                .iter()
                .flat_map(|body| body.parts.iter().map(move |part| (body, part)))
                .any(|(body, part)| part.contains(node, &target, &body.to, lattice));
        if blocked {
            shift = Quad::ZERO;
        }
        tile.points.shift[p] = shift;
    }
}
