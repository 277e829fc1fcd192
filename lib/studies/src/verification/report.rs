//! The verification page and table.

use std::fmt::Write as _;

use super::goals::{self, Goal};
use super::{Measured, Scene};
use crate::Result;
use crate::job::Outcome;
use crate::method::Method;
use crate::numbers::worst;
use crate::study::{Study, distinct, filled, table};

/// Families of scenes in the order of the page, each with its heading and text.
const FAMILIES: &str = include_str!("families.txt");

/// Writes `verification.csv` and `verification.md`.
pub(super) fn write(study: &Study, outcomes: &[Outcome]) -> Result<()> {
    let columns = "case,scheme,method,set,against,quantity,value,reference,error,order,steps,cpu_s";
    let rows = outcomes.iter().flat_map(|o| fields(o, outcomes));
    study.write_csv("verification.csv", columns, rows)?;
    let head = study.head(outcomes.iter().map(|o| o.cpu_s));
    study.write("verification.md", page(&head, outcomes))
}

/// The rows of a run in the table.
fn fields(o: &Outcome, outcomes: &[Outcome]) -> Vec<Vec<String>> {
    let method = &o.method;
    let (scheme, label, set) = (method.scheme.name(), &method.label, method.set.join(" "));
    let head = [&o.scene, scheme, label, &set, o.against].map(String::from);
    let row = |m: &Measured| {
        let order = order(o, m, outcomes).map_or(String::new(), |order| format!("{order:.1}"));
        let numbers = [
            m.what.clone(),
            format!("{:.6e}", m.value),
            format!("{:.6e}", m.reference),
            format!("{:.4e}", m.error),
            order,
            o.steps.to_string(),
            format!("{:.2}", o.cpu_s),
        ];
        [&head[..], &numbers].concat()
    };
    match &o.measured {
        Ok(list) => list.iter().map(row).collect(),
        Err(said) => {
            let mut row = head.to_vec();
            row.push(format!("failed: {said}"));
            row.resize(12, String::new());
            vec![row]
        }
    }
}

/// Observed order from half as many cells; none where the error passes zero between.
fn order(o: &Outcome, m: &Measured, outcomes: &[Outcome]) -> Option<f64> {
    let (series, Some(cells)) = Scene::resolution(&o.scene) else {
        return None;
    };
    let coarse = outcomes.iter().find(|c| {
        c.method == o.method && Scene::resolution(&c.scene) == (series.clone(), Some(cells / 2))
    })?;
    let before = coarse.measured(&m.what).filter(|_| !m.counted)?;
    let ratio = before.error / m.error;
    (ratio > 0.0 && ratio.is_finite()).then(|| ratio.log2())
}

fn page(head: &str, outcomes: &[Outcome]) -> String {
    let mut families = String::new();
    for line in FAMILIES.lines() {
        let (family, text) = line.split_once(" | ").unwrap_or((line, ""));
        let prefix = format!("{family}-");
        let of = |o: &&Outcome| o.scene == family || o.scene.starts_with(&prefix);
        let of_family: Vec<&Outcome> = outcomes.iter().filter(of).collect();
        if !of_family.is_empty() {
            let text = text.replacen(" | ", "\n\n", 1).replace("\\n", "\n");
            let _ = writeln!(families, "## {text}\n");
            family_table(&mut families, &of_family, outcomes);
        }
    }
    let values = [
        ("head", head),
        ("goals", &*goals(outcomes)),
        ("families", &families),
    ];
    filled(include_str!("page.txt"), &values)
}

/// Goals with the worst error found.
fn goals(outcomes: &[Outcome]) -> String {
    let line = |goal: Goal| {
        let worst = worst_of(&goal, outcomes)?;
        let reached = match goal.why {
            _ if worst.abs() <= goal.limit => "reached".into(),
            Some(why) => format!("**missed**: {why}"),
            None => "**missed**".into(),
        };
        let (limit, worst) = (percent(goal.limit), percent(worst));
        let (cases, method, quantity) = (goal.cases, goal.method, goal.quantity);
        let limit = limit.trim_start_matches('+');
        Some(format!(
            "| {cases} | {method} | {quantity} | {limit} | {worst} | {reached} |"
        ))
    };
    let heads = "| case | method | quantity | goal | worst | |";
    table(heads, goals::goals().into_iter().filter_map(line))
}

fn worst_of(goal: &Goal, outcomes: &[Outcome]) -> Option<f64> {
    let of = (outcomes.iter()).filter(|o| goal.is_about(&o.scene, &o.method.label));
    let all = of.filter_map(|o| o.measured.as_ref().ok()).flatten();
    worst(
        all.filter(|m| m.what.starts_with(goal.quantity))
            .map(|m| m.error),
    )
}

/// The worst error of each quantity at each resolution by each method, and what failed.
fn family_table(out: &mut String, outcomes: &[&Outcome], all_outcomes: &[Outcome]) {
    let mut methods = distinct(outcomes.iter().map(|o| o.method.label.as_str()));
    let place = |label: &&str| Method::UPDATES.iter().position(|update| update == label);
    methods.sort_by_key(|label| (*label == "implicit", place(label)));
    let all = outcomes.iter().flat_map(|o| {
        let (_, cells) = Scene::resolution(&o.scene);
        let whats = o.measured.iter().flatten().map(|m| m.what.as_str());
        whats.map(move |what| (what, cells))
    });
    let line = |(what, cells)| {
        let cell = |label: &&str| {
            let own = outcomes.iter().filter(|o| o.method.label == **label);
            let errors = own.filter_map(|o| {
                let (series, n) = Scene::resolution(&o.scene);
                let m = o.measured(what).filter(|_| n == cells)?;
                Some((m, series, order(o, m, all_outcomes)))
            });
            let worst = errors.max_by(|a, b| a.0.error.abs().total_cmp(&b.0.error.abs()));
            worst.map_or(String::new(), |(m, series, order)| {
                let order = order.map(|order| format!("order {order:.1}"));
                let place = series.split_once('-').map(|(_, place)| place.to_owned());
                match [place, order].into_iter().flatten().collect::<Vec<_>>() {
                    notes if notes.is_empty() => error(m),
                    notes => format!("{} ({})", error(m), notes.join(", ")),
                }
            })
        };
        let row: Vec<String> = methods.iter().map(cell).collect();
        let n = cells.map_or(String::new(), |n| n.to_string());
        format!("| {what} | {n} | {} |", row.join(" | "))
    };
    let failed = outcomes.iter().filter_map(|o| {
        let said = o.measured.as_ref().err()?;
        Some(format!(
            "| {}, {} failed: {said} |",
            o.scene, o.method.label
        ))
    });
    let heads = format!("| quantity | n | {} |", methods.join(" | "));
    let lines = distinct(all).into_iter().map(line).chain(failed);
    let _ = writeln!(out, "{}", table(&heads, lines));
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
