//! Sizes of pores and lumens, from the tables of `wp-metrics --pores`.

use std::path::Path;

use crate::table::Table;
use crate::{Error, Labelled, Mark, Plot};

/// The share of the open volume that is at most so wide, a line for each specimen of each table.
///
/// # Errors
/// [`Error::Data`] for an unreadable file, a missing column, or one without numbers.
pub fn pores(tables: &[Labelled]) -> Result<Plot, Error> {
    let (x, y) = ("diameter (µm)", "share of the open volume in smaller pores");
    let mut plot = Plot::new("Sizes of pores and lumens", x, y).logarithmic([true, false]);
    let mut lines = Vec::new();
    for named in tables {
        let table = Table::read(&named.path)?;
        let files = table.texts("file")?;
        let (diameters, up_to) = (
            table.numbers("diameter_um")?,
            table.numbers("up_to_fraction")?,
        );
        let mut specimens = files.clone();
        specimens.dedup();
        for specimen in &specimens {
            let label = match (specimens.len(), Path::new(specimen).file_stem()) {
                (2.., Some(stem)) => stem.to_string_lossy(),
                _ => named.label.as_str().into(),
            };
            let rows = (0..files.len()).filter(|&row| files[row] == *specimen);
            let points: Vec<_> = rows.map(|row| [diameters[row], up_to[row]]).collect();
            let (label, path) = (label.into_owned(), specimen.into());
            lines.push((Labelled { label, path }, points));
        }
    }
    let mut names: Vec<Labelled> = lines.iter().map(|(name, _)| name.clone()).collect();
    Labelled::tell_apart(&mut names);
    for (name, (_, points)) in names.iter().zip(lines) {
        plot = plot.with(&name.label, Mark::Line, points);
    }
    Ok(plot)
}
