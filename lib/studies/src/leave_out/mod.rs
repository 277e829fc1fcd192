//! What a scene pays for features it does not use: the build of the committed tree against builds
//! from which a patch of `pipelines/leave-out` removed one feature, on a scene without it.

pub mod builds;
pub mod instructions;
pub mod pairs;
pub mod report;
pub mod scenes;

use pairs::Pairs;
use scenes::Bench;

/// A feature that a patch removes.
#[derive(Clone, Copy, Debug)]
pub struct Feature {
    /// Name of its patch, without the ending.
    pub name: &'static str,
    /// What the patch removes.
    pub what: &'static str,
    /// The scene without it.
    pub bench: Bench,
}

/// The full build against itself: what the measurement cannot tell apart.
pub const CONTROL: &str = "nothing";

const fn feature(name: &'static str, what: &'static str, bench: Bench) -> Feature {
    Feature { name, what, bench }
}

/// The features, the control first.
pub const FEATURES: &[Feature] = &[
    feature(
        CONTROL,
        "nothing: the same binary twice",
        Bench::ExplicitFree,
    ),
    feature(
        "contact",
        "rigid bodies at nodes and points, wall law, reactions",
        Bench::ExplicitFree,
    ),
    feature(
        "viscosity-table",
        "the table's flow law in stress and wall law",
        Bench::ExplicitFree,
    ),
    feature(
        "shear-rate",
        "the points' shear rate, for the column and the viscous power",
        Bench::ExplicitFree,
    ),
    feature(
        "clamp-control",
        "the clamp's speed and its control",
        Bench::ExplicitFree,
    ),
    feature("gravity", "the body force", Bench::ExplicitFree),
    feature(
        "sides",
        "mirror planes, mirror and periodic images",
        Bench::ExplicitFree,
    ),
    feature(
        "third-dimension",
        "kernels, tiles and blocks of three dimensions",
        Bench::ExplicitFlat,
    ),
    feature("velocity-filter", "XPIC and FMPM", Bench::ExplicitFree),
    feature("apic", "the affine velocity fields", Bench::ExplicitFree),
    feature(
        "cell-mean",
        "pressure from the mean of a cell",
        Bench::ExplicitFree,
    ),
    feature(
        "density-projection",
        "the density projection",
        Bench::ExplicitFree,
    ),
    feature(
        "implicit-viscosity-table",
        "passes for a viscosity that varies",
        Bench::ImplicitSlit,
    ),
    feature(
        "implicit-load-control",
        "solves at a pressure limit",
        Bench::ImplicitSlit,
    ),
    feature("implicit-gravity", "the body force", Bench::ImplicitSlit),
];

/// What became of a feature's comparison.
#[derive(Clone, Debug)]
pub struct Row {
    /// The feature.
    pub feature: Feature,
    /// CPU times and instructions, or why there are none.
    pub measured: Result<Measured, String>,
}

/// What the two builds took.
#[derive(Clone, Debug)]
pub struct Measured {
    /// CPU times.
    pub pairs: Pairs,
    /// Instructions of some steps by the full build and the one without, where valgrind counts.
    pub instructions: Option<[f64; 2]>,
}

impl Measured {
    /// Instructions of the full build over those of the one without.
    pub fn instruction_ratio(&self) -> Option<f64> {
        self.instructions.map(|[full, less]| full / less)
    }
}
