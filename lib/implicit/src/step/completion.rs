//! Completion of an accepted step: advects the liquid, closes the gap, moves the bodies and reports.

use std::time::Instant;

use physics::{StepLimit, StepReport};

use super::length::{courant_speed, filled_by};
use super::mid_step::MidStep;
use super::trial::{Solved, Trial};
use super::{Implicit, Pressures, Reference};
use crate::clock::Stage;
use crate::liquid::{Moved, TRACE, transport};

/// Bound on the extrapolated growth of the flow speed from step to step. Without extrapolation every step of an accelerating
/// flow would be repeated; the growth of a flow that starts is no trend.
const MAX_FORESEEN_GROWTH: f64 = 1.25;

impl Implicit {
    /// Completes an accepted step and returns its report.
    pub(super) fn complete_step(&mut self, solved: Solved, limit: StepLimit) -> StepReport {
        let (continues, pressures) = (self.continues(&solved), self.end_pressures(&solved));
        let middle_pressures = self.pressures(&solved.flow, &solved.forces);
        let Solved {
            trial: Trial {
                middle, drive, air, ..
            },
            flow,
            settled,
            air_settled,
            ends_travel,
            ..
        } = solved;
        let (cell_m, dt) = (self.setup.units.cell_m, middle.dt);
        let travel = match ends_travel {
            true => self.travel_left(limit),
            false => flow.speed * dt,
        };
        self.move_liquid(travel, &flow.velocity, middle);
        let state = &mut self.state;
        state.drive = drive;
        let courant_speed = courant_speed(&flow, self.setup.settings.cfl);
        state.growth = (courant_speed / state.courant_speed.max(f64::MIN_POSITIVE))
            .clamp(1.0, MAX_FORESEEN_GROWTH);
        state.courant_speed = courant_speed;
        state.unsettled += u64::from(!settled);
        state.time += dt;
        state.dt = dt;
        state.steps += 1;
        state.travel += travel * cell_m;
        self.move_bodies(travel, dt);
        let travel = self.state.travel;
        let new_stage = self.state.drive.observe(pressures[2], dt, travel);
        self.state.reference = (continues && !new_stage).then_some(Reference {
            time: -0.5 * dt,
            pressures: middle_pressures,
        });
        let report = StepReport {
            dt_s: dt,
            closing_speed: flow.speed * cell_m,
            travel_m: travel,
            pressure_bottom: pressures[0],
            pressure_top: pressures[1],
            lost: (self.state.lost * self.setup.points_per_cell).round() as u64,
            iterations: flow.iterations,
        };
        self.state.flow = flow;
        if let (Some(gas), Some(air)) = (self.setup.gas, air) {
            self.store_air(gas, air, air_settled, dt);
        }
        // Between steps no row has zero height.
        if self.setup.lattice.moving.is_some() && self.height() == 0.0 {
            self.update_mesh();
        }
        report
    }

    /// Whether the next step continues the flow of this one: no large void fills in it, or counts as full from its start.
    fn continues(&self, solved: &Solved) -> bool {
        let (middle, flow) = (&solved.trial.middle, &solved.flow);
        let voids = self.voids(&middle.mesh, &self.full_pores(), flow, middle.end_height);
        self.setup.gas.is_some() || !filled_by(&voids, middle.dt)
    }

    /// Pressures on the bodies at the end of a step.
    fn end_pressures(&self, solved: &Solved) -> Pressures {
        let dt = solved.trial.middle.dt;
        let now = self.pressures(&solved.flow, &solved.forces);
        if let Some(change) = solved.trial.drive.change_to_end(dt) {
            return now.map(|pressure| pressure + change);
        }
        match solved.reference {
            Some(reference) => reference.extrapolated((0.5 * dt, now), dt),
            None => now,
        }
    }

    /// Closes the gap by `travel` (cells), moves water between pores and walls, and advects the liquid by the face `velocity`.
    fn move_liquid(&mut self, travel: f64, velocity: &[f64], middle: MidStep) {
        let (begun, dt) = (Instant::now(), middle.dt);
        let height = match self.setup.lattice.moving {
            Some(_) if self.height() - travel > TRACE => self.height() - travel,
            Some(_) => 0.0,
            None => self.height(),
        };
        let capacities = self.capacities(height);
        let state = &mut self.state;
        if let (Some(balance), Some(exchange)) = (&mut state.water, middle.water_loss) {
            balance.give_off(&exchange, dt, &mut state.volumes);
        }
        let Moved {
            volumes,
            water,
            lost: [lost, water_lost],
        } = transport(
            // Liquid moves through faces as they are in the middle of the step, into pore volumes as they are at its end.
            &middle.mesh,
            [
                &state.volumes,
                state.water.as_ref().map_or(&[], |balance| &balance.water),
            ],
            &middle.full,
            &capacities,
            velocity,
            dt,
        );
        self.mesh = self.mesh.at_height(height);
        self.couplings = middle.couplings;
        self.clock.add(Stage::Transport, begun);
        state.volumes = volumes;
        if let Some(balance) = &mut state.water {
            balance.water = water;
            balance.left += water_lost;
        }
        state.lost += lost;
    }

    /// Moves the bodies: by the clamp's `travel` (cells), and sliding walls by their velocity over a step of `dt` (s).
    fn move_bodies(&mut self, travel: f64, dt: f64) {
        let (lattice, cell_m) = (&self.setup.lattice, self.setup.units.cell_m);
        for (body, displacement) in self.state.displacement.iter_mut().enumerate() {
            let [x, _, z] = lattice.slide[body].map(|v| v * dt);
            let moved = [x, lattice.body_speed(body) * travel, z];
            for a in 0..3 {
                displacement[a] += moved[a] * cell_m;
            }
        }
    }
}
