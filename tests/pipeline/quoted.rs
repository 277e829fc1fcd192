//! The tutorial: its commands run as they stand, and its quotes are what they print.

use crate::workbench::{Workbench, root, said};

/// A line without what is only layout.
fn words(line: &str) -> String {
    line.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn the_tutorial_prints_what_it_quotes() {
    let bench = Workbench::new();
    std::os::unix::fs::symlink(root().join("pipelines"), bench.path("pipelines")).unwrap();
    let tutorial = std::fs::read_to_string(root().join("docs/tutorial.md")).unwrap();
    let (mut printed, mut quoted) = (Vec::new(), Vec::new());
    for (i, part) in tutorial.split("```").enumerate() {
        match part.strip_prefix("sh\n") {
            Some(commands) => {
                // The tools are built, and on the path of this shell.
                let own =
                    |l: &&str| !l.starts_with("cargo build") && !l.starts_with("export PATH=");
                let script: Vec<&str> = commands.lines().filter(own).collect();
                let output = bench.shell(&script.join("\n"));
                assert!(output.status.success(), "{commands}: {}", said(&output));
                let told = String::from_utf8_lossy(&output.stdout).into_owned() + &said(&output);
                printed.extend(told.lines().map(words));
            }
            None => {
                assert_eq!(i % 2, 0, "a block that is not of commands: {part}");
                let quotes = part.lines().filter(|line| line.starts_with("    "));
                quoted.extend(quotes.map(words));
            }
        }
    }
    assert_eq!(quoted.len(), 11, "lines that the tutorial quotes");
    for line in quoted {
        assert!(
            printed.contains(&line),
            "quoted: {line}\nprinted: {printed:#?}"
        );
    }
}
