//! The scene that a scheme computes.

use crate::{Choice, Clamp, Liquid, Motion, PressStage, RigidBody, WallLaw};

/// Number of dimensions computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimensions {
    /// Plane strain: one layer of cells along z, no z velocity; forces are for that depth.
    Two,
    /// Three dimensions.
    Three,
}

impl Dimensions {
    /// Number of computed axes.
    pub fn axes(self) -> usize {
        match self {
            Self::Two => 2,
            Self::Three => 3,
        }
    }
}

/// Condition at the two sides of the domain normal to an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Boundary {
    /// Mirror: no flow through, no friction.
    #[default]
    Symmetry,
    /// Liquid and bodies that leave on one side enter on the other.
    Periodic,
    /// Zero traction; liquid that reaches it is lost and counted.
    Open,
}

impl Choice for Boundary {
    const NAMED: &'static [(&'static str, Self)] = &[
        ("symmetry", Self::Symmetry),
        ("periodic", Self::Periodic),
        ("open", Self::Open),
    ];
}

/// The domain of cubic cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridBox {
    /// Edge of a cell, m.
    pub cell_m: f64,
    /// Low corner, m.
    pub min_m: [f64; 3],
    /// Cells along x, y, z; one along z in plane strain.
    pub cells: [usize; 3],
}

impl GridBox {
    /// High corner, m.
    pub fn max_m(&self) -> [f64; 3] {
        std::array::from_fn(|a| self.min_m[a] + self.cells[a] as f64 * self.cell_m)
    }

    /// Area of the cross-section normal to y, m2, to which clamp pressures refer.
    pub fn area_m2(&self) -> f64 {
        self.cells[0] as f64 * self.cells[2] as f64 * self.cell_m * self.cell_m
    }
}

/// The liquid material points at the start, in flat arrays of equal length.
#[derive(Clone, Debug, Default)]
pub struct Points {
    /// Positions, m.
    pub position: Vec<[f64; 3]>,
    /// Velocities, m/s.
    pub velocity: Vec<[f64; 3]>,
    /// Volumes at J = 1, m3.
    pub volume: Vec<f64>,
}

/// A material point of the liquid at the start, one of [`Points`].
#[derive(Clone, Copy, Debug)]
pub struct Seed {
    /// Position, m.
    pub position: [f64; 3],
    /// Velocity, m/s.
    pub velocity: [f64; 3],
    /// Volume at J = 1, m3.
    pub volume: f64,
}

impl Points {
    /// The points one by one.
    pub fn seeds(&self) -> impl Iterator<Item = Seed> + '_ {
        let motions = self.position.iter().zip(&self.velocity);
        (motions.zip(&self.volume)).map(|((&position, &velocity), &volume)| Seed {
            position,
            velocity,
            volume,
        })
    }
}

impl FromIterator<Seed> for Points {
    fn from_iter<I: IntoIterator<Item = Seed>>(seeds: I) -> Self {
        let mut points = Self::default();
        for seed in seeds {
            points.position.push(seed.position);
            points.velocity.push(seed.velocity);
            points.volume.push(seed.volume);
        }
        points
    }
}

/// Amount and extent of the liquid at the start, which a plan needs; known without making the points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Amount {
    /// Material points.
    pub points: u64,
    /// Volume at J = 1, m3.
    pub volume_m3: f64,
    /// Low corner of the box around them, m.
    pub low_m: [f64; 3],
    /// High corner of that box, m.
    pub high_m: [f64; 3],
    /// Speed of the fastest point, m/s.
    pub speed: f64,
}

impl Default for Amount {
    /// No liquid.
    fn default() -> Self {
        Self {
            points: 0,
            volume_m3: 0.0,
            low_m: [f64::INFINITY; 3],
            high_m: [f64::NEG_INFINITY; 3],
            speed: 0.0,
        }
    }
}

impl Amount {
    /// The amount of `points`.
    pub fn of(points: &Points) -> Self {
        points.seeds().fold(Self::default(), |sum, seed| {
            sum.and(Self {
                points: 1,
                volume_m3: seed.volume,
                low_m: seed.position,
                high_m: seed.position,
                speed: norm(seed.velocity),
            })
        })
    }

    /// This and `other` together.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            points: self.points.saturating_add(other.points),
            volume_m3: self.volume_m3 + other.volume_m3,
            low_m: std::array::from_fn(|a| self.low_m[a].min(other.low_m[a])),
            high_m: std::array::from_fn(|a| self.high_m[a].max(other.high_m[a])),
            speed: self.speed.max(other.speed),
        }
    }
}

/// Length of a vector.
pub fn norm(v: [f64; 3]) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

/// End condition of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// At this travel of the clamp (the adherends are back in place).
    Closed {
        /// Travel, m.
        travel_m: f64,
    },
    /// At this time, s.
    Time(f64),
}

/// A scene in SI: all that a scheme needs, and no more.
///
/// The bond normal is y. In plane strain the grid is one cell deep.
#[derive(Clone, Debug)]
pub struct Scene {
    /// 2 or 3.
    pub dimensions: Dimensions,
    /// Cells and extent.
    pub grid: GridBox,
    /// Sides normal to x, y, z.
    pub boundary: [Boundary; 3],
    /// The liquid's constitutive law.
    pub liquid: Liquid,
    /// The liquid's material points.
    pub points: Points,
    /// Rigid bodies; no two have the same name and motion.
    pub bodies: Vec<RigidBody>,
    /// Law between liquid and bodies.
    pub wall: WallLaw,
    /// Body force per mass, m/s2.
    pub gravity: [f64; 3],
    /// The clamp that drives bodies with `Motion::Clamped`.
    pub clamp: Option<Clamp>,
    /// The stages of its press programme; empty for a clamp of one speed and limit. With a programme, `clamp` has its largest
    /// speed and pressure, and `stop` is the travel at whose end the clamp stands.
    pub programme: Vec<PressStage>,
    /// When to end.
    pub stop: Stop,
    /// Index in `bodies` of the lower reaction reported as `pressure_bottom_Pa`.
    pub bottom: Option<usize>,
    /// Index in `bodies` of the upper reaction reported as `pressure_top_Pa`.
    pub top: Option<usize>,
}

impl Scene {
    /// Liquid volume at J = 1, m3.
    pub fn liquid_volume(&self) -> f64 {
        self.points.volume.iter().sum()
    }

    /// Largest speed known before the first step, m/s: bodies and initial liquid.
    pub fn initial_speed(&self) -> f64 {
        self.speed_with(&Amount::of(&self.points))
    }

    /// Largest speed known before the first step, m/s, for `liquid` instead of the scene's points.
    pub fn speed_with(&self, liquid: &Amount) -> f64 {
        (self.bodies.iter())
            .map(|body| norm(self.velocity(body.motion)))
            .fold(liquid.speed, f64::max)
    }

    /// Period (m) along `axis`; `None` if its sides are not periodic.
    pub fn period(&self, axis: usize) -> Option<f64> {
        let periodic = axis < self.dimensions.axes() && self.boundary[axis] == Boundary::Periodic;
        periodic.then(|| self.grid.cells[axis] as f64 * self.grid.cell_m)
    }

    /// The body that the clamp drives and whose pressure controls the clamp.
    pub fn clamped(&self) -> Option<usize> {
        (self.bodies.iter()).position(|body| body.motion == Motion::Clamped)
    }

    /// Velocity of a body at the clamp's full speed, m/s.
    pub fn velocity(&self, motion: Motion) -> [f64; 3] {
        match motion {
            Motion::Fixed => [0.0; 3],
            Motion::Constant(v) => v,
            Motion::Clamped => [0.0, -self.clamp.map_or(0.0, |c| c.closing_speed), 0.0],
        }
    }
}
