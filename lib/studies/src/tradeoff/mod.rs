//! Error against CPU time: what scheme, update, shape function, cell size, points, Courant
//! number, bulk modulus, solver tolerance, options and precision cost and give on four flows.

mod bond;
mod report;
mod settings;

use std::path::Path;

use crate::Result;
use crate::job::{Job, Outcome, run_all};
use crate::method::Scheme;
use crate::numbers::rms;
use crate::study::Study;
use crate::verification::{Scene, channel, incline, slit};
use settings::Setting;

/// The build of `mpm-run` with the feature `double`.
const DOUBLE: &str = "target/double/release/mpm-run";

/// The study, with the settings so named.
pub fn run(study: &Study) -> Result<bool> {
    let mut settings = settings::all(Path::new(DOUBLE));
    settings.retain(|setting| study.wants(&setting.method.label));
    let mut rows = bond::rows(&settings, &study.folder().join("bond"))?;
    let bonds = rows.iter().filter(|r| r.flow == Flow::BondPressure);
    let mut cpu_s: Vec<f64> = bonds.map(|r| r.cpu_s).collect();
    let (more, outcomes) = boxes(&settings, &study.folder());
    rows.extend(more);
    cpu_s.extend(outcomes.iter().map(|o| o.cpu_s));
    mark_front(&mut rows);
    report::write(study, &rows, &study.head(cpu_s.into_iter()))?;
    Ok(true)
}

/// The flows, in the order of the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Flow {
    /// Piston into slit: piston force at one and two filled widths, walls on the nodes and a
    /// quarter cell off, of the implicit scheme half a cell.
    Slit,
    /// Channel: mean velocity, walls on the nodes, a quarter (explicit) and half a cell off.
    Channel,
    /// Film on an incline: profile, floor on the nodes.
    Incline,
    /// A small synthetic bond line: mean clamp pressure over the second half of the closing.
    BondPressure,
    /// The same bond line: weighted penetration when closed.
    BondWp,
}

impl Flow {
    const ALL: [Flow; 5] = [
        Flow::Slit,
        Flow::Channel,
        Flow::Incline,
        Flow::BondPressure,
        Flow::BondWp,
    ];

    /// Name in tables, and the beginning of the name of the quantity whose error counts.
    const NAMES: [(&str, &str); 5] = [
        ("piston into slit", "piston force"),
        ("channel", "mean velocity"),
        ("incline", "rms profile"),
        ("bond line, pressure", ""),
        ("bond line, WP", ""),
    ];

    fn name(self) -> &'static str {
        Self::NAMES[self as usize].0
    }

    /// Scenes of this flow with `n` cells across the lumen for a scheme; none where it is not one of
    /// boxes. An implicit step is as long as the runs of the explicit scheme from rest: its channel has two,
    /// and its film one that is long enough, for the error of a backward Euler step not to show.
    fn scenes(self, n: u32, scheme: Scheme) -> Vec<Scene> {
        let until = |explicit: f64, factor: f64| match scheme {
            Scheme::Explicit => explicit,
            Scheme::Implicit => factor * explicit,
        };
        // The implicit scheme takes walls half way between the faces of cells, not a quarter off.
        let (off, offsets): (f64, &[f64]) = match scheme {
            Scheme::Explicit => (0.25, &[0.0, 0.25, 0.5]),
            Scheme::Implicit => (0.5, &[0.0, 0.5]),
        };
        match self {
            Flow::Slit => Vec::from([0.0, off].map(|offset| {
                let mut scene = slit::scene(n, [offset, 0.0]);
                // To two and a quarter of its four and a half widths.
                scene.case.stop = scene.case.stop.map(|t| 0.52 * t);
                scene
            })),
            Flow::Channel => (offsets.iter())
                .map(|&offset| channel::scene(n, offset, None, until(3e-6, 10.0)))
                .collect(),
            Flow::Incline => vec![incline::scene(n, 0.0, until(5e-6, 100.0))],
            Flow::BondPressure | Flow::BondWp => Vec::new(),
        }
    }
}

/// Error and cost of a setting on a flow.
#[derive(Clone, Debug)]
struct Row {
    flow: Flow,
    setting: Setting,
    /// Root mean square of the relative errors over the flow's runs and quantities; NaN when a
    /// run failed.
    error: f64,
    /// CPU time of one run, s.
    cpu_s: f64,
    /// What a failed run said.
    failed: Option<String>,
    /// Whether nothing cheaper is as accurate.
    pareto: bool,
}

/// Runs the settings on the flows of boxes.
fn boxes(settings: &[Setting], folder: &Path) -> (Vec<Row>, Vec<Outcome>) {
    let mut parts: Vec<(Flow, &Setting, Vec<Scene>)> = Vec::new();
    for flow in [Flow::Slit, Flow::Channel, Flow::Incline] {
        let scenes = |s: &Setting| flow.scenes(s.cells, s.method.scheme);
        parts.extend(settings.iter().map(|s| (flow, s, scenes(s))));
    }
    let mut jobs: Vec<Job> = Vec::new();
    for (_, setting, scenes) in &parts {
        jobs.extend(scenes.iter().map(|scene| (scene, setting.method.clone())));
    }
    let outcomes = run_all(&jobs, folder);
    let mut rest = &outcomes[..];
    let mut rows = Vec::new();
    for (flow, setting, scenes) in &parts {
        let (own, others) = rest.split_at(scenes.len());
        rows.push(row(*flow, setting, own));
        rest = others;
    }
    (rows, outcomes)
}

fn row(flow: Flow, setting: &Setting, outcomes: &[Outcome]) -> Row {
    let failed = outcomes.iter().find_map(|o| o.measured.clone().err());
    let all = outcomes
        .iter()
        .filter_map(|o| o.measured.as_ref().ok())
        .flatten();
    let of_flow = all.filter(|m| m.what.starts_with(Flow::NAMES[flow as usize].1));
    let error = rms(of_flow.map(|m| m.error));
    let cpu: f64 = outcomes.iter().map(|o| o.cpu_s).sum();
    Row {
        flow,
        setting: setting.clone(),
        error: if failed.is_some() { f64::NAN } else { error },
        cpu_s: cpu / outcomes.len() as f64,
        failed,
        pareto: false,
    }
}

/// Marks the rows of each flow that nothing cheaper matches.
fn mark_front(rows: &mut [Row]) {
    let all: Vec<(Flow, f64, f64)> = rows.iter().map(|r| (r.flow, r.cpu_s, r.error)).collect();
    for row in rows {
        let beaten = all.iter().any(|&(flow, cpu, error)| {
            flow == row.flow
                && cpu <= row.cpu_s
                && error <= row.error
                && (cpu < row.cpu_s || error < row.error)
        });
        row.pareto = row.error.is_finite() && !beaten;
    }
}
