//! The middle of a step: height of the gap, position of the liquid, full pores (docs/methods.md sections 3.1 and 3.3).

use std::time::Instant;

use super::Implicit;
use super::exchange::WaterExchange;
use crate::clock::Stage;
use crate::geometry::Mesh;
use crate::liquid::transport;
use crate::system::{FULL, Flow, WallCouplings, masses};

/// The state at a time within a step, from which its flow is solved.
#[derive(Clone)]
pub(super) struct MidStep {
    /// Length of the step, s, and the part of it after which this is the state: a half, or none.
    pub(super) dt: f64,
    pub(super) part: f64,
    /// The mesh and the wall couplings at the height of the gap then.
    pub(super) mesh: Mesh,
    pub(super) couplings: WallCouplings,
    /// Height of the gap at the end of the step, cells.
    pub(super) end_height: f64,
    /// Which pores are full at the start of the step, or count so.
    pub(super) full: Vec<bool>,
    /// Volume fraction of each pore.
    pub(super) fractions: Vec<f64>,
    /// Liquid volume that moves with each face.
    pub(super) masses: Vec<f64>,
    /// Factor on the viscosity by cure.
    pub(super) viscosity: f64,
    /// The water exchange, of a liquid that loses water.
    pub(super) water_loss: Option<WaterExchange>,
}

/// A void: connected pores that are not full, in a step.
pub(super) struct Void {
    pub(super) pores: Vec<u32>,
    /// Volume that flows in per time, cells/s, and free volume at the end of the step, cells; infinite where the void goes on
    /// beyond the active cells.
    pub(super) inflow: f64,
    pub(super) free: f64,
}

impl Implicit {
    /// The state a `part` into a step of `dt` (s): liquid moved by `flow` from the start of the step, the gap closed at a speed
    /// `closing`. `full` pores count as full.
    ///
    /// # Errors
    /// Where no balance of the water is found.
    pub(super) fn middle(
        &self,
        (dt, part): (f64, f64),
        closing: f64,
        flow: &Flow,
        full: Vec<bool>,
    ) -> Result<MidStep, String> {
        let begun = Instant::now();
        let end_height = self.end_height(dt, closing);
        // The flow of a film goes with a power of its height: the geometric mean has its mean flow.
        let height = match part {
            0.0 => self.height(),
            _ => (self.height() * end_height)
                .sqrt()
                .max(0.25 * self.height()),
        };
        let mesh = self.mesh.at_height(height);
        self.clock.add(Stage::Geometry, begun);
        let fractions = self.moved_fractions(part * dt, &mesh, &full, flow);
        let begun = Instant::now();
        let couplings = self.setup.channels(&mesh);
        let couplings = self.couplings.at_height(&couplings, &fractions);
        self.clock.add(Stage::Geometry, begun);
        let begun = Instant::now();
        let masses = masses(&mesh, &fractions);
        self.clock.add(Stage::Assembly, begun);
        let begun = Instant::now();
        let water_loss = self.exchange(dt, &mesh, &fractions)?;
        if water_loss.is_some() {
            self.clock.add(Stage::Water, begun);
        }
        let cure = self.setup.liquid.cure.as_ref();
        Ok(MidStep {
            dt,
            part,
            mesh,
            couplings,
            end_height,
            full,
            fractions,
            masses,
            viscosity: cure.map_or(1.0, |cure| cure.factor(self.state.time + part * dt)),
            water_loss,
        })
    }

    /// Which pores are full between steps.
    pub(super) fn full_pores(&self) -> Vec<bool> {
        let pores = self.state.volumes.iter().enumerate();
        pores
            .map(|(pore, volume)| *volume >= FULL * self.mesh.volume(pore))
            .collect()
    }

    /// The voids between `full` pores, filled by `flow` through the faces of `mesh` until the gap has the height `end`.
    pub(super) fn voids(&self, mesh: &Mesh, full: &[bool], flow: &Flow, end: f64) -> Vec<Void> {
        let void = |pores: Vec<u32>| {
            let (mut inflow, mut free) = (0.0, 0.0);
            for pore in pores.iter().map(|&pore| pore as usize) {
                free += self.capacity(pore, end) - self.state.volumes[pore];
                for neighbour in mesh.neighbours(pore).filter(|beside| full[beside.pore]) {
                    let face = neighbour.face;
                    inflow -= neighbour.sign() * mesh.area(face) * flow.velocity[face];
                }
            }
            let free = if mesh.is_cut(&pores) {
                f64::INFINITY
            } else {
                free
            };
            Void {
                pores,
                inflow,
                free,
            }
        };
        let voids = mesh.components(|pore| !full[pore]).into_iter();
        voids.map(void).collect()
    }

    /// Volume fractions after liquid between `full` pores has moved for `dt` (s) by `flow`, on a `mesh` as it is then.
    fn moved_fractions(&self, dt: f64, mesh: &Mesh, full: &[bool], flow: &Flow) -> Vec<f64> {
        let begun = Instant::now();
        let moved = match dt {
            0.0 => self.state.volumes.clone(),
            _ => {
                let liquid = [&self.state.volumes[..], &[]];
                let capacities = self.capacities(mesh.rows().height);
                transport(mesh, liquid, full, &capacities, &flow.velocity, dt).volumes
            }
        };
        self.clock.add(Stage::Transport, begun);
        let fraction = |(pore, volume): (usize, f64)| match volume / mesh.volume(pore) {
            _ if full[pore] => 1.0,
            then if then >= FULL => 1.0,
            then => then,
        };
        moved.into_iter().enumerate().map(fraction).collect()
    }

    /// Height of the gap between steps, cells.
    pub(super) fn height(&self) -> f64 {
        self.mesh.rows().height
    }

    /// Height of the gap at the end of a step of `dt` (s) at a `closing` speed (cells/s), cells.
    pub(super) fn end_height(&self, dt: f64, closing: f64) -> f64 {
        match self.setup.lattice.moving {
            Some(_) => (self.height() - dt * closing).max(0.0),
            None => self.height(),
        }
    }

    /// Volume of each pore at a height of the gap; infinite for ghost cells.
    pub(super) fn capacities(&self, height: f64) -> Vec<f64> {
        let pores = 0..self.mesh.pores.len();
        pores.map(|pore| self.capacity(pore, height)).collect()
    }

    /// Volume of a pore at a height of the gap; infinite for a ghost cell.
    fn capacity(&self, pore: usize, height: f64) -> f64 {
        match self.mesh.is_ghost(self.mesh.cell(pore)) {
            true => f64::INFINITY,
            false => self.mesh.volume_at(pore, height),
        }
    }
}
