//! The interface of a scheme.

use std::fmt;

use crate::PressRun;

/// Limits of a step.
#[derive(Clone, Copy, Debug)]
pub struct StepLimit {
    /// Time to the next event that a step must meet exactly, s.
    pub time_s: f64,
    /// Clamp travel to closure, m; infinite without a clamp.
    pub travel_m: f64,
}

/// Report of a step, from data at hand.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepReport {
    /// Time step, s.
    pub dt_s: f64,
    /// Speed of the clamp during the step, m/s.
    pub closing_speed: f64,
    /// Clamp travel since the start, m.
    pub travel_m: f64,
    /// Normal force of the liquid on the lower body over the bond area, Pa; positive in compression.
    pub pressure_bottom: f64,
    /// The same on the upper body.
    pub pressure_top: f64,
    /// Material points that left through an open side so far; voxels of liquid, if the scheme does not follow points.
    pub lost: u64,
    /// Iterations of the linear solver; 0 for an explicit step.
    pub iterations: u32,
}

/// Quantities computed only when a row of the history is due.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Diagnostics {
    /// Kinetic energy of the liquid, J.
    pub kinetic_energy: f64,
    /// Viscous dissipation, W.
    pub viscous_power: f64,
    /// Current volume of the liquid, m3.
    pub volume: f64,
    /// Largest speed of a material point, m/s.
    pub max_speed: f64,
    /// Fraction of the liquid volume whose viscosity was capped to keep an explicit step
    /// stable; 0 for an implicit one.
    pub capped_fraction: f64,
    /// Water balance of a liquid that loses water.
    pub water: Option<WaterState>,
}

/// Water balance of a liquid that loses water to the walls.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WaterState {
    /// Water given off by the remaining material points, m3.
    pub given_off_m3: f64,
    /// Volume of water in the walls, m3.
    pub in_walls_m3: f64,
    /// Fraction of the water that the balance misses: not in points or walls, and not gone with points that left.
    pub missing: f64,
    /// Mean solids content of the liquid, by mass.
    pub solids: f64,
}

/// The liquid for snapshots and metrics: arrays of equal length, one entry per point.
#[derive(Clone, Debug, Default)]
pub struct LiquidState {
    /// Positions, m.
    pub position: Vec<[f32; 3]>,
    /// Velocities, m/s.
    pub velocity: Vec<[f32; 3]>,
    /// Current volumes, m3.
    pub volume: Vec<f32>,
    /// Pressures, Pa.
    pub pressure: Vec<f32>,
    /// Shear rates by the scene's convention, 1/s.
    pub shear_rate: Vec<f32>,
    /// Solids contents by mass; empty if the liquid loses no water.
    pub solids: Vec<f32>,
}

/// One array of a saved scheme.
#[derive(Clone, Debug, PartialEq)]
pub enum Array {
    /// Single precision.
    F32(Vec<f32>),
    /// Double precision.
    F64(Vec<f64>),
    /// Indices.
    U32(Vec<u32>),
}

/// A function that passes the pieces of an array, in order, to a visitor; it can be called repeatedly.
pub type Pieces<'a, T> = Box<dyn Fn(&mut dyn FnMut(&[T])) + 'a>;

/// One array of a scheme that is being saved: whole, or in pieces, so that arrays as large as the liquid are not in memory
/// twice.
pub enum Saving<'a> {
    /// The whole array.
    Whole(Array),
    /// In single precision.
    F32(Pieces<'a, f32>),
    /// In double precision.
    F64(Pieces<'a, f64>),
    /// Indices.
    U32(Pieces<'a, u32>),
}

impl Saving<'_> {
    /// The array.
    fn whole(self) -> Array {
        fn joined<T: Copy>(pieces: &Pieces<T>) -> Vec<T> {
            let mut all = Vec::new();
            pieces(&mut |piece| all.extend_from_slice(piece));
            all
        }
        match self {
            Self::Whole(array) => array,
            Self::F32(pieces) => Array::F32(joined(&pieces)),
            Self::F64(pieces) => Array::F64(joined(&pieces)),
            Self::U32(pieces) => Array::U32(joined(&pieces)),
        }
    }
}

/// The saved state of a scheme, from which it continues with the same bits: named arrays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Saved(pub Vec<(String, Array)>);

/// Arrays by name and type; an error if one is absent or of another type.
macro_rules! arrays {
    ($(#[$doc:meta] $name:ident $kind:ident $type:ident $otherwise:literal,)*) => {
        $(#[$doc]
        pub fn $name(&self, name: &str) -> Result<&[$type], String> {
            match self.find(name)? {
                Array::$kind(array) => Ok(array),
                _ => Err(format!("array '{name}' of the checkpoint {}", $otherwise)),
            }
        })*
    };
}

impl Saved {
    arrays! {
        /// The array `name` in double precision.
        f64s F64 f64 "is not in double precision",
        /// The array `name` in single precision.
        f32s F32 f32 "is not in single precision",
        /// The array `name` of indices.
        u32s U32 u32 "does not hold indices",
    }

    fn find(&self, name: &str) -> Result<&Array, String> {
        let found = self.0.iter().find(|(n, _)| n == name);
        found
            .map(|(_, array)| array)
            .ok_or_else(|| format!("the checkpoint has no array '{name}'"))
    }
}

/// Time spent in one named stage of a step.
#[derive(Clone, Copy, Debug)]
pub struct StageTime {
    /// Name as in the algorithm's description.
    pub name: &'static str,
    /// Wall-clock seconds so far.
    pub wall_s: f64,
}

/// Why a step failed: step, place and likely cause, in one sentence.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure(pub String);

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Failure {}

/// A time-stepping scheme over a scene.
pub trait Scheme {
    /// Takes one step, at most as far as `limit`.
    ///
    /// # Errors
    /// If the state is no longer sound; the state before the step is then lost.
    fn advance(&mut self, limit: StepLimit) -> Result<StepReport, Failure>;
    /// Quantities of a history row, for the state after the last step.
    fn diagnostics(&self) -> Diagnostics;
    /// The liquid after the last step.
    fn liquid(&self) -> LiquidState;
    /// Positions and volumes of the liquid, for the metrics of a history row; other arrays may be empty.
    fn filling(&self) -> LiquidState {
        self.liquid()
    }
    /// Displacement of each body of the scene, m.
    fn displacements(&self) -> Vec<[f64; 3]>;
    /// The arrays for [`Scheme::restore`], by name.
    fn saving(&self) -> Vec<(String, Saving<'_>)>;
    /// The same arrays in memory.
    fn save(&self) -> Saved {
        let arrays = self.saving().into_iter();
        Saved(arrays.map(|(name, array)| (name, array.whole())).collect())
    }
    /// Restores a saved state.
    ///
    /// # Errors
    /// If the arrays are not those of this scheme and scene.
    fn restore(&mut self, saved: &Saved) -> Result<(), String>;
    /// Wall time per stage since the start.
    fn stage_times(&self) -> Vec<StageTime>;
    /// Interventions of the scheme since the start, counted by kind, for the summary.
    fn counts(&self) -> Vec<(&'static str, u64)>;
    /// The press programme and its progress, if there is one.
    fn programme(&self) -> Option<&PressRun> {
        None
    }
    /// Whether the liquid has set by drying, before the time of its cure.
    fn has_set(&self) -> bool {
        false
    }
    /// Whether the points of [`Scheme::liquid`] are the scene's material points, followed from the start; else they sample a
    /// field, and their number varies.
    fn follows_points(&self) -> bool {
        true
    }
    /// The scheme's own objection to its results, a clause.
    fn objection(&self) -> Option<String> {
        None
    }
}
