//! The trial of a step: all that its flow is solved from, iterated until it agrees with the flow (docs/methods.md section 3.1).

use std::time::Instant;

use super::compression::Compression;
use super::drive::ClampDrive;
use super::length::filled_within;
use super::mid_step::{MidStep, Void};
use super::{Implicit, Pressures};
use crate::air::Air;
use crate::clock::Stage;
use crate::geometry::Mesh;
use crate::settings::ITERATION_TOLERANCE;
use crate::system::{
    Drive, Flow, FlowField, MAX_PASSES, Problem, Unknowns, Viscosities, ViscosityIteration,
    WallCouplings, forces, solve,
};

/// Accepted excess over the free volume of voids, as a share of all flow into voids. Steps in wood with many lumens stay
/// below it and are solved once; results hardly depend on it up to 0.1.
const MAX_OVERFILL: f64 = 0.03;
/// Bound on the positions of gap and liquid that a step tries: they converge in one or two, or not at all.
const MAX_POSITIONS: usize = 6;

/// Accepted errors of the height of the gap, over that of an iteration: that at which the search ends, and one at which it may.
const POSITION_TOLERANCE: [f64; 2] = [3.0, 10.0];

/// The trial of a step. Each pass changes the parts that disagree with the flow found.
pub(super) struct Trial {
    pub(super) middle: MidStep,
    pub(super) drive: ClampDrive,
    unknowns: Unknowns,
    torn: Vec<bool>,
    pub(super) air: Option<Air>,
    viscosity: ViscosityIteration,
    /// Positions of gap and liquid tried so far.
    positions: usize,
}

/// A solved step: a trial and the flow that agrees with it.
pub(super) struct Solved {
    pub(super) trial: Trial,
    pub(super) flow: Flow,
    /// Forces on the bodies along y, over the unit of viscosity.
    pub(super) forces: Vec<f64>,
    /// Whether all parts of the trial agree with the flow, but for the air.
    pub(super) settled: bool,
    /// Whether the pockets of air obey the gas law.
    pub(super) air_settled: bool,
    /// Pressures on the bodies at its start or before, and at what time from its start, s.
    pub(super) before: (f64, Pressures),
    /// Whether the step ends the travel of the clamp.
    pub(super) ends_travel: bool,
}

impl Implicit {
    /// Solves the flow a `part` into a step of `dt` (s), with the `drive` of its start. `ahead` is the flow that moves the
    /// liquid there, `guess` that from which the solution starts.
    ///
    /// # Errors
    /// A sentence where a linear system or the water balance is not solved.
    pub(super) fn solve(
        &self,
        step: (f64, f64),
        mut drive: ClampDrive,
        ahead: &Flow,
        mut guess: Flow,
    ) -> Result<Solved, String> {
        let (dt, part) = step;
        // Liquid has the pressure of this time, air that of its volume at the end of the step.
        let begins = drive.begin(match self.setup.gas {
            Some(_) => dt,
            None => part * dt,
        });
        let cell_m = self.setup.units.cell_m;
        let started = drive.speed / cell_m;
        if begins && part > 0.0 {
            drive.speed *= self.foreseen(part * dt);
        }
        // Viscous flow is proportional to the closing speed.
        guess.scale_to_speed(drive.speed / cell_m);
        // Liquid moves to the middle by the flow half-way there.
        let closing = drive.speed / cell_m;
        let halfway = ahead.at_speed((started * closing).max(0.0).sqrt().copysign(closing));
        let middle = self.middle(step, closing, &halfway, self.full_pores())?;
        let torn = vec![false; self.mesh.pores.len()];
        let unknowns = Unknowns::new(&middle.mesh, &middle.fractions, &torn);
        let air = self.air_pockets(&unknowns, &middle.fractions, dt);
        let viscosity = self.viscosity_iteration(&middle, &guess);
        let mut trial = Trial {
            middle,
            drive,
            unknowns,
            torn,
            air,
            viscosity,
            positions: 1,
        };
        let mut flow = guess;
        let (mut forces, mut iterations) = (Vec::new(), 0);
        let (mut settled, mut air_settled) = (false, false);
        for _ in 0..MAX_PASSES {
            (flow, forces, settled) = self.solve_once(&trial, flow)?;
            iterations += flow.iterations;
            settled &= self.update_viscosity(&mut trial, &flow);
            settled &= self.update_torn(&mut trial, &flow);
            air_settled = match (&mut trial.air, self.setup.gas) {
                (Some(air), Some(gas)) => air.update_tangents(gas, &flow.pressure, dt),
                _ => true,
            };
            let pressure = self.setup.pressure(flow.force);
            let driven = trial.drive.agrees(pressure, flow.speed * cell_m);
            if !driven {
                flow.scale_to_speed(trial.drive.speed / cell_m);
            }
            settled &= driven && self.update_position(&mut trial, &flow)?;
            if settled && air_settled {
                break;
            }
        }
        flow.iterations = iterations;
        Ok(Solved {
            trial,
            flow,
            forces,
            settled,
            air_settled,
            before: (0.0, [0.0; 3]),
            ends_travel: false,
        })
    }

    /// Factor by which the closing speed under a limit is expected to change from the last flow to a `time` (s) in the next step.
    fn foreseen(&self, time: f64) -> f64 {
        /// Bound on the factor: a trend that is no trend.
        const MOST: f64 = 2.0;
        let ahead = (self.state.trend * (self.time_of_flow() + time)).exp();
        ahead.clamp(1.0 / MOST, MOST)
    }

    /// Solves once with all parts of a trial as they are, from the flow `start`. Returns the flow, the forces on the bodies,
    /// and whether compression obeys its law.
    fn solve_once(&self, trial: &Trial, mut start: Flow) -> Result<(Flow, Vec<f64>, bool), String> {
        let (setup, state, clock) = (&self.setup, &self.state, &self.clock);
        let Trial {
            middle, unknowns, ..
        } = trial;
        let (mesh, dt, full) = (&middle.mesh, middle.dt, &middle.full);
        let fronts = self.fronts(unknowns, &trial.torn, trial.air.as_ref(), middle);
        let begun = Instant::now();
        let thick = self.thickened(trial);
        clock.add(Stage::Viscosity, begun);
        let problem = Problem {
            lattice: &setup.lattice,
            mesh,
            couplings: &middle.couplings,
            edges: &self.edges,
            unknowns,
            fractions: &middle.fractions,
            masses: &middle.masses,
            viscosities: thick.as_ref().unwrap_or(&trial.viscosity.used),
            before: &state.flow.velocity,
            speed_before: state.flow.speed,
            end_height: middle.end_height,
            fronts: &fronts,
            pockets: trial.air.as_ref().map_or(&[], |air| &air.pockets),
            coefficients: setup.coefficients(dt),
        };
        let compression = Compression {
            tait: setup.liquid.tait,
            unit: setup.units.viscosity,
            mesh,
            volumes: &state.volumes,
            pressure: &state.flow.pressure,
            full,
            heights: [self.height(), middle.end_height],
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
        let drive = self.driven(&trial.drive);
        let flow = solve(
            &problem,
            excess_rate,
            drive,
            &mut start,
            &self.solver,
            clock,
        )
        .map_err(|error| self.unsolved(&error))?;
        let begun = Instant::now();
        let forces = forces(&problem, &flow, state.displacement.len());
        let holds = compression.obeys_law(&unknowns.pores, &start.pressure, &flow.pressure);
        clock.add(Stage::Forces, begun);
        Ok((flow, forces, holds))
    }

    /// How a linear solve drives the moving body.
    fn driven(&self, drive: &ClampDrive) -> Drive {
        let speed = drive.speed / self.setup.units.cell_m;
        match drive.held() {
            None => Drive::Speed(speed),
            Some(control) => Drive::Force {
                force: self.setup.force(control.limit),
                scale: self.setup.force(control.scale()),
                start_speed: speed,
            },
        }
    }

    /// The fixed-point iteration for the viscosity field, from that of the flow `start`.
    fn viscosity_iteration(&self, middle: &MidStep, start: &Flow) -> ViscosityIteration {
        let (liquid, slip) = (&self.setup.liquid, self.setup.influence_length);
        let factor = middle.viscosity / self.setup.units.viscosity;
        let used = match self.setup.is_non_newtonian() && start.dissipation > 0.0 {
            true => {
                let rates = self
                    .field((&middle.mesh, &middle.couplings), start)
                    .rates(liquid.shear_rate, slip);
                Viscosities::of(&rates, &liquid.viscosity, factor, slip)
            }
            false => Viscosities::constant(&middle.mesh, middle.viscosity),
        };
        ViscosityIteration::new(factor, slip, used)
    }

    /// The viscosities of a liquid that loses water; `None` for others.
    fn thickened(&self, trial: &Trial) -> Option<Viscosities> {
        let lost = trial.middle.water_loss.as_ref()?;
        let used = &trial.viscosity.used;
        Some(used.thickened(&trial.middle.mesh, &self.edges, &lost.factor))
    }

    /// Updates the viscosities by the flow found with them; returns whether they agree.
    fn update_viscosity(&self, trial: &mut Trial, flow: &Flow) -> bool {
        if !self.setup.is_non_newtonian() {
            return true;
        }
        let begun = Instant::now();
        let middle = &trial.middle;
        let field = self.field((&middle.mesh, &middle.couplings), flow);
        let rates = field.rates(self.setup.liquid.shear_rate, trial.viscosity.slip);
        let thick = self.thickened(trial);
        let viscosities = thick.as_ref().unwrap_or(&trial.viscosity.used);
        let slip = trial.viscosity.slip;
        let power = rates.power(viscosities, &middle.mesh, &middle.fractions, slip);
        let agrees = trial
            .viscosity
            .update(&self.setup.liquid.viscosity, rates, &power);
        self.clock.add(Stage::Viscosity, begun);
        agrees
    }

    /// Updates which pores are torn; returns whether they agree with the flow.
    fn update_torn(&self, trial: &mut Trial, flow: &Flow) -> bool {
        let Trial { middle, torn, .. } = trial;
        let changed = self.tear(&trial.unknowns, flow, middle, torn);
        if changed {
            trial.unknowns = Unknowns::new(&middle.mesh, &middle.fractions, torn);
        }
        !changed
    }

    /// Updates the position of gap and liquid by the flow found; returns whether it agrees with the one assumed.
    fn update_position(&self, trial: &mut Trial, flow: &Flow) -> Result<bool, String> {
        let middle = &trial.middle;
        if middle.part == 0.0 {
            return Ok(true);
        }
        let end = self.end_height(middle.dt, flow.speed);
        let [assumed, found] = [middle.end_height, end].map(|end| 0.5 * (self.height() + end));
        // Flow goes with the cube of the height, but another solve costs as much as a step.
        let off = match assumed > 0.0 {
            true => (found - assumed).abs() / (ITERATION_TOLERANCE * assumed),
            false => 0.0,
        };
        let voids = self.overfilled(middle, flow, end);
        if voids.is_empty() && off <= POSITION_TOLERANCE[0] {
            return Ok(true);
        }
        if trial.positions == MAX_POSITIONS {
            return Ok(off <= POSITION_TOLERANCE[1]);
        }
        // A faster clamp may fill pores that were not full before. A slower one keeps the pores that were full, or the
        // iteration would oscillate.
        let mut full = middle.full.clone();
        if found > assumed {
            let filled = middle.fractions.iter().map(|&fraction| fraction == 1.0);
            full.iter_mut()
                .zip(filled)
                .for_each(|(full, filled)| *full |= filled);
        }
        for void in &voids {
            void.pores
                .iter()
                .for_each(|&pore| full[pore as usize] = true);
        }
        trial.middle = self.middle((middle.dt, middle.part), flow.speed, flow, full)?;
        let Trial { middle, torn, .. } = &*trial;
        let unknowns = Unknowns::new(&middle.mesh, &middle.fractions, torn);
        trial.air = self.air_pockets(&unknowns, &middle.fractions, middle.dt);
        (trial.unknowns, trial.positions) = (unknowns, trial.positions + 1);
        Ok(false)
    }

    /// The voids that `flow`, found for this step, would overfill, if by more than a tolerance. Their volume balance then has
    /// to admit no more than their free volume; the excess would leave in later steps, under a spurious pressure. A void
    /// marked full by another flow might have to be filled by suction.
    fn overfilled(&self, middle: &MidStep, flow: &Flow, end: f64) -> Vec<Void> {
        // With air, voids are pockets with a pressure and do not overfill.
        if self.setup.gas.is_some() {
            return Vec::new();
        }
        let mut voids = self.voids(&middle.mesh, &middle.full, flow, end);
        // A step that a large void shortens is solved again.
        if filled_within(&voids, middle.dt).next().is_some() {
            return Vec::new();
        }
        let all: f64 = voids.iter().map(|void| void.inflow.max(0.0)).sum();
        voids.retain(|void| void.inflow * middle.dt > void.free);
        let excess: f64 = (voids.iter())
            .map(|void| void.inflow * middle.dt - void.free)
            .sum();
        if excess <= MAX_OVERFILL * all * middle.dt {
            voids.clear();
        }
        voids
    }

    /// A flow with the wall couplings and edges that it was solved with.
    pub(super) fn field<'a>(
        &'a self,
        (mesh, couplings): (&'a Mesh, &'a WallCouplings),
        flow: &'a Flow,
    ) -> FlowField<'a> {
        FlowField {
            mesh,
            couplings,
            edges: &self.edges,
            velocity: &flow.velocity,
            speed: flow.speed,
        }
    }
}
