//! Reading a checkpoint.

use std::path::Path;

use particle_file::ParticleFile;

use super::*;
use crate::failure::refused;

/// Reads the run folder's checkpoint, if there is one. `changed` lists the keys of the case that differ, for the message.
/// Errors: a checkpoint that is corrupt, of another case or particle file, or of another build.
pub(crate) fn read(
    folder: &Path,
    origin: &Origin,
    changed: &dyn Fn() -> String,
) -> Result<Option<Checkpoint>, RunFailure> {
    let path = folder.join(CHECKPOINT);
    if !path.exists() {
        return Ok(None);
    }
    let bad = |said: String| RunFailure::Data(format!("{}: {said}", path.display()));
    let file = ParticleFile::open(&path)?;
    let header = file.header();
    if header.kind != Kind::Checkpoint {
        return Err(bad("it is not a checkpoint".into()));
    }
    if header.attribute(IDENTITY) != Some(&origin.identity) {
        let another = "it belongs to another case (only integrator.cfl may change) or particle file; use --overwrite to start anew";
        return refused(format!("{}: {another}{}", path.display(), changed()));
    }
    if let Some(said) = another_build(header, origin) {
        return refused(format!("{}: {said}", path.display()));
    }
    content(&file).map(Some).map_err(bad)
}

/// A clause on the build that wrote the checkpoint, if it is not this one.
fn another_build(header: &Header, origin: &Origin) -> Option<String> {
    let here = &origin.by;
    let of = |tool: &str, version: &str, format: &str| {
        format!("{tool} {version} in the checkpoint format '{format}'")
    };
    let format = header.attribute(FORMAT).unwrap_or_default();
    let writer = header.provenance.last().cloned().unwrap_or_default();
    let same = writer.version == here.version && format == origin.format;
    (!same).then(|| {
        format!(
            "it was written by {}, and this is {}; continue the run with the build that wrote it, or use --overwrite to start anew",
            of(&writer.tool, &writer.version, format),
            of(&here.tool, &here.version, &origin.format)
        )
    })
}

/// The content of a checkpoint of this build.
fn content(file: &ParticleFile) -> Result<Checkpoint, String> {
    let header = file.header();
    let column = |name| file.column::<f64>(name).map_err(|e| e.to_string());
    let clock = clock(header, column("run.clock")?, column("run.last_step")?)?;
    clock.check(header.time_s)?;
    let courant = (column("run.courant")?.as_chunks().0.iter())
        .map(|&[after, cfl]| Courant {
            after_step: after as u64,
            cfl,
        })
        .collect();
    let columns = file.columns().filter(|c| !c.name.starts_with("run."));
    let saved = columns.map(|column| Ok((column.name.clone(), array(file, &column.name)?)));
    Ok(Checkpoint {
        clock,
        courant,
        history: Extent {
            bytes: attribute(header, HISTORY_BYTES)?,
            hash: attribute(header, HISTORY_HASH)?,
        },
        saved: Saved(saved.collect::<Result<_, String>>()?),
    })
}

fn clock(header: &Header, times: &[f64], last: &[f64]) -> Result<Clock, String> {
    let mut clock = Clock {
        step: header.step,
        snapshots: attribute(header, SNAPSHOTS)?,
        row_missing: attribute(header, ROW_MISSING)?,
        ..Clock::default()
    };
    clock.last_step.lost = attribute(header, LOST)?;
    clock.last_step.iterations = attribute(header, ITERATIONS)?;
    let (own, of_step) = numbers(&mut clock);
    fill(own, times).ok_or("its clock is incomplete")?;
    fill(of_step, last).ok_or("its last step is incomplete")?;
    Ok(clock)
}

fn fill<const N: usize>(places: [&mut f64; N], values: &[f64]) -> Option<()> {
    let values: &[f64; N] = values.try_into().ok()?;
    (places.into_iter().zip(values)).for_each(|(place, value)| *place = *value);
    Some(())
}

fn array(file: &ParticleFile, name: &str) -> Result<Array, String> {
    file.column::<f64>(name)
        .map(|v| Array::F64(v.to_vec()))
        .or_else(|_| file.column::<f32>(name).map(|v| Array::F32(v.to_vec())))
        .or_else(|_| file.column::<u32>(name).map(|v| Array::U32(v.to_vec())))
        .map_err(|e| e.to_string())
}

fn attribute<T: std::str::FromStr>(header: &Header, name: &str) -> Result<T, String> {
    let found = header.attribute(name).and_then(|text| text.parse().ok());
    found.ok_or_else(|| format!("its attribute '{name}' is missing or not a number"))
}
