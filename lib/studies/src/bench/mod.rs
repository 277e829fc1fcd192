//! `make bench`: what both schemes cost per liquid cell, point and step, at several sizes and numbers
//! of threads, beside an older build where `BASE` names its folder.

mod report;
mod runs;

use std::path::PathBuf;

use crate::Result;
use crate::outputs::bin_folder;
use crate::study::Study;
use runs::Cost;

/// One line of the plan by one program.
struct Row {
    piece: runs::Piece,
    /// By this build.
    cost: Cost,
    /// By the older one, where there is one.
    base: Option<Cost>,
}

/// The study, on the sizes and methods so named.
pub fn run(study: &Study) -> Result<bool> {
    let folder = study.folder();
    let base = std::env::var_os("BASE").map(PathBuf::from);
    let mut rows = Vec::new();
    for piece in runs::plan().into_iter().filter(|p| study.wants(&p.name())) {
        let bond = runs::specimen(piece.size, &folder)?;
        let (mut costs, mut older) = (Vec::new(), Vec::new());
        // Next to each other, so that both see the same load of the machine.
        for _ in 0..piece.times {
            costs.push(piece.cost(&bin_folder(), &bond, &folder)?);
            if let Some(base) = &base {
                older.push(piece.cost(base, &bond, &folder)?);
            }
        }
        let row = Row {
            piece,
            cost: Cost::median(costs),
            base: (!older.is_empty()).then(|| Cost::median(older)),
        };
        println!("{}", report::line(&row));
        rows.push(row);
    }
    report::write(study, &rows)?;
    Ok(true)
}
