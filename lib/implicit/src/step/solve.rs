//! Solution of a step: which pores are full, and the flow.

use std::mem::take;
use std::time::Instant;

use super::Implicit;
use super::compression::Compression;
use super::exchange::Exchange;
use crate::air::Air;
use crate::clock::{Clock, Stage};
use crate::liquid::transport;
use crate::system::{
    Drive, FULL, Flow, FlowField, PASSES, Problem, Search, Unknowns, Viscosities, forces, halves,
    masses, solve, stiffnesses,
};

/// The liquid in the middle of a step, and what all solutions have in common that begin there.
pub(super) struct Middle {
    dt: f64,
    /// Closing speed that puts the rows there, cells/s, and the height of the gap at the end of the step by it, cells.
    pub(super) closing: f64,
    end: f64,
    /// Which pores are full at its start.
    full: Vec<bool>,
    /// What pores are filled to.
    fractions: Vec<f64>,
    /// Liquid in the halves of each face, and its volume.
    halves: Vec<[f64; 2]>,
    masses: Vec<f64>,
    /// Factor of the viscosity by cure.
    viscosity: f64,
    /// Of a liquid that loses water: what it loses.
    lost: Option<Exchange>,
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
    /// Whether viscosity, compression and torn pores are those of the flow.
    pub(super) settled: bool,
    /// The air that is closed off, and whether it has the pressures of its volumes.
    pub(super) air: Option<(Air, bool)>,
    /// Whether the step ends the travel of the clamp.
    pub(super) arrives: bool,
    /// Of a liquid that loses water: what it loses.
    pub(super) exchange: Option<Exchange>,
}

impl Implicit {
    /// Puts the rows where they are in the middle of a step of `dt` (s), and the liquid: by a `flow`, or by the last and the speed
    /// that the clamp is asked for.
    pub(super) fn middle(&mut self, dt: f64, flow: Option<&Flow>) -> Middle {
        let asked = self.state.drive.speed / self.setup.units.cell_m;
        let closing = flow.map_or(asked, |flow| flow.speed);
        let full: Vec<bool> = (self.state.volumes.iter().enumerate())
            .map(|(pore, volume)| *volume >= FULL * self.mesh.volume_at(pore, self.height))
            .collect();
        let closes = self.setup.lattice.moving.is_some();
        if closes {
            self.mesh.set_height(self.middle_height(dt, closing));
        }
        let fractions = self.filled(dt, &full, flow);
        let begun = Instant::now();
        if closes {
            let channels = self.setup.channels(&self.mesh);
            self.links.measure(&channels, &fractions);
        }
        self.clock.add(Stage::Geometry, begun);
        let begun = Instant::now();
        let halves = halves(&self.mesh, &fractions);
        let masses = masses(&self.mesh, &halves);
        self.clock.add(Stage::Assembly, begun);
        let cure = self.setup.liquid.cure.as_ref();
        Middle {
            dt,
            closing,
            end: self.end_height(dt, closing),
            full,
            fractions,
            halves,
            masses,
            viscosity: cure.map_or(1.0, |cure| cure.factor(self.state.time + 0.5 * dt)),
            lost: None,
        }
    }

    /// Finds what liquid loses in a `middle` that is solved.
    pub(super) fn dry(&mut self, middle: &mut Middle) -> Result<(), String> {
        let begun = Instant::now();
        middle.lost = self.exchange(middle.dt, &middle.fractions)?;
        if middle.lost.is_some() {
            self.clock.add(Stage::Water, begun);
        }
        Ok(())
    }

    /// What pores are filled to in the middle of a step of `dt` (s), those `full` at its start and others, by a `flow` or the last.
    fn filled(&mut self, dt: f64, full: &[bool], flow: Option<&Flow>) -> Vec<f64> {
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

    /// The same at its end.
    fn end_height(&self, dt: f64, closing: f64) -> f64 {
        (self.height - dt * closing).max(0.0)
    }

    /// What each pore can hold: without end beyond open sides.
    pub(super) fn capacities(&self) -> Vec<f64> {
        let mesh = &self.mesh;
        let capacity = |pore: usize| match mesh.is_beyond(mesh.cell(pore)) {
            true => f64::INFINITY,
            false => mesh.volume(pore),
        };
        (0..mesh.pores.len()).map(capacity).collect()
    }

    /// Solves with the body that closes the gap driven so, in passes: until viscosity, compression, air and torn pores are
    /// those of the flow.
    pub(super) fn solve_driven(
        &mut self,
        middle: &Middle,
        drive: Drive,
        guess: &mut Flow,
    ) -> Result<Solved, String> {
        let mut clock = take(&mut self.clock);
        let solved = self.in_passes(middle, drive, guess, &mut clock);
        self.clock = clock;
        solved
    }

    fn in_passes(
        &self,
        middle: &Middle,
        drive: Drive,
        guess: &mut Flow,
        clock: &mut Clock,
    ) -> Result<Solved, String> {
        let (setup, mesh, dt) = (&self.setup, &self.mesh, middle.dt);
        let fractions = &middle.fractions;
        let mut torn = vec![false; mesh.pores.len()];
        let mut unknowns = Unknowns::new(mesh, fractions, &torn);
        let mut air = self.closed_off(&unknowns, fractions, dt);
        let mut search = self.search(middle.viscosity, guess);
        let mut flow = take(guess);
        let (mut forces, mut iterations) = (Vec::new(), 0);
        let (mut settled, mut astray) = (false, false);
        for _ in 0..PASSES {
            let begun = Instant::now();
            let lost = middle.lost.as_ref();
            let thick = lost.map(|lost| (search.used).thickened(mesh, &self.edges, &lost.factor));
            let viscosities = thick.as_ref().unwrap_or(&search.used);
            clock.add(Stage::Viscosity, begun);
            let last = take(&mut flow);
            let ends = (&torn[..], air.as_ref());
            let holds;
            let driven = (middle, drive);
            (flow, forces, holds) =
                self.solve_pass(driven, &unknowns, viscosities, ends, &last, clock)?;
            iterations += flow.iterations;
            let begun = Instant::now();
            settled = holds;
            if setup.varies() {
                let rates = self
                    .field(&flow)
                    .rates(setup.liquid.shear_rate, search.slip);
                let power = rates.power(viscosities, mesh, fractions);
                settled &= search.go_on(rates, power);
            }
            clock.add(Stage::Viscosity, begun);
            if self.tear(&unknowns, &flow, dt, &mut torn) {
                unknowns = Unknowns::new(mesh, fractions, &torn);
                settled = false;
            }
            astray = match (&mut air, setup.gas) {
                (Some(air), Some(gas)) => !air.settle(gas, &flow.pressure, dt),
                _ => false,
            };
            if settled && !astray {
                break;
            }
        }
        flow.iterations = iterations;
        guess.clone_from(&flow);
        Ok(Solved {
            dt,
            flow,
            full: middle.full.clone(),
            forces,
            settled,
            air: air.map(|air| (air, !astray)),
            arrives: false,
            exchange: middle.lost.clone(),
        })
    }

    /// The search for the viscosity of the flow of a step, which begins with that of the flow `guess`; `viscosity` is that of
    /// no flow.
    fn search(&self, viscosity: f64, guess: &Flow) -> Search<'_> {
        let (liquid, slip) = (&self.setup.liquid, self.setup.influence_length);
        let factor = viscosity / self.setup.units.viscosity;
        let used = match self.setup.varies() && self.state.steps > 0 {
            true => {
                let rates = self.field(guess).rates(liquid.shear_rate, slip);
                Viscosities::of(&rates, liquid, factor, slip)
            }
            false => Viscosities::constant(&self.mesh, viscosity),
        };
        Search::new(liquid, factor, slip, used)
    }

    /// A flow with the friction of the middle of the step.
    pub(super) fn field<'a>(&'a self, flow: &'a Flow) -> FlowField<'a> {
        FlowField {
            mesh: &self.mesh,
            links: &self.links,
            edges: &self.edges,
            velocity: &flow.velocity,
            speed: flow.speed,
        }
    }

    /// Solves once with these viscosities, from the flow `guess`: the flow, the forces on bodies, and whether compression obeys
    /// its law.
    fn solve_pass(
        &self,
        (middle, drive): (&Middle, Drive),
        unknowns: &Unknowns,
        viscosities: &Viscosities,
        (torn, air): (&[bool], Option<&Air>),
        guess: &Flow,
        clock: &mut Clock,
    ) -> Result<(Flow, Vec<f64>, bool), String> {
        let (setup, mesh, state) = (&self.setup, &self.mesh, &self.state);
        let (dt, full, fractions) = (middle.dt, &middle.full, &middle.fractions);
        let stiffnesses = stiffnesses(mesh, &middle.halves, viscosities);
        let fronts = self.fronts(unknowns, torn, air, middle.viscosity, dt);
        let problem = Problem {
            lattice: &setup.lattice,
            mesh,
            links: &self.links,
            edges: &self.edges,
            unknowns,
            fractions,
            halves: &middle.halves,
            masses: &middle.masses,
            stiffnesses: &stiffnesses,
            viscosities,
            before: &state.flow.velocity,
            speed_before: state.flow.speed,
            end_height: middle.end,
            fronts: &fronts,
            pockets: air.map_or(&[], |air| &air.pockets),
            scales: setup.scales(dt),
        };
        let compression = Compression {
            tait: setup.liquid.tait,
            unit: setup.units.viscosity,
            mesh,
            volumes: &state.volumes,
            pressure: &state.flow.pressure,
            full,
            heights: [self.height, middle.end],
            times: [dt, self.crossing()],
        };
        let mut carried = compression.released(&unknowns.pores, &guess.pressure);
        if let Some(exchange) = &middle.lost {
            // What full pores gain in the step, those with a pressure hold more.
            let pores = unknowns.pores.iter().map(|&pore| pore as usize);
            for (carried, pore) in carried.iter_mut().zip(pores).filter(|of| full[of.1]) {
                *carried += exchange.gained[pore] / dt;
            }
        }
        let flow = solve(&problem, &carried, drive, guess, &self.solver, clock)
            .map_err(|error| self.unsolved(&error))?;
        let begun = Instant::now();
        let forces = forces(&problem, &flow, state.displacement.len());
        let holds = compression.holds(&unknowns.pores, &guess.pressure, &flow.pressure);
        clock.add(Stage::Forces, begun);
        Ok((flow, forces, holds))
    }
}
