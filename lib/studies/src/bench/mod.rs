//! `make bench`: what both schemes cost per liquid cell, point and step, at several sizes and numbers
//! of threads, beside an older build where `BASE` names its folder.

pub mod machine;
pub mod report;
pub mod runs;

use crate::study::Study;
use runs::{Cost, PLAN, Program};

/// One line of the plan by one program.
pub struct Row {
    /// What is run.
    pub piece: runs::Piece,
    /// By this build.
    pub cost: Cost,
    /// By the older one, where there is one.
    pub base: Option<Cost>,
}

/// The study, on the sizes and methods so named.
///
/// # Errors
/// What a tool said.
pub fn run(study: &Study) -> Result<bool, String> {
    let folder = study.folder();
    let base = std::env::var_os("BASE").map(|bin| Program::at(bin.into()));
    let bandwidth = machine::triad();
    let mut rows = Vec::new();
    for piece in PLAN.into_iter().filter(|p| study.wants(&p.name())) {
        let bond = runs::specimen(&piece.size, &folder)?;
        let own = Program::own();
        let (mut costs, mut older) = (Vec::new(), Vec::new());
        // Next to each other, so that both see the same load of the machine.
        for _ in 0..piece.times {
            costs.push(own.cost(&piece, &bond, &folder)?);
            if let Some(base) = &base {
                older.push(base.cost(&piece, &bond, &folder)?);
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
    report::write(study, &rows, &bandwidth)?;
    Ok(true)
}
