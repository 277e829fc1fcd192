//! The small bond line of the trade-off study: a synthetic specimen closed at constant speed,
//! against the implicit scheme with the finest cells.

use std::path::Path;

use super::settings::Setting;
use super::{Flow, Row};
use crate::Result;
use crate::method::{Method, Scheme};
use crate::outputs::{Run, synthetic_bond};
use crate::study::side_by_side;

/// Edge of a cell of the reference, um: half a voxel.
const FINEST: f64 = 0.725;

/// Mean clamp pressure over the second half of the closing (Pa), WP (um) and CPU time (s).
#[derive(Clone, Copy, Debug)]
struct Closed {
    pressure: f64,
    wp: f64,
    cpu_s: f64,
}

/// Runs the settings that ask for it.
pub(super) fn rows(settings: &[Setting], folder: &Path) -> Result<Vec<Row>> {
    let bond = folder.join("bond.mpts");
    synthetic_bond(&bond, "24x72x24", "11.6 um")?;
    let implicit = Method::implicit();
    let reference = close(&bond, &implicit, FINEST, &folder.join("reference"))?;
    println!(
        "bond line, implicit, cells of {FINEST} um: {:.4e} Pa, WP {:.4} um, {:.0} s",
        reference.pressure, reference.wp, reference.cpu_s
    );
    let chosen: Vec<&Setting> = settings.iter().filter(|s| s.bond).collect();
    let rows: Vec<[Row; 2]> = side_by_side(&chosen, |&setting| {
        // Six cells are two voxels each, as in the paper.
        let cell = 17.4 / f64::from(setting.cells);
        let runs = folder.join(setting.method.file_label());
        let closed = close(&bond, &setting.method, cell, &runs);
        compared(setting, closed.map_err(|e| e.to_string()), &reference)
    });
    Ok(rows.into_iter().flatten().collect())
}

/// Pressure and WP of a run against the reference; said on standard output too.
fn compared(setting: &Setting, closed: Result<Closed, String>, reference: &Closed) -> [Row; 2] {
    let row = |flow: Flow, of: fn(&Closed) -> f64| {
        let error = |c: &Closed| (of(c) / of(reference) - 1.0).abs();
        let row = Row {
            flow,
            setting: setting.clone(),
            error: closed.as_ref().map_or(f64::NAN, error),
            cpu_s: closed.as_ref().map_or(f64::NAN, |c| c.cpu_s),
            failed: closed.as_ref().err().cloned(),
            pareto: false,
        };
        let (flow, label) = (flow.name(), &setting.method.label);
        let failed = row.failed.as_deref().unwrap_or("");
        println!(
            "{flow:<20} {label:<36} {:.3e} {:7.1} s {failed}",
            row.error, row.cpu_s
        );
        row
    };
    [
        row(Flow::BondPressure, |c| c.pressure),
        row(Flow::BondWp, |c| c.wp),
    ]
}

/// Closes the bond line at 1 m/s, whatever the pressure.
fn close(bond: &Path, method: &Method, cell_um: f64, folder: &Path) -> Result<Closed> {
    let case = match method.scheme {
        Scheme::Explicit => "pipelines/cases/pf-flip.toml",
        Scheme::Implicit => "pipelines/cases/pf-implicit.toml",
    };
    let bond = bond.display().to_string();
    let cell = format!("grid.cell=\"{cell_um} um\"");
    let mut arguments = vec!["--particles", &bond];
    for change in [
        cell.as_str(),
        // The wall law's length does not go with the cell here.
        "contact.influence_length=\"29 nm\"",
        "clamp.max_pressure=\"100 MPa\"",
        "output.history_every=\"0.1 us\"",
        "output.snapshots=0",
    ] {
        arguments.extend(["--set", change]);
    }
    let run = method.run(Path::new(case), folder, &arguments)?;
    Ok(Closed {
        pressure: late_pressure(&run)?,
        wp: run.weighted_penetration()?[2],
        cpu_s: run.cpu_s(),
    })
}

/// Mean of both reactions over the second half of the travel: the work over the way.
fn late_pressure(run: &Run) -> Result<f64> {
    let [travel, bottom, top] =
        run.columns(["displacement_m", "pressure_bottom_Pa", "pressure_top_Pa"])?;
    let [end] = run.ends(["displacement_m"])?;
    let work = (1..travel.len()).map(|i| {
        let way = travel[i] - travel[i - 1].max(0.5 * end);
        0.25 * (bottom[i - 1] + bottom[i] + top[i - 1] + top[i]) * way.max(0.0)
    });
    Ok(work.sum::<f64>() / (0.5 * end))
}
