//! The free drop by the explicit scheme and by its minimal twin.

use std::process::Command;

use mpm::{Explicit, Minimal, Settings};
use physics::{
    Boundary, Dimensions, GridBox, Liquid, Newtonian, Points, Scene, Scheme, ShearRate, StepLimit,
    Stop, Tait, Viscosity, WallLaw,
};

use super::{callgrind, pairs};
use crate::case_text::PF;
use crate::outputs;

const CELL: f64 = 2.9e-6;
/// Cells across the drop, and around it.
const EDGE: usize = 14;
const MARGIN: usize = 5;
/// Steps between which instructions are counted, and steps that are timed.
const COUNTED: [usize; 2] = [2, 12];
const TIMED: usize = 300;
/// Pairs of timed runs.
const PAIRS: usize = 11;
/// The scheme and its twin as `drop` calls them.
const WHO: [&str; 2] = ["scheme", "twin"];

/// What the scheme and its twin took.
pub(super) struct Drop {
    /// Instructions per point and step, where valgrind counts.
    pub(super) instructions: Option<[f64; 2]>,
    /// CPU time, s, and its ratio pair by pair: lower quartile, median, upper quartile.
    seconds: [f64; 2],
    quartiles: [f64; 3],
}

/// Takes `steps` steps of the drop by `who`, the scheme or the twin, on this thread.
///
/// # Errors
/// An unknown name, or what the scheme said.
pub fn fly(who: &str, steps: usize) -> Result<(), String> {
    let scene = scene();
    let settings = Settings::default();
    let free = StepLimit {
        time_s: f64::INFINITY,
        travel_m: f64::INFINITY,
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.map_err(|e| e.to_string())?.install(|| match who {
        "scheme" => {
            let mut run = Explicit::new(&scene, &settings)?;
            (0..steps).try_for_each(|_| run.advance(free).map(drop).map_err(|e| e.0))
        }
        "twin" => {
            let mut run = Minimal::new(&scene, settings.cfl)?;
            (0..steps).try_for_each(|_| run.step(f64::INFINITY).map(drop).map_err(|e| e.0))
        }
        _ => Err(format!("'{who}' is neither scheme nor twin")),
    })
}

fn scene() -> Scene {
    let mut points = Points::default();
    for i in 0..8 * EDGE.pow(3) {
        let across = 2 * EDGE;
        let at = [i % across, i / across % across, i / across / across];
        let metres = |n: usize| (MARGIN as f64 + 0.5 * (n as f64 + 0.5)) * CELL;
        points.position.push(at.map(metres));
        points.velocity.push([0.4, 0.3, 0.2]);
        points.volume.push(CELL.powi(3) / 8.0);
    }
    Scene {
        dimensions: Dimensions::Three,
        grid: GridBox {
            cell_m: CELL,
            min_m: [0.0; 3],
            cells: [EDGE + 2 * MARGIN; 3],
        },
        boundary: [Boundary::Open; 3],
        liquid: Liquid {
            density: PF[0],
            tait: Tait {
                bulk_modulus: PF[1],
            },
            viscosity: Viscosity::Newtonian(Newtonian(PF[2])),
            shear_rate: ShearRate::Paper,
            cure: None,
            water: None,
            cavitation_pressure: None,
            wetting: None,
        },
        points,
        bodies: Vec::new(),
        wall: WallLaw::Stick,
        gravity: [0.0; 3],
        clamp: None,
        programme: Vec::new(),
        stop: Stop::Time(1.0),
        bottom: None,
        top: None,
    }
}

impl Drop {
    pub(super) fn measure() -> Result<Self, String> {
        let program = outputs::bin_folder().join("drop");
        let flight = |who: &str, steps: usize| {
            let mut command = Command::new(&program);
            command.args([who, &steps.to_string()]);
            command
        };
        let counted = |who: &str| {
            let [few, more] = COUNTED.map(|steps| callgrind::total(&flight(who, steps)));
            let per_step = (more? - few?) / (COUNTED[1] - COUNTED[0]) as f64;
            Some(per_step / (8 * EDGE.pow(3)) as f64)
        };
        let instructions = WHO.map(counted);
        let pairs = pairs::measure(WHO.map(|who| flight(who, TIMED)), PAIRS)?;
        Ok(Self {
            instructions: instructions[0].zip(instructions[1]).map(|(a, b)| [a, b]),
            seconds: pairs.seconds(),
            quartiles: pairs.quartiles(),
        })
    }

    /// Instructions of the scheme over those of the twin.
    fn ratio(&self) -> Option<f64> {
        self.instructions.map(|[scheme, twin]| scheme / twin)
    }

    /// Whether the ratio of instructions, where they were counted, is within `allowed` of 1.
    pub(super) fn is_within(&self, allowed: f64) -> bool {
        self.ratio()
            .is_none_or(|ratio| (ratio - 1.0).abs() <= allowed)
    }

    /// One line for the terminal.
    pub(super) fn line(&self) -> String {
        let [low, median, high] = self.quartiles;
        format!(
            "free drop, scheme over twin: instructions {}, CPU {median:.3} ({low:.3} to {high:.3})",
            self.ratio()
                .map_or("not counted".into(), |ratio| format!("{ratio:.4}"))
        )
    }

    /// The page's table.
    pub(super) fn table(&self, allowed: f64) -> String {
        let [low, median, high] = self.quartiles;
        let count = |i: usize| {
            self.instructions
                .map_or("not counted".into(), |n| format!("{:.1}", n[i]))
        };
        let ratio = self
            .ratio()
            .map_or("not counted".into(), |r| format!("{r:.4}"));
        let verdict = match (self.instructions, self.is_within(allowed)) {
            (None, _) => "",
            (_, true) => "yes",
            (_, false) => "**no**",
        };
        format!(
            "| | scheme | twin | scheme over twin | within 2 % |\n|---|---|---|---|---|\n\
             | instructions per point and step | {} | {} | {ratio} | {verdict} |\n\
             | CPU (s), median | {:.2} | {:.2} | {median:.3} ({low:.3} to {high:.3}) | |\n",
            count(0),
            count(1),
            self.seconds[0],
            self.seconds[1]
        )
    }

    /// Rows of the CSV file.
    pub(super) fn rows(&self) -> Vec<Vec<String>> {
        let row = |what: String, value: String| vec!["free drop".into(), what, value];
        let mut rows = Vec::new();
        for (i, who) in WHO.iter().enumerate() {
            if let Some(instructions) = self.instructions {
                let value = format!("{:.3}", instructions[i]);
                rows.push(row(
                    format!("instructions per point and step, {who}"),
                    value,
                ));
            }
            rows.push(row(
                format!("cpu_s, {who}"),
                format!("{:.3}", self.seconds[i]),
            ));
        }
        let names = ["lower quartile", "median", "upper quartile"];
        for (name, value) in names.iter().zip(self.quartiles) {
            rows.push(row(format!("cpu ratio, {name}"), format!("{value:.4}")));
        }
        rows
    }
}
