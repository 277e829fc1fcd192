//! Scenes of about one CPU second that use as little as possible.

use std::path::{Path, PathBuf};

use crate::case_text::{Body, CaseText};
use crate::job::write_case;
use crate::method::Method;
use crate::verification::{Scene, slit};

const CELL: f64 = 2.9e-6;
const SPEED: [f64; 2] = [0.4, 0.3];

/// A scene to be timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bench {
    /// A drop in free flight, FLIP, three dimensions: no body, side, clamp, body force or table.
    ExplicitFree,
    /// The same in plane strain.
    ExplicitFlat,
    /// A piston at constant speed that pushes a Newtonian liquid into a slit of twelve cells,
    /// implicit.
    ImplicitSlit,
}

impl Bench {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Bench::ExplicitFree => "free drop, FLIP",
            Bench::ExplicitFlat => "free drop in plane strain, FLIP",
            Bench::ImplicitSlit => "piston into slit, implicit",
        }
    }

    /// Two times (us) between which it takes a few steps.
    pub fn few_steps_us(self) -> [f64; 2] {
        match self {
            Bench::ExplicitFree | Bench::ExplicitFlat => [0.0005, 0.004],
            Bench::ImplicitSlit => [0.5, 2.0],
        }
    }

    /// Writes its case file into `folder`.
    ///
    /// # Errors
    /// The system's reason.
    pub fn write(self, folder: &Path) -> Result<PathBuf, String> {
        let (scene, method) = match self {
            Bench::ExplicitFree => (drop(3, 14.0, 0.2e-6), Method::flip()),
            Bench::ExplicitFlat => (drop(2, 40.0, 0.7e-6), Method::flip()),
            Bench::ImplicitSlit => (slit::scene(12, [0.0; 2]), Method::implicit()),
        };
        write_case(folder, &scene, &method)
    }
}

/// A square or cube of liquid of `edge` cells that flies for `until` (s).
fn drop(dimensions: u8, edge: f64, until: f64) -> Scene {
    let depth = if dimensions == 3 { edge } else { 1.0 };
    let margin = if dimensions == 3 { 2.0 } else { 0.0 };
    let low = [2.0 * CELL, 2.0 * CELL, margin * CELL];
    let sizes = [edge, edge, depth];
    let high = std::array::from_fn(|a| low[a] + sizes[a] * CELL);
    let domain = [edge + 4.0, edge + 4.0, depth + 2.0 * margin].map(|n| n * CELL);
    let z = if dimensions == 3 { "open" } else { "symmetry" };
    let case = CaseText {
        boundary: ["open", "open", z],
        stop: Some(until),
        bodies: vec![Body::liquid(low, high).moving([SPEED[0], SPEED[1], 0.0])],
        history_every: until,
        ..CaseText::new(
            "A drop in free flight, which needs nothing but the equations of motion.",
            CELL,
            dimensions,
            domain,
        )
    };
    Scene {
        name: format!("free-drop-{dimensions}d"),
        case,
        against: "itself",
        measure: Box::new(|_| Ok(Vec::new())),
    }
}
