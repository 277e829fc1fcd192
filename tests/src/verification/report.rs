//! The verification page and table.

use std::fmt::Write as _;
use std::path::Path;

use super::catalogue::Entry;
use super::goals::{GOALS, Goal};
use super::{Measured, Scene};
use crate::study::{Outcome, provenance};

/// Heading and text of each family, in the order of the page.
const FAMILIES: &[(&str, &str)] = &[
    (
        "incline",
        "Film on an incline (paper Eq. 5, Fig. 4)\n\nGravity of the earth, 50 degrees, 6 cells; 0.5 ms with the floor on the nodes as in the paper, 0.05 ms elsewhere (the film is steady after 1 us).\n\n![Profiles at 0.5 ms, floor on the nodes](verification-incline.png)\n![Points at 0.5 ms coloured by velocity](verification-incline-points.png)\n![XPIC(5), floor off the nodes](verification-incline-xpic.png)\n![Implicit, floor off the nodes](verification-incline-implicit.png)",
    ),
    (
        "channel",
        "Channel (plane Poiseuille), with and without slip\n\nMean velocity against rho g H^2/(12 eta) (1 + 6 l/H).\n\n![Error over the offset of the walls, 6 cells](verification-channel.png)",
    ),
    (
        "table",
        "Viscosity table in a channel\n\nEta linear in log10 of the rate, 20 to 5 Pa s; mean velocity against quadrature of the profile. Noise of FLIP's velocities counts as shear and thins the liquid.",
    ),
    (
        "couette",
        "Couette flow with partial slip\n\nSlip velocity at the resting wall, from a line through the middle half of the gap: an error of 1 % in its slope is one of 5 % here.",
    ),
    (
        "duct",
        "Lumens in three dimensions\n\nDeveloped flow through a square and a tube of voxels (tube: two voxels on the edge of a cell, tube1: one); 7 cells put the walls half a cell off. The staircase itself slows the flow by 9 % against a circle of the same area: the second row of a tube compares with finite differences in the same staircase.",
    ),
    (
        "slit",
        "A piston presses liquid into a slit\n\nForce on the piston at four filled lengths against a 24-cell run of another code.\n\n![Force over filled length, 6 cells, walls on the nodes](verification-slit.png)",
    ),
    (
        "piston",
        "A piston presses liquid into a square lumen and a tube\n\nPressure against developed flow (finite differences in the same staircase) plus the equivalent length of entrance and front.",
    ),
    (
        "washburn",
        "Filling a slit at constant pressure\n\nTime to five widths against a 24-cell run of another code; the error of L(t) is half that of the time.",
    ),
    (
        "washburn3d",
        "Filling a square lumen and a tube at constant pressure\n\nTime from one to two diameters, as for the piston.",
    ),
    (
        "squeeze",
        "Squeeze film between plates\n\nAgainst 8 eta V a^3/h^3 per length, a as long as what was pressed out makes it.",
    ),
    (
        "disc8",
        "Squeeze film of a disc\n\nAgainst 3 pi eta R^4 V/(2 h^3), R of the voxels' area and as wide as what was pressed out makes it.",
    ),
    (
        "tait",
        "Compression\n\nA closed column by 2 %, pressure against paper Eq. 1. The piston moves off the nodes, so that the explicit scheme compresses the column 3 % less than it is; the law of each point is exact.",
    ),
    (
        "acoustic",
        "Standing sound wave\n\nHalf a wave over 32 cells: frequency against c^2 = K/rho, damping per period against (4/3 eta) k^2/(2 rho); what is beyond it at 0.001 Pa s is the update's own.",
    ),
    (
        "column",
        "Liquid at rest under a body force\n\nA free surface, 12 cells.",
    ),
    (
        "vortex",
        "Taylor-Green vortex\n\nDecay of the kinetic energy against 4 nu k^2. At 0.05 Pa s the explicit scheme rings instead of decaying: it holds div v = 0 on every point, which gives flows of constant volume a stiffness of about K (k cell)^4 (locking). The implicit scheme is made for flows without inertia; its error here is that of backward Euler steps.",
    ),
    (
        "drop",
        "Momentum\n\nA free drop whose quarters move differently, 0.5 us.",
    ),
    (
        "galilean",
        "Galilean invariance\n\nLiquid and walls all at 0.5 m/s, walls 0.3 cell off the nodes, until all has moved by three cells.",
    ),
    (
        "sealed",
        "Sealed lumens\n\nUnder 2.5 MPa behind walls of 1 and 2 voxels.",
    ),
    (
        "clamp",
        "Load control\n\nA squeeze film closed under a pressure limit of 2.5 MPa. The resistance of the explicit scheme jumps where the moving wall crosses nodes, by more than its controller can follow without overshoot.",
    ),
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
        "Every case is a file `pipelines/cases/verification/CASE-SCHEME.toml`; updates other than \
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
    let methods = distinct(outcomes.iter().map(|o| o.method.label.as_str()));
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

/// Observed order where a series has more than one resolution.
fn order_table(out: &mut String, outcomes: &[&Outcome]) {
    let mut rows = String::new();
    for a in outcomes {
        let (series, Some(n)) = Scene::resolution(&a.scene) else {
            continue;
        };
        for b in outcomes {
            let (other, finer) = Scene::resolution(&b.scene);
            if other != series || finer != Some(2 * n) || a.method != b.method {
                continue;
            }
            let Ok(list) = &a.measured else { continue };
            for m in list.iter().filter(|m| !m.counted) {
                if let Some(fine) = b.measured(&m.what) {
                    let order = (m.error / fine.error).abs().log2();
                    let _ = writeln!(
                        rows,
                        "| {series} | {} | {} | {n} to {} | {} to {} | {order:.1} |",
                        m.what,
                        a.method.label,
                        2 * n,
                        error(m),
                        error(fine)
                    );
                }
            }
        }
    }
    if !rows.is_empty() {
        let _ = writeln!(
            out,
            "Observed order:\n\n| series | quantity | method | cells | errors | order |\n|---|---|---|---|---|---|\n{rows}"
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
        p if p == 0.0 => "0".into(),
        p if p.abs() < 0.01 => format!("{p:+.1e} %"),
        p if p.abs() < 1.0 => format!("{p:+.2} %"),
        p if p.abs() < 100.0 => format!("{p:+.1} %"),
        p => format!("{p:+.0} %"),
    }
}
