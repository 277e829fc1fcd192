//! The tables as CSV; the columns are a contract with other people's scripts.

mod penetration;

pub use penetration::{PenetrationRows, write_penetration, write_summary};

use std::io::{self, Write};

use units::Axis;

use crate::{DepthLayer, Map, PoreSize, ShearRates};

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

/// `file,diameter_um,volume_fraction,up_to_fraction`, a row for each size of pores in each file.
///
/// # Errors
/// What `out` says.
pub fn write_pores(out: &mut dyn Write, files: &[(String, Vec<PoreSize>)]) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let header = "file,diameter_um,volume_fraction,up_to_fraction";
    table.write_record(header.split(',')).map_err(unwrapped)?;
    for (file, sizes) in files {
        for size in sizes {
            let [share, up_to] = [size.share, size.up_to].map(|share| format!("{share:.6}"));
            let row = [file.clone(), um(size.diameter_m), share, up_to];
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
