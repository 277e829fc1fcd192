//! The start of a run: the scheme of a scene, and its points on the grid.

use physics::{Amount, PidControl, Scene, Viscosity};

use crate::contact::separation_limit;
use crate::density::Projection;
use crate::explicit::{Corrections, Explicit, State};
use crate::lanes::{Lanes4, Lanes8};
use crate::lattice::Lattice;
use crate::material::{Constant, Segments, Stress};
use crate::plan::Plan;
use crate::real::Real;
use crate::settings::Settings;
use crate::stages::{Clock, Present};
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
        settings.check()?;
        if scene.bodies.len() > 64 {
            return Err(format!(
                "the scene has {} rigid bodies: the explicit scheme takes at most 64",
                scene.bodies.len()
            ));
        }
        let plan = Plan::new(scene, &Amount::of(&scene.points), settings);
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
            kernels: Kernels::new(settings.shape, present.three, mode),
            flow: match &scene.liquid.viscosity {
                Viscosity::Newtonian(law) => AnyFlow::Constant(Constant::new(law.0, density)),
                Viscosity::Table(table) => AnyFlow::Segments(Segments::new(table, density)),
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
            clock: Clock::new(),
            plan,
        };
        let points = explicit.initial_points(scene)?;
        explicit.grid.insert(points);
        Ok(explicit)
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
            let mut place = Lanes4([0.0, 0.0, 0.0, (volume / cell.powi(3)) as Real]);
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
            let motion = Lanes4([
                v[0] as Real,
                v[1] as Real,
                if axes == 3 { v[2] as Real } else { 0.0 },
                0.0,
            ]);
            let point = Point {
                id: id as u32,
                place,
                motion,
                stress: Lanes8::ZERO,
                affine: [Lanes4::ZERO; 3],
            };
            points.push((folded.node, point));
        }
        Ok(points)
    }
}
