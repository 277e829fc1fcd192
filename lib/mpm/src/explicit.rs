use physics::{
    Diagnostics, Failure, LiquidState, Motion, PidControl, Saved, Scene, Scheme, StageTime,
    StepLimit, StepReport, Viscosity,
};

use crate::collide::Obstacle;
use crate::contact::separation_limit;
use crate::density::Projection;
use crate::lanes::{Oct, Quad};
use crate::lattice::Lattice;
use crate::material::{Constant, Segments, Stress};
use crate::nodes::Mode;
use crate::plan::Plan;
use crate::real::Real;
use crate::settings::{PressureFrom, Settings, VelocityUpdate};
use crate::step::Stage;
use crate::tiles::Point;
use crate::topology::{Extras, Grid};
use crate::transfer::{AnyFlow, Kernels};
use crate::walls::{BlockShape, Integrator};

/// The explicit scheme on a scene.
pub struct Explicit {
    /// The scene without its points, which live in `grid`.
    pub(crate) scene: Scene,
    pub(crate) settings: Settings,
    pub(crate) plan: Plan,
    pub(crate) kernels: Kernels,
    pub(crate) flow: AnyFlow,
    pub(crate) stress: Stress,
    pub(crate) grid: Grid,
    pub(crate) integrator: Integrator,
    pub(crate) separation: Real,
    /// Voxel blocks of each body, in cells.
    pub(crate) parts: Vec<Vec<BlockShape>>,
    pub(crate) control: Option<PidControl>,
    pub(crate) projection: Option<Projection>,
    pub(crate) state: State,
    /// Tiles changed since the bodies' reach was marked on them.
    pub(crate) unseen: bool,
    pub(crate) stage_s: [f64; Stage::COUNT],
}

/// What changes from step to step besides points.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct State {
    pub(crate) step: u64,
    pub(crate) time_s: f64,
    pub(crate) travel_m: f64,
    /// Displacement of each body, m.
    pub(crate) displacement: Vec<[f64; 3]>,
    /// Largest stable step now, s; the Courant number is not in it, because a run may go on from
    /// a saved state at another one.
    pub(crate) limit_s: f64,
    pub(crate) lost: u64,
    pub(crate) corrections: Corrections,
}

/// How often points had to be kept out of the bodies since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Corrections {
    /// Times a point was stopped at the face of a solid voxel.
    pub stopped: u64,
    /// Times it was left inside one, caught between two bodies.
    pub trapped: u64,
}

impl Explicit {
    /// The scheme at the start of `scene`.
    ///
    /// # Errors
    /// Settings out of range, more bodies than 64, and points outside the grid or in a body.
    pub fn new(scene: &Scene, settings: &Settings) -> Result<Self, String> {
        settings.check()?;
        if scene.bodies.len() > 64 {
            return Err(format!(
                "the scene has {} rigid bodies: the explicit scheme takes at most 64",
                scene.bodies.len()
            ));
        }
        let plan = Plan::new(scene, &physics::Amount::of(&scene.points), settings);
        let lattice = Lattice::new(scene);
        let affine = settings.velocity_update == VelocityUpdate::Apic;
        let (cell, density) = (scene.grid.cell_m, scene.liquid.density);
        let filtered = matches!(
            settings.velocity_update,
            VelocityUpdate::Xpic(2..) | VelocityUpdate::Fmpm(2..)
        );
        let parts: Vec<Vec<BlockShape>> = scene
            .bodies
            .iter()
            .map(|body| BlockShape::of(body, scene.grid.min_m, cell))
            .collect();
        let mut explicit = Self {
            scene: Scene {
                points: Default::default(),
                ..scene.clone()
            },
            settings: *settings,
            plan,
            kernels: Kernels::new(settings.shape, lattice.three, affine),
            flow: match &scene.liquid.viscosity {
                Viscosity::Newtonian(law) => AnyFlow::Constant(Constant::new(law.0, density)),
                Viscosity::Table(table) => AnyFlow::Segments(Segments::new(table, density)),
            },
            stress: Stress::new(&scene.liquid, cell, plan.viscosity_cap),
            integrator: Integrator::new(&lattice, settings.shape),
            separation: settings
                .separation
                .map_or(separation_limit(settings.shape), |cells| cells as Real),
            grid: Grid::new(
                lattice,
                scene.bodies.len(),
                Extras {
                    filtered,
                    affine,
                    cell_sums: settings.pressure == PressureFrom::CellMean,
                },
            ),
            parts,
            control: scene
                .clamp
                .map(|clamp| PidControl::new(clamp, cell / scene.liquid.sound_speed())),
            projection: settings
                .density_projection
                .map(|every| Projection::new(every, scene.initial_speed())),
            state: State {
                step: 0,
                time_s: 0.0,
                travel_m: 0.0,
                displacement: vec![[0.0; 3]; scene.bodies.len()],
                limit_s: plan.acoustic_s.min(plan.viscous_s),
                lost: 0,
                corrections: Corrections::default(),
            },
            unseen: true,
            stage_s: [0.0; Stage::COUNT],
        };
        let points = explicit.initial_points(scene)?;
        explicit.grid.insert(points);
        Ok(explicit)
    }

    /// Times points had to be kept out of the bodies.
    pub fn corrections(&self) -> Corrections {
        self.state.corrections
    }

    /// The plan the run follows.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// What the second half of a node's velocity holds.
    pub(crate) fn mode(&self) -> Mode {
        match self.settings.velocity_update {
            VelocityUpdate::Flip => Mode::Increment,
            VelocityUpdate::Xpic(2..) => Mode::FilterBefore,
            VelocityUpdate::Fmpm(2..) => Mode::FilterAfter,
            _ => Mode::Replace,
        }
    }

    /// Bodies that move from displacement `from` to `to`, m.
    pub(crate) fn obstacles<'a>(
        &'a self,
        from: &[[f64; 3]],
        to: &[[f64; 3]],
        velocities: &[[Real; 3]],
    ) -> Vec<Obstacle<'a>> {
        let cell = self.scene.grid.cell_m;
        self.parts
            .iter()
            .enumerate()
            .map(|(b, parts)| Obstacle {
                parts,
                from: from[b].map(|x| x / cell),
                to: to[b].map(|x| x / cell),
                velocity: velocities[b],
            })
            .collect()
    }

    /// Velocity of each body at closing speed `speed`, m/s.
    pub(crate) fn body_velocities(&self, speed: f64) -> Vec<[f64; 3]> {
        self.scene
            .bodies
            .iter()
            .map(|body| match body.motion {
                Motion::Fixed => [0.0; 3],
                Motion::Constant(v) => v,
                Motion::Clamped => [0.0, -speed, 0.0],
            })
            .collect()
    }

    /// The scene's points with their nearest nodes.
    fn initial_points(&self, scene: &Scene) -> Result<Vec<([i32; 3], Point)>, String> {
        let lattice = &self.grid.lattice;
        let (cell, min) = (scene.grid.cell_m, scene.grid.min_m);
        let axes = lattice.axes();
        let rest = self.obstacles(
            &self.state.displacement,
            &self.state.displacement,
            &vec![[0.0; 3]; scene.bodies.len()],
        );
        let mut points = Vec::with_capacity(scene.points.position.len());
        let liquid = &scene.points;
        for (id, ((x, v), volume)) in liquid
            .position
            .iter()
            .zip(&liquid.velocity)
            .zip(&liquid.volume)
            .enumerate()
        {
            let mut node = [0; 3];
            let mut place = Quad([0.0, 0.0, 0.0, (volume / cell.powi(3)) as Real]);
            for a in 0..3 {
                let at = (x[a] - min[a]) / cell;
                if !(0.0..=scene.grid.cells[a] as f64).contains(&at) {
                    return Err(format!(
                        "liquid point {id} at {x:?} m lies outside the grid, which ends at {:?} m",
                        scene.grid.max_m()
                    ));
                }
                node[a] = if a < axes { at.round() as i32 } else { 0 };
                place.0[a] = (at - f64::from(node[a])) as Real;
            }
            if let Some(b) = rest.iter().position(|body| {
                body.parts
                    .iter()
                    .any(|part| part.contains(node, &place, &body.to, lattice))
            }) {
                return Err(format!(
                    "liquid point {id} at {x:?} m lies inside the rigid body '{}'",
                    scene.bodies[b].name
                ));
            }
            let Some(folded) = lattice.fold(node) else {
                return Err(format!(
                    "liquid point {id} at {x:?} m is on no node of the grid"
                ));
            };
            let motion = Quad([
                v[0] as Real,
                v[1] as Real,
                if axes == 3 { v[2] as Real } else { 0.0 },
                0.0,
            ]);
            let point = Point {
                id: id as u32,
                place,
                motion,
                stress: Oct::ZERO,
                affine: [Quad::ZERO; 3],
            };
            points.push((folded.node, point));
        }
        Ok(points)
    }
}

impl Scheme for Explicit {
    fn advance(&mut self, limit: StepLimit) -> Result<StepReport, Failure> {
        self.step(limit)
    }

    fn diagnostics(&self) -> Diagnostics {
        let (cell, density) = (self.scene.grid.cell_m, self.scene.liquid.density);
        let volume = cell.powi(3);
        let mut sum = Diagnostics::default();
        let mut capped = 0.0;
        for tile in &self.grid.tiles {
            let points = &tile.points;
            for p in 0..points.len() {
                let [vx, vy, vz, j] = points.motion[p].0.map(f64::from);
                let v0 = f64::from(points.place[p].0[3]) * volume;
                let now = v0 * (1.0 + j);
                let square = vx * vx + vy * vy + vz * vz;
                let rate = f64::from(points.stress[p].0[6]);
                let viscosity = f64::from(points.stress[p].0[7]) * density;
                // 2 eta D':D' with rate = f |D'|
                let norm = rate / self.scene.liquid.shear_rate.factor();
                sum.kinetic_energy += 0.5 * density * v0 * square;
                sum.viscous_power += 2.0 * viscosity * norm * norm * now;
                sum.volume += now;
                sum.max_speed = sum.max_speed.max(square.sqrt());
                if self.scene.liquid.viscosity.at(rate) > 1.001 * self.plan.viscosity_cap {
                    capped += now;
                }
            }
        }
        sum.capped_fraction = if sum.volume > 0.0 {
            capped / sum.volume
        } else {
            0.0
        };
        sum
    }

    fn liquid(&self) -> LiquidState {
        let (cell, min) = (self.scene.grid.cell_m, self.scene.grid.min_m);
        let mut order: Vec<(u32, usize, usize)> = Vec::new();
        for (t, tile) in self.grid.tiles.iter().enumerate() {
            order.extend(tile.points.id.iter().enumerate().map(|(p, &id)| (id, t, p)));
        }
        order.sort_unstable();
        let mut state = LiquidState::default();
        for (_, t, p) in order {
            let tile = &self.grid.tiles[t];
            let points = &tile.points;
            let node = tile.node_of(points.base[p]);
            let [vx, vy, vz, j] = points.motion[p].0;
            state.position.push(std::array::from_fn(|a| {
                let offset = f64::from(node[a]) + f64::from(points.place[p].0[a]);
                (min[a] + offset * cell) as f32
            }));
            state.velocity.push([vx, vy, vz].map(|v| v as f32));
            let v0 = f64::from(points.place[p].0[3]) * cell.powi(3);
            state.volume.push((v0 * (1.0 + f64::from(j))) as f32);
            let pressure = self.stress.pressure(j) * self.scene.liquid.density as Real;
            state.pressure.push(pressure as f32);
            state.shear_rate.push(points.stress[p].0[6] as f32);
        }
        state
    }

    fn displacements(&self) -> Vec<[f64; 3]> {
        self.state.displacement.clone()
    }

    fn save(&self) -> Saved {
        self.to_saved()
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), String> {
        self.take_saved(saved)
    }

    fn counts(&self) -> Vec<(&'static str, u64)> {
        let Corrections { stopped, trapped } = self.state.corrections;
        let mut counts = vec![
            ("points stopped at walls", stopped),
            ("points trapped in walls", trapped),
        ];
        if let Some(projection) = &self.projection {
            counts.push(("density projections", projection.count));
        }
        counts
    }

    fn stage_times(&self) -> Vec<StageTime> {
        Stage::NAMES
            .iter()
            .zip(self.stage_s)
            .map(|(&name, wall_s)| StageTime { name, wall_s })
            .collect()
    }
}
