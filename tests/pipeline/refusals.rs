//! Bad input: exit status and sentence of every tool, and nothing half written.

use std::fs;

use crate::verdicts;
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
    let label = |from: u8, to: u8| {
        npy([16, 32, 16], move |x, y, z| match grooved(x, y, z) {
            found if found == from => to,
            found => found,
        })
    };
    bench.write("odd.npy", label(WOOD, 7));
    bench.write("bare.npy", label(ADHESIVE, VOID));
    bench.press("run", &["clamp.stop=0.05 us"], "");
    bench.done(
        "xct2particles -q bare.npy --voxel 1.45um --labels void=0,wood=128,adhesive=255 -o bare.mpts
         particles export bond.mpts -o bond.tif; mkdir empty
         head -c 3000 bond.tif >short.tif; head -c 900 bond.mpts >short.mpts
         printf 'hello\\nworld\\n' >text.csv; printf 'PK\\x03\\x04' >archive.npz",
    );
    bench.damage(
        "bond.mpts",
        "header.mpts",
        bench.read("bond.mpts").len() - 40,
    );
    bench.damage("bond.mpts", "payload.mpts", 3000);
    bench.write("overlap.toml", CASE.to_owned() + OVERLAP);
    bench.write("boxes.toml", verdicts::SMALL);
    bench.done("mpm-run -q boxes.toml -o boxes");
    for (name, from, to) in [
        ("unknown.toml", "cell = ", "cel = "),
        ("unitless.toml", "\"300 cP\"", "\"300\""),
        ("negative.toml", "\"300 cP\"", "\"-300 cP\""),
    ] {
        assert!(CASE.contains(from));
        bench.write(name, CASE.replace(from, to));
    }
    bench
}

#[test]
fn bad_input_gets_its_status_and_a_sentence() {
    let bench = bench();
    let before = bench.names("");
    let mut wrong = Vec::new();
    let is_row = |line: &&str| !line.is_empty() && !line.starts_with('#');
    for line in TABLE.lines().filter(is_row) {
        let cells: Vec<_> = line.split(" | ").collect();
        let [command, status, sentence] = cells[..] else {
            panic!("not a line of the table: {line}");
        };
        let mut words = command.split(' ');
        let mut tool = bench.tool(words.next().unwrap());
        let output = tool.args(words).output().unwrap();
        let (code, said) = (output.status.code(), said(&output));
        let told = sentence.split(" ; ").all(|part| said.contains(part));
        if code != status.parse().ok() || !told || said.contains("panicked") {
            wrong.push(format!("{line}\n  exit {code:?}: {said}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(bench.names(""), before, "something was left behind");
    assert_eq!(fs::read_dir(bench.path("empty")).unwrap().count(), 0);
}

#[test]
fn every_tool_has_help_version_man_page_and_refuses_zero_threads() {
    let bench = Workbench::new();
    for tool in TOOLS {
        let help = bench.done(&format!("{tool} --help"));
        let (_, examples) = help.split_once("Examples:").expect(tool);
        let is_example = |line: &&str| line.starts_with("  ") && line.contains(tool);
        assert!(
            examples.lines().filter(is_example).count() >= 3,
            "{tool}: examples"
        );
        assert!(bench.done(&format!("{tool} --version")).starts_with(tool));
        let man = bench.done(&format!("{tool} --generate man"));
        // One page, and one for each subcommand.
        let pages = man.lines().filter(|l| l.starts_with(".TH")).count();
        assert_eq!(pages, 1 + subcommands(&help), "{tool}");
        for shell in ["bash", "zsh", "fish"] {
            assert!(
                bench
                    .done(&format!("{tool} --generate {shell}"))
                    .contains(tool)
            );
        }
        let subcommand = match tool {
            "particles" => "sum",
            "bond-figures" => "slice",
            "bond-sweep" => "run",
            _ => "",
        };
        bench.ends(2, &format!("{tool} {subcommand} --threads 0"), "--threads");
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
