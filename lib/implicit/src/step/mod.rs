//! The scheme and the order of a step (docs/methods.md section 3.1).

mod air;
mod completion;
mod compression;
mod drive;
mod exchange;
mod failure;
mod length;
mod mid_step;
mod output;
mod remesh;
mod scheme;
mod setup;
mod trial;
mod water;

use std::time::Instant;

use physics::{Failure, Scene, StepLimit, StepReport};
use saddle_point::{SaddleOptions, SaddleSolver};

use crate::clock::{Clock, Stage};
use crate::geometry::Mesh;
use crate::settings::Settings;
use crate::system::{Edges, Flow, REST_DISTANCE, WallCouplings};
use crate::water::AbsorbingWalls;
use air::AirState;
use drive::ClampDrive;
use length::Attempts;
use setup::Setup;
use trial::Solved;
use water::WaterBalance;

/// Bound on the attempts at a step; the second nearly always has an acceptable length.
const MAX_ATTEMPTS: usize = 8;
/// Largest pressure in a pore over the bulk modulus: beyond, a liquid is no liquid.
const MOST_COMPRESSION: f64 = 0.2;
/// Largest change of ln(viscosity) in a step by cure, and the target by loss of water: 1/viscosity in the middle of the step
/// then differs from its mean by 0.17 %.
pub(crate) const LN_VISCOSITY_STEP: f64 = 0.2;
/// The implicit scheme on a scene.
pub struct Implicit {
    setup: Setup,
    state: State,
    mesh: Mesh,
    /// Wall couplings of the mesh; those that depend on the height of the gap belong to each trial.
    couplings: WallCouplings,
    edges: Edges,
    /// Absorbing walls of the mesh.
    absorbing_walls: Option<AbsorbingWalls>,
    solver: SaddleSolver,
    clock: Clock,
}

/// The state that changes from step to step.
#[derive(Default)]
struct State {
    /// Liquid volume of each pore at zero pressure, cells.
    volumes: Vec<f64>,
    flow: Flow,
    drive: ClampDrive,
    air: AirState,
    /// Displacement of each body, m.
    displacement: Vec<[f64; 3]>,
    /// Clamp travel, m.
    travel: f64,
    time: f64,
    steps: u64,
    /// Length of the last step, s.
    dt: f64,
    /// Flow speed of the last step for the Courant number, cells/s, and its expected growth to the next step, a factor.
    courant_speed: f64,
    growth: f64,
    /// Whose state `flow` is, the pressures on the bodies by it, and the rate of change of ln(closing speed) in it, 1/s.
    flow_of: FlowOf,
    pressures: Pressures,
    trend: f64,
    /// Liquid volume that left the domain, cells.
    lost: f64,
    /// Steps whose iterations did not converge.
    unsettled: u64,
    /// The water balance of a liquid that loses water.
    water: Option<WaterBalance>,
}

/// Pressures on bodies, Pa: the lower one, the upper one, the moving one.
type Pressures = [f64; 3];

/// What the flow of a state is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum FlowOf {
    /// That of an earlier state: the next step begins by a solution of its start.
    #[default]
    Earlier,
    /// That of the middle of the last step, which the next step continues.
    LastStep,
    /// That of this state.
    Now,
}

impl Implicit {
    /// Sets up the scheme for `scene`.
    ///
    /// # Errors
    /// A sentence on what this scheme cannot do with the scene or the settings.
    pub fn new(scene: &Scene, settings: Settings) -> Result<Self, String> {
        settings.check()?;
        let (setup, mesh, volumes) = Setup::new(scene, settings)?;
        let balance = setup.initial_water(&volumes);
        let drive = setup.drive(scene);
        let closing = drive.speed / setup.units.cell_m;
        let flow = Flow {
            velocity: setup.initial_velocity(&scene.points, &mesh, &volumes, closing)?,
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
                displacement: vec![[0.0; 3]; scene.bodies.len()],
                courant_speed: speed,
                growth: 1.0,
                water: balance,
                ..State::default()
            },
            solver: SaddleSolver::new(SaddleOptions {
                tolerance: settings.tolerance,
                ..SaddleOptions::default()
            }),
            clock: Clock::default(),
            edges: Edges::default(),
            absorbing_walls: None,
            setup,
            mesh,
            couplings: WallCouplings::default(),
        };
        scheme.update_mesh();
        scheme.state.air = scheme.first_air();
        Ok(scheme)
    }

    /// Takes one step: remeshes, finds the flow of a step of acceptable length, and completes it.
    fn step(&mut self, limit: StepLimit) -> Result<StepReport, Failure> {
        let programme = self.state.drive.programme.as_ref();
        let limit = programme.map_or(limit, |run| run.within(limit, self.state.travel));
        if self.setup.lattice.moving.is_some()
            && self.height() == 0.0
            && self.state.drive.speed > 0.0
        {
            // A body of given velocity may overlap another by a fiftieth of a cell at the end (docs/verdicts.md), and the step that
            // ends its travel may do so earlier by a hundredth.
            let left = self.state.drive.speed * limit.time_s / self.setup.units.cell_m;
            if self.setup.clamp.is_some() || left > 3.0 * REST_DISTANCE {
                return Err(self.failure("the bodies have met and cannot move on"));
            }
            self.state.drive.speed = 0.0;
        }
        let begun = Instant::now();
        self.update_mesh();
        self.clock.add(Stage::Geometry, begun);
        let solved = self.find_step(limit)?;
        self.complete_step(solved, limit)
    }

    /// Solves steps of different lengths until one is acceptable.
    fn find_step(&self, limit: StepLimit) -> Result<Solved, Failure> {
        let mut dt = self.step_length(limit);
        let fail = |why: String| self.failure(&why);
        self.check_length(dt)?;
        let start = match self.state.flow_of {
            FlowOf::Earlier => Some(self.solve_now(dt).map_err(fail)?),
            _ => None,
        };
        let (ahead, drive, start_time, pressures) = match &start {
            Some(start) => (
                &start.flow,
                &start.trial.drive,
                0.0,
                self.pressures(&start.flow, &start.forces),
            ),
            None => (
                &self.state.flow,
                &self.state.drive,
                -self.time_of_flow(),
                self.state.pressures,
            ),
        };
        let (mut guess, mut attempts, mut dries) = (ahead.clone(), Attempts::none(), false);
        for _ in 0..MAX_ATTEMPTS {
            let mut solved = self
                .solve((dt, 0.5), drive.clone(), ahead, guess)
                .map_err(fail)?;
            solved.before = (start_time, pressures);
            dries = solved.dries_too_fast().is_some();
            let Some(length) = self.better_length(&mut solved, limit, &mut attempts) else {
                self.check_pressure(&solved.flow)?;
                return Ok(solved);
            };
            dt = length;
            self.check_length(dt)?;
            guess = solved.flow;
        }
        Err(self.no_acceptable_length(dries))
    }

    /// Solves the flow of the state as it is, as if a step of `dt` (s) began.
    fn solve_now(&self, dt: f64) -> Result<Solved, String> {
        let flow = &self.state.flow;
        self.solve((dt, 0.0), self.state.drive.clone(), flow, flow.clone())
    }

    fn check_length(&self, dt: f64) -> Result<(), Failure> {
        match dt > 0.0 && dt.is_finite() {
            true => Ok(()),
            false => Err(self.failure("nothing moves, so no time step can be chosen")),
        }
    }

    /// Refuses a flow whose pressure anywhere is beyond the range of the liquid's law.
    fn check_pressure(&self, flow: &Flow) -> Result<(), Failure> {
        let most = flow.pressure.iter().fold(0.0_f64, |most, p| most.max(*p));
        let (most, bulk_modulus) = (
            most * self.setup.units.viscosity,
            self.setup.liquid.tait.bulk_modulus,
        );
        match most <= MOST_COMPRESSION * bulk_modulus {
            true => Ok(()),
            false => Err(self.failure(&format!(
                "the pressure reaches {most:.3e} Pa in a pore, above {MOST_COMPRESSION} of the bulk modulus: a max_pressure, a lower \
                 closing_speed or an earlier end is needed"
            ))),
        }
    }

    /// Pressures on the bodies.
    fn pressures(&self, flow: &Flow, forces: &[f64]) -> Pressures {
        let pressure = |body: Option<usize>, sign: f64| {
            body.map_or(0.0, |body| {
                let force = match self.setup.lattice.body_speed(body) {
                    0.0 => sign * forces[body],
                    speed => -sign * speed * flow.force,
                };
                self.setup.pressure(force)
            })
        };
        [
            pressure(self.setup.bottom, -1.0),
            pressure(self.setup.top, 1.0),
            self.setup.pressure(flow.force),
        ]
    }
}
