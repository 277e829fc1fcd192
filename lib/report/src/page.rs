//! The page: its sections in order.

use crate::html::{details, escape, table, verbatim};
use crate::{Report, RunFolder, summary};

const STYLE: &str = include_str!("../assets/style.css");
const VIEWER: &str = include_str!("../assets/viewer.js");
/// ogl 1.0.11 (docs/dependencies.md).
const OGL: &str = include_str!("../assets/ogl.min.js");

/// What nothing on the page may do: ask any host for anything.
const POLICY: &str =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// A section with its heading.
struct Section {
    id: &'static str,
    title: &'static str,
    body: String,
}

/// The page of a report.
pub(crate) fn write(report: &Report) -> String {
    let title = escape(&report.title);
    let sections = sections(report);
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n<title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<header>\n<h1>{title}</h1>\n<nav aria-label=\"Sections\"><ul>\n"
    );
    for section in &sections {
        out += &format!(
            "<li><a href=\"#{}\">{}</a></li>\n",
            section.id, section.title
        );
    }
    out += "</ul></nav>\n</header>\n<main>\n";
    for Section { id, title, body } in &sections {
        out += &format!("<section id=\"{id}\">\n<h2>{title}</h2>\n{body}</section>\n");
    }
    out += "</main>\n";
    if !report.scenes.is_empty() {
        out += &format!("<script>{OGL}</script>\n<script>{VIEWER}</script>\n");
    }
    out + "</body>\n</html>\n"
}

fn sections(report: &Report) -> Vec<Section> {
    let section = |id, title, body| Section { id, title, body };
    let pictures = &report.pictures;
    let all = [
        section("summary", "Summary", summary::write(report)),
        section(
            "tables",
            "Tables",
            concat(&report.tables, crate::Table::to_html),
        ),
        section(
            "pictures",
            "Pictures",
            concat(
                pictures.get(summary::PICTURES..).unwrap_or_default(),
                crate::Picture::to_html,
            ),
        ),
        section(
            "views",
            "In 3D",
            concat(&report.scenes, crate::Scene::to_html),
        ),
        section("runs", "Runs", runs(&report.runs)),
        section("provenance", "How this page was made", provenance(report)),
    ];
    all.into_iter()
        .filter(|section| !section.body.is_empty())
        .collect()
}

fn concat<T>(parts: &[T], html: fn(&T) -> String) -> String {
    parts.iter().map(html).collect()
}

fn runs(runs: &[RunFolder]) -> String {
    if runs.is_empty() {
        return String::new();
    }
    let rows: Vec<Vec<String>> = runs.iter().map(RunFolder::row).collect();
    let one = |run: &RunFolder| format!("<h3>{}</h3>\n{}", escape(&run.label), run.to_html());
    let details: String = runs.iter().map(one).collect();
    table("How the runs ended", &RunFolder::COLUMNS, &rows) + &details
}

fn provenance(report: &Report) -> String {
    let rows: Vec<Vec<String>> = report.inputs.iter().map(|file| file.to_vec()).collect();
    let files = table("Files read", &["file", "XXH3-64"], &rows);
    details("Command and files", &(verbatim(&report.command) + &files))
}
