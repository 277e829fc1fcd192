//! Points as CSV.

use std::io::{self, Write};

use super::points::{Column, Points, Values};

/// Writes a line per point; the names of the columns carry their units.
pub fn write(points: &Points, out: &mut dyn Write) -> io::Result<()> {
    let names: Vec<String> = points.columns.iter().flat_map(names).collect();
    writeln!(out, "{}", names.join(","))?;
    for row in 0..points.rows {
        for (c, column) in points.columns.iter().enumerate() {
            for i in row * column.components..(row + 1) * column.components {
                let comma = if c == 0 && i == row * column.components {
                    ""
                } else {
                    ","
                };
                match &column.values {
                    Values::F32(v) => write!(out, "{comma}{:e}", v[i])?,
                    Values::F64(v) => write!(out, "{comma}{:e}", v[i])?,
                    Values::U32(v) => write!(out, "{comma}{}", v[i])?,
                    Values::U64(v) => write!(out, "{comma}{}", v[i])?,
                    Values::U8(v) => write!(out, "{comma}{}", v[i])?,
                }
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

/// The header's names of a column, one per component.
fn names(column: &Column) -> Vec<String> {
    let known = match column.name {
        "position" => ["x_m", "y_m", "z_m"].as_slice(),
        "velocity" => &["velocity_x_m_s", "velocity_y_m_s", "velocity_z_m_s"],
        "volume" => &["volume_m3"],
        "pressure" => &["pressure_Pa"],
        "shear_rate" => &["shear_rate_1_s"],
        _ => &[],
    };
    if known.len() == column.components {
        return known.iter().map(|&name| name.to_owned()).collect();
    }
    let name = cli::cell(column.name).replace([',', '"', '\n'], "_");
    match column.components {
        1 => vec![name],
        n => (0..n).map(|i| format!("{name}_{i}")).collect(),
    }
}
