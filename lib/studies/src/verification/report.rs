//! The verification page and table.

use std::fmt::Write as _;
use std::path::Path;

use super::catalogue::Entry;
use super::families::FAMILIES;
use super::goals::{GOALS, Goal};
use super::{Measured, Scene};
use crate::study::{Outcome, provenance};

/// Order of the methods in tables.
const COLUMNS: [&str; 9] = [
    "FLIP", "PIC", "APIC", "XPIC(2)", "XPIC(3)", "XPIC(5)", "FMPM(2)", "FMPM(5)", "implicit",
];

/// Writes `verification.csv` and `verification.md` into `results`.
///
/// # Errors
/// The system's reason.
pub fn write(results: &Path, entries: &[Entry], outcomes: &[Outcome]) -> Result<(), String> {
    std::fs::create_dir_all(results).map_err(|e| format!("{}: {e}", results.display()))?;
    let save = |name: &str, text: String| {
        let path = results.join(name);
        std::fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))
    };
    save("verification.csv", table(entries, outcomes))?;
    save("verification.md", page(outcomes))
}

fn table(entries: &[Entry], outcomes: &[Outcome]) -> String {
    let mut csv =
        String::from("case,scheme,method,set,against,quantity,value,reference,error,steps,cpu_s\n");
    for o in outcomes {
        let against = entries
            .iter()
            .find(|(scene, _)| scene.name == o.scene)
            .map_or("", |(scene, _)| scene.against);
        let head = format!(
            "{},{},{},{},{against}",
            o.scene,
            o.method.scheme.name(),
            o.method.label,
            o.method.set.join(" ").replace('"', "'")
        );
        match &o.measured {
            Ok(list) => {
                for m in list {
                    let what = m.what.replace(',', ";");
                    let _ = writeln!(
                        csv,
                        "{head},{what},{:.6e},{:.6e},{:.4e},{},{:.2}",
                        m.value, m.reference, m.error, o.steps, o.cpu_s
                    );
                }
            }
            Err(said) => {
                let _ = writeln!(
                    csv,
                    "{head},failed: {},,,,,",
                    said.replace([',', '\n'], ";")
                );
            }
        }
    }
    csv
}

fn page(outcomes: &[Outcome]) -> String {
    let mut out = String::from("# Verification\n\n");
    let _ = writeln!(out, "{}", provenance("make verify", outcomes));
    out.push_str(
        "Every case is written to `out/verify/cases/CASE-SCHEME.toml` (`make verify ONLY=CASE` writes and runs one); updates other than \
         FLIP are `--set` on it. Errors are relative, in per cent of the reference, unless the \
         quantity says otherwise; n is cells across the lumen, off the offset of the walls from \
         the nodes in cells. All numbers: [verification.csv](verification.csv). Implicit runs \
         solve to 1e-4; those from rest to a steady flow take short steps (column `set`), because \
         at the usual Courant number the first step is as long as the run. The explicit scheme is the paper's, with none of its options.\n\n",
    );
    goals(&mut out, outcomes);
    for (family, text) in FAMILIES {
        let prefix = format!("{family}-");
        let of = |o: &&Outcome| o.scene == *family || o.scene.starts_with(&prefix);
        let of_family: Vec<&Outcome> = outcomes.iter().filter(of).collect();
        if !of_family.is_empty() {
            let _ = writeln!(out, "## {text}\n");
            family_table(&mut out, &of_family);
            order_table(&mut out, &of_family);
        }
    }
    out
}

/// Goals with the worst error found.
fn goals(out: &mut String, outcomes: &[Outcome]) {
    out.push_str(
        "## Goals\n\n| case | method | quantity | goal | worst | |\n|---|---|---|---|---|---|\n",
    );
    for goal in GOALS {
        let Some(worst) = worst(goal, outcomes) else {
            continue;
        };
        let reached = if worst.abs() <= goal.limit {
            "reached"
        } else {
            "**missed**"
        };
        let _ = writeln!(
            out,
            "| {} | {} | {} | {} | {} | {reached} |",
            goal.cases,
            goal.method,
            goal.quantity,
            percent(goal.limit).trim_start_matches('+'),
            percent(worst)
        );
    }
    out.push('\n');
}

fn worst(goal: &Goal, outcomes: &[Outcome]) -> Option<f64> {
    let of = outcomes
        .iter()
        .filter(|o| goal.is_about(&o.scene, &o.method.label));
    let errors = of.filter_map(|o| {
        let list = o.measured.as_ref().ok()?;
        let about = list.iter().filter(|m| m.what.starts_with(goal.quantity));
        about
            .map(|m| m.error)
            .max_by(|a, b| a.abs().total_cmp(&b.abs()))
    });
    errors.max_by(|a, b| a.abs().total_cmp(&b.abs()))
}

fn family_table(out: &mut String, outcomes: &[&Outcome]) {
    let mut methods = distinct(outcomes.iter().map(|o| o.method.label.as_str()));
    methods.sort_by_key(|label| COLUMNS.iter().position(|c| c == label));
    let scenes = distinct(outcomes.iter().map(|o| o.scene.as_str()));
    let _ = writeln!(out, "| case | quantity | {} |", methods.join(" | "));
    let _ = writeln!(out, "|---|---|{}", "---|".repeat(methods.len()));
    for scene in scenes {
        let runs: Vec<_> = outcomes.iter().filter(|o| o.scene == scene).collect();
        let whats = distinct(
            runs.iter()
                .filter_map(|o| o.measured.as_ref().ok())
                .flatten()
                .map(|m| m.what.as_str()),
        );
        for what in whats {
            let cell = |method: &&str| {
                let run = runs.iter().find(|o| o.method.label == **method)?;
                Some(match &run.measured {
                    Ok(_) => run.measured(what).map_or(String::new(), error),
                    Err(_) => "failed".to_owned(),
                })
            };
            let cells: Vec<String> = methods
                .iter()
                .map(|m| cell(m).unwrap_or_default())
                .collect();
            let _ = writeln!(out, "| {scene} | {what} | {} |", cells.join(" | "));
        }
        for run in runs {
            if let Err(said) = &run.measured {
                let _ = writeln!(out, "| {scene} | {} failed | {said} |", run.method.label);
            }
        }
    }
    out.push('\n');
}

/// Errors of the series of 3, 6 and 12 cells with the order observed from each to the next. An
/// order means little where an error passes zero.
fn order_table(out: &mut String, outcomes: &[&Outcome]) {
    let mut rows = String::new();
    for coarse in outcomes {
        let (series, Some(3)) = Scene::resolution(&coarse.scene) else {
            continue;
        };
        let finer = |n: u32| {
            outcomes.iter().find(|o| {
                o.method == coarse.method
                    && Scene::resolution(&o.scene) == (series.clone(), Some(n))
            })
        };
        for m in coarse.measured.iter().flatten().filter(|m| !m.counted) {
            let errors: Vec<f64> = std::iter::once(m.error)
                .chain([6, 12].iter().map_while(|&n| {
                    let found = finer(n)?.measured(&m.what)?;
                    Some(found.error)
                }))
                .collect();
            if errors.len() > 1 {
                let orders: Vec<String> = errors
                    .windows(2)
                    .map(|pair| format!("{:.1}", (pair[0] / pair[1]).abs().log2()))
                    .collect();
                let errors: Vec<String> = errors.iter().map(|&e| percent(e)).collect();
                let _ = writeln!(
                    rows,
                    "| {series} | {} | {} | {} | {} |",
                    m.what,
                    coarse.method.label,
                    errors.join(", "),
                    orders.join(", ")
                );
            }
        }
    }
    if !rows.is_empty() {
        let _ = writeln!(
            out,
            "Observed order from 3 to 6 (to 12) cells:\n\n| series | quantity | method | errors | order |\n|---|---|---|---|---|\n{rows}"
        );
    }
}

fn distinct<'a>(words: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut list: Vec<&str> = Vec::new();
    for word in words {
        if !list.contains(&word) {
            list.push(word);
        }
    }
    list
}

fn error(m: &Measured) -> String {
    if m.counted {
        format!("{}", m.error)
    } else {
        percent(m.error)
    }
}

/// A share in per cent with what digits it needs.
pub(crate) fn percent(share: f64) -> String {
    match 100.0 * share {
        0.0 => "0".into(),
        p if p.abs() < 0.01 => format!("{p:+.1e} %"),
        p if p.abs() < 1.0 => format!("{p:+.2} %"),
        p if p.abs() < 100.0 => format!("{p:+.1} %"),
        p => format!("{p:+.0} %"),
    }
}
