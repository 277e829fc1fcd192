//! The constant part of a run, from the scene.

use std::ops::Range;

use physics::{Clamp, Dimensions, Liquid, Motion, Points, PressRun, Scene, Seed, Stop, Viscosity};

use super::drive::ClampDrive;
use super::remesh::MARGIN;
use crate::air::Gas;
use crate::geometry::{Chords, Face, Lattice, Mesh, Rows};
use crate::liquid::{GridOrigin, deposit};
use crate::settings::Settings;
use crate::system::{Channels, Coefficients, REST_DISTANCE};

/// Units of the scheme.
#[derive(Clone, Copy, Debug)]
pub(super) struct Units {
    /// Edge of a cell, m.
    pub(super) cell_m: f64,
    /// Unit of viscosity, Pa s.
    pub(super) viscosity: f64,
}

impl Units {
    /// Unit of force, N: viscosity times area over time.
    pub(super) fn force(self) -> f64 {
        self.viscosity * self.cell_m * self.cell_m
    }

    /// Unit of volume, m3.
    pub(super) fn volume(self) -> f64 {
        self.cell_m.powi(3)
    }
}

/// The constant part of a run.
pub(super) struct Setup {
    pub(super) settings: Settings,
    pub(super) lattice: Lattice,
    pub(super) chords: Chords,
    pub(super) liquid: Liquid,
    pub(super) units: Units,
    pub(super) origin: GridOrigin,
    gravity: [f64; 3],
    /// Influence length of the walls, cells; infinite without friction.
    pub(super) influence_length: f64,
    pub(super) bottom: Option<usize>,
    pub(super) top: Option<usize>,
    /// Number of the scene's points per cell of liquid.
    pub(super) points_per_cell: f64,
    /// Reference area of pressures, the cross-section of the domain, m2.
    area: f64,
    pub(super) clamp: Option<Clamp>,
    /// The gas law of pockets; `None` where all air is ambient.
    pub(super) gas: Option<Gas>,
    /// Whether each body absorbs water.
    pub(super) absorbs: Vec<bool>,
    /// Motion of each body.
    pub(super) motions: Vec<Motion>,
}

impl Setup {
    /// The setup of a scene, its first mesh, and the liquid volume of each pore.
    ///
    /// # Errors
    /// A sentence on what the scheme cannot do with the scene.
    pub(super) fn new(scene: &Scene, settings: Settings) -> Result<(Self, Mesh, Vec<f64>), String> {
        if scene.points.position.is_empty() {
            return Err("the scene holds no liquid: nothing would move".into());
        }
        let lattice = Lattice::new(scene)?;
        let cell_m = scene.grid.cell_m;
        let speed = scene
            .clamp
            .map_or(scene.initial_speed(), |clamp| clamp.closing_speed);
        let units = Units {
            cell_m,
            viscosity: scene.liquid.viscosity.at(speed / cell_m),
        };
        let origin = GridOrigin {
            cell_m,
            origin_m: [scene.grid.min_m[0], lattice.gap_low_m, scene.grid.min_m[2]],
            flat: scene.dimensions == Dimensions::Two,
        };
        let rows = lattice.rows();
        let range = rows_of(&scene.points, rows, origin);
        let mesh = Mesh::whole(&lattice, rows, range);
        let volumes = deposit(&mesh, &scene.points, origin, |point| {
            point.volume / cell_m.powi(3)
        })?;
        let setup = Self {
            settings,
            chords: Chords::new(&lattice),
            lattice,
            liquid: scene.liquid.clone(),
            units,
            origin,
            gravity: scene.gravity,
            influence_length: scene.wall.influence_length() / cell_m,
            points_per_cell: scene.points.position.len() as f64 / volumes.iter().sum::<f64>(),
            bottom: scene.bottom,
            top: scene.top,
            area: scene.grid.area_m2(),
            gas: settings.air_pressure.map(|pressure| {
                let tait = scene.liquid.tait;
                Gas::new(pressure, settings.air_leak_time, tait, units.viscosity)
            }),
            clamp: scene.clamp,
            motions: scene.bodies.iter().map(|body| body.motion).collect(),
            absorbs: (scene.bodies.iter())
                .map(|body| {
                    let water = scene.liquid.water.as_ref();
                    water.is_some_and(|water| water.enters(&body.name))
                })
                .collect(),
        };
        Ok((setup, mesh, volumes))
    }

    /// The inputs of the wall couplings of a mesh.
    pub(super) fn channels<'a>(&'a self, mesh: &'a Mesh) -> Channels<'a> {
        Channels {
            lattice: &self.lattice,
            chords: &self.chords,
            mesh,
            influence_length: self.influence_length,
        }
    }

    /// Initial velocity of each face relative to the grid, cells/s: the volume mean of the points in the two pores of the face.
    /// `volumes` is the liquid in each pore, `speed` the closing speed, cells/s, at which the grid moves.
    ///
    /// # Errors
    /// As [`deposit`].
    pub(super) fn initial_velocity(
        &self,
        points: &Points,
        mesh: &Mesh,
        volumes: &[f64],
        speed: f64,
    ) -> Result<Vec<f64>, String> {
        let cell_m = self.units.cell_m;
        let mut moments = Vec::new();
        if points.velocity.iter().any(|v| *v != [0.0; 3]) {
            for axis in 0..3 {
                let moment = |point: &Seed| point.volume * point.velocity[axis] / cell_m.powi(4);
                moments.push(deposit(mesh, points, self.origin, moment)?);
            }
        }
        let velocity = |(index, face): (usize, &Face)| {
            let axis = usize::from(face.axis);
            let ends = [face.low as usize, face.high as usize];
            let sum = |of: &[f64]| of[ends[0]] + of[ends[1]];
            let volume = sum(volumes);
            let own = match moments.get(axis) {
                Some(moments) if volume > 0.0 => sum(moments) / volume,
                _ => 0.0,
            };
            match axis {
                1 => own - mesh.grid_velocity(&self.lattice, index) * speed,
                _ => own,
            }
        };
        Ok(mesh.faces.iter().enumerate().map(velocity).collect())
    }

    /// The drive of the body that closes the gap.
    pub(super) fn drive(&self, scene: &Scene) -> ClampDrive {
        let travel = match scene.stop {
            Stop::Closed { travel_m } => travel_m,
            Stop::Time(_) => f64::INFINITY,
        };
        let stages = &scene.programme;
        let programme = (!stages.is_empty()).then(|| PressRun::new(stages.clone(), travel));
        let full = self.lattice.moving.map_or(0.0, |moving| {
            scene.velocity(scene.bodies[moving.body].motion)[1].abs()
        });
        let acoustic = self.units.cell_m / self.liquid.sound_speed();
        ClampDrive::new(scene.clamp, programme, acoustic, full)
    }

    /// Whether the viscosity depends on the flow.
    pub(super) fn is_non_newtonian(&self) -> bool {
        !matches!(self.liquid.viscosity, Viscosity::Newtonian(_))
    }

    /// Coefficients of the equations of a step of `dt` (s).
    pub(super) fn coefficients(&self, dt: f64) -> Coefficients {
        let (h, eta) = (self.units.cell_m, self.units.viscosity);
        let density = self.liquid.density;
        Coefficients {
            dt,
            slow: REST_DISTANCE * self.settings.cfl / dt,
            inertia: density * h * h / (eta * dt),
            gravity: self.gravity.map(|g| density * h * g / eta),
            compressibility: eta / self.liquid.tait.bulk_modulus,
            influence_length: self.influence_length,
        }
    }

    /// Acceleration by gravity, cells/s2.
    pub(super) fn gravity_acceleration(&self) -> f64 {
        self.gravity.iter().map(|g| g * g).sum::<f64>().sqrt() / self.units.cell_m
    }

    /// Force of a pressure (Pa) on the area of the bond.
    pub(super) fn force(&self, pressure: f64) -> f64 {
        pressure * self.area / self.units.force()
    }

    /// Pressure of a force on the area of the bond, Pa.
    pub(super) fn pressure(&self, force: f64) -> f64 {
        force * self.units.force() / self.area
    }
}

/// The range of rows that covers the points and the gap, and a margin around them.
fn rows_of(points: &Points, rows: Rows, origin: GridOrigin) -> Range<usize> {
    let gap = [0.0, rows.height];
    let [low, high] = points.seeds().fold(gap, |[low, high], point| {
        let y = (point.position[1] - origin.origin_m[1]) / origin.cell_m;
        let half = origin.half(point.volume)[1];
        [low.min(y - half), high.max(y + half)]
    });
    let sides: Vec<f64> = (0..rows.len()).map(|row| rows.low(row)).collect();
    let start = sides.partition_point(|side| *side <= low).saturating_sub(1);
    let end = sides.partition_point(|side| *side < high);
    start.saturating_sub(MARGIN)..(end + MARGIN).min(rows.len())
}

impl Lattice {
    /// The rows of the grid at the start.
    pub(crate) fn rows(&self) -> Rows {
        let open = usize::from(self.boundary[1] == physics::Boundary::Open);
        let [below, _, above] = (self.layers.each_ref()).map(|part| part.len().div_ceil(self.k));
        let below = match self.moving {
            Some(_) => below + open,
            None => open,
        };
        Rows::of_gap(below, above + open, self.gap_height)
    }
}
