//! `make leave-out`: what a scene pays for what it does not use. The explicit scheme against its
//! minimal twin on a free drop; the stages of the implicit scheme on scenes with and without them.

mod callgrind;
pub mod drop;
mod implicit;
mod pairs;

use std::fmt::Write;

use crate::study::Study;
use drop::Drop;
use implicit::{STAGES, Scene};

/// What a scene may pay, and what its twin may be slower.
const ALLOWED: f64 = 0.02;

const HEAD: &str = "\
## The explicit scheme and its minimal twin

`lib/mpm/src/minimal.rs` is the explicit scheme with FLIP, GIMP and a Newtonian liquid in free flight and nothing \
else; a test holds it to the scheme to the last bit, so the errors of both are the same. Both take the same steps \
with the same drop (14 cells across, 21952 points, one thread). Instructions are those of ten steps by callgrind, \
CPU time that of the process over 300 steps, the two in turn (A B B A ...). Goal: the ratios of instructions \
within 2 % of 1, on both sides.
";

const IMPLICIT: &str = "\
## The stages of the implicit scheme

Its options are passes. Millions of instructions per step in the functions of a stage, with all that they call, \
by callgrind; 0 where the scene has no such stage. Body force is a term of `assembly` and no stage. CPU: ms per step of the same run without callgrind.
";

/// Measures both schemes and writes `leave-out.md` and `leave-out.csv`; says whether all goals are met.
///
/// # Errors
/// What a run said, or that functions of a stage are not to be found.
pub fn run(study: &Study) -> Result<bool, String> {
    let drop = Drop::measure()?;
    println!("{}", drop.line());
    let scenes = implicit::measure(&study.folder())?;
    let mut page = format!(
        "# What a scene pays for what it does not use\n\n{}.\n{}\n{HEAD}\n{}\n{IMPLICIT}\n",
        study.origin(),
        if drop.instructions.is_some() {
            ""
        } else {
            "There is no valgrind here: instructions were not counted.\n"
        },
        drop.table(ALLOWED),
    );
    // Writing to a string cannot fail.
    let _ = writeln!(page, "| stage | {} |", joined(&scenes, |s| s.name.into()));
    let _ = writeln!(page, "|---|{}", "---|".repeat(scenes.len()));
    for (i, (stage, _)) in STAGES.iter().enumerate() {
        let _ = writeln!(page, "| {stage} | {} |", joined(&scenes, |s| s.cell(i)));
    }
    let _ = writeln!(page, "| whole step | {} |", joined(&scenes, Scene::whole));
    let _ = writeln!(page, "| CPU | {} |", joined(&scenes, Scene::cpu));
    study.write("leave-out.md", page)?;
    let rows = drop.rows().into_iter();
    study.write_csv(
        "leave-out.csv",
        "scene,quantity,value",
        rows.chain(scenes.iter().flat_map(Scene::rows)),
    )?;
    Ok(drop.is_within(ALLOWED) && implicit::absent_are_zero(&scenes))
}

fn joined(scenes: &[Scene], cell: impl Fn(&Scene) -> String) -> String {
    scenes.iter().map(cell).collect::<Vec<_>>().join(" | ")
}
