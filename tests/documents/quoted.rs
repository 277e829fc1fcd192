//! Numbers that the README takes from the tables of results.

use std::path::Path;

/// Errors of the channels six cells wide by the methods of the paper's six runs and by the
/// implicit scheme, from the table that `make verify` writes: (method, error).
fn channels(root: &Path) -> Vec<(String, f64)> {
    let mut table = csv::Reader::from_path(root.join("docs/results/verification.csv")).unwrap();
    let names = table.headers().unwrap().clone();
    let column = |name: &str| names.iter().position(|n| n == name).unwrap();
    let (case, method, error) = (column("case"), column("method"), column("error"));
    let rows = table.records().map(Result::unwrap);
    rows.filter(|row| row[case].starts_with("channel-n6-"))
        .filter(|row| matches!(&row[method], "implicit" | "FLIP" | "XPIC(5)"))
        .map(|row| (row[method].to_owned(), row[error].parse().unwrap()))
        .collect()
}

/// What is wrong with the sentence of the README about a lumen six cells wide.
pub fn differences(root: &Path) -> Vec<String> {
    let readme = std::fs::read_to_string(root.join("README.md")).unwrap();
    let words: Vec<&str> = readme.split_whitespace().collect();
    let readme = words.join(" ");
    let errors = channels(root);
    let of = |implicit: bool| {
        let picked = errors
            .iter()
            .filter(move |e| (e.0 == "implicit") == implicit);
        picked.map(|e| 100.0 * e.1)
    };
    let worst = of(true).fold(0.0, |most: f64, e| most.max(e.abs()));
    let (least, most) = of(false).fold((0.0_f64, 0.0_f64), |(l, m), e| (l.min(e), m.max(e)));
    [
        format!(
            "the implicit scheme carries the flow to {:.1} %",
            (10.0 * worst).ceil() / 10.0
        ),
        format!("is off by {least:.0} to {most:+.0} %"),
    ]
    .into_iter()
    .filter(|sentence| !readme.contains(sentence))
    .map(|sentence| format!("README.md does not say: {sentence}"))
    .collect()
}
