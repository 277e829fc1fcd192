//! The content of a file, in words.

use std::fmt::Write;

use cli::Failure;
use particle_file::{Block, Element, Kind, ParticleFile, Provenance, Section, command_line};

/// What a file holds and how it was made, one fact per line.
pub fn describe(file: &ParticleFile) -> Result<String, Failure> {
    let mut text = String::new();
    write(&mut text, file).map_err(Failure::failed)?;
    Ok(text)
}

fn write(out: &mut String, file: &ParticleFile) -> std::fmt::Result {
    let header = file.header();
    // The header of an opened file names one of the three.
    let normal = ["x", "y", "z"][usize::from(header.normal)];
    writeln!(out, "file        {}", file.name())?;
    writeln!(out, "kind        {}", header.kind)?;
    writeln!(out, "voxel       {} um", um(header.voxel_m))?;
    writeln!(out, "normal      {normal}")?;
    let box_um: Vec<String> = (header.box_min_m.iter().zip(&header.box_max_m))
        .map(|(&low, &high)| format!("{} to {}", um(low), um(high)))
        .collect();
    writeln!(out, "box         {} um", box_um.join(", "))?;
    if matches!(header.kind, Kind::State | Kind::Checkpoint) {
        let (time_s, step) = (units::shortened(header.time_s), header.step);
        writeln!(out, "time        {time_s:e} s, step {step}")?;
    }
    for block in &header.blocks {
        write_block(out, block)?;
    }
    if header.particles > 0 {
        writeln!(out, "liquid      {} points", header.particles)?;
    }
    let mut arrays = file
        .sections()
        .iter()
        .filter(|s| s.element != Element::Bits);
    arrays.try_for_each(|section| write_array(out, section))?;
    for (name, value) in &header.attributes {
        writeln!(out, "attribute   {name} = {value}")?;
    }
    (header.provenance.iter()).try_for_each(|p| write_provenance(out, p))
}

fn write_block(out: &mut String, block: &Block) -> std::fmt::Result {
    let [nx, ny, nz] = block.dims;
    let [x, y, z] = block.origin_m.map(um);
    let all = block.dims.iter().map(|&n| n as f64).product::<f64>();
    writeln!(
        out,
        "block       {}: {}, {} of {nx} x {ny} x {nz} voxels ({:.2} %) of {} um \
         from {x}, {y}, {z} um",
        block.name,
        block.material,
        block.count,
        100.0 * block.count as f64 / all,
        um(block.voxel_m),
    )
}

fn write_array(out: &mut String, section: &Section) -> std::fmt::Result {
    let (name, rows) = (&section.name, section.rows);
    if section.element == Element::Blob {
        return writeln!(out, "blob        {name}: {rows} bytes");
    }
    let element = format!("{:?}", section.element).to_lowercase();
    writeln!(
        out,
        "column      {name}: {rows} rows of {} {element}",
        section.components
    )
}

fn write_provenance(out: &mut String, by: &Provenance) -> std::fmt::Result {
    let command = command_line(&by.command);
    writeln!(out, "made by     {} {}: {command}", by.tool, by.version)?;
    (by.inputs.iter())
        .try_for_each(|(path, hash)| writeln!(out, "  from      {path} (xxh3 {hash:016x})"))
}

/// A length in micrometres without the digits that only rounding made.
fn um(length_m: f64) -> f64 {
    (length_m * 1e12).round() / 1e6
}
