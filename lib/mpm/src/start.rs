//! The start of a run: the scheme of a scene, and its points on the grid.

use physics::{Amount, PidControl, Scene, Seed, Viscosity};

use crate::collide::Obstacle;
use crate::contact::separation_limit;
use crate::density::Projection;
use crate::explicit::{Corrections, Explicit, State};
use crate::fields::point::VOLUME;
use crate::lanes::{Lanes4, Lanes8};
use crate::lattice::Lattice;
use crate::material::{Constant, Formula, Segments};
use crate::plan::Plan;
use crate::real::Real;
use crate::settings::Settings;
use crate::stages::{Clock, Present};
use crate::stress::Stress;
use crate::tiles::Point;
use crate::topology::Grid;
use crate::transfer::{AnyFlow, Kernels};
use crate::walls::{BlockShape, Integrator};

impl Explicit {
    /// The scheme at the start of `scene`.
    ///
    /// # Errors
    /// Settings out of range, more bodies than 64, and points outside the grid or in a body.
    pub fn new(scene: &Scene, settings: &Settings) -> Result<Self, String> {
        let amount = Amount::of(&scene.points);
        Self::of_points(scene, &amount, scene.points.seeds(), settings)
    }

    /// The same with `points` instead of the scene's, `amount` in all, which are taken one by one and need not be
    /// in memory twice.
    ///
    /// # Errors
    /// As [`Explicit::new`].
    pub fn of_points(
        scene: &Scene,
        amount: &Amount,
        points: impl Iterator<Item = Seed>,
        settings: &Settings,
    ) -> Result<Self, String> {
        settings.check()?;
        if scene.bodies.len() > 64 {
            return Err(format!(
                "the scene has {} rigid bodies: the explicit scheme accepts at most 64",
                scene.bodies.len()
            ));
        }
        let plan = Plan::new(scene, amount, settings);
        let present = Present::from(&plan.stages);
        let lattice = Lattice::new(scene, present);
        let mode = settings.velocity_update.mode();
        let (cell, density) = (scene.grid.cell_m, scene.liquid.density);
        let blocks = |body| BlockShape::of(body, scene.grid.min_m, cell);
        let mut explicit = Self {
            scene: Scene {
                points: Default::default(),
                ..scene.clone()
            },
            settings: *settings,
            present,
            mode,
            kernels: Kernels::new(present.three, mode),
            flow: match &scene.liquid.viscosity {
                Viscosity::Newtonian(law) => AnyFlow::Constant(Constant((law.0 / density) as Real)),
                Viscosity::Table(table) => AnyFlow::Segments(Segments::new(table, density)),
                Viscosity::Law(law) => AnyFlow::Formula(Formula { law: *law, density }),
            },
            stress: Stress::new(&scene.liquid, cell, plan.viscosity_cap),
            integrator: Integrator::new(&lattice, settings.shape),
            separation: settings
                .separation
                .map_or(separation_limit(settings.shape), |cells| cells as Real),
            grid: Grid::new(lattice, scene.bodies.len(), present),
            parts: scene.bodies.iter().map(blocks).collect(),
            control: (scene.clamp.filter(|_| present.clamp))
                .map(|clamp| PidControl::new(clamp, cell / scene.liquid.sound_speed())),
            projection: (settings.density_projection.filter(|_| present.projection))
                .map(|every| Projection::new(every, scene.speed_with(amount))),
            state: State {
                step: 0,
                time_s: 0.0,
                travel_m: 0.0,
                displacement: vec![[0.0; 3]; scene.bodies.len()],
                limit_s: plan.acoustic_s.min(plan.viscous_s),
                lost: 0,
                corrections: Corrections::default(),
            },
            clock: Clock::new(),
            plan,
        };
        explicit.grid = explicit.initial_grid(points)?;
        Ok(explicit)
    }

    /// The grid with `points` at their nearest nodes.
    fn initial_grid(&self, points: impl Iterator<Item = Seed>) -> Result<Grid, String> {
        let here = &self.state.displacement;
        let rest = self.obstacles(here, here, &vec![[0.0; 3]; self.scene.bodies.len()]);
        let (mut grid, mut fault) = (Grid::like(&self.grid), None);
        grid.insert(points.enumerate().map_while(|(id, seed)| {
            let point = self.initial_point(id, &seed, &rest);
            point.map_err(|said| fault = Some(said)).ok()
        }));
        fault.map_or(Ok(grid), Err)
    }

    fn initial_point(
        &self,
        id: usize,
        seed: &Seed,
        rest: &[Obstacle],
    ) -> Result<([i32; 3], Point), String> {
        let (scene, lattice) = (&self.scene, &self.grid.lattice);
        let (axes, cell) = (lattice.axes(), scene.grid.cell_m);
        let (x, v) = (seed.position, seed.velocity);
        let (mut node, mut place, mut motion) = ([0; 3], Lanes4::ZERO, Lanes4::ZERO);
        place.0[VOLUME] = (seed.volume / cell.powi(3)) as Real;
        for a in 0..3 {
            let at = (x[a] - scene.grid.min_m[a]) / cell;
            if !(0.0..=scene.grid.cells[a] as f64).contains(&at) {
                return Err(format!(
                    "liquid point {id} at {x:?} m lies outside the grid, which ends at {:?} m",
                    scene.grid.max_m()
                ));
            }
            node[a] = if a < axes { at.round() as i32 } else { 0 };
            place.0[a] = (at - f64::from(node[a])) as Real;
            motion.0[a] = if a < axes { v[a] as Real } else { 0.0 };
        }
        let mut bodies = rest.iter();
        if let Some(b) = bodies.position(|body| body.contains(node, &place, lattice)) {
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
        let point = Point {
            id: id as u32,
            place,
            motion,
            stress: Lanes8::ZERO,
            affine: [Lanes4::ZERO; 3],
        };
        Ok((folded.node, point))
    }
}
