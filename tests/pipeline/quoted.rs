//! The tutorial: its commands run as they stand, and its quotes are what they print; the implicit rows of the results.

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

/// The implicit rows of the table of quick runs in docs/results: steps, CPU seconds and WP end them. The explicit ones take
/// minutes and are `make`'s.
#[test]
fn the_results_quote_the_quick_implicit_runs() {
    let page = std::fs::read_to_string(root().join("docs/results/README.md")).unwrap();
    let (_, page) = page.split_once("## The six runs").expect("its heading");
    for (adhesive, name) in [("pf", "PF"), ("pva-pf", "PVA-PF")] {
        let size = format!("--adhesive {adhesive} --size 40x96x40 --slab 14.5um --seed 1");
        for (row, case) in [
            ("implicit", "implicit"),
            ("implicit, frictionless", "implicit-frictionless"),
        ] {
            let case = root().join(format!("pipelines/cases/{adhesive}-{case}.toml"));
            let bench = Workbench::with_wood(&size, std::fs::read(case).unwrap());
            bench.press("run", &[], "");
            let steps = bench.table("run/history.csv").last("step");
            let wp = bench.measured("run/final.mpts").last("wp_um");
            let begin = format!("| {row} | {name} |");
            let quoted = page.lines().find(|line| line.starts_with(&begin)).unwrap();
            println!("{quoted} {steps} steps, WP {wp:.2} um");
            let cells: Vec<&str> = quoted.split(" | ").collect();
            assert_eq!(cells[5], format!("{steps}"), "{quoted}");
            assert_eq!(cells[7], format!("{wp:.2} |"), "{quoted}");
        }
    }
}
