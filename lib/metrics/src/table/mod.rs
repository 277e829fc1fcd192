//! Output tables as CSV. Other people's scripts rely on the columns. Errors are those of `out`.

mod penetration;

pub use penetration::{PenetrationRows, write_penetration, write_summary};

use std::io::{self, Write};

use units::Axis;

use crate::{DepthLayer, Map, PoreSize, ShearRates};

/// Writes the comma-separated names of the columns, and the rows.
fn write(
    out: &mut dyn Write,
    header: &str,
    rows: impl IntoIterator<Item = Vec<String>>,
) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let header = header.split(',').map(str::to_owned).collect();
    for row in [header].into_iter().chain(rows) {
        // Unwrap the error of the writer, so that a closed pipe is recognised.
        table
            .write_record(row)
            .map_err(|error| match error.into_kind() {
                csv::ErrorKind::Io(error) => error,
                other => io::Error::other(format!("{other:?}")),
            })?;
    }
    table.flush()
}

/// A number with so many decimals; zero has no sign.
fn fixed(number: f64, decimals: usize) -> String {
    let text = format!("{number:.decimals$}");
    match text.strip_prefix('-') {
        Some(zero) if zero.bytes().all(|b| b"0.".contains(&b)) => zero.into(),
        _ => text,
    }
}

/// Micrometres with six decimals.
fn um(metres: f64) -> String {
    fixed(1e6 * metres, 6)
}

fn um3(cubic_metres: f64) -> String {
    fixed(1e18 * cubic_metres, 4)
}

fn pascal(pressure: f64) -> String {
    format!("{pressure:.6e}")
}

fn share(share: f64) -> String {
    fixed(share, 6)
}

fn seconds(time_s: f64) -> String {
    format!("{time_s:.9e}")
}

/// A permeability, with the porosity of the specimen.
pub struct PermeabilityRow {
    /// The file as the user named it.
    pub file: String,
    /// Axis of the flow.
    pub axis: Axis,
    /// Permeability and its error, m2.
    pub permeability_m2: [f64; 2],
    /// Open fraction of the volume.
    pub porosity: f64,
    /// Fraction of the open volume that is connected from side to side.
    pub through: f64,
}

/// `file,axis,permeability_m2,error_m2,porosity,through`.
pub fn write_permeabilities(out: &mut dyn Write, rows: &[PermeabilityRow]) -> io::Result<()> {
    let cells = |row: &PermeabilityRow| {
        let [m2, error] = row.permeability_m2;
        vec![
            row.file.clone(),
            row.axis.to_string(),
            format!("{m2:.6e}"),
            format!("{error:.2e}"),
            share(row.porosity),
            share(row.through),
        ]
    };
    let header = "file,axis,permeability_m2,error_m2,porosity,through";
    write(out, header, rows.iter().map(cells))
}

/// `file,diameter_um,volume_fraction,up_to_fraction`, a row for each size of pores in each file.
pub fn write_pores(out: &mut dyn Write, files: &[(String, Vec<PoreSize>)]) -> io::Result<()> {
    let rows = files.iter().flat_map(|(file, sizes)| {
        let cells = |size: &PoreSize| {
            let [of, up_to] = [size.share, size.up_to].map(share);
            vec![file.clone(), um(size.diameter_m), of, up_to]
        };
        sizes.iter().map(cells)
    });
    write(out, "file,diameter_um,volume_fraction,up_to_fraction", rows)
}

/// `x_um,z_um,wp_um,volume_um3` (the names of the two axes across the bond), a row for each
/// column of voxels; WP is NaN where there is no adhesive.
pub fn write_map(out: &mut dyn Write, map: &Map) -> io::Result<()> {
    let [u, v] = map.across.axes;
    let rows = map.volume_m3.iter().enumerate().map(|(column, &volume)| {
        let [u, v] = map.across.centre_m(column).map(um);
        let wp = um(map.wp_m(column).unwrap_or(f64::NAN));
        vec![u, v, wp, um3(volume)]
    });
    write(out, &format!("{u}_um,{v}_um,wp_um,volume_um3"), rows)
}

/// `depth_um,adhesive_fraction,filled_void_fraction,filled_open_fraction`, bottom adherend at negative depths; after `time_s` (s)
/// for each state of a series.
pub fn write_depth_profiles(
    out: &mut dyn Write,
    profiles: &[(Option<f64>, Vec<DepthLayer>)],
) -> io::Result<()> {
    let timed = profiles.iter().any(|(time_s, _)| time_s.is_some());
    let header = "depth_um,adhesive_fraction,filled_void_fraction,filled_open_fraction";
    let header = format!("{}{header}", if timed { "time_s," } else { "" });
    let rows = profiles.iter().flat_map(|(time_s, layers)| {
        let cells = move |layer: &DepthLayer| {
            let shares = [
                layer.adhesive_fraction,
                layer.filled_void_fraction,
                layer.filled_open_fraction,
            ];
            let row = time_s.map(seconds).into_iter().chain([um(layer.depth_m)]);
            row.chain(shares.map(share)).collect()
        };
        layers.iter().map(cells)
    });
    write(out, &header, rows)
}

/// `time_s,q05,q10,q25,q50,q75,q90,q95,max,mean,volume_um3`, rates in 1/s.
pub fn write_shear_rates(out: &mut dyn Write, states: &[ShearRates]) -> io::Result<()> {
    let cells = |state: &ShearRates| {
        let rates = state.quantiles.iter().chain([&state.max, &state.mean]);
        let rates = rates.map(|rate| format!("{rate:.6e}"));
        let row = [seconds(state.time_s)].into_iter().chain(rates);
        row.chain([um3(state.volume_m3)]).collect()
    };
    let header = "time_s,q05,q10,q25,q50,q75,q90,q95,max,mean,volume_um3";
    write(out, header, states.iter().map(cells))
}

#[cfg(test)]
mod tests {
    #[test]
    fn zero_has_no_sign() {
        let told = [-0.0, -4e-8, 4e-8, -0.5, f64::NAN].map(super::share);
        assert_eq!(
            told,
            ["0.000000", "0.000000", "0.000000", "-0.500000", "NaN"]
        );
    }
}
