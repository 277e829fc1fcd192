//! Commits named in docs/results are in the history.

use std::path::Path;
use std::process::Command;

/// A sentence about each commit named in docs/results that is not an ancestor of the present one;
/// none where there is no whole history to look in, with the reason.
pub fn missing(root: &Path) -> Result<Vec<String>, String> {
    let git = |arguments: &[&str]| {
        let mut command = Command::new("git");
        let output = command.arg("-C").arg(root).args(arguments).output();
        let output = output.map_err(|e| format!("git: {e}"))?;
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim().to_owned();
        if output.status.success() {
            Ok(text(&output.stdout))
        } else {
            Err(text(&output.stderr))
        }
    };
    if git(&["rev-parse", "--is-shallow-repository"])? == "true" {
        return Err("the history is cut short".into());
    }
    let history = git(&["rev-list", "HEAD"])?;
    let mut said = Vec::new();
    for entry in std::fs::read_dir(root.join("docs/results")).expect("a folder of results") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|ending| ending != "md") {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("a page");
        for commit in named(&text) {
            if !history.lines().any(|full| full.starts_with(commit)) {
                said.push(format!("{}: no commit {commit}", path.display()));
            }
        }
    }
    Ok(said)
}

/// Words of `text` that are a commit: seven to forty hexadecimal digits, letters among them or after
/// the word.
fn named(text: &str) -> Vec<&str> {
    let words = text.split(|c: char| !c.is_alphanumeric() && c != '.');
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    let is_one = |i: usize| {
        let word = words[i].trim_end_matches('.');
        let hex = |c: char| c.is_ascii_digit() || ('a'..='f').contains(&c);
        let digits = word.contains(|c: char| c.is_ascii_digit());
        let letters = word.contains(|c: char| c.is_ascii_lowercase());
        let told = i > 0 && ["commit", "commits"].contains(&words[i - 1]);
        (7..=40).contains(&word.len()) && word.chars().all(hex) && (digits && letters || told)
    };
    let found = (0..words.len()).filter(|&i| is_one(i));
    found.map(|i| words[i].trim_end_matches('.')).collect()
}

#[test]
fn commits_are_told_from_other_words() {
    let text =
        "on commit 1234567 (before: ac686b0), 50 000 of 1234567 defaced, 3.1e-18, `c9b02df`.";
    assert_eq!(named(text), ["1234567", "ac686b0", "c9b02df"]);
}
