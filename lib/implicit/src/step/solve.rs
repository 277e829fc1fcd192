//! Solution of a step: which pores are full, the flow, the clamp's speed, and the length that ends its travel.

use std::time::Instant;

use physics::StepLimit;
use rayon::prelude::*;

use super::Implicit;
use super::drive::Asked;
use super::failure::unsolved;
use crate::air::Air;
use crate::clock::Part;
use crate::liquid::{Held, transport};
use crate::system::{
    Drive, FULL, Flow, Problem, Rates, Unknowns, Viscosities, forces, halves, masses, solve,
    stiffnesses,
};
use crate::water::Exchange;

/// Part of the travel that is left from which on a step that covers it is made to end it.
const NEAR: f64 = 0.7;
/// Part of it by which a step may miss the end and still is there, or the rest would be taken in ever smaller steps, and
/// solves that bring it nearer: a held speed settles in one or two where it settles at all.
const MISSED: f64 = 1e-3;
/// Travel, cells, that counts as none: surfaces of voxels are known less well, and a film under a pressure never ends.
const NOTHING: f64 = 1e-2;
const CLOSER: usize = 4;
/// Solves of a step in which a clamp under a pressure comes to the speed at which it meets liquid.
const MEETINGS: usize = 4;
/// Passes in which the viscosity of the flow is sought, and its mean change, weighted by dissipation, that ends them.
const PASSES: usize = 20;
const SETTLED: f64 = 2e-3;

/// The liquid in the middle of a step.
struct Middle {
    dt: f64,
    /// Closing speed that puts the rows there, cells/s.
    closing: f64,
    /// Which pores are full at its start.
    full: Vec<bool>,
    /// What pores are filled to.
    fractions: Vec<f64>,
}

impl Middle {
    /// Whether more pores have a pressure than in `other`.
    fn meets_more(&self, other: &Self) -> bool {
        let both = self.fractions.iter().zip(&other.fractions);
        both.into_iter()
            .any(|(&here, &there)| here == 1.0 && there < 1.0)
    }
}

/// A step that was solved.
pub(super) struct Solved {
    pub(super) dt: f64,
    pub(super) flow: Flow,
    pub(super) full: Vec<bool>,
    pub(super) forces: Vec<f64>,
    /// Whether the viscosity is that of the flow.
    pub(super) settled: bool,
    /// The air that is closed off, and whether it has the pressures of its volumes.
    pub(super) air: Option<(Air, bool)>,
    /// Whether the step ends the travel of the clamp.
    pub(super) arrives: bool,
    /// Of a liquid that loses water: what it loses.
    pub(super) exchange: Option<Exchange>,
}

/// Length of the step that goes as far as `left`, of lengths and speeds of the last one and the one `before`: speeds are linear
/// in the length.
fn arrival(left: f64, [dt, speed]: [f64; 2], before: Option<[f64; 2]>) -> f64 {
    let slope = before.map_or(0.0, |[other, slower]| (speed - slower) / (dt - other));
    let first = speed - slope * dt;
    let end = 2.0 * left / (first + (first * first + 4.0 * slope * left).sqrt());
    if end > 0.0 && end.is_finite() {
        end
    } else {
        left / speed
    }
}

impl Implicit {
    /// Solves the flow of a step of `dt` (s), of another length, `longest` at most, where the clamp comes to the end of its
    /// travel. Each solution begins from `guess`, and leaves its flow there.
    pub(super) fn solve(
        &mut self,
        dt: f64,
        limit: StepLimit,
        longest: f64,
        guess: &mut Flow,
    ) -> Result<Solved, String> {
        let left = self.left(limit);
        let mut solved = self.solve_controlled(dt, guess)?;
        if left == f64::INFINITY || left == 0.0 {
            return Ok(solved);
        }
        // The clamp's speed under load is known only then: the step ends the travel when it is that of its own length.
        let mut before = None;
        for _ in 0..CLOSER {
            let now = [solved.dt, solved.flow.speed];
            let reach = now[0] * now[1];
            let end = arrival(left, now, before.replace(now));
            if reach < NEAR * left || (reach / left - 1.0).abs() <= MISSED || end > longest {
                break;
            }
            solved = self.solve_controlled(end, guess)?;
        }
        let reach = solved.flow.speed * solved.dt;
        if reach > left + (MISSED * left).max(NOTHING) {
            let dt = solved.dt;
            let middle = self.middle(dt, Some(&solved.flow));
            solved = self.solve_driven(&middle, Drive::Speed(left / dt), guess)?;
        }
        let reach = solved.flow.speed * solved.dt;
        solved.arrives = (reach - left).abs() <= (MISSED * left).max(NOTHING);
        Ok(solved)
    }

    /// Travel that is left, cells: the gap at most.
    pub(super) fn left(&self, limit: StepLimit) -> f64 {
        let travel = limit.travel_m / self.setup.units.cell_m;
        match self.setup.lattice.moving {
            Some(_) => travel.min(self.height),
            None => travel,
        }
    }

    /// Solves the flow of a step of `dt` (s) with the clamp at full speed, or at the speed of its pressure limit.
    fn solve_controlled(&mut self, dt: f64, guess: &mut Flow) -> Result<Solved, String> {
        self.state.drive.aim(dt);
        let mut middle = self.middle(dt, None);
        // A clamp that goes faster than in the last step may meet liquid that it would not have met.
        for _ in 1..MEETINGS {
            let solved = self.solve_middle(&middle, guess)?;
            if solved.flow.speed <= middle.closing {
                return Ok(solved);
            }
            let faster = self.middle(dt, Some(&solved.flow));
            if !faster.meets_more(&middle) {
                self.mesh.set_height(self.middle_height(dt, middle.closing));
                return Ok(solved);
            }
            middle = faster;
        }
        self.solve_middle(&middle, guess)
    }

    /// The same with the liquid in the `middle` of the step as it is.
    fn solve_middle(&mut self, middle: &Middle, guess: &mut Flow) -> Result<Solved, String> {
        if let Some(asked) = self.state.drive.held() {
            return self.solve_held(middle, asked, guess);
        }
        let full = Drive::Speed(self.state.drive.speed / self.setup.units.cell_m);
        let free = self.solve_driven(middle, full, guess)?;
        let pressure = self.setup.pressure(free.flow.force);
        match self.state.drive.exceeded(pressure) {
            Some(asked) => self.solve_held(middle, asked, guess),
            None => Ok(free),
        }
    }

    /// The same under a pressure on the clamp, at the nearest speed that it can follow.
    fn solve_held(
        &mut self,
        middle: &Middle,
        asked: Asked,
        guess: &mut Flow,
    ) -> Result<Solved, String> {
        let cell_m = self.setup.units.cell_m;
        // Viscous flow is in proportion to the speed that drives it.
        guess.speed_up(self.state.drive.speed / cell_m);
        let drive = Drive::Force {
            force: self.setup.force(asked.limit),
            scale: self.setup.force(asked.limit.max(asked.least)),
            guess: self.state.drive.speed / cell_m,
        };
        let solved = self.solve_driven(middle, drive, guess)?;
        match self.state.drive.follow(solved.flow.speed * cell_m) {
            true => Ok(solved),
            false => {
                let drive = Drive::Speed(self.state.drive.speed / cell_m);
                self.solve_driven(middle, drive, guess)
            }
        }
    }

    /// Puts the rows where they are in the middle of a step of `dt` (s); which pores are full now, and what they are filled
    /// to in the middle, by a `flow`, or the last.
    fn middle(&mut self, dt: f64, flow: Option<&Flow>) -> Middle {
        let height = self.height;
        let state = &self.state;
        let closing = flow.unwrap_or(&state.flow).speed;
        let full: Vec<bool> = (0..self.mesh.pores.len())
            .map(|pore| state.volumes[pore] >= FULL * self.mesh.volume_at(pore, height))
            .collect();
        if self.setup.lattice.moving.is_some() {
            self.mesh.set_height(self.middle_height(dt, closing));
        }
        let begun = Instant::now();
        let mesh = &self.mesh;
        let moved = if state.steps == 0 {
            state.volumes.clone()
        } else {
            transport(
                mesh,
                Held {
                    volumes: &state.volumes,
                    water: &[],
                },
                &full,
                &self.capacities(),
                &flow.unwrap_or(&state.flow).velocity,
                0.5 * dt,
            )
            .volumes
        };
        self.clock.add(Part::Transport, begun);
        let fractions: Vec<f64> = (0..mesh.pores.len())
            .map(|pore| match moved[pore] / mesh.volume(pore) {
                _ if full[pore] => 1.0,
                then if then >= FULL => 1.0,
                then => then,
            })
            .collect();
        let begun = Instant::now();
        if self.setup.lattice.moving.is_some() {
            (self.setup).measure(&mut self.links, &self.mesh, &fractions);
        }
        self.clock.add(Part::Geometry, begun);
        Middle {
            dt,
            closing,
            full,
            fractions,
        }
    }

    /// Height of the gap in the middle of a step of `dt` (s) at a `closing` speed (cells/s), cells.
    fn middle_height(&self, dt: f64, closing: f64) -> f64 {
        0.5 * (self.height + self.end_height(dt, closing))
    }

    /// The same at its end.
    fn end_height(&self, dt: f64, closing: f64) -> f64 {
        (self.height - dt * closing).max(self.least_height())
    }

    /// Least height of the gap, cells: in a programme a film stays, by which liquid pushes the bodies apart where a stage
    /// lets it.
    pub(super) fn least_height(&self) -> f64 {
        match self.state.drive.programme() {
            Some(_) => NOTHING,
            None => 0.0,
        }
    }

    /// What each pore can hold: without end beyond open sides.
    pub(super) fn capacities(&self) -> Vec<f64> {
        let mesh = &self.mesh;
        (0..mesh.pores.len())
            .into_par_iter()
            .map(
                |pore| match mesh.is_beyond(mesh.pores[pore].cell as usize) {
                    true => f64::INFINITY,
                    false => mesh.volume(pore),
                },
            )
            .collect()
    }

    /// Solves with the body that closes the gap driven so: in passes where the viscosity depends on the flow, until that
    /// no longer changes.
    fn solve_driven(
        &mut self,
        middle: &Middle,
        drive: Drive,
        guess: &mut Flow,
    ) -> Result<Solved, String> {
        let Middle { fractions, .. } = middle;
        let dt = middle.dt;
        let begun = Instant::now();
        let lost = self.exchange(dt, fractions)?;
        if lost.is_some() {
            self.clock.add(Part::Water, begun);
        }
        let begun = Instant::now();
        let (setup, mesh, state) = (&self.setup, &self.mesh, &self.state);
        let mut torn = self.untorn();
        let mut unknowns = Unknowns::new(mesh, fractions, &torn);
        let mut air = self.closed_off(&unknowns, fractions, dt);
        let halves = halves(mesh, fractions);
        let masses = masses(mesh, &halves);
        let end = self.end_height(dt, middle.closing);
        let thickened = |viscosities: Viscosities| match &lost {
            Some(exchange) => viscosities.thickened(mesh, &self.edges, &exchange.factor),
            None => viscosities,
        };
        self.clock.add(Part::Assembly, begun);
        let begun = Instant::now();
        let cured = setup.viscosity_at(state.time + 0.5 * dt);
        let factor = cured / setup.units.viscosity;
        let varies = setup.varies();
        let slip = setup.influence_length();
        let rates = |flow: &Flow| {
            let convention = (setup.liquid.shear_rate, slip);
            Rates::of(
                mesh,
                &self.links,
                &self.edges,
                &flow.velocity,
                flow.speed,
                convention,
            )
        };
        let mut viscosities = match varies && state.steps > 0 {
            true => Viscosities::of(&rates(guess), &setup.liquid, factor, slip),
            false => Viscosities::constant(mesh, cured),
        };
        viscosities = thickened(viscosities);
        self.clock.add(Part::Viscosity, begun);
        let mut solved = Solved {
            dt,
            full: middle.full.clone(),
            forces: Vec::new(),
            settled: false,
            air: None,
            arrives: false,
            exchange: None,
            flow: std::mem::take(guess),
        };
        let (mut iterations, mut astray) = (0, false);
        for _ in 0..PASSES {
            let stiffnesses = stiffnesses(mesh, &halves, &viscosities);
            let fronts = self.fronts(&unknowns, &torn, air.as_ref(), cured, dt);
            let problem = Problem {
                lattice: &setup.lattice,
                mesh,
                links: &self.links,
                edges: &self.edges,
                unknowns: &unknowns,
                fractions,
                halves: &halves,
                masses: &masses,
                stiffnesses: &stiffnesses,
                viscosities: &viscosities,
                before: &state.flow.velocity,
                speed_before: state.flow.speed,
                end_height: end,
                fronts: &fronts,
                pockets: air.as_ref().map_or(&[], |air| &air.pockets),
                scales: setup.scales(dt),
            };
            let heights = [self.height, end];
            let mut carried = setup.carried(
                mesh,
                &unknowns,
                state,
                &solved.full,
                heights,
                [dt, self.asked()],
            );
            if let Some(exchange) = &lost {
                exchange.add_to(&unknowns.pores, &solved.full, dt, &mut carried);
            }
            let flow = solve(
                &problem,
                &carried,
                drive,
                &solved.flow,
                &mut self.solver,
                &mut self.clock,
            )
            .map_err(|error| unsolved(&error))?;
            iterations += flow.iterations;
            let begun = Instant::now();
            solved.forces = forces(&problem, &flow, state.displacement.len());
            self.clock.add(Part::Forces, begun);
            let begun = Instant::now();
            solved.settled = true;
            if varies {
                let next = rates(&flow);
                let changed = thickened(Viscosities::of(&next, &setup.liquid, factor, slip));
                solved.settled = viscosities.change(&changed, &next, mesh, fractions) < SETTLED;
                viscosities = changed;
            }
            self.clock.add(Part::Viscosity, begun);
            let tears = self.tear(&unknowns, &flow, dt, &mut torn);
            if tears {
                unknowns = Unknowns::new(mesh, fractions, &torn);
            }
            solved.flow = flow;
            astray = match (&mut air, setup.gas) {
                (Some(air), Some(gas)) => !air.settle(gas, &solved.flow.pressure, dt),
                _ => false,
            };
            if solved.settled && !tears && !astray {
                break;
            }
        }
        solved.flow.iterations = iterations;
        solved.air = air.map(|air| (air, !astray));
        solved.exchange = lost;
        guess.clone_from(&solved.flow);
        Ok(solved)
    }
}
