//! `make stability`: small scenes with stiff and extreme values through the real `mpm-run`.
//! Whatever a case asks for, the automatic time step keeps it stable or the run refuses it or
//! stops with a reason; nothing ends in NaN silently.

pub mod instability;
mod plan;
mod report;
pub(crate) mod scenes;
mod trial;

use crate::Result;
use crate::study::{Study, side_by_side};
use trial::{ENDS, Row, Trial};

/// The study, on what is varied or has a value so named.
pub fn run(study: &Study) -> Result<bool> {
    let mut trials = plan::trials();
    trials.retain(|t| study.wants(t.varied) || study.wants(&t.value));
    let rows: Result<Vec<Row>> = side_by_side(&trials, |trial: &Trial| {
        let row = trial.clone().run(&study.folder());
        row.inspect(|row| println!("{}", report::said(row)))
    });
    let rows = rows?;
    let unstable: Vec<_> = (instability::trials().iter().enumerate())
        .filter(|(_, trial)| study.wants(trial.scene))
        .map(|(i, trial)| trial.run(&study.folder().join(format!("checkpoint-{i}"))))
        .collect();
    report::write(study, &rows, &instability::lines(&unstable))?;
    let broken = |row: &Row| row.verdict == ENDS[4];
    Ok(!rows.iter().any(broken) && unstable.iter().all(Result::is_ok))
}
