//! The scheme, and the order of one step.

mod drive;
mod scheme;
mod setup;

use physics::{Failure, Scene, StepLimit, StepReport};
use rayon::prelude::*;
use saddle_point::{SaddleOptions, SaddleSolver};

use crate::geometry::{Mesh, Rows};
use crate::liquid::{Moved, carried_velocities, carried_volumes, transport};
use crate::settings::Settings;
use crate::system::{
    Drive, Edges, FULL, Flow, Links, Problem, Rates, Unknowns, Viscosities, forces, halves, solve,
};
use drive::{Asked, ClampDrive};
use setup::Setup;

/// Attempts at a step of acceptable length.
const ATTEMPTS: usize = 8;
/// Excess over the Courant number that a step may have.
const EXCESS: f64 = 1.1;
/// Rows of cells around the liquid that a mesh has, and the least that it may have before it is made anew.
const MARGIN: [usize; 2] = [8, 2];
/// Most that cure changes ln(viscosity) by in a step.
const CURED: f64 = 0.2;
/// Passes in which the viscosity of the flow is sought, and its mean change, weighted by dissipation, that ends them.
const PASSES: usize = 20;
const SETTLED: f64 = 2e-3;
/// Fraction of the faces, the fastest, that the Courant number ignores, and the cells that they cross at most.
const JETS: f64 = 1e-3;
const JET_CFL: f64 = 1.5;
/// Part of the travel that is left from which on a step that covers it is made to end it.
const NEAR: f64 = 0.7;
/// Part of it by which a step may miss the end and still is there, and solves that bring it nearer.
const MISSED: f64 = 1e-3;
const CLOSER: usize = 4;
/// Height of a gap, cells, that is none.
const CLOSED: f64 = 1e-9;

/// The implicit scheme on a scene.
pub struct Implicit {
    setup: Setup,
    state: State,
    mesh: Mesh,
    links: Links,
    edges: Edges,
    /// Height of the gap between steps, cells; in a step, the mesh has that in its middle.
    height: f64,
    solver: SaddleSolver,
}

/// What changes from step to step.
struct State {
    /// Liquid in each pore at no pressure, cells.
    volumes: Vec<f64>,
    flow: Flow,
    drive: ClampDrive,
    /// Displacement of each body, m.
    displacement: Vec<[f64; 3]>,
    /// Clamp travel, m.
    travel: f64,
    time: f64,
    steps: u64,
    /// Fastest flow, cells/s.
    fastest: f64,
    /// Liquid that left the domain, cells.
    lost: f64,
    /// Viscous dissipation, over the unit of viscosity.
    power: f64,
    /// Steps whose viscosity did not settle.
    unsettled: u64,
}

/// A step that was solved.
struct Solved {
    dt: f64,
    flow: Flow,
    full: Vec<bool>,
    forces: Vec<f64>,
    /// Whether the viscosity is that of the flow.
    settled: bool,
    /// Whether the step ends the travel of the clamp.
    arrives: bool,
}

impl Implicit {
    /// The scheme for `scene`.
    ///
    /// # Errors
    /// A sentence on what this scheme cannot do with the scene or the settings.
    pub fn new(scene: &Scene, settings: Settings) -> Result<Self, String> {
        settings.check()?;
        let (setup, mesh, volumes) = Setup::new(scene, settings)?;
        let links = setup.links(&mesh);
        let flow = Flow {
            velocity: setup.initial_velocity(scene, &mesh),
            pressure: vec![0.0; mesh.pores.len()],
            ..Flow::default()
        };
        let drive = setup.drive(scene);
        let speed = scene.initial_speed() / setup.units.cell_m;
        Ok(Self {
            state: State {
                volumes,
                flow: Flow {
                    speed: drive.speed / setup.units.cell_m,
                    ..flow
                },
                drive,
                displacement: vec![[0.0; 3]; scene.bodies.len()],
                travel: 0.0,
                time: 0.0,
                steps: 0,
                fastest: speed,
                lost: 0.0,
                power: 0.0,
                unsettled: 0,
            },
            solver: SaddleSolver::new(SaddleOptions {
                tolerance: settings.tolerance,
                ..SaddleOptions::default()
            }),
            height: mesh.rows().height,
            edges: Edges::new(&mesh, setup.lattice.flat),
            setup,
            mesh,
            links,
        })
    }

    /// Takes one step: its length, which pores are full, the solution, the liquid that moves, the rows that close.
    fn step(&mut self, limit: StepLimit) -> Result<StepReport, Failure> {
        let limit = self.state.drive.within(limit, self.state.travel);
        self.fit_mesh();
        let mut longest = limit.time_s;
        for _ in 0..ATTEMPTS {
            let dt = self.length(limit).min(longest);
            let solved = self
                .solve(dt, limit, longest)
                .map_err(|why| self.failure(&why))?;
            let crossed = fastest(&solved.flow, self.setup.settings.cfl) * solved.dt;
            if crossed <= EXCESS * self.setup.settings.cfl {
                return Ok(self.follow(solved, limit));
            }
            longest = 0.95 * solved.dt * self.setup.settings.cfl / crossed;
        }
        Err(self.failure("the liquid is faster than any step that was tried allows for"))
    }

    fn failure(&self, why: &str) -> Failure {
        Failure(format!(
            "step {} at {:.6e} s: {why}",
            self.state.steps + 1,
            self.state.time
        ))
    }

    /// Makes the mesh anew where the gap has fewer rows now, or the liquid has come near its end.
    fn fit_mesh(&mut self) {
        self.mesh.set_height(self.height);
        let rows = Rows::of_gap(self.mesh.rows().below, self.mesh.rows().above, self.height);
        let wet = self.wet_rows();
        let near =
            |end: usize, side: usize, all: usize| side != all && end.abs_diff(side) < MARGIN[1];
        let range = &self.mesh.range;
        if rows.gap == self.mesh.rows().gap
            && !near(wet.start, range.start, 0)
            && !near(wet.end, range.end, self.mesh.rows().len())
        {
            return;
        }
        let removed = self.mesh.rows().gap - rows.gap;
        let end = wet.end.saturating_sub(removed).max(wet.start) + MARGIN[0];
        let range = wet.start.saturating_sub(MARGIN[0])..end.min(rows.len());
        let mesh = Mesh::new(&self.setup.lattice, rows, range);
        let old = std::mem::replace(&mut self.mesh, mesh);
        let (state, mesh) = (&mut self.state, &self.mesh);
        state.volumes = carried_volumes(mesh, &old, &state.volumes);
        state.flow.velocity = carried_velocities(mesh, &old, &state.flow.velocity);
        state.flow.pressure = carried_volumes(mesh, &old, &state.flow.pressure);
        self.links = self.setup.links(mesh);
        self.edges = Edges::new(mesh, self.setup.lattice.flat);
    }

    /// Rows of the grid that hold liquid, and those of the gap.
    fn wet_rows(&self) -> std::ops::Range<usize> {
        let mesh = &self.mesh;
        let gap = mesh.rows().below..mesh.rows().below + mesh.rows().gap;
        (0..mesh.pores.len())
            .filter(|&pore| self.state.volumes[pore] > 0.0)
            .map(|pore| mesh.row(mesh.pores[pore].cell as usize))
            .fold(gap, |range, row| {
                range.start.min(row)..range.end.max(row + 1)
            })
    }

    /// Length of the next step by the flow of the last, s.
    fn length(&self, limit: StepLimit) -> f64 {
        let settings = &self.setup.settings;
        let pull = self.setup.pull();
        let fastest = self.state.fastest.max(self.state.flow.speed.abs());
        let free = settings.cfl / fastest;
        // From rest, weight sets the pace.
        let falls = (2.0 * settings.cfl / pull).sqrt();
        // The viscosity of a liquid that cures is that of the middle of the step.
        let cure = self.setup.liquid.cure.as_ref();
        let free = cure.map_or(free, |cure| cure.steady(self.state.time, CURED).min(free));
        let dt = free.min(if self.state.steps == 0 {
            falls
        } else {
            f64::INFINITY
        });
        let left =
            limit.travel_m / self.setup.units.cell_m / self.state.flow.speed.max(f64::MIN_POSITIVE);
        dt.min(limit.time_s).min(left)
    }

    /// Solves the flow of a step of `dt` (s), of another length, `longest` at most, where the clamp comes to the end of its
    /// travel.
    fn solve(&mut self, dt: f64, limit: StepLimit, longest: f64) -> Result<Solved, String> {
        let left = limit.travel_m / self.setup.units.cell_m;
        let mut solved = self.solve_controlled(dt)?;
        // The clamp's speed under load is known only then: the step ends the travel when it is that of its own length.
        for _ in 0..CLOSER {
            let Solved { dt, flow, .. } = &solved;
            let reach = flow.speed * dt;
            let end = left / flow.speed;
            if reach < NEAR * left || (reach / left - 1.0).abs() <= MISSED || end > longest {
                break;
            }
            solved = self.solve_controlled(end)?;
        }
        let reach = solved.flow.speed * solved.dt;
        if reach > (1.0 + MISSED) * left {
            let dt = solved.dt;
            solved = self.solve_driven(dt, Drive::Speed(left / dt))?;
        }
        solved.arrives = (solved.flow.speed * solved.dt / left - 1.0).abs() <= MISSED;
        Ok(solved)
    }

    /// Solves the flow of a step of `dt` (s) with the clamp at full speed, or at the speed of its pressure limit.
    fn solve_controlled(&mut self, dt: f64) -> Result<Solved, String> {
        self.state.drive.aim(dt);
        if let Some(asked) = self.state.drive.held() {
            return self.solve_held(dt, asked);
        }
        let full = Drive::Speed(self.state.drive.speed / self.setup.units.cell_m);
        let free = self.solve_driven(dt, full)?;
        let pressure = self.setup.pressure(free.flow.force);
        match self.state.drive.exceeded(pressure) {
            Some(asked) => self.solve_held(dt, asked),
            None => Ok(free),
        }
    }

    /// The same under a pressure on the clamp, at the nearest speed that it can follow.
    fn solve_held(&mut self, dt: f64, asked: Asked) -> Result<Solved, String> {
        let cell_m = self.setup.units.cell_m;
        let drive = Drive::Force {
            force: self.setup.force(asked.limit),
            scale: self.setup.force(asked.limit.max(asked.least)),
            guess: self.state.drive.speed / cell_m,
        };
        let solved = self.solve_driven(dt, drive)?;
        match self.state.drive.follow(solved.flow.speed * cell_m) {
            true => Ok(solved),
            false => self.solve_driven(dt, Drive::Speed(self.state.drive.speed / cell_m)),
        }
    }

    /// Puts the rows where they are in the middle of a step of `dt` (s) by the last closing speed; which pores are full now,
    /// and what they are filled to in the middle by the last flow.
    fn middle(&mut self, dt: f64) -> (Vec<bool>, Vec<f64>) {
        let height = self.height;
        let state = &self.state;
        let full: Vec<bool> = (0..self.mesh.pores.len())
            .map(|pore| state.volumes[pore] >= FULL * self.mesh.volume_at(pore, height))
            .collect();
        if self.setup.lattice.moving.is_some() {
            let middle = (height - 0.5 * dt * state.flow.speed).max(0.5 * height);
            self.mesh.set_height(middle);
            self.setup.measure(&mut self.links, &self.mesh);
            self.edges.measure(&self.mesh, self.setup.lattice.flat);
        }
        let mesh = &self.mesh;
        let moved = if state.steps == 0 {
            state.volumes.clone()
        } else {
            transport(
                mesh,
                &state.volumes,
                &full,
                &self.capacities(),
                &state.flow.velocity,
                0.5 * dt,
            )
            .volumes
        };
        let fractions = (0..mesh.pores.len())
            .map(|pore| match moved[pore] / mesh.volume(pore) {
                _ if full[pore] => 1.0,
                then if then >= FULL => 1.0,
                then => then,
            })
            .collect();
        (full, fractions)
    }

    /// What each pore can hold: without end beyond open sides.
    fn capacities(&self) -> Vec<f64> {
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
    fn solve_driven(&mut self, dt: f64, drive: Drive) -> Result<Solved, String> {
        let (full, fractions) = self.middle(dt);
        let (setup, mesh, state) = (&self.setup, &self.mesh, &self.state);
        let unknowns = Unknowns::new(mesh, &fractions);
        let halves = halves(mesh, &fractions);
        let carried = setup.carried(mesh, &unknowns, state, &full, self.height, dt);
        let cured = setup.viscosity_at(state.time + 0.5 * dt);
        let factor = cured / setup.units.viscosity;
        let varies = setup.varies();
        let rates = |flow: &Flow| {
            let convention = setup.liquid.shear_rate;
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
            true => Viscosities::of(&rates(&state.flow), &setup.liquid, factor),
            false => Viscosities::constant(mesh, cured),
        };
        let mut flow = state.flow.clone();
        let mut iterations = 0;
        let mut solved = Solved {
            dt,
            full,
            forces: Vec::new(),
            settled: false,
            arrives: false,
            flow: Flow::default(),
        };
        for _ in 0..PASSES {
            let problem = Problem {
                lattice: &setup.lattice,
                mesh,
                links: &self.links,
                edges: &self.edges,
                unknowns: &unknowns,
                fractions: &fractions,
                halves: &halves,
                viscosity: &viscosities.pores,
                wall_viscosity: &viscosities.walls,
                before: &state.flow.velocity,
                speed_before: state.flow.speed,
                scales: setup.scales(dt),
            };
            flow = solve(&problem, &carried, drive, &flow, &mut self.solver)
                .map_err(|error| error.to_string())?;
            iterations += flow.iterations;
            let next = match varies {
                true => rates(&flow),
                false => Rates::default(),
            };
            let changed = match varies {
                true => Viscosities::of(&next, &setup.liquid, factor),
                false => Viscosities::default(),
            };
            solved.settled =
                !varies || viscosities.change(&changed, &next, mesh, &fractions) < SETTLED;
            solved.forces = forces(&problem, &flow, state.displacement.len());
            if solved.settled {
                break;
            }
            viscosities = changed;
        }
        flow.iterations = iterations;
        Ok(Solved { flow, ..solved })
    }

    /// Completes an accepted step.
    fn follow(&mut self, solved: Solved, limit: StepLimit) -> StepReport {
        let Solved {
            dt,
            flow,
            full,
            forces,
            settled,
            arrives,
        } = solved;
        let cell_m = self.setup.units.cell_m;
        let travel = match arrives {
            true => limit.travel_m / cell_m,
            false => flow.speed * dt,
        };
        // Liquid moves through the faces of the middle of the step into the pores of its end.
        let middle = self.mesh.rows().height;
        if self.setup.lattice.moving.is_some() {
            let height = self.height - travel;
            self.height = if height > CLOSED { height } else { 0.0 };
        }
        self.mesh.set_height(self.height);
        let capacities = self.capacities();
        self.mesh.set_height(middle);
        let mesh = &mut self.mesh;
        let Moved { volumes, lost } = transport(
            mesh,
            &self.state.volumes,
            &full,
            &capacities,
            &flow.velocity,
            dt,
        );
        mesh.set_height(self.height);
        let state = &mut self.state;
        state.volumes = volumes;
        state.lost += lost;
        state.fastest = fastest(&flow, self.setup.settings.cfl);
        state.unsettled += u64::from(!settled);
        state.power = flow.dissipation;
        state.time += dt;
        state.steps += 1;
        state.travel += travel * cell_m;
        for (body, displacement) in state.displacement.iter_mut().enumerate() {
            let slide = self.setup.lattice.slide[body];
            for a in 0..3 {
                displacement[a] += slide[a] * dt;
            }
            if self.setup.lattice.mover == Some(body) {
                displacement[1] +=
                    self.setup.lattice.speed_of(body) * travel * cell_m - slide[1] * dt;
            }
        }
        let pressure = |body: Option<usize>, sign: f64| {
            body.map_or(0.0, |body| {
                let force = match self.setup.lattice.mover == Some(body) {
                    true => -sign * self.setup.lattice.speed_of(body) * flow.force,
                    false => sign * forces[body],
                };
                self.setup.pressure(force)
            })
        };
        state
            .drive
            .observe(self.setup.pressure(flow.force), dt, state.travel);
        let report = StepReport {
            dt_s: dt,
            closing_speed: flow.speed * cell_m,
            travel_m: state.travel,
            pressure_bottom: pressure(self.setup.bottom, -1.0),
            pressure_top: pressure(self.setup.top, 1.0),
            lost: self.setup.points_of(state.lost),
            iterations: flow.iterations,
        };
        state.flow = flow;
        report
    }
}

/// Cells a second that count: those of the fastest faces but for jets through single voxels, which may cross more.
fn fastest(flow: &Flow, cfl: f64) -> f64 {
    let mut speeds: Vec<f64> = (flow.velocity.iter())
        .filter(|v| **v != 0.0)
        .map(|v| v.abs())
        .collect();
    if speeds.is_empty() {
        return 0.0;
    }
    let at = ((1.0 - JETS) * (speeds.len() - 1) as f64) as usize;
    let most = speeds.iter().fold(0.0, |most: f64, &v| v.max(most));
    let (_, &mut counted, _) = speeds.select_nth_unstable_by(at, f64::total_cmp);
    counted.max(most * cfl / JET_CFL)
}
