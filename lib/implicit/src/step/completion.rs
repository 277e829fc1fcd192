//! Completion of an accepted step: advects the liquid, closes the gap, moves the bodies and reports.

use std::time::Instant;

use physics::{StepLimit, StepReport};

use super::Implicit;
use super::exchange::WaterExchange;
use super::solve::Solved;
use crate::clock::Stage;
use crate::liquid::{Moved, TRACE, transport};
use crate::settings::LARGEST_CFL;
use crate::system::Flow;

/// Bound on the extrapolated growth of the flow speed from step to step. Without extrapolation every step of an accelerating
/// flow would be repeated; the growth of a flow that starts is no trend.
const MAX_FORESEEN_GROWTH: f64 = 1.25;
/// Fraction of the faces, the fastest ones, that the Courant number ignores. A larger one misplaces liquid; with none, jets
/// through holes of one voxel would set the step length.
const IGNORED_FACES: f64 = 1e-3;

impl Implicit {
    /// Completes an accepted step and returns its report.
    pub(super) fn complete_step(&mut self, solved: Solved, limit: StepLimit) -> StepReport {
        let Solved {
            dt,
            flow,
            full,
            forces,
            settled,
            air,
            ends_travel,
            exchange,
        } = solved;
        let cell_m = self.setup.units.cell_m;
        let travel = match ends_travel {
            true => self.travel_left(limit),
            false => flow.speed * dt,
        };
        self.move_liquid(travel, &flow.velocity, &full, exchange, dt);
        let state = &mut self.state;
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
        let pressure = |body: Option<usize>, sign: f64| {
            body.map_or(0.0, |body| {
                let force = match self.setup.lattice.body_speed(body) {
                    0.0 => sign * forces[body],
                    speed => -sign * speed * flow.force,
                };
                self.setup.pressure(force)
            })
        };
        let (force, travel) = (self.setup.pressure(flow.force), self.state.travel);
        self.state.drive.observe(force, dt, travel);
        let report = StepReport {
            dt_s: dt,
            closing_speed: flow.speed * cell_m,
            travel_m: travel,
            pressure_bottom: pressure(self.setup.bottom, -1.0),
            pressure_top: pressure(self.setup.top, 1.0),
            lost: (self.state.lost * self.setup.points_per_cell).round() as u64,
            iterations: flow.iterations,
        };
        self.state.flow = flow;
        if let (Some(gas), Some((air, settled))) = (self.setup.gas, air) {
            self.store_air(gas, air, settled, dt);
        }
        // Between steps no row has zero height.
        if self.setup.lattice.moving.is_some() && self.height == 0.0 {
            self.update_mesh();
        }
        report
    }

    /// Closes the gap by `travel` (cells), moves the water of `exchange`, and advects the liquid by the face `velocity` over
    /// a step of `dt` (s). `full` says which pores were full.
    fn move_liquid(
        &mut self,
        travel: f64,
        velocity: &[f64],
        full: &[bool],
        exchange: Option<WaterExchange>,
        dt: f64,
    ) {
        let begun = Instant::now();
        // Liquid moves through faces as they are in the middle of the step, into pore volumes as they are at its end.
        let middle = self.mesh.rows().height;
        if self.setup.lattice.moving.is_some() {
            let height = self.height - travel;
            self.height = if height > TRACE { height } else { 0.0 };
        }
        self.mesh.set_height(self.height);
        let capacities = self.capacities();
        self.mesh.set_height(middle);
        let state = &mut self.state;
        if let (Some(balance), Some(exchange)) = (&mut state.water, exchange) {
            balance.give_off(&exchange, dt, &mut state.volumes);
        }
        let mesh = &mut self.mesh;
        let Moved {
            volumes,
            water,
            lost: [lost, water_lost],
        } = transport(
            mesh,
            [
                &state.volumes,
                state.water.as_ref().map_or(&[], |balance| &balance.water),
            ],
            full,
            &capacities,
            velocity,
            dt,
        );
        mesh.set_height(self.height);
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

/// Flow speed for the Courant number, cells/s: that of the fastest faces but for the ignored ones, which may reach
/// [`LARGEST_CFL`] cells a step.
pub(super) fn courant_speed(flow: &Flow, cfl: f64) -> f64 {
    let mut speeds: Vec<f64> = (flow.velocity.iter())
        .filter(|v| **v != 0.0)
        .map(|v| v.abs())
        .collect();
    if speeds.is_empty() {
        return 0.0;
    }
    let at = ((1.0 - IGNORED_FACES) * (speeds.len() - 1) as f64) as usize;
    let most = speeds.iter().fold(0.0, |most: f64, &v| v.max(most));
    let (_, &mut counted, _) = speeds.select_nth_unstable_by(at, f64::total_cmp);
    counted.max(most * cfl / LARGEST_CFL)
}
