//! The stages of a step: which of them a run has, and why it leaves out the others.

use crate::{Boundary, Choice, Dimensions, Scene, Viscosity, WallLaw};

/// One stage of a step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stage {
    /// Name in plans and summaries.
    pub name: &'static str,
    /// Why the run leaves it out, in a few words with numbers; `None` for a stage that it has.
    pub absent: Option<String>,
}

/// The stages of a scheme on a scene. The scheme builds its step from this list, and plans list the absent stages.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Stages(Vec<Stage>);

impl Stages {
    /// Motion along z.
    pub const THIRD_DIMENSION: &str = "third dimension";
    /// Rigid bodies.
    pub const CONTACT: &str = "wall contact";
    /// Eq. 3.
    pub const FRICTION: &str = "wall friction";
    /// A viscosity that depends on the shear rate.
    pub const TABLE: &str = "viscosity table";
    /// Gravity.
    pub const FORCE: &str = "body force";
    /// A body that the clamp drives.
    pub const CLAMP: &str = "clamp control";
    /// A clamp that a pressure limit holds back.
    pub const LOAD: &str = "load control";
    /// Sides that mirror.
    pub const MIRRORS: &str = "mirror images";
    /// Sides that wrap around.
    pub const PERIODIC: &str = "periodic images";

    /// The stages whose presence depends on the scene only.
    pub fn of(scene: &Scene) -> Self {
        let absent = |absent: bool, why: &str| absent.then(|| why.to_owned());
        let flat = scene.dimensions == Dimensions::Two;
        let no_side = |kind: Boundary| {
            let sides = &scene.boundary[..if flat { 2 } else { 3 }];
            absent(!sides.contains(&kind), &format!("no {} side", kind.name()))
        };
        let no_body = absent(scene.bodies.is_empty(), "the scene has no rigid body");
        let frictionless = scene.wall == WallLaw::Frictionless;
        let no_friction = absent(frictionless, "frictionless walls (k = 0)");
        let no_table = match &scene.liquid.viscosity {
            Viscosity::Newtonian(law) => Some(format!("Newtonian liquid, {} Pa s", law.0)),
            Viscosity::Table(_) | Viscosity::Law(_) => None,
        };
        let no_force = absent(scene.gravity == [0.0; 3], "gravity is zero");
        let no_clamp = absent(scene.clamp.is_none(), "no [clamp]");
        let unlimited = scene.clamp.is_none_or(|clamp| clamp.max_pressure.is_none());
        let no_limit = absent(unlimited, "constant closing speed: no max_pressure");
        let no_depth = absent(flat, "plane strain: one layer of cells, no z velocity");
        Self::default()
            .and(Self::THIRD_DIMENSION, no_depth)
            .and(Self::CONTACT, no_body.clone())
            .and(Self::FRICTION, no_body.or(no_friction))
            .and(Self::TABLE, no_table)
            .and(Self::FORCE, no_force)
            .and(Self::CLAMP, no_clamp.clone())
            .and(Self::LOAD, no_clamp.or(no_limit))
            .and(Self::MIRRORS, no_side(Boundary::Symmetry))
            .and(Self::PERIODIC, no_side(Boundary::Periodic))
    }

    /// Adds a stage, with the reason if it is absent.
    #[must_use]
    pub fn and(mut self, name: &'static str, absent: Option<String>) -> Self {
        self.0.push(Stage { name, absent });
        self
    }

    /// Whether the run has the stage `name`.
    pub fn has(&self, name: &str) -> bool {
        self.iter().any(|s| s.name == name && s.absent.is_none())
    }

    /// All stages, present or absent.
    pub fn iter(&self) -> impl Iterator<Item = &Stage> {
        self.0.iter()
    }

    /// Names of the present stages.
    pub fn present(&self) -> Vec<&'static str> {
        let present = self.iter().filter(|stage| stage.absent.is_none());
        present.map(|stage| stage.name).collect()
    }
}
