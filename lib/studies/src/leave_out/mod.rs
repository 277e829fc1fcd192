//! `make leave-out`: what a scene pays for what it does not use, by the instructions of the stages of both schemes on scenes
//! with and without them.

mod callgrind;
mod scenes;
mod stages;

use crate::Result;
use crate::method::Scheme;
use crate::study::{Study, filled};
use stages::Table;

/// Measures both schemes and writes `leave-out.md` and `leave-out.csv`; says whether the goal is met.
pub fn run(study: &Study) -> Result<bool> {
    let folder = study.folder();
    let explicit = Table::measure(Scheme::Explicit, &folder)?;
    let implicit = Table::measure(Scheme::Implicit, &folder)?;
    let values = [
        ("origin", study.origin()),
        ("explicit", &explicit.text()),
        ("implicit", &implicit.text()),
    ];
    let page = filled(include_str!("page.txt"), &values);
    study.write("leave-out.md", page)?;
    let rows = explicit.rows().chain(implicit.rows());
    let columns = "scheme,scene,stage,million_instructions_per_step";
    study.write_csv("leave-out.csv", columns, rows)?;
    Ok(explicit.absent_are_zero() && implicit.absent_are_zero())
}
