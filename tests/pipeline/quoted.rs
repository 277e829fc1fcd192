//! Quotes of the tools' output in documents: they are what the tools print.

use std::fs;
use std::path::{Path, PathBuf};

use crate::workbench::{Workbench, said};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A bench in which paths from the top of the repository lead somewhere.
pub fn bench() -> Workbench {
    let bench = Workbench::new();
    let cases = root().join("pipelines").canonicalize().unwrap();
    std::os::unix::fs::symlink(cases, bench.path("pipelines")).unwrap();
    bench
}

/// A line without what is only layout.
fn words(line: &str) -> String {
    line.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Blocks of a document in their order: commands (fenced as `sh`) and what they are said to print
/// (indented by four blanks).
enum Block {
    Commands(String),
    Quote(Vec<String>),
}

fn blocks(text: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut fence: Option<String> = None;
    for line in text.lines() {
        match &mut fence {
            Some(_) if line == "```" => blocks.extend(fence.take().map(Block::Commands)),
            Some(commands) => *commands += &format!("{line}\n"),
            None if line == "```sh" => fence = Some(String::new()),
            None => {
                let Some(quoted) = line.strip_prefix("    ") else {
                    continue;
                };
                match blocks.last_mut() {
                    Some(Block::Quote(lines)) => lines.push(words(quoted)),
                    _ => blocks.push(Block::Quote(vec![words(quoted)])),
                }
            }
        }
    }
    blocks
}

#[test]
fn the_tutorial_prints_what_it_quotes() {
    let bench = bench();
    let text = fs::read_to_string(root().join("docs/tutorial.md")).unwrap();
    let (mut printed, mut quotes) = (Vec::new(), 0);
    for block in blocks(&text) {
        match block {
            Block::Commands(commands) => {
                // The tools are built, and on the path of this shell.
                let lines = commands.lines();
                let own =
                    |l: &&str| !l.starts_with("cargo build") && !l.starts_with("export PATH=");
                let script: Vec<&str> = lines.filter(own).collect();
                let output = bench.shell(&script.join("\n"));
                assert!(output.status.success(), "{commands}: {}", said(&output));
                let all = String::from_utf8_lossy(&output.stdout).into_owned() + &said(&output);
                printed.extend(all.lines().map(words));
            }
            Block::Quote(lines) => {
                quotes += 1;
                let found = printed.windows(lines.len()).any(|window| window == lines);
                assert!(found, "quoted: {lines:#?}\nprinted: {printed:#?}");
            }
        }
    }
    assert_eq!(quotes, 3, "the tutorial's quotes");
}

/// Cells of the rows of `page` that begin with `name`, in their order.
fn rows<'a>(page: &'a str, name: &str) -> Vec<Vec<&'a str>> {
    page.lines()
        .filter_map(|line| line.strip_prefix('|')?.strip_suffix('|'))
        .map(|row| row.split('|').map(str::trim).collect::<Vec<_>>())
        .filter(|row| row[0] == name)
        .collect()
}

/// The implicit rows of the table of quick runs in docs/results; the explicit ones take
/// minutes and are `make`'s.
#[test]
fn the_results_quote_the_quick_implicit_runs() {
    let bench = bench();
    let page = fs::read_to_string(root().join("docs/results/README.md")).unwrap();
    let from = page.find("## The six runs").expect("its heading");
    for (place, adhesive) in ["pf", "pva-pf"].into_iter().enumerate() {
        let made = bench.shell(&format!(
            "synth-xct -q --adhesive {adhesive} --size 40x96x40 --slab '14.5 um' --voxel '1.45 um' --seed 1 -o - |
             xct2particles -q - -o - | build-bondline -q - -o {adhesive}.mpts"
        ));
        assert!(made.status.success(), "{}", said(&made));
        for (row, case) in [
            ("implicit", "implicit"),
            ("implicit, frictionless", "implicit-frictionless"),
        ] {
            let quoted = &rows(&page[from..], row)[place];
            let name = format!("{adhesive}-{case}");
            let output = bench.shell(&format!(
                "mpm-run -q pipelines/cases/{name}.toml --particles {adhesive}.mpts -o {name}
                 wp-metrics -q {name}/final.mpts -o {name}.csv"
            ));
            assert!(output.status.success(), "{}", said(&output));
            let value = |file: &str, key: &str| last_total(&bench, file, key);
            let steps = value(&format!("{name}/history.csv"), "step").round();
            let wp = value(&format!("{name}.csv"), "wp_um");
            println!("{name}: {steps} steps, WP {wp:.2} um");
            // The last cells of a row: steps, CPU seconds, WP.
            let [.., quoted_steps, _, quoted_wp] = quoted[..] else {
                panic!("{quoted:?}");
            };
            assert_eq!(quoted_steps, format!("{steps}"), "{name}: steps");
            assert_eq!(quoted_wp, format!("{wp:.2}"), "{name}: WP total");
        }
    }
}

/// The number under `key` in the last row of a table, which is that of both sides together where
/// there are sides.
fn last_total(bench: &Workbench, file: &str, key: &str) -> f64 {
    let table = String::from_utf8(bench.read(file)).unwrap();
    let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
    let header = cells(table.lines().next().unwrap());
    let column = header.iter().position(|name| name == key).unwrap();
    cells(table.lines().last().unwrap())[column]
        .parse()
        .unwrap()
}
