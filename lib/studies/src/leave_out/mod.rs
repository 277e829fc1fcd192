//! `make leave-out`: what a scene pays for what it does not use, by the instructions of the stages of both schemes on scenes
//! with and without them.

mod callgrind;
mod scenes;
mod stages;

use crate::Result;
use crate::method::Scheme;
use crate::study::Study;
use stages::Table;

const HEAD: &str = "\
What a scheme can do besides are passes of a step, or kernels compiled without it. Millions of instructions per step in the functions of a \
stage, with all that they call, by callgrind; 0 where a scene has no such stage. Goal: 0 in every stage that a scene does without.
";

/// Measures both schemes and writes `leave-out.md` and `leave-out.csv`; says whether the goal is met.
///
/// # Errors
/// What a run said, or that functions of a stage are not to be found.
pub fn run(study: &Study) -> Result<bool> {
    let folder = study.folder();
    let explicit = Table::measure(Scheme::Explicit, scenes::explicit(), &folder)?;
    let implicit = Table::measure(Scheme::Implicit, scenes::implicit(), &folder)?;
    let page = format!(
        "# What a scene pays for what it does not use\n\n{}.\n\n{HEAD}\n## Explicit scheme\n\n{}\n## Implicit scheme\n\n\
         Body force is a term of `assembly` and no stage.\n\n{}",
        study.origin(),
        explicit.text(),
        implicit.text(),
    );
    study.write("leave-out.md", page)?;
    let rows = explicit.rows().chain(implicit.rows());
    let columns = "scheme,scene,stage,million_instructions_per_step";
    study.write_csv("leave-out.csv", columns, rows)?;
    Ok(explicit.absent_are_zero() && implicit.absent_are_zero())
}
