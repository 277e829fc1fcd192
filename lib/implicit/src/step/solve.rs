//! Solution of a step: which pores are full, and the flow.

use std::time::Instant;

use rayon::prelude::*;

use super::Implicit;
use super::compression::Compression;
use super::failure::unsolved;
use crate::air::Air;
use crate::clock::Part;
use crate::liquid::{Held, transport};
use crate::system::{
    Drive, FULL, Flow, Pass, Problem, Rates, Unknowns, Viscosities, forces, halves, masses, solve,
    stiffnesses,
};
use crate::water::Exchange;

/// Passes in which the viscosity of the flow is sought, and its mean change, weighted by dissipation, that ends them.
const PASSES: usize = 30;
const SETTLED: f64 = 2e-3;

/// The liquid in the middle of a step.
pub(super) struct Middle {
    dt: f64,
    /// Closing speed that puts the rows there, cells/s.
    pub(super) closing: f64,
    /// Which pores are full at its start.
    full: Vec<bool>,
    /// What pores are filled to.
    fractions: Vec<f64>,
}

impl Middle {
    /// Whether more pores have a pressure than in `other`.
    pub(super) fn meets_more(&self, other: &Self) -> bool {
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

impl Implicit {
    /// Puts the rows where they are in the middle of a step of `dt` (s); which pores are full now, and what they are filled
    /// to in the middle: by a `flow`, or by the last and the speed that the clamp is asked for.
    pub(super) fn middle(&mut self, dt: f64, flow: Option<&Flow>) -> Middle {
        let height = self.height;
        let state = &self.state;
        let asked = state.drive.speed / self.setup.units.cell_m;
        let closing = flow.map_or(asked, |flow| flow.speed);
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
    pub(super) fn middle_height(&self, dt: f64, closing: f64) -> f64 {
        0.5 * (self.height + self.end_height(dt, closing))
    }

    /// The same at its end.
    fn end_height(&self, dt: f64, closing: f64) -> f64 {
        (self.height - dt * closing).max(self.least_height())
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
    pub(super) fn solve_driven(
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
        let mut used = match varies && state.steps > 0 {
            true => Viscosities::of(&rates(guess), &setup.liquid, factor, slip),
            false => Viscosities::constant(mesh, cured),
        };
        let (mut last, mut response): (Option<Pass>, f64) = (None, 0.0);
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
            let begun = Instant::now();
            let thick =
                (lost.as_ref()).map(|exchange| used.thickened(mesh, &self.edges, &exchange.factor));
            let viscosities = thick.as_ref().unwrap_or(&used);
            self.clock.add(Part::Viscosity, begun);
            let stiffnesses = stiffnesses(mesh, &halves, viscosities);
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
                viscosities,
                before: &state.flow.velocity,
                speed_before: state.flow.speed,
                end_height: end,
                fronts: &fronts,
                pockets: air.as_ref().map_or(&[], |air| &air.pockets),
                scales: setup.scales(dt),
            };
            let compression = Compression {
                tait: setup.liquid.tait,
                unit: setup.units.viscosity,
                mesh,
                state,
                full: &middle.full,
                heights: [self.height, end],
                times: [dt, self.crossing()],
            };
            let around = &solved.flow.pressure;
            let mut carried = compression.released(&unknowns.pores, around);
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
            let holds = compression.holds(&unknowns.pores, around, &flow.pressure);
            self.clock.add(Part::Forces, begun);
            let begun = Instant::now();
            solved.settled = true;
            if varies {
                let next = rates(&flow);
                let by_law = Viscosities::of(&next, &setup.liquid, factor, slip);
                let power = next.power(viscosities, mesh, fractions);
                let pass = Pass::new(used, next, power);
                solved.settled = pass.change(&by_law) < SETTLED;
                used = match &last {
                    Some(before) => {
                        response = pass.response(before, response);
                        pass.ahead(&setup.liquid, factor, slip, response)
                    }
                    None => by_law,
                };
                last = Some(pass);
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
            if solved.settled && holds && !tears && !astray {
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
