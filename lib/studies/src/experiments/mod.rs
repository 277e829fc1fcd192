//! `make experiments`: predictions held against experiments that others made and published.

pub mod capillary;
pub mod capillary_report;
pub mod capillary_voxels;
pub mod predictions;
pub mod press;
pub mod section;
pub mod squeeze;
pub mod squeeze_report;
pub mod wood;

use crate::study::Study;

/// The study.
///
/// # Errors
/// What a run or the system said.
pub fn run(study: &Study) -> Result<bool, String> {
    let predictions = predictions::run(study)?;
    let rises = capillary::run(study)?;
    let wood = wood::run(study)?;
    let press = press::run(study)?;
    let mut page = String::from("# Evidence from outside\n\n");
    page += &study.head((predictions.iter().map(|p| p.cpu_s)).chain(rises.iter().map(|r| r.cpu_s)));
    page.push('\n');
    if !predictions.is_empty() {
        page += &squeeze_report::write(study, &predictions)?;
    }
    if !rises.is_empty() {
        page += &capillary_report::write(study, &rises)?;
    }
    page += &wood;
    page += &press;
    study.write("experiments.md", page)?;
    Ok(squeeze_report::sound(&predictions) && capillary_report::sound(&rises))
}
