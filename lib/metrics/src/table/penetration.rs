//! The table of penetration, and its mean over several files.

use std::io::{self, Write};

use super::{pascal, seconds, share, um, um3, write};
use crate::{Agreement, BondLine, CellError, Extrapolated, Penetration, Reference, Side, Tilt};

/// One file's rows of the table of `wp-metrics`.
pub struct PenetrationRows {
    /// The file as the user named it.
    pub file: String,
    /// Reference of the depths.
    pub reference: Reference,
    /// Tilt of the reference plane, if fitted.
    pub tilt: Option<Tilt>,
    /// Bottom, top and total.
    pub sides: [Penetration; 3],
    /// Agreement with an experiment, when asked for.
    pub agreement: Option<[Agreement; 3]>,
    /// Pressure on the body that the clamp drives, Pa, when asked for.
    pub pressure_pa: Option<f64>,
    /// Time (s), gap (m; NaN where there is none) and bond line of a state in a series.
    pub series: Option<(f64, f64, BondLine)>,
    /// Sides and pressure extrapolated to zero cell size, if a finer run was given.
    pub cell_error: Option<([CellError; 3], Extrapolated)>,
}

/// `file,side,reference,plane_m,wp_um,slab_wp_um,ep_um,max_depth_um,p99_depth_um,volume_um3,voxels`,
/// then `dice,map_correlation` when the files were compared, `pressure_pa` when asked for,
/// `time_s,gap_um,p95_depth_um,wetted_area_um2,bond_line_filled,bond_line,surfaces_um,half_filled_depth_um` of a
/// series, and
/// `wp_extrapolated_um,wp_error_um,ep_extrapolated_um,ep_error_um,pressure_extrapolated_pa,pressure_error_pa`
/// when a finer run was given, and `tilt_x_deg,tilt_y_deg,tilt_z_deg` of a fit with their standard errors
/// `tilt_x_error_deg,tilt_y_error_deg,tilt_z_error_deg`; always last `entered_share,mean_depth_um`.
pub fn write_penetration(out: &mut dyn Write, files: &[PenetrationRows]) -> io::Result<()> {
    let rows = || {
        files
            .iter()
            .flat_map(|file| (0..3).map(|side| cells(file, side)))
    };
    let names: Vec<&str> = rows().take(1).flatten().map(|(name, _)| name).collect();
    let texts = rows().map(|row| row.into_iter().map(|(_, text)| text).collect());
    write(out, &names.join(","), texts)
}

fn cells(file: &PenetrationRows, side: usize) -> Vec<(&'static str, String)> {
    let p = &file.sides[side];
    let mut row = vec![
        ("file", file.file.clone()),
        ("side", p.side.to_string()),
        ("reference", file.reference.to_string()),
        ("plane_m", format!("{:.9e}", p.plane_m)),
        ("wp_um", um(p.wp_m)),
        ("slab_wp_um", um(p.slab_wp_m)),
        ("ep_um", um(p.ep_m)),
        ("max_depth_um", um(p.max_depth_m)),
        ("p99_depth_um", um(p.p99_depth_m)),
        ("volume_um3", um3(p.volume_m3)),
        ("voxels", p.voxels.to_string()),
    ];
    if let Some(agreement) = &file.agreement {
        row.push(("dice", share(agreement[side].dice)));
        row.push(("map_correlation", share(agreement[side].map_correlation)));
    }
    row.extend(
        file.pressure_pa
            .map(|pressure| ("pressure_pa", pascal(pressure))),
    );
    if let Some((time_s, gap_m, line)) = &file.series {
        row.extend([
            ("time_s", seconds(*time_s)),
            ("gap_um", um(*gap_m)),
            ("p95_depth_um", um(p.p95_depth_m)),
            (
                "wetted_area_um2",
                format!("{:.4}", 1e12 * line.wetted_m2[side]),
            ),
            ("bond_line_filled", share(line.filled)),
            ("bond_line", line.filling.to_string()),
            ("surfaces_um", um(line.surfaces_m)),
            ("half_filled_depth_um", um(line.half_filled_m[side])),
        ]);
    }
    if let Some((sides, pressure)) = &file.cell_error {
        let CellError { wp_m, ep_m } = sides[side];
        row.extend([
            ("wp_extrapolated_um", um(wp_m.value)),
            ("wp_error_um", um(wp_m.error)),
            ("ep_extrapolated_um", um(ep_m.value)),
            ("ep_error_um", um(ep_m.error)),
            ("pressure_extrapolated_pa", pascal(pressure.value)),
            ("pressure_error_pa", pascal(pressure.error)),
        ]);
    }
    if let Some(tilt) = file.tilt {
        let names = [
            "tilt_x_deg",
            "tilt_y_deg",
            "tilt_z_deg",
            "tilt_x_error_deg",
            "tilt_y_error_deg",
            "tilt_z_error_deg",
        ];
        let values = tilt.deg.into_iter().chain(tilt.error_deg);
        row.extend(names.into_iter().zip(values.map(|t| format!("{t:.4}"))));
    }
    row.push(("entered_share", share(p.entered_share)));
    row.push(("mean_depth_um", um(p.mean_depth_m)));
    row
}

/// A quantity of the summary: columns of its mean and standard deviation, its value on a side, and its format.
type Summed = (&'static str, fn(&Penetration) -> f64, fn(f64) -> String);

const SUMMED: [Summed; 8] = [
    ("wp_um,wp_sd_um", |p| p.wp_m, um),
    ("slab_wp_um,slab_wp_sd_um", |p| p.slab_wp_m, um),
    ("ep_um,ep_sd_um", |p| p.ep_m, um),
    ("max_depth_um,max_depth_sd_um", |p| p.max_depth_m, um),
    ("p99_depth_um,p99_depth_sd_um", |p| p.p99_depth_m, um),
    ("volume_um3,volume_sd_um3", |p| p.volume_m3, um3),
    ("entered_share,entered_sd", |p| p.entered_share, share),
    ("mean_depth_um,mean_depth_sd_um", |p| p.mean_depth_m, um),
];

/// `side,reference,files`, then mean and standard deviation over the files, with equal weights, of `wp_um`, `slab_wp_um`,
/// `ep_um`, `max_depth_um`, `p99_depth_um`, `volume_um3`, `entered_share` and `mean_depth_um` (`wp_um,wp_sd_um,...`). NaN if any file has NaN.
pub fn write_summary(out: &mut dyn Write, files: &[PenetrationRows]) -> io::Result<()> {
    let columns = SUMMED.map(|(names, ..)| names).join(",");
    let reference = files.first().map_or(Reference::Mid, |file| file.reference);
    let rows = Side::ALL.iter().enumerate().map(|(i, side)| {
        let mut row = vec![
            side.to_string(),
            reference.to_string(),
            files.len().to_string(),
        ];
        for (_, value, written) in SUMMED {
            let values: Vec<f64> = files.iter().map(|file| value(&file.sides[i])).collect();
            row.extend(mean_and_deviation(&values).map(written));
        }
        row
    });
    write(out, &format!("side,reference,files,{columns}"), rows)
}

fn mean_and_deviation(values: &[f64]) -> [f64; 2] {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    [mean, (squares / (count - 1.0)).sqrt()]
}
