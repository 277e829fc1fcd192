//! The first section of the page: what was pressed, what came of it, what to doubt.

use figures::{AT_THE_END, ERRORS, Known, RunEnd, signed};

use crate::html::{escape, table, verbatim};
use crate::setup::Setup;
use crate::{Measured, Report, RunFolder};

/// Pictures that stand in the summary.
pub(crate) const PICTURES: usize = 2;
/// Share of a value from which its error is doubted.
const LARGE: f64 = 0.1;
/// Share of the adhesive that left through open sides from which it is told.
const LEFT: f64 = 0.05;

/// The section.
pub(crate) fn write(report: &Report) -> String {
    let runs = &report.runs[..];
    let pictures: String = report.pictures.iter().take(PICTURES).cloned().collect();
    let pictures = match pictures.is_empty() {
        true => pictures,
        false => format!("<div class=\"pair\">\n{pictures}</div>\n"),
    };
    let penetration = penetration(&report.experiments, runs);
    match runs {
        [] => penetration + &pictures,
        runs => pressed(runs) + &penetration + &pictures + &doubts(runs, &report.experiments),
    }
}

/// A row for runs of the same.
fn pressed(runs: &[RunFolder]) -> String {
    let mut groups: Vec<(&Setup, Vec<&str>)> = Vec::new();
    for run in runs {
        match groups.iter_mut().find(|(setup, _)| *setup == &run.setup) {
            Some((_, labels)) => labels.push(&run.label),
            None => groups.push((&run.setup, vec![&run.label])),
        }
    }
    let row = |(setup, labels): &(&Setup, Vec<&str>)| {
        let kind = match setup.synthetic.is_empty() {
            true => "",
            false => " (synthetic)",
        };
        vec![
            labels.join(", "),
            format!("{}{kind}", setup.specimen),
            setup.size.clone(),
            setup.adhesive.clone(),
            setup.press.clone(),
            setup.date.clone(),
        ]
    };
    let rows: Vec<Vec<String>> = groups.iter().map(row).collect();
    let size = "size including the gap";
    let headers = ["run", "specimen", size, "adhesive", "press", "date"];
    table("Specimens and presses", &headers, &rows)
}

fn penetration(experiments: &[Measured], runs: &[RunFolder]) -> String {
    let wp = |known: &[Known; 3]| known.map(|known| known.told(2).join(" \u{b1} "));
    let experiment = |measured: &Measured| {
        let nothing = ["-", "-"].map(String::from);
        let label = std::slice::from_ref(&measured.label);
        [label, &measured.entered, &wp(&measured.wp), &nothing].concat()
    };
    let run = |run: &RunFolder| {
        let pressure = run.pressure.told_pressure(2, " \u{b1} ", run.limit);
        let mut end = run.end.mark().unwrap_or_else(|| ended(&run.end));
        end.extend(run.end.released().map(|told| format!("; {told}")));
        let label = [run.label.clone()];
        [&label[..], &run.entered(), &wp(&run.wp), &[pressure, end]].concat()
    };
    let rows = experiments.iter().map(experiment);
    let rows: Vec<Vec<String>> = rows.chain(runs.iter().map(run)).collect();
    if rows.is_empty() {
        return String::new();
    }
    let pressure = "pressure at the end (MPa)";
    let [share, depth] = ["adhesive in the wood (%)", "its mean depth (um)"];
    let headers = [
        "run", share, depth, "bottom", "top", "total", pressure, "press",
    ];
    let note = match runs.iter().any(|run| run.wp[2].has_error()) {
        true => format!(
            "<p class=\"note\">{ERRORS}; without \u{b1}: as run. Pressure at the end: {AT_THE_END}</p>\n"
        ),
        false => String::new(),
    };
    table(
        "Adhesive in the wood; Weighted penetration (um)",
        &headers,
        &rows,
    ) + &note
}

/// How a run ended against which nothing is to be said.
fn ended(end: &RunEnd) -> String {
    let closed = end.end == "closed" || end.gap_share.is_finite();
    let closed = if closed { "closed" } else { "-" };
    match end.end.as_str() {
        "set" => format!("{closed}, set"),
        "programme" => format!("{closed}, end of programme"),
        _ => closed.to_owned(),
    }
}

/// Label and extrapolated total WP of a run of the same press as one that has none.
fn best_of<'a>(runs: &'a [RunFolder], run: &RunFolder) -> Option<(&'a str, f64)> {
    let known = |other: &&RunFolder| other.wp[2].has_error();
    let mut others = runs.iter().filter(known);
    let same = |other: &&RunFolder| other.setup.is_pressed_as(&run.setup);
    let best = others
        .find(same)
        .filter(|_| !known(&run) && run.wp[2].best().is_finite())?;
    Some((&best.label, best.wp[2].best()))
}

/// By how much the total WP of a run, um, differs from another.
fn apart(run: &RunFolder, wp: f64, label: &str, other: f64) -> String {
    let by = wp - other;
    let share = signed(100.0 * by / other, 0);
    format!(
        "{} by {} um ({share} %) from {label}",
        run.label,
        signed(by, 2)
    )
}

fn doubts(runs: &[RunFolder], experiments: &[Measured]) -> String {
    let mut items = Vec::new();
    for run in runs {
        if let Some(advice) = run.end.advice() {
            let (said, command) = advice.split_once(":\n").unwrap_or((&advice, ""));
            let command = Some(command.trim()).filter(|command| !command.is_empty());
            let command = command.map_or(String::new(), verbatim);
            let (label, said) = (escape(&run.label), escape(said));
            items.push(format!("<strong>{label}: {said}</strong>{command}"));
        }
        let doubts = run.voxel_doubts.iter().map(String::as_str);
        let doubts = doubts.chain(run.end.closed_in());
        let left = run.left();
        let left = (left > LEFT).then(|| {
            let percent = 100.0 * left;
            format!("{percent:.0} % of the adhesive left through open sides")
        });
        let doubts = doubts.map(str::to_owned).chain(left);
        items.extend(doubts.map(|doubt| escape(&format!("{}: {doubt}", run.label))));
    }
    let mut say = |said: &str, is: &dyn Fn(&RunFolder) -> bool| {
        let labels: Vec<&str> = (runs.iter().filter(|run| is(run)))
            .map(|run| run.label.as_str())
            .collect();
        match labels.len() {
            0 => {}
            n if n > 1 && n == runs.len() => items.push(escape(&format!("{said}: all runs."))),
            _ => items.push(escape(&format!("{said}: {}.", labels.join(", ")))),
        }
    };
    say(
        "Synthetic specimens: wood generated by a program, which also placed the adhesive of the \u{201c}experiment\u{201d}",
        &|run| run.setup.synthetic == "wood and adhesive",
    );
    say("Synthetic specimens: wood generated by a program", &|run| {
        run.setup.synthetic == "wood"
    });
    say(
        "Adhesive reached the outer face of the wood: the specimen is too small",
        &|run| run.outer_face_reached(),
    );
    if let Some(why) = runs.iter().find_map(RunFolder::beyond_sides) {
        let said = format!("Beyond the sides: {why}");
        say(&said, &|run| run.beyond_sides().is_some());
    }
    let large = |known: &Known| known.error > LARGE * known.best().abs();
    say(
        "The error of WP exceeds a tenth on one side or in total",
        &|run| run.wp.iter().any(large),
    );
    say(
        "The error of the pressure at the end exceeds a tenth",
        &|run| large(&run.pressure),
    );
    say(
        "The error due to the cell size is not known (wp-metrics --finer computes it)",
        &|run| !run.wp[2].has_error() && best_of(runs, run).is_none(),
    );
    let measured = |run: &RunFolder| experiments.iter().find(|experiment| run.is_of(experiment));
    say(
        "How well a real bond line is predicted is not told: no measurement of the specimen is on this page (--experiment)",
        &|run| measured(run).is_none(),
    );
    let from_best = runs.iter().filter_map(|run| {
        let (label, best) = best_of(runs, run)?;
        Some(apart(run, run.wp[2].as_run, label, best))
    });
    let from_measured = runs.iter().filter_map(|run| {
        let of = measured(run).filter(|_| run.wp[2].best().is_finite())?;
        Some(apart(run, run.wp[2].best(), &of.label, of.wp[2].best()))
    });
    for (said, off) in [
        (
            "Total WP that is not extrapolated differs from that of the same press",
            from_best.collect::<Vec<_>>(),
        ),
        (
            "Total WP differs from that measured in the specimen",
            from_measured.collect(),
        ),
    ] {
        if !off.is_empty() {
            items.push(escape(&format!("{said}: {}.", off.join("; "))));
        }
    }
    let items = items.iter().map(|item| format!("<li>{item}</li>\n"));
    let items: String = items.collect();
    format!("<h3>Limitations</h3>\n<ul class=\"doubts\">\n{items}</ul>\n")
}
