//! Solution of the flow of a step, iterated over all that depends on it (docs/methods.md section 3.1, item 4).

use std::mem::take;
use std::time::Instant;

use super::Implicit;
use super::compression::Compression;
use super::exchange::WaterExchange;
use super::mid_step::MidStep;
use crate::air::Air;
use crate::clock::Stage;
use crate::system::{
    Drive, Flow, FlowField, MAX_PASSES, Problem, Unknowns, Viscosities, ViscosityIteration, forces,
    solve,
};

/// A solved step.
pub(super) struct Solved {
    pub(super) dt: f64,
    pub(super) flow: Flow,
    pub(super) full: Vec<bool>,
    pub(super) forces: Vec<f64>,
    /// Whether viscosity, compression and torn pores are consistent with the flow.
    pub(super) settled: bool,
    /// Pockets of air, and whether they obey the gas law.
    pub(super) air: Option<(Air, bool)>,
    /// Whether the step ends the travel of the clamp.
    pub(super) ends_travel: bool,
    /// The water exchange, of a liquid that loses water.
    pub(super) exchange: Option<WaterExchange>,
}

impl Implicit {
    /// Solves the flow with the moving body driven by `drive`. Iterates until viscosity, compression, air and torn pores are
    /// consistent with the flow.
    pub(super) fn solve_driven(
        &self,
        middle: &MidStep,
        drive: Drive,
        start: &mut Flow,
    ) -> Result<Solved, String> {
        let (setup, mesh, clock, dt) = (&self.setup, &self.mesh, &self.clock, middle.dt);
        let fractions = &middle.fractions;
        let mut torn = vec![false; mesh.pores.len()];
        let mut unknowns = Unknowns::new(mesh, fractions, &torn);
        let mut air = self.air_pockets(&unknowns, fractions, dt);
        let mut viscosity_iteration = self.viscosity_iteration(middle.viscosity, start);
        let mut flow = take(start);
        let (mut forces, mut iterations) = (Vec::new(), 0);
        let (mut settled, mut air_unsettled) = (false, false);
        for _ in 0..MAX_PASSES {
            let begun = Instant::now();
            let lost = middle.water_loss.as_ref();
            let thick = lost
                .map(|lost| (viscosity_iteration.used).thickened(mesh, &self.edges, &lost.factor));
            let viscosities = thick.as_ref().unwrap_or(&viscosity_iteration.used);
            clock.add(Stage::Viscosity, begun);
            let previous = take(&mut flow);
            let surface = (&torn[..], air.as_ref());
            let holds;
            let driven = (middle, drive);
            (flow, forces, holds) =
                self.solve_once(driven, &unknowns, viscosities, surface, previous)?;
            iterations += flow.iterations;
            let begun = Instant::now();
            settled = holds;
            if setup.is_non_newtonian() {
                let rates = self
                    .field(&flow)
                    .rates(setup.liquid.shear_rate, viscosity_iteration.slip);
                let power = rates.power(viscosities, mesh, fractions);
                settled &= viscosity_iteration.update(rates, power);
            }
            clock.add(Stage::Viscosity, begun);
            if self.tear(&unknowns, &flow, dt, &mut torn) {
                unknowns = Unknowns::new(mesh, fractions, &torn);
                settled = false;
            }
            air_unsettled = match (&mut air, setup.gas) {
                (Some(air), Some(gas)) => !air.update_tangents(gas, &flow.pressure, dt),
                _ => false,
            };
            if settled && !air_unsettled {
                break;
            }
        }
        flow.iterations = iterations;
        start.clone_from(&flow);
        Ok(Solved {
            dt,
            flow,
            full: middle.full.clone(),
            forces,
            settled,
            air: air.map(|air| (air, !air_unsettled)),
            ends_travel: false,
            exchange: middle.water_loss.clone(),
        })
    }

    /// The fixed-point iteration for the viscosity field of a step, from that of the flow `start`. `viscosity` is that of a
    /// Newtonian liquid over the unit, which is its factor by cure.
    fn viscosity_iteration(&self, viscosity: f64, start: &Flow) -> ViscosityIteration<'_> {
        let (liquid, slip) = (&self.setup.liquid, self.setup.influence_length);
        let factor = viscosity / self.setup.units.viscosity;
        let used = match self.setup.is_non_newtonian() && self.state.steps > 0 {
            true => {
                let rates = self.field(start).rates(liquid.shear_rate, slip);
                Viscosities::of(&rates, liquid, factor, slip)
            }
            false => Viscosities::constant(&self.mesh, viscosity),
        };
        ViscosityIteration::new(liquid, factor, slip, used)
    }

    /// A flow with the wall couplings and edges that it was solved with.
    pub(super) fn field<'a>(&'a self, flow: &'a Flow) -> FlowField<'a> {
        FlowField {
            mesh: &self.mesh,
            couplings: &self.couplings,
            edges: &self.edges,
            velocity: &flow.velocity,
            speed: flow.speed,
        }
    }

    /// Solves once with given viscosities, from the flow `start`. Returns the flow, the forces on the bodies, and whether
    /// compression obeys its law.
    fn solve_once(
        &self,
        (middle, drive): (&MidStep, Drive),
        unknowns: &Unknowns,
        viscosities: &Viscosities,
        (torn, air): (&[bool], Option<&Air>),
        mut start: Flow,
    ) -> Result<(Flow, Vec<f64>, bool), String> {
        let (setup, mesh, state) = (&self.setup, &self.mesh, &self.state);
        let (dt, full, fractions) = (middle.dt, &middle.full, &middle.fractions);
        let fronts = self.fronts(unknowns, torn, air, middle.viscosity, dt);
        let problem = Problem {
            lattice: &setup.lattice,
            mesh,
            couplings: &self.couplings,
            edges: &self.edges,
            unknowns,
            fractions,
            masses: &middle.masses,
            viscosities,
            before: &state.flow.velocity,
            speed_before: state.flow.speed,
            end_height: middle.end_height,
            fronts: &fronts,
            pockets: air.map_or(&[], |air| &air.pockets),
            coefficients: setup.coefficients(dt),
        };
        let compression = Compression {
            tait: setup.liquid.tait,
            unit: setup.units.viscosity,
            mesh,
            volumes: &state.volumes,
            pressure: &state.flow.pressure,
            full,
            heights: [self.height, middle.end_height],
            times: [dt, self.cell_crossing_time()],
        };
        let mut excess_rate = compression.release_rates(&unknowns.pores, &start.pressure);
        if let Some(exchange) = &middle.water_loss {
            // A full pore that loses water draws in as much liquid.
            let pores = unknowns.pores.iter().map(|&pore| pore as usize);
            for (excess_rate, pore) in excess_rate.iter_mut().zip(pores).filter(|of| full[of.1]) {
                *excess_rate += exchange.gained[pore] / dt;
            }
        }
        let (solver, clock) = (&self.solver, &self.clock);
        let flow = solve(&problem, excess_rate, drive, &mut start, solver, clock)
            .map_err(|error| self.unsolved(&error))?;
        let begun = Instant::now();
        let forces = forces(&problem, &flow, state.displacement.len());
        let holds = compression.obeys_law(&unknowns.pores, &start.pressure, &flow.pressure);
        clock.add(Stage::Forces, begun);
        Ok((flow, forces, holds))
    }
}
