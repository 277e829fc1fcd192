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

impl Report {
    /// The page.
    pub fn to_html(&self) -> String {
        let title = escape(&self.title);
        let rest = self.pictures.get(summary::PICTURES..).unwrap_or_default();
        let mut sections = vec![
            ("summary", "Summary", summary::write(self)),
            ("tables", "Tables", self.tables.concat()),
            ("pictures", "Pictures", rest.concat()),
            ("views", "In 3D", self.scenes.concat()),
            ("runs", "Runs", runs(&self.runs)),
            ("provenance", "How this page was made", provenance(self)),
        ];
        sections.retain(|(_, _, body)| !body.is_empty());
        let mut out = format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n<title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<header>\n<h1>{title}</h1>\n<nav aria-label=\"Sections\"><ul>\n"
        );
        for (id, title, _) in &sections {
            out += &format!("<li><a href=\"#{id}\">{title}</a></li>\n");
        }
        out += "</ul></nav>\n</header>\n<main>\n";
        for (id, title, body) in &sections {
            out += &format!("<section id=\"{id}\">\n<h2>{title}</h2>\n{body}</section>\n");
        }
        out += "</main>\n";
        if !self.scenes.is_empty() {
            out += &format!("<script>{OGL}</script>\n<script>{VIEWER}</script>\n");
        }
        out + "</body>\n</html>\n"
    }
}

fn runs(runs: &[RunFolder]) -> String {
    let Some(first) = runs.first() else {
        return String::new();
    };
    let headers = first.row().map(|(header, _)| header);
    let row = |run: &RunFolder| run.row().map(|(_, cell)| cell).to_vec();
    let rows: Vec<Vec<String>> = runs.iter().map(row).collect();
    let one = |run: &RunFolder| format!("<h3>{}</h3>\n{}", escape(&run.label), run.to_html());
    let details: String = runs.iter().map(one).collect();
    table("How the runs ended", &headers, &rows) + &details
}

fn provenance(report: &Report) -> String {
    let rows: Vec<Vec<String>> = report.inputs.iter().map(|file| file.to_vec()).collect();
    let files = table("Files read", &["file", "XXH3-64"], &rows);
    details("Command and files", &(verbatim(&report.command) + &files))
}
