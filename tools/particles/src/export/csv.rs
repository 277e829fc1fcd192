//! Points as CSV.

use std::io::{self, Write};

use bytemuck::pod_read_unaligned;
use particle_file::Element;

use super::points::{Column, Points};

/// Writes a line per point; the names of the columns carry their units.
pub fn write(points: &Points, out: &mut dyn Write) -> io::Result<()> {
    let names: Vec<String> = points.columns.iter().flat_map(names).collect();
    writeln!(out, "{}", names.join(","))?;
    for row in 0..points.rows {
        let mut comma = "";
        for column in &points.columns {
            let size = column.element.size() as usize;
            let width = column.components * size;
            for value in column.bytes[row * width..(row + 1) * width].chunks_exact(size) {
                out.write_all(comma.as_bytes())?;
                write_value(column.element, value, out)?;
                comma = ",";
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

fn write_value(element: Element, value: &[u8], out: &mut dyn Write) -> io::Result<()> {
    match element {
        Element::F32 => write!(out, "{:e}", pod_read_unaligned::<f32>(value)),
        Element::F64 => write!(out, "{:e}", pod_read_unaligned::<f64>(value)),
        Element::U32 => write!(out, "{}", pod_read_unaligned::<u32>(value)),
        Element::U64 | Element::Bits => write!(out, "{}", pod_read_unaligned::<u64>(value)),
        Element::U8 | Element::Blob => write!(out, "{}", value[0]),
    }
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
