//! The table of penetration, and its mean over several files.

use std::io::{self, Write};

use super::{pascal, um, um3, unwrapped};
use crate::{Agreement, BondLine, CellError, Extrapolated, Penetration, Reference, Side};

/// One file's rows of the table of `wp-metrics`.
pub struct PenetrationRows {
    /// The file as the user named it.
    pub file: String,
    /// What depths are measured from.
    pub reference: Reference,
    /// How the plane that depths are measured from is turned about x, y and z, degrees; of a fit.
    pub tilt_deg: Option<[f64; 3]>,
    /// Bottom, top and total.
    pub sides: [Penetration; 3],
    /// Agreement with an experiment, when asked for.
    pub agreement: Option<[Agreement; 3]>,
    /// Pressure on the body that the clamp drives, Pa, when asked for.
    pub pressure_pa: Option<f64>,
    /// Time (s), gap (m; NaN where there is none) and bond line of a state in a series.
    pub course: Option<(f64, f64, BondLine)>,
    /// Each side and the pressure carried on to cells of no size, when a finer run was given.
    pub cell_error: Option<([CellError; 3], Extrapolated)>,
}

/// `file,side,reference,plane_m,wp_um,slab_wp_um,ep_um,max_depth_um,p99_depth_um,volume_um3,voxels`,
/// then `dice,map_correlation` when the files were compared, `pressure_pa` when asked for,
/// `time_s,gap_um,p95_depth_um,wetted_area_um2,bond_line_filled,bond_line,surfaces_um,half_filled_depth_um` of a
/// series, and
/// `wp_extrapolated_um,wp_error_um,ep_extrapolated_um,ep_error_um,pressure_extrapolated_pa,pressure_error_pa`
/// when a finer run was given, and `tilt_x_deg,tilt_y_deg,tilt_z_deg` of a fit.
///
/// # Errors
/// What `out` says.
pub fn write_penetration(out: &mut dyn Write, files: &[PenetrationRows]) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let mut header = vec![
        "file",
        "side",
        "reference",
        "plane_m",
        "wp_um",
        "slab_wp_um",
        "ep_um",
        "max_depth_um",
        "p99_depth_um",
        "volume_um3",
        "voxels",
    ];
    if files.iter().any(|f| f.agreement.is_some()) {
        header.extend(["dice", "map_correlation"]);
    }
    if files.iter().any(|f| f.pressure_pa.is_some()) {
        header.push("pressure_pa");
    }
    if files.iter().any(|f| f.course.is_some()) {
        header.extend([
            "time_s",
            "gap_um",
            "p95_depth_um",
            "wetted_area_um2",
            "bond_line_filled",
            "bond_line",
            "surfaces_um",
            "half_filled_depth_um",
        ]);
    }
    if files.iter().any(|f| f.cell_error.is_some()) {
        header.extend([
            "wp_extrapolated_um",
            "wp_error_um",
            "ep_extrapolated_um",
            "ep_error_um",
            "pressure_extrapolated_pa",
            "pressure_error_pa",
        ]);
    }
    if files.iter().any(|f| f.tilt_deg.is_some()) {
        header.extend(["tilt_x_deg", "tilt_y_deg", "tilt_z_deg"]);
    }
    table.write_record(header).map_err(unwrapped)?;
    for file in files {
        for (i, p) in file.sides.iter().enumerate() {
            let mut row = vec![
                file.file.clone(),
                p.side.to_string(),
                file.reference.to_string(),
                format!("{:.9e}", p.plane_m),
                um(p.wp_m),
                um(p.slab_wp_m),
                um(p.ep_m),
                um(p.max_depth_m),
                um(p.p99_depth_m),
                um3(p.volume_m3),
                p.voxels.to_string(),
            ];
            if let Some(agreement) = file.agreement {
                row.push(format!("{:.6}", agreement[i].dice));
                row.push(format!("{:.6}", agreement[i].map_correlation));
            }
            row.extend(file.pressure_pa.map(pascal));
            if let Some((time_s, gap_m, line)) = &file.course {
                row.extend([
                    format!("{time_s:.9e}"),
                    um(*gap_m),
                    um(p.p95_depth_m),
                    format!("{:.4}", 1e12 * line.wetted_m2[i]),
                    format!("{:.6}", line.filled),
                    line.filling.to_string(),
                    um(line.surfaces_m),
                    um(line.half_filled_m[i]),
                ]);
            }
            if let Some((sides, pressure)) = &file.cell_error {
                let CellError { wp_m, ep_m } = sides[i];
                row.extend([wp_m.value, wp_m.error, ep_m.value, ep_m.error].map(um));
                row.extend([pressure.value, pressure.error].map(pascal));
            }
            row.extend(
                file.tilt_deg
                    .into_iter()
                    .flatten()
                    .map(|t| format!("{t:.4}")),
            );
            table.write_record(row).map_err(unwrapped)?;
        }
    }
    table.flush()
}

/// A quantity of the summary: the columns of its mean and standard deviation, its value of a side, and how a number of it is
/// written.
type Summed = (
    [&'static str; 2],
    fn(&Penetration) -> f64,
    fn(f64) -> String,
);

const SUMMED: [Summed; 6] = [
    (["wp_um", "wp_sd_um"], |p| p.wp_m, um),
    (["slab_wp_um", "slab_wp_sd_um"], |p| p.slab_wp_m, um),
    (["ep_um", "ep_sd_um"], |p| p.ep_m, um),
    (["max_depth_um", "max_depth_sd_um"], |p| p.max_depth_m, um),
    (["p99_depth_um", "p99_depth_sd_um"], |p| p.p99_depth_m, um),
    (["volume_um3", "volume_sd_um3"], |p| p.volume_m3, um3),
];

/// `side,reference,files`, then mean and standard deviation over the files, each of which counts as one, of `wp_um`,
/// `slab_wp_um`, `ep_um`, `max_depth_um`, `p99_depth_um` and `volume_um3` (`wp_um,wp_sd_um,...`). NaN where a file has NaN.
///
/// # Errors
/// What `out` says.
pub fn write_summary(out: &mut dyn Write, files: &[PenetrationRows]) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let columns = SUMMED.iter().flat_map(|(names, ..)| *names);
    let header = ["side", "reference", "files"].into_iter().chain(columns);
    table.write_record(header).map_err(unwrapped)?;
    let reference = files.first().map_or(Reference::Mid, |file| file.reference);
    for (i, side) in Side::ALL.iter().enumerate() {
        let mut row = vec![
            side.to_string(),
            reference.to_string(),
            files.len().to_string(),
        ];
        for (_, value, written) in SUMMED {
            let values: Vec<f64> = files.iter().map(|file| value(&file.sides[i])).collect();
            row.extend(mean_and_deviation(&values).map(written));
        }
        table.write_record(row).map_err(unwrapped)?;
    }
    table.flush()
}

/// Mean and standard deviation of a sample (n - 1).
fn mean_and_deviation(values: &[f64]) -> [f64; 2] {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    [mean, (squares / (count - 1.0)).sqrt()]
}
