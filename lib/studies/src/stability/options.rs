//! `make options`: what the explicit scheme's options change on the flows it is wrong on, piston
//! into slit and channel, against the same references as `make verify`.

use std::fmt::Write;

use crate::method::{Method, Scheme};
use crate::study::{Folders, Job, Outcome, run_all};
use crate::verification::{Scene, acoustic, channel, slit, squeeze};

/// The options by name, with the keys they set.
pub const OPTIONS: [(&str, &[&str]); 5] = [
    ("cell mean", &["integrator.pressure=cell-mean"]),
    ("projection", &["integrator.density_projection=0.04cell"]),
    ("separation 0.6", &["contact.separation=0.6cell"]),
    ("separation 1.0", &["contact.separation=1.0cell"]),
    (
        "cell mean, projection",
        &[
            "integrator.pressure=cell-mean",
            "integrator.density_projection=0.04cell",
        ],
    ),
];

/// Offsets of the walls against the nodes, cells.
const OFFSETS: [f64; 3] = [0.0, 0.25, 0.5];
/// Cells across slit and channel.
const CELLS: u32 = 6;

/// Methods: the paper's two, APIC, each with every option; the implicit scheme beside them.
fn methods() -> Vec<Method> {
    let mut list = Vec::new();
    for plain in [Method::flip(), Method::xpic(5), Method::apic()] {
        list.push(plain.clone());
        for (name, keys) in OPTIONS {
            let label = format!("{}, {name}", plain.label);
            let with = keys.iter().fold(plain.clone(), |m, key| m.setting(*key));
            list.push(with.called(label));
        }
    }
    list.push(Method::implicit());
    list
}

/// What is measured: where the paper's scheme is wrong, and flows that an option must not spoil.
fn scenes() -> Vec<Scene> {
    let mut list: Vec<Scene> = (OFFSETS.iter())
        .map(|&offset| slit::scene(CELLS, [offset, 0.0]))
        .collect();
    list.extend(OFFSETS.map(|offset| channel::scene(CELLS, offset, None, 3e-6)));
    list.extend(OFFSETS.map(|offset| squeeze::scene(CELLS, offset)));
    list.push(acoustic::scene(0.001));
    list
}

/// Runs the study on the scenes whose name contains one of `only`, on all without.
pub fn outcomes(folders: &Folders, only: &[&str]) -> Vec<Outcome> {
    let mut scenes = scenes();
    scenes.retain(|s| only.is_empty() || only.iter().any(|part| s.name.contains(part)));
    // The implicit scheme's usual step is as long as these runs: `make verify` has it.
    let short = |scene: &Scene| ["squeeze", "acoustic"].contains(&scene.family());
    let mut jobs: Vec<Job> = Vec::new();
    for scene in &scenes {
        for method in methods() {
            if method.scheme == Scheme::Explicit || !short(scene) {
                jobs.push(Job { scene, method });
            }
        }
    }
    run_all(&jobs, folders)
}

/// The errors as CSV.
pub fn csv(outcomes: &[Outcome]) -> String {
    let mut out = String::from("case,method,quantity,error,steps,cpu_s,said\n");
    for o in outcomes {
        // Writing to a string cannot fail.
        let _ = match &o.measured {
            Ok(list) => list.iter().try_for_each(|m| {
                writeln!(
                    out,
                    "{},\"{}\",{},{:.4e},{},{:.1},",
                    o.scene, o.method.label, m.what, m.error, o.steps, o.cpu_s
                )
            }),
            Err(said) => writeln!(
                out,
                "{},\"{}\",,,,,\"{}\"",
                o.scene,
                o.method.label,
                said.replace('"', "'")
            ),
        };
    }
    out
}

/// The errors as a table: a row per method, a column per quantity and scene.
pub fn table(outcomes: &[Outcome]) -> String {
    let mut scenes: Vec<&str> = outcomes.iter().map(|o| o.scene.as_str()).collect();
    scenes.dedup();
    let mut out = String::new();
    for (family, what) in [
        ("slit", "piston force"),
        ("channel", "mean velocity"),
        ("squeeze", "force on the top"),
    ] {
        let columns: Vec<&str> = (scenes.iter().copied())
            .filter(|scene| scene.starts_with(family))
            .collect();
        let _ = writeln!(
            out,
            "\n| method | {} |",
            columns.join(" | CPU s | ") + " | CPU s"
        );
        let _ = writeln!(out, "|---|{}", "---|---|".repeat(columns.len()));
        for method in methods() {
            let cells: Vec<String> = (columns.iter())
                .filter_map(|scene| {
                    let found = |o: &&Outcome| o.scene == *scene && o.method == method;
                    outcomes.iter().find(found).map(|o| cell(o, what))
                })
                .collect();
            if !cells.is_empty() {
                let _ = writeln!(out, "| {} | {} |", method.label, cells.join(" | "));
            }
        }
    }
    out
}

/// Errors in per cent, or where the run stopped, and CPU seconds.
fn cell(outcome: &Outcome, what: &str) -> String {
    match &outcome.measured {
        Ok(list) => {
            let errors: Vec<String> = (list.iter())
                .filter(|m| m.what.starts_with(what))
                .map(|m| format!("{:+.0}", 100.0 * m.error))
                .collect();
            format!("{} | {:.0}", errors.join(", "), outcome.cpu_s)
        }
        Err(_) => "stopped |".into(),
    }
}
