//! The tables as CSV; the columns are a contract with other people's scripts.

use std::io::{self, Write};

use units::Axis;

use crate::{
    Agreement, BondLine, CellError, DepthLayer, Extrapolated, Map, Penetration, Reference,
    ShearRates,
};

/// Micrometres with six digits behind the point.
fn um(metres: f64) -> String {
    format!("{:.6}", 1e6 * metres)
}

/// The writer's own error in place of csv's wrapping of it, so that a closed pipe can be told.
fn unwrapped(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}

fn um3(cubic_metres: f64) -> String {
    format!("{:.4}", 1e18 * cubic_metres)
}

fn pascal(pressure: f64) -> String {
    format!("{pressure:.6e}")
}

/// One file's rows of the table of `wp-metrics`.
pub struct PenetrationRows {
    /// The file as the user named it.
    pub file: String,
    /// What depths are measured from.
    pub reference: Reference,
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

/// A permeability, and what it was found from.
pub struct PermeabilityRow {
    /// The file as the user named it.
    pub file: String,
    /// Axis of the flow.
    pub axis: Axis,
    /// Permeability and its error, m2.
    pub permeability_m2: [f64; 2],
    /// Share of the volume that is open, and share of that through which liquid flows from side to side.
    pub porosity: f64,
    /// See `porosity`.
    pub through: f64,
}

/// `file,axis,permeability_m2,error_m2,porosity,through`.
///
/// # Errors
/// What `out` says.
pub fn write_permeabilities(out: &mut dyn Write, rows: &[PermeabilityRow]) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let header = "file,axis,permeability_m2,error_m2,porosity,through";
    table.write_record(header.split(',')).map_err(unwrapped)?;
    for row in rows {
        let [m2, error] = row.permeability_m2;
        let cells = [
            row.file.clone(),
            row.axis.to_string(),
            format!("{m2:.6e}"),
            format!("{error:.2e}"),
            format!("{:.6}", row.porosity),
            format!("{:.6}", row.through),
        ];
        table.write_record(cells).map_err(unwrapped)?;
    }
    table.flush()
}

/// `file,side,reference,plane_m,wp_um,slab_wp_um,ep_um,max_depth_um,p99_depth_um,volume_um3,voxels`,
/// then `dice,map_correlation` when the files were compared, `pressure_pa` when asked for,
/// `time_s,gap_um,p95_depth_um,wetted_area_um2,bond_line_filled,bond_line,surfaces_um,half_filled_depth_um` of a
/// series, and
/// `wp_extrapolated_um,wp_error_um,ep_extrapolated_um,ep_error_um,pressure_extrapolated_pa,pressure_error_pa`
/// when a finer run was given.
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
            table.write_record(row).map_err(unwrapped)?;
        }
    }
    table.flush()
}

/// `x_um,z_um,wp_um,volume_um3` (the names of the two axes across the bond), a row for each
/// column of voxels; WP is NaN where there is no adhesive.
///
/// # Errors
/// What `out` says.
pub fn write_map(out: &mut dyn Write, map: &Map) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let [u, v] = map.across.axes.map(|axis: Axis| format!("{axis}_um"));
    table
        .write_record([u.as_str(), v.as_str(), "wp_um", "volume_um3"])
        .map_err(unwrapped)?;
    for (column, &volume) in map.volume_m3.iter().enumerate() {
        let [u, v] = map.across.centre_m(column).map(um);
        let wp = um(map.wp_m(column).unwrap_or(f64::NAN));
        table
            .write_record([u, v, wp, um3(volume)])
            .map_err(unwrapped)?;
    }
    table.flush()
}

/// `depth_um,adhesive_fraction,filled_void_fraction,filled_open_fraction`, bottom adherend at negative depths; after `time_s` (s)
/// for each state of a series.
///
/// # Errors
/// What `out` says.
pub fn write_depth_profiles(
    out: &mut dyn Write,
    profiles: &[(Option<f64>, Vec<DepthLayer>)],
) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let timed = profiles.iter().any(|(time_s, _)| time_s.is_some());
    let header = [
        "depth_um",
        "adhesive_fraction",
        "filled_void_fraction",
        "filled_open_fraction",
    ];
    let header = timed.then_some("time_s").into_iter().chain(header);
    table.write_record(header).map_err(unwrapped)?;
    for (time_s, layers) in profiles {
        for layer in layers {
            let row = [
                um(layer.depth_m),
                format!("{:.6}", layer.adhesive_fraction),
                format!("{:.6}", layer.filled_void_fraction),
                format!("{:.6}", layer.filled_open_fraction),
            ];
            let time = time_s.map(|time_s| format!("{time_s:.9e}"));
            table
                .write_record(time.into_iter().chain(row))
                .map_err(unwrapped)?;
        }
    }
    table.flush()
}

/// `time_s,q05,q10,q25,q50,q75,q90,q95,max,mean,volume_um3`, rates in 1/s.
///
/// # Errors
/// What `out` says.
pub fn write_shear_rates(out: &mut dyn Write, states: &[ShearRates]) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    table
        .write_record([
            "time_s",
            "q05",
            "q10",
            "q25",
            "q50",
            "q75",
            "q90",
            "q95",
            "max",
            "mean",
            "volume_um3",
        ])
        .map_err(unwrapped)?;
    for state in states {
        let mut row = vec![format!("{:.9e}", state.time_s)];
        let rates = state.quantiles.iter().chain([&state.max, &state.mean]);
        row.extend(rates.map(|rate| format!("{rate:.6e}")));
        row.push(um3(state.volume_m3));
        table.write_record(row).map_err(unwrapped)?;
    }
    table.flush()
}
