//! The scheme, and the order of one step.

mod air;
mod drive;
mod failure;
mod scheme;
mod setup;
mod solve;
mod water;

use std::time::Instant;

use physics::{Failure, Scene, StepLimit, StepReport};
use saddle_point::{SaddleOptions, SaddleSolver};

use crate::clock::{Clock, Part};
use crate::geometry::{Mesh, Region, Rows};
use crate::liquid::{
    Held, Kept, Moved, carried_pressures, carried_region, carried_velocities, carried_volumes,
    transport,
};
use crate::settings::Settings;
use crate::system::{Edges, Flow, Links};
use crate::water::Walls;
use air::HeldAir;
use drive::ClampDrive;
use setup::Setup;
use solve::Solved;
use water::Wet;

pub(crate) use water::DRIED;

/// Attempts at a step of acceptable length; the second nearly always is.
const ATTEMPTS: usize = 8;
/// Excess over the Courant number that a step may have, and the part of it that the next attempt aims at: so few steps are
/// solved twice.
const EXCESS: f64 = 1.1;
const AIM: f64 = 0.95;
/// Most by which flow is expected to go on growing: a flow that starts is no trend.
const FORESEEN: f64 = 1.25;
/// Cells around the liquid that a mesh has, and the least that it may have before it is made anew: liquid crosses less than
/// two in a step.
const MARGIN: usize = 4;
const LEAST_MARGIN: usize = 2;
/// Most that cure changes ln(viscosity) by in a step: its middle then differs from the mean of 1/viscosity by 0.17 %.
pub(crate) const CURED: f64 = 0.2;
/// Fraction of the faces, the fastest, that the Courant number ignores, jets through holes of a voxel, and the cells that
/// they cross at most.
const JETS: f64 = 1e-3;
const JET_CFL: f64 = 1.5;
/// Most that a step grows by where menisci are held.
const GROWTH: f64 = 2.0;
/// Height of a gap, cells, that is none.
const CLOSED: f64 = 1e-9;

/// The implicit scheme on a scene.
pub struct Implicit {
    setup: Setup,
    state: State,
    mesh: Mesh,
    links: Links,
    edges: Edges,
    /// Walls of the mesh that take water.
    walls: Option<Walls>,
    /// Height of the gap between steps, cells; in a step, the mesh has that in its middle.
    height: f64,
    solver: SaddleSolver,
    clock: Clock,
}

/// What changes from step to step.
struct State {
    /// Liquid in each pore at no pressure, cells.
    volumes: Vec<f64>,
    flow: Flow,
    drive: ClampDrive,
    air: HeldAir,
    /// Displacement of each body, m.
    displacement: Vec<[f64; 3]>,
    /// Clamp travel, m.
    travel: f64,
    time: f64,
    steps: u64,
    /// Length of the last step, s.
    dt: f64,
    /// Fastest flow, cells/s, and by what factor it is expected to be faster in the next step.
    fastest: f64,
    growth: f64,
    /// Liquid that left the domain, cells.
    lost: f64,
    /// Viscous dissipation, over the unit of viscosity.
    power: f64,
    /// Steps whose viscosity did not settle.
    unsettled: u64,
    /// Of a liquid that loses water.
    wet: Option<Wet>,
}

impl Implicit {
    /// The scheme for `scene`.
    ///
    /// # Errors
    /// A sentence on what this scheme cannot do with the scene or the settings.
    pub fn new(scene: &Scene, settings: Settings) -> Result<Self, String> {
        settings.check()?;
        let (setup, mesh, volumes) = Setup::new(scene, settings)?;
        let wet = setup.wet(&volumes);
        let drive = setup.drive(scene);
        let closing = drive.speed / setup.units.cell_m;
        let flow = Flow {
            velocity: setup.initial_velocity(&scene.points, &mesh, closing)?,
            pressure: vec![0.0; mesh.pores.len()],
            speed: closing,
            ..Flow::default()
        };
        let speed = scene.initial_speed() / setup.units.cell_m;
        let mut scheme = Self {
            state: State {
                volumes,
                flow,
                drive,
                air: HeldAir::default(),
                displacement: vec![[0.0; 3]; scene.bodies.len()],
                travel: 0.0,
                time: 0.0,
                steps: 0,
                dt: 0.0,
                fastest: speed,
                growth: 1.0,
                lost: 0.0,
                power: 0.0,
                unsettled: 0,
                wet,
            },
            solver: SaddleSolver::new(SaddleOptions {
                tolerance: settings.tolerance,
                ..SaddleOptions::default()
            }),
            clock: Clock::default(),
            height: mesh.rows().height,
            edges: Edges::default(),
            walls: None,
            setup,
            mesh,
            links: Links::default(),
        };
        scheme.fit_mesh();
        scheme.state.air = scheme.first_air();
        Ok(scheme)
    }

    /// Takes one step: its length, which pores are full, the solution, the liquid that moves, the rows that close.
    fn step(&mut self, limit: StepLimit) -> Result<StepReport, Failure> {
        let limit = self.state.drive.within(limit, self.state.travel);
        if self.setup.lattice.moving.is_some() && self.height == 0.0 && self.state.drive.speed > 0.0
        {
            return Err(self.failure("the bodies have met and cannot go on"));
        }
        let begun = Instant::now();
        self.fit_mesh();
        self.clock.add(Part::Geometry, begun);
        let (mut longest, mut dries) = (limit.time_s, false);
        let mut guess = self.state.flow.clone();
        for _ in 0..ATTEMPTS {
            let dt = self.length(limit).min(longest);
            let solved = self
                .solve(dt, limit, longest, &mut guess)
                .map_err(|why| self.failure(&why))?;
            let shorter = solved.dries_too_fast();
            dries = shorter.is_some();
            if let Some(shorter) = shorter {
                longest = shorter;
                continue;
            }
            let crossed = fastest(&solved.flow, self.setup.settings.cfl) * solved.dt;
            if crossed <= EXCESS * self.setup.settings.cfl {
                return Ok(self.follow(solved, limit));
            }
            longest = AIM * solved.dt * self.setup.settings.cfl / crossed;
        }
        Err(self.no_step(dries))
    }

    /// Makes the mesh anew where the gap has other rows now, or the liquid has come near its end.
    fn fit_mesh(&mut self) {
        self.mesh.set_height(self.height);
        let mesh = &self.mesh;
        let rows = Rows::of_gap(mesh.rows().below, mesh.rows().above, self.height);
        let wet = mesh.cells_with(|pore| self.state.volumes[pore] > 0.0);
        let wet_rows = self.wet_rows();
        let near =
            |end: usize, side: usize, all: usize| side != all && end.abs_diff(side) < LEAST_MARGIN;
        if !self.links.0.is_empty()
            && rows.gap == mesh.rows().gap
            && !near(wet_rows.start, mesh.range.start, 0)
            && !near(wet_rows.end, mesh.range.end, mesh.rows().len())
            && (mesh.region).covers(&wet.grown(LEAST_MARGIN, mesh.periodic()))
        {
            return;
        }
        let end = (wet_rows.end + rows.gap - mesh.rows().gap).max(wet_rows.start) + MARGIN;
        let near = wet_rows.start.saturating_sub(MARGIN)..end.min(rows.len());
        let (range, region) = match self.setup.gas {
            None => {
                let region = carried_region(mesh, &wet, (&rows, &near), MARGIN);
                (near, region)
            }
            // Air may be closed off anywhere.
            Some(_) => {
                let range = 0..rows.len();
                let size = Mesh::size_of(&self.setup.lattice, &range);
                (range, Region::new(size, true))
            }
        };
        let mesh = Mesh::new(&self.setup.lattice, rows, range, region);
        let old = std::mem::replace(&mut self.mesh, mesh);
        let (state, mesh) = (&mut self.state, &self.mesh);
        state.volumes = carried_volumes(mesh, &old, &state.volumes);
        if !state.air.of.is_empty() {
            state.air.of = carried_volumes(mesh, &old, &state.air.of);
        }
        state.flow.velocity = carried_velocities(mesh, &old, &state.flow.velocity);
        state.flow.pressure = carried_pressures(mesh, &old, &state.flow.pressure);
        if let Some(wet) = &mut state.wet {
            wet.water = carried_volumes(mesh, &old, &wet.water);
            wet.soaked = carried_volumes(mesh, &old, &wet.soaked);
        }
        self.walls = self.setup.taking_walls(mesh);
        let kept = match self.links.0.is_empty() {
            true => Kept::default(),
            false => Kept::new(mesh, &old),
        };
        self.links = self.setup.links(mesh, &kept, &self.links);
        self.edges = Edges::new(mesh, &self.setup.lattice, &kept, &self.edges);
    }

    /// Rows of the grid that hold liquid, and those of the gap.
    fn wet_rows(&self) -> std::ops::Range<usize> {
        let mesh = &self.mesh;
        let gap = mesh.rows().below..mesh.rows().below + mesh.rows().gap;
        (0..mesh.pores.len())
            .filter(|&pore| self.state.volumes[pore] > 0.0)
            .map(|pore| mesh.row_of(pore))
            .fold(gap, |range, row| {
                range.start.min(row)..range.end.max(row + 1)
            })
    }

    /// Time in which the flow of the last step, as it grows, crosses what the Courant number allows, s.
    fn asked(&self) -> f64 {
        let fastest = self.state.fastest.max(self.state.flow.speed.abs());
        self.setup.settings.cfl / (self.state.growth * fastest)
    }

    /// Length of the next step by the flow of the last, s.
    fn length(&self, limit: StepLimit) -> f64 {
        let settings = &self.setup.settings;
        let pull = self.setup.pull();
        let free = self.asked();
        // From rest, weight sets the speed.
        let falls = (2.0 * settings.cfl / pull).sqrt();
        // The viscosity of a liquid that cures is that of the middle of the step.
        let cure = self.setup.liquid.cure.as_ref();
        let free = cure.map_or(free, |cure| cure.steady(self.state.time, CURED).min(free));
        let moist = self.state.wet.as_ref().map_or(f64::INFINITY, Wet::steady);
        let dt = free.min(moist).min(if self.state.steps == 0 {
            falls
        } else {
            f64::INFINITY
        });
        // From rest, no meniscus outruns tension over viscosity; what holds one is known by the speed of the step before.
        let wets = self.setup.liquid.wetting.map_or(f64::INFINITY, |wetting| {
            let units = self.setup.units;
            match self.state.steps {
                0 => units.cell_m * units.viscosity / wetting.tension,
                _ => GROWTH * self.state.dt,
            }
        });
        let dt = dt.min(wets);
        let left = match self.left(limit) {
            left if left > 0.0 => left / self.state.flow.speed.max(f64::MIN_POSITIVE),
            // The clamp is where it was to go.
            _ => f64::INFINITY,
        };
        dt.min(limit.time_s).min(left)
    }

    /// Completes an accepted step.
    fn follow(&mut self, solved: Solved, limit: StepLimit) -> StepReport {
        let Solved {
            dt,
            flow,
            full,
            forces,
            settled,
            air,
            arrives,
            exchange,
        } = solved;
        let cell_m = self.setup.units.cell_m;
        let travel = match arrives {
            true => self.left(limit),
            false => flow.speed * dt,
        };
        let begun = Instant::now();
        // Liquid moves through the faces of the middle of the step into the pores of its end.
        let middle = self.mesh.rows().height;
        if self.setup.lattice.moving.is_some() {
            let height = self.height - travel;
            self.height = if height > CLOSED { height } else { 0.0 }.max(self.least_height());
        }
        self.mesh.set_height(self.height);
        let capacities = self.capacities();
        self.mesh.set_height(middle);
        let state = &mut self.state;
        if let (Some(wet), Some(exchange)) = (&mut state.wet, exchange) {
            wet.give_off(&exchange, dt, &mut state.volumes);
        }
        let mesh = &mut self.mesh;
        let Moved {
            volumes,
            water,
            lost: [lost, water_lost],
        } = transport(
            mesh,
            Held {
                volumes: &state.volumes,
                water: state.wet.as_ref().map_or(&[], |wet| &wet.water),
            },
            &full,
            &capacities,
            &flow.velocity,
            dt,
        );
        mesh.set_height(self.height);
        self.clock.add(Part::Transport, begun);
        state.volumes = volumes;
        if let Some(wet) = &mut state.wet {
            wet.water = water;
            wet.account.left += water_lost;
        }
        state.lost += lost;
        let fastest = fastest(&flow, self.setup.settings.cfl);
        state.growth = (fastest / state.fastest.max(f64::MIN_POSITIVE)).clamp(1.0, FORESEEN);
        state.fastest = fastest;
        state.unsettled += u64::from(!settled);
        state.power = flow.dissipation;
        state.time += dt;
        state.dt = dt;
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
        if let (Some(gas), Some((air, settled))) = (self.setup.gas, air) {
            self.keep_air(gas, air, settled, dt);
        }
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
