//! Types shared by both schemes, independent of any grid: the scene in SI, its materials (a Tait liquid and rigid voxel
//! bodies), the wall law between them, clamp control, and the regime numbers that justify what is left out.

mod bodies;
mod choice;
mod clamp;
mod material;
mod press;
mod regime;
pub mod restored;
mod scene;
mod scheme;
mod stages;
mod wall_law;

pub use bodies::{Motion, RigidBody, VoxelBlock};
pub use choice::Choice;
pub use clamp::{Clamp, Pid, PidControl, breaks, broken};
pub use material::{
    Course, Cure, CureLaw, Law, Liquid, Newtonian, Rheology, SET, ShearRate, TAIT_C, Table, Tait,
    Viscosity, Water, WaterLaw, Wetting,
};
pub use press::{CONTROLLED, Press, PressRun, PressStage, PressStep, Reason, StageEnd};
pub use regime::Regime;
pub use scene::{Amount, Boundary, Dimensions, GridBox, Points, Scene, Seed, Stop, norm};
pub use scheme::{
    Array, Diagnostics, Failure, LiquidState, Pieces, Saved, Saving, Scheme, StageTime, StepLimit,
    StepReport, WaterState,
};
pub use stages::{Stage, Stages};
pub use wall_law::WallLaw;
