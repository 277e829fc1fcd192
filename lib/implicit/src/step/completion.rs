//! Completion of an accepted step: advects the liquid, closes the gap, moves the bodies and reports.

use std::time::Instant;

use physics::{Failure, StepLimit, StepReport};

use super::length::{courant_speed, filled_by};
use super::mid_step::MidStep;
use super::trial::{Solved, Trial};
use super::{FlowOf, Implicit, Pressures};
use crate::clock::Stage;
use crate::liquid::{Moved, TRACE, transport};

/// Bound on the extrapolated growth of the flow speed from step to step. Without extrapolation every step of an accelerating
/// flow would be repeated; the growth of a flow that starts is no trend.
const MAX_FORESEEN_GROWTH: f64 = 1.25;

/// Pressures at a `time`, in proportion to those at two times before.
fn extrapolated(
    (then, before): (f64, Pressures),
    (now, pressures): (f64, Pressures),
    time: f64,
) -> Pressures {
    std::array::from_fn(|i| {
        let growth = pressures[i] / before[i];
        match growth > 1.0 / MOST_GROWTH && growth < MOST_GROWTH {
            true => pressures[i] * growth.powf((time - now) / (now - then)),
            false => pressures[i],
        }
    })
}

/// Rate of change of the logarithm of a speed that changes between two values in a `time` (s), 1/s.
fn trend([before, now]: [f64; 2], time: f64) -> f64 {
    match before > 0.0 && now > 0.0 && time > 0.0 {
        true => (now / before).ln() / time,
        false => 0.0,
    }
}

/// Steps at the start of a run whose last pressures tell nothing of the next.
const STARTING: u64 = 2;
/// Ratio of two pressures that is a jump, not a trend.
const MOST_GROWTH: f64 = 2.0;

impl Implicit {
    /// Completes an accepted step and returns its report.
    pub(super) fn complete_step(
        &mut self,
        solved: Solved,
        limit: StepLimit,
    ) -> Result<StepReport, Failure> {
        let continues = self.continues(&solved, limit);
        let mut pressures = self.pressures(&solved.flow, &solved.forces);
        let (middle_pressures, before) = (pressures, solved.before);
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
        state.steps += 1;
        state.travel += travel * cell_m;
        self.move_bodies(travel, dt);
        if let (Some(gas), Some(air)) = (self.setup.gas, air) {
            self.store_air(gas, air, air_settled, &flow, dt);
        }
        let (closing_speed, mut iterations) = (flow.speed * cell_m, flow.iterations);
        let (middle_speed, since) = (flow.speed, self.time_of_flow());
        // A gap without height has no flow.
        let closed = self.setup.lattice.moving.is_some() && self.height() == 0.0;
        if continues || closed || self.setup.lattice.moving.is_none() {
            let state = &mut self.state;
            pressures = match state.drive.change_to_end(dt) {
                Some(change) => pressures.map(|pressure| pressure + change),
                None => extrapolated(before, (0.5 * dt, pressures), dt),
            };
            state.trend = trend([state.flow.speed, middle_speed], since + 0.5 * dt);
            (state.flow, state.flow_of, state.pressures) =
                (flow, FlowOf::LastStep, middle_pressures);
        } else {
            // Velocities before the step stay those that inertia starts from.
            self.state.flow.pressure.clone_from(&flow.pressure);
            let drive = self.state.drive.clone();
            let solved = self
                .solve((dt, 0.0), drive, &flow, flow.clone())
                .map_err(|why| self.failure(&why))?;
            pressures = self.pressures(&solved.flow, &solved.forces);
            iterations += solved.flow.iterations;
            let state = &mut self.state;
            state.trend = trend([middle_speed, solved.flow.speed], 0.5 * dt);
            state.drive = solved.trial.drive;
            (state.flow, state.flow_of, state.pressures) = (solved.flow, FlowOf::Now, pressures);
        }
        let state = &mut self.state;
        state.dt = dt;
        if state.drive.observe(pressures[2], dt, state.travel) || closed {
            state.flow_of = FlowOf::Earlier;
        }
        let report = StepReport {
            dt_s: dt,
            closing_speed,
            travel_m: state.travel,
            pressure_bottom: pressures[0],
            pressure_top: pressures[1],
            lost: (state.lost * self.setup.points_per_cell).round() as u64,
            iterations,
        };
        // Between steps no row has zero height.
        if closed {
            self.update_mesh();
        }
        Ok(report)
    }

    /// Time since the one whose flow the state has, s.
    pub(super) fn time_of_flow(&self) -> f64 {
        match self.state.flow_of {
            FlowOf::Now => 0.0,
            _ => 0.5 * self.state.dt,
        }
    }

    /// Whether the next step continues the flow of this one, and the pressure at its end follows from those before: it is not one
    /// of the first or the last at full speed, and no large void fills in it.
    fn continues(&self, solved: &Solved, limit: StepLimit) -> bool {
        let (middle, flow) = (&solved.trial.middle, &solved.flow);
        let ends = solved.ends_travel || middle.dt >= limit.time_s * (1.0 - 1e-12);
        let free = solved.trial.drive.change_to_end(middle.dt).is_none();
        if free && (ends || self.state.steps < STARTING) {
            return false;
        }
        let voids = self.voids(&middle.mesh, &self.full_pores(), flow, middle.end_height);
        self.setup.gas.is_some() || !filled_by(&voids, middle.dt)
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
