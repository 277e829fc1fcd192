//! The first section of the page: what was pressed, what came of it, what to doubt.

use figures::{Known, RunEnd};

use crate::html::{escape, table, verbatim};
use crate::setup::Setup;
use crate::{Report, RunFolder};

/// Pictures that stand in the summary.
pub(crate) const PICTURES: usize = 2;
/// Share of a value from which its error is doubted.
const LARGE: f64 = 0.1;

/// The section.
pub(crate) fn write(report: &Report) -> String {
    let runs = &report.runs[..];
    let pictures: String = report.pictures.iter().take(PICTURES).cloned().collect();
    let pictures = match pictures.is_empty() {
        true => pictures,
        false => format!("<div class=\"pair\">\n{pictures}</div>\n"),
    };
    match runs {
        [] => pictures,
        runs => pressed(runs) + &penetration(runs) + &pictures + &doubts(runs),
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
        let kind = if setup.synthetic { " (synthetic)" } else { "" };
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
    let size = "size with the gap";
    let headers = ["run", "specimen", size, "adhesive", "press", "date"];
    table("What was pressed", &headers, &rows)
}

fn penetration(runs: &[RunFolder]) -> String {
    let row = |run: &RunFolder| {
        let mut row = vec![run.label.clone()];
        let known = run.wp.iter().chain([&run.pressure]);
        row.extend(known.map(|known| known.told(2).join(" \u{b1} ")));
        row.push(run.end.mark().unwrap_or_else(|| ended(&run.end)));
        row
    };
    let rows: Vec<Vec<String>> = runs.iter().map(row).collect();
    let pressure = "pressure at the end (MPa)";
    let headers = ["run", "bottom", "top", "total", pressure, "press"];
    let note = match runs.iter().any(|run| run.wp[2].has_error()) {
        true => {
            "<p class=\"note\">With \u{b1}: extrapolated to infinitely small cells (first order); the error is the difference of two sizes of cells. Others: as run.</p>\n"
        }
        false => "",
    };
    table("Weighted penetration (um)", &headers, &rows) + note
}

/// How a run ended against which nothing is to be said.
fn ended(end: &RunEnd) -> String {
    let closed = end.end == "closed" || end.gap_share.is_finite();
    let closed = if closed { "closed" } else { "-" };
    match end.end.as_str() {
        "set" => format!("{closed}, set"),
        "programme" => format!("{closed}, programme over"),
        _ => closed.to_owned(),
    }
}

fn doubts(runs: &[RunFolder]) -> String {
    let mut items = Vec::new();
    for run in runs {
        if let Some(advice) = run.end.advice() {
            let (said, command) = advice.split_once(":\n").unwrap_or((&advice, ""));
            let command = Some(command.trim()).filter(|command| !command.is_empty());
            let command = command.map_or(String::new(), verbatim);
            let (label, said) = (escape(&run.label), escape(said));
            items.push(format!("<strong>{label}: {said}</strong>{command}"));
        }
        if let Some(doubt) = &run.voxel_doubt {
            items.push(escape(&format!("{}: {doubt}", run.label)));
        }
    }
    let mut say = |said: &str, is: &dyn Fn(&RunFolder) -> bool| {
        let labels: Vec<&str> = (runs.iter().filter(|run| is(run)))
            .map(|run| run.label.as_str())
            .collect();
        if !labels.is_empty() {
            items.push(escape(&format!("{said}: {}.", labels.join(", "))));
        }
    };
    say(
        "Synthetic specimens: a program grew the wood and placed the adhesive of its \u{201c}experiment\u{201d}",
        &|run| run.setup.synthetic,
    );
    say(
        "Adhesive came to the outer face of the wood: the specimen is too small",
        &|run| run.outer_face_reached(),
    );
    say(
        "Air in lumens is closed off where the specimen ends: WP is uncertain by its difference from the same run without [air]",
        &|run| run.closes_off_air(),
    );
    let large = |known: &Known| known.error > LARGE * known.best().abs();
    say("WP of a side is off by more than a tenth", &|run| {
        run.wp.iter().any(large)
    });
    say(
        "The pressure at the end is off by more than a tenth",
        &|run| large(&run.pressure),
    );
    say(
        "The error by the size of the cells is not known (wp-metrics --finer tells it)",
        &|run| !run.wp[2].has_error(),
    );
    items.push("How well either scheme predicts a real bond line is not known: no scanned one was at hand.".into());
    let items = items.iter().map(|item| format!("<li>{item}</li>\n"));
    let items: String = items.collect();
    format!("<h3>What to doubt</h3>\n<ul class=\"doubts\">\n{items}</ul>\n")
}
