//! Bad input: exit status and sentence of every tool, and nothing half written.

use std::fs;

use crate::workbench::{ADHESIVE, CASE, TOOLS, VOID, WOOD, Workbench, grooved, npy, said};

/// Command lines, the exit status of each, and parts of the one sentence it must say.
const TABLE: &str = include_str!("refusals.txt");

/// Two bodies of liquid that share a layer.
const OVERLAP: &str = r#"
[[body]]
material = "adhesive"
box = { min = ["0 um", "0 um", "0 um"], max = ["29 um", "29 um", "29 um"] }
[[body]]
material = "adhesive"
box = { min = ["0 um", "26.1 um", "0 um"], max = ["29 um", "58 um", "29 um"] }
"#;

/// Every file the table names.
fn bench() -> Workbench {
    let bench = Workbench::with_bond();
    let dims = [16, 32, 16];
    let label = |from: u8, to: u8| {
        npy(dims, move |x, y, z| match grooved(x, y, z) {
            found if found == from => to,
            found => found,
        })
    };
    bench.write("odd.npy", label(WOOD, 7));
    bench.write("bare.npy", label(ADHESIVE, VOID));
    bench.done(
        "xct2particles",
        &[
            "-q",
            "bare.npy",
            "--voxel",
            "1.45um",
            "--labels",
            "void=0,wood=128,adhesive=255",
            "-o",
            "bare.mpts",
        ],
    );
    bench.pressed("run", &["clamp.stop=0.05 us"], &[]);
    bench.done("particles", &["export", "bond.mpts", "-o", "bond.tif"]);
    let cut = |from: &str, to: &str, length: usize| {
        bench.write(to, &bench.read(from)[..length]);
    };
    cut("bond.tif", "short.tif", 3000);
    cut("bond.mpts", "short.mpts", 900);
    let flip = |to: &str, at: fn(usize) -> usize| {
        let mut bytes = bench.read("bond.mpts");
        let at = at(bytes.len());
        bytes[at] ^= 4;
        bench.write(to, bytes);
    };
    flip("header.mpts", |_| 40);
    flip("payload.mpts", |length| length - 3000);
    fs::create_dir(bench.path("empty")).unwrap();
    bench.write("text.csv", "hello\nworld\n");
    bench.write("archive.npz", b"PK\x03\x04");
    let changed = |name: &str, from: &str, to: &str| {
        assert!(CASE.contains(from));
        bench.write(name, CASE.replace(from, to));
    };
    changed("unknown.toml", "cell = ", "cel = ");
    bench.write("overlap.toml", CASE.to_owned() + OVERLAP);
    changed("unitless.toml", "\"300 cP\"", "\"300\"");
    changed("negative.toml", "\"300 cP\"", "\"-300 cP\"");
    bench
}

#[test]
fn bad_input_gets_its_status_and_a_sentence() {
    let bench = bench();
    let before = bench.names("");
    let mut wrong = Vec::new();
    let lines = TABLE
        .lines()
        .filter(|l| !l.is_empty() && !l.starts_with('#'));
    for line in lines {
        let cells: Vec<_> = line.split(" | ").collect();
        let [command, status, sentence] = cells[..] else {
            panic!("not a line of the table: {line}");
        };
        let words: Vec<_> = command.split(' ').collect();
        let output = bench.run(words[0], &words[1..]);
        let said = said(&output);
        let told = sentence.split(" ; ").all(|part| said.contains(part));
        let code = output.status.code();
        if code != status.parse().ok() || !told || said.contains("panicked") {
            wrong.push(format!("{line}\n  exit {code:?}: {said}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(bench.names(""), before, "something was left behind");
}

#[test]
fn every_tool_has_help_version_man_page_and_refuses_zero_threads() {
    let bench = Workbench::new();
    for tool in TOOLS {
        let help = bench.done(tool, &["--help"]);
        let (_, examples) = help.split_once("Examples:").expect(tool);
        let examples = examples
            .lines()
            .filter(|l| l.starts_with("  ") && l.contains(tool));
        assert!(
            examples.count() >= 3,
            "{tool} has fewer than three examples"
        );
        assert!(bench.done(tool, &["--version"]).starts_with(tool));
        let man = bench.done(tool, &["--generate", "man"]);
        // One page, and one for each subcommand.
        let pages = man.lines().filter(|l| l.starts_with(".TH")).count();
        assert_eq!(pages, 1 + subcommands(&help), "{tool}");
        for shell in ["bash", "zsh", "fish"] {
            assert!(bench.done(tool, &["--generate", shell]).contains(tool));
        }
        let subcommand: &[&str] = match tool {
            "particles" => &["sum"],
            "bond-figures" => &["slice"],
            "bond-sweep" => &["run"],
            _ => &[],
        };
        let refused = bench.run(tool, &[subcommand, &["--threads", "0"]].concat());
        assert_eq!(refused.status.code(), Some(2), "{tool}");
        assert!(
            said(&refused).contains("--threads"),
            "{tool}: {}",
            said(&refused)
        );
    }
}

/// Subcommands that a help text lists, `help` aside.
fn subcommands(help: &str) -> usize {
    let list = help.split_once("Commands:\n").map_or("", |(_, list)| list);
    let lines = list.lines().take_while(|line| !line.is_empty());
    // A description that goes on is indented further.
    let names = lines.filter(|line| !line.starts_with("   ") && !line.contains("  help "));
    names.count()
}

/// The reader of a pipe that goes away ends a tool quietly.
#[test]
fn a_closed_pipe_is_no_error() {
    let bench = Workbench::with_bond();
    bench.pressed("run", &[], &[]);
    let lines = [
        "synth-xct -q --adhesive pf --size 64x128x64 -o -",
        "xct2particles -q specimen.npy --voxel 1.45um -o -",
        "build-bondline -q specimen.mpts -o -",
        "mpm-run -q case.toml --particles bond.mpts --explain",
        "wp-metrics -q run/final.mpts",
        "wp-metrics -q run/final.mpts -o table.csv --profile -",
        "shear-stats -q run/final.mpts",
        "particles sum run/final.mpts",
        "particles info run/final.mpts",
        "particles export -f csv run/final.mpts -o -",
        "particles export -f npz run/final.mpts -o -",
        "particles export -f tiff run/final.mpts -o -",
        "bond-figures slice run/final.mpts -o -",
        "particles --help",
    ];
    for line in lines {
        // The reader is gone before the tool starts to write.
        let output = bench.shell(&format!(
            "set +o pipefail; {{ sleep 0.1; {line}; echo $? >&2; }} | :"
        ));
        assert_eq!(said(&output).trim(), "0", "{line}");
    }
}

/// A disk that is full in the middle of a run, played by a limit on the size of files.
#[test]
fn a_full_disk_ends_a_run_with_a_sentence_and_without_a_half_file() {
    let bench = Workbench::with_bond();
    let output = bench.shell("ulimit -f 16; mpm-run -q case.toml --particles bond.mpts -o run");
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    assert!(
        said(&output).contains("cannot write run/"),
        "{}",
        said(&output)
    );
    assert!(!bench.path("run/final.mpts").exists());
    let left: Vec<_> = fs::read_dir(bench.path("run/snapshots"))
        .into_iter()
        .flatten()
        .collect();
    assert!(left.is_empty(), "{left:?}");
}
