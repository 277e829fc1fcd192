//! `make experiments`: predictions held against experiments that others made and published.

mod capillary;
mod capillary_report;
mod capillary_voxels;
mod predictions;
mod press;
mod section;
mod squeeze;
mod squeeze_report;
mod wood;

use crate::Result;
use crate::case_text::CaseText;
use crate::method::Method;
use crate::outputs::Run;
use crate::study::{Study, write};

/// The study.
pub fn run(study: &Study) -> Result<bool> {
    let predictions = predictions::run(study)?;
    let rises = capillary::run(study)?;
    let wood = wood::run(study)?;
    let press = press::run(study)?;
    let mut page = String::from("# Comparison with published experiments\n\n");
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

/// Of a goal.
fn met(met: bool) -> &'static str {
    if met { "met" } else { "not met" }
}

/// Runs a case by the implicit scheme, and says so.
fn run_case(study: &Study, name: &str, case: &CaseText, method: &Method) -> Result<Run> {
    let path = study.folder().join(format!("{name}.toml"));
    write(&path, case.text(method.scheme.integrator()))?;
    let run = method.run(&path, &study.folder().join(name), &[])?;
    println!("{name:<32} {:6.1} s", run.cpu_s());
    Ok(run)
}
