//! The middle of a step: height of the gap, position of the liquid, full pores (docs/methods.md sections 3.1 and 3.3).

use std::time::Instant;

use super::Implicit;
use super::exchange::WaterExchange;
use crate::clock::Stage;
use crate::liquid::transport;
use crate::system::{FULL, Flow, masses};

/// Accepted excess over the free volume of voids, as a share of all flow into voids. Steps in wood with many lumens stay
/// below it and are solved once; results hardly depend on it up to 0.1.
const MAX_OVERFILL: f64 = 0.03;

/// State in the middle of a step, shared by all solves from it.
pub(super) struct MidStep {
    pub(super) dt: f64,
    /// Closing speed that sets the gap's height, cells/s, and the height of the gap at the end of the step by it, cells.
    pub(super) closing_speed: f64,
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

impl MidStep {
    /// Whether some pore is full here that is not in `other`.
    pub(super) fn has_more_full_pores(&self, other: &Self) -> bool {
        let both = self.fractions.iter().zip(&other.fractions);
        both.into_iter()
            .any(|(&here, &there)| here == 1.0 && there < 1.0)
    }
}

impl Implicit {
    /// Moves the rows and the liquid to the middle of a step of `dt` (s): by `flow`, or by the last step's flow and the
    /// drive's speed. Voids that `flow` would fill count as full, as do pores that were full `before`, in an earlier
    /// estimate of the middle.
    pub(super) fn middle(&mut self, dt: f64, flow: Option<&Flow>, before: &[bool]) -> MidStep {
        let asked = self.state.drive.speed / self.setup.units.cell_m;
        let closing = flow.map_or(asked, |flow| flow.speed);
        let mut full: Vec<bool> = (self.state.volumes.iter().enumerate())
            .map(|(pore, volume)| *volume >= FULL * self.mesh.volume_at(pore, self.height))
            .collect();
        for (full, before) in full.iter_mut().zip(before) {
            *full |= before;
        }
        let closes = self.setup.lattice.moving.is_some();
        if closes {
            self.mesh.set_height(self.middle_height(dt, closing));
        }
        let end = self.end_height(dt, closing);
        if let Some(flow) = flow {
            self.fill_voids(dt, end, &mut full, flow);
        }
        let fractions = self.mid_fractions(dt, &full, flow);
        let begun = Instant::now();
        if closes {
            let channels = self.setup.channels(&self.mesh);
            self.couplings.measure(&channels, &fractions);
        }
        self.clock.add(Stage::Geometry, begun);
        let begun = Instant::now();
        let masses = masses(&self.mesh, &fractions);
        self.clock.add(Stage::Assembly, begun);
        let cure = self.setup.liquid.cure.as_ref();
        MidStep {
            dt,
            closing_speed: closing,
            end_height: end,
            full,
            fractions,
            masses,
            viscosity: cure.map_or(1.0, |cure| cure.factor(self.state.time + 0.5 * dt)),
            water_loss: None,
        }
    }

    /// Solves the water balance for a `middle` of the step.
    pub(super) fn find_water_loss(&mut self, middle: &mut MidStep) -> Result<(), String> {
        let begun = Instant::now();
        middle.water_loss = self.exchange(middle.dt, &middle.fractions)?;
        if middle.water_loss.is_some() {
            self.clock.add(Stage::Water, begun);
        }
        Ok(())
    }

    /// Marks as `full` the pores of each void (connected pores that are not full) that `flow`, found for a step of `dt` (s),
    /// would overfill. Their volume balance then admits no more than their free volume at the gap's height `end`; the excess
    /// would have to leave in later steps, under a spurious pressure. Returns the excess over all flow into voids. `flow`
    /// must be that of this step: a void marked full by another flow might have to be filled by suction.
    fn fill_voids(&self, dt: f64, end: f64, full: &mut [bool], flow: &Flow) -> f64 {
        // With air, voids are pockets with a pressure and do not overfill.
        if self.setup.gas.is_some() {
            return 0.0;
        }
        let (mesh, volumes) = (&self.mesh, &self.state.volumes);
        let (mut excess, mut all) = (0.0, f64::MIN_POSITIVE);
        for void in mesh.components(|pore| !full[pore]) {
            let (mut inflow, mut free) = (0.0, 0.0);
            for pore in void.iter().map(|&pore| pore as usize) {
                free += self.capacity(pore, end) - volumes[pore];
                for neighbour in mesh
                    .neighbours(pore)
                    .filter(|neighbour| full[neighbour.pore])
                {
                    inflow -= neighbour.sign()
                        * mesh.area(neighbour.face)
                        * flow.velocity[neighbour.face]
                        * dt;
                }
            }
            all += inflow.max(0.0);
            // A void that goes on beyond the active cells has more room than they show.
            if inflow > free && !mesh.is_cut(&void) {
                excess += inflow - free;
                void.iter().for_each(|&pore| full[pore as usize] = true);
            }
        }
        excess / all
    }

    /// Volume fractions in the middle of a step of `dt` (s), by `flow` or that of the last step. `full` says which pores are
    /// full at the start.
    fn mid_fractions(&mut self, dt: f64, full: &[bool], flow: Option<&Flow>) -> Vec<f64> {
        let begun = Instant::now();
        let (state, mesh) = (&self.state, &self.mesh);
        let velocity = &flow.unwrap_or(&state.flow).velocity;
        let moved = match state.steps {
            0 => state.volumes.clone(),
            _ => {
                let liquid = [&state.volumes[..], &[]];
                transport(mesh, liquid, full, &self.capacities(), velocity, 0.5 * dt).volumes
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

    /// Height of the gap in the middle of a step of `dt` (s) at a `closing` speed (cells/s), cells.
    pub(super) fn middle_height(&self, dt: f64, closing: f64) -> f64 {
        0.5 * (self.height + self.end_height(dt, closing))
    }

    /// Height of the gap at the end of the step, cells.
    fn end_height(&self, dt: f64, closing: f64) -> f64 {
        (self.height - dt * closing).max(0.0)
    }

    /// Volume of each pore at the mesh's current gap height; infinite for ghost cells.
    pub(super) fn capacities(&self) -> Vec<f64> {
        let height = self.mesh.rows().height;
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

    /// Whether a flow that was solved from `middle` overfills voids.
    pub(super) fn overfills(&self, middle: &MidStep, flow: &Flow) -> bool {
        let end = self.end_height(middle.dt, flow.speed);
        self.fill_voids(middle.dt, end, &mut middle.full.clone(), flow) > MAX_OVERFILL
    }
}
