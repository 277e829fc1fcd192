//! Bad input: exit status and sentence of every tool, and nothing half written.

use std::fs;

use crate::workbench::{ADHESIVE, CASE, TOOLS, VOID, WOOD, Workbench, grooved, npy, said};

/// A command line, its exit status, and parts of the one sentence it must say.
type Refusal = (&'static str, i32, &'static [&'static str]);

const XCT2PARTICLES: [Refusal; 16] = [
    (
        "odd.npy --voxel 1.45um -o O",
        2,
        &["'odd.npy', page 1", "holds 7", "--labels"],
    ),
    (
        "odd.npy --voxel 1.45um --labels void=0,wood=128,adhesive=255 -o O",
        2,
        &["holds 7", "no phase"],
    ),
    (
        "specimen.npy --voxel 1.45um --labels void=0,wood=128 -o O",
        2,
        &["no label is given for adhesive"],
    ),
    ("specimen.npy -o O", 2, &["how large a voxel is", "1.45 um"]),
    (
        "specimen.npy --voxel 1.45 -o O",
        2,
        &["'1.45' has no unit", "um"],
    ),
    ("specimen.npy --voxel=-1um -o O", 2, &["greater than zero"]),
    (
        "specimen.npy --voxel 1s -o O",
        2,
        &["'s'", "not a unit of a length"],
    ),
    (
        "specimen.npy --voxel 1.45um --crop 0:99,0:32,0:16 -o O",
        2,
        &["0:99 along x", "16 voxels"],
    ),
    (
        "absent.tif --voxel 1.45um -o O",
        3,
        &["cannot read 'absent.tif'"],
    ),
    ("empty --voxel 1.45um -o O", 3, &["holds no slices", ".tif"]),
    (
        "text.csv --voxel 1.45um -o O",
        3,
        &["not a stack", "BigTIFF"],
    ),
    ("bond.mpts --voxel 1.45um -o O", 3, &["not a stack"]),
    ("short.tif --voxel 1.45um -o O", 3, &["page 1", "truncated"]),
    (
        "specimen.npy --voxel 1.45um -o /dev/full",
        1,
        &["cannot write '/dev/full'", "No space left"],
    ),
    (
        "specimen.npy --voxel 1.45um -o absent/O",
        1,
        &["cannot write 'absent/O'"],
    ),
    (
        "specimen.npy --voxel 1.45um -o empty",
        1,
        &["cannot write 'empty'", "folder"],
    ),
];

const BUILD_BONDLINE: [Refusal; 12] = [
    ("bare.mpts -o O", 3, &["no adhesive voxel"]),
    (
        "bond.mpts -o O",
        2,
        &["'bond.mpts' holds a bond before pressing, not a specimen"],
    ),
    (
        "run/final.mpts -o O",
        2,
        &["holds a state of a run, not a specimen"],
    ),
    ("specimen.npy -o O", 3, &["not a particle file", ".mpts"]),
    ("short.mpts -o O", 3, &["truncated"]),
    (
        "header.mpts -o O",
        3,
        &["'header.mpts' has a damaged header"],
    ),
    ("empty -o O", 3, &["cannot read 'empty'", "folder"]),
    (
        "specimen.mpts --normal w -o O",
        2,
        &["'w' is not an axis", "x, y and z"],
    ),
    (
        "specimen.mpts --normal x -o O",
        2,
        &["normal to x", "another --normal"],
    ),
    (
        "specimen.mpts --plane 1mm -o O",
        2,
        &["outside the specimen"],
    ),
    (
        "specimen.mpts --voxels-per-cell 3 -o O",
        2,
        &["-25.00 %", "--tolerance"],
    ),
    (
        "specimen.mpts -o /dev/full",
        1,
        &["cannot write '/dev/full'"],
    ),
];

const MPM_RUN: [Refusal; 22] = [
    (
        "unknown.toml --particles bond.mpts -o O",
        2,
        &["unknown.toml:2:1", "`cel`", "`cell`"],
    ),
    (
        "unitless.toml --particles bond.mpts -o O",
        2,
        &["unitless.toml:6:13", "unit"],
    ),
    (
        "negative.toml --particles bond.mpts -o O",
        2,
        &["negative.toml:6:13", "greater than zero"],
    ),
    (
        "case.toml --particles bond.mpts -o O --set grid.cel=1",
        2,
        &["--set grid.cel=1", "`cell`"],
    ),
    (
        "case.toml --particles bond.mpts -o O --set integrator.cfl=-1",
        2,
        &["cfl is -1"],
    ),
    (
        "case.toml --particles bond.mpts -o O --set clamp.pid.kp=nan --set clamp.pid.ki=0 --set clamp.pid.kd=0",
        2,
        &["kp, ki and kd"],
    ),
    (
        "case.toml --particles bond.mpts -o O --set grid.cell=3um",
        2,
        &["7.733 cells", "another cell"],
    ),
    (
        "case.toml --particles bond.mpts -o O --set grid.dimensions=2",
        2,
        &["one voxel thick", "--crop"],
    ),
    (
        "case.toml --particles bond.mpts -o O --set grid.dimensions=4",
        2,
        &["2 or 3"],
    ),
    (
        "case.toml --particles specimen.mpts -o O",
        2,
        &["holds a specimen", "build-bondline"],
    ),
    (
        "case.toml --particles run/final.mpts -o O",
        2,
        &["holds a state of a run"],
    ),
    (
        "case.toml --particles specimen.npy -o O",
        3,
        &["not a particle file"],
    ),
    ("case.toml --particles short.mpts -o O", 3, &["truncated"]),
    (
        "case.toml --particles header.mpts -o O",
        3,
        &["damaged header"],
    ),
    (
        "case.toml --particles payload.mpts -o O",
        3,
        &["damaged array 'wood-"],
    ),
    (
        "case.toml --particles absent.mpts -o O",
        3,
        &["cannot read 'absent.mpts'"],
    ),
    (
        "bond.mpts --particles case.toml -o O",
        2,
        &["'bond.mpts'", "not TOML"],
    ),
    (
        "empty --particles bond.mpts -o O",
        2,
        &["'empty'", "directory"],
    ),
    (
        "case.toml --particles bond.mpts -o text.csv",
        2,
        &["'text.csv' is a file", "folder"],
    ),
    (
        "case.toml --particles bond.mpts -o -",
        2,
        &["standard output"],
    ),
    (
        "case.toml --particles bond.mpts -o /proc/absent/O",
        1,
        &["cannot write /proc/absent/O"],
    ),
    ("case.toml -o O", 2, &["--particles BOND or [[body]]"]),
];

const WP_METRICS: [Refusal; 9] = [
    ("bare.mpts -o O", 3, &["no adhesive voxel"]),
    ("specimen.npy -o O", 2, &["how large a voxel is"]),
    (
        "payload.mpts -o O",
        3,
        &["'payload.mpts': the file has a damaged array"],
    ),
    (
        "run/final.mpts --reference plane=2 -o O",
        2,
        &["'2' has no unit"],
    ),
    (
        "run/final.mpts --reference middle -o O",
        2,
        &["mid, adherend, fit and plane=LEN"],
    ),
    ("run/final.mpts specimen.mpts --map O", 2, &["one file"]),
    (
        "run/final.mpts -o /dev/full",
        1,
        &["cannot write '/dev/full'"],
    ),
    (
        "run/final.mpts --compare absent.mpts -o O",
        3,
        &["cannot read 'absent.mpts'"],
    ),
    ("run -o O", 3, &["'run'", "no slices"]),
];

const SHEAR_STATS: [Refusal; 4] = [
    ("specimen.mpts -o O", 3, &["no column 'shear_rate'"]),
    ("text.csv -o O", 3, &["not a particle file"]),
    ("--tube 1,2", 2, &["'1' has no unit"]),
    (
        "run/final.mpts -o /dev/full",
        1,
        &["cannot write '/dev/full'"],
    ),
];

const PARTICLES: [Refusal; 6] = [
    ("check payload.mpts", 3, &["damaged array 'wood-"]),
    ("info short.mpts", 3, &["truncated"]),
    ("sum text.csv", 3, &["not a particle file"]),
    ("sum absent.mpts", 3, &["cannot read 'absent.mpts'"]),
    (
        "export bond.mpts -o O.xyz",
        2,
        &["cannot tell the format", "npz"],
    ),
    (
        "export bond.mpts -f csv -o /dev/full",
        1,
        &["cannot write '/dev/full'"],
    ),
];

const BOND_FIGURES: [Refusal; 7] = [
    (
        "slice absent.mpts -o O.svg",
        3,
        &["cannot read 'absent.mpts'"],
    ),
    ("slice bond.mpts -o O.pdf", 2, &[".svg or .png"]),
    (
        "slice bond.mpts --at 9mm -o O.svg",
        2,
        &["no slice at z = 9000.00 um"],
    ),
    ("pressure --run a=empty -o O.svg", 3, &["empty/history.csv"]),
    (
        "map --map a=text.csv -o O.svg",
        3,
        &["no column x_um", "hello"],
    ),
    ("shear text.csv -o O.svg", 3, &["'text.csv' has no column"]),
    (
        "table2 --run pf:x=text.csv -o O",
        3,
        &["'text.csv' has no column"],
    ),
];

const SYNTH_XCT: [Refusal; 4] = [
    (
        "--adhesive pf --size 1x1x1 -o O",
        2,
        &["1x1x1 is not accepted", "24 to 4096"],
    ),
    ("--adhesive glue -o O", 2, &["pf, pva-pf"]),
    ("--adhesive pf --voxel 1 -o O", 2, &["'1' has no unit"]),
    (
        "--adhesive pf --size 24x48x24 -o /dev/full",
        1,
        &["cannot write '/dev/full'"],
    ),
];

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
    let changed = |name: &str, from: &str, to: &str| {
        assert!(CASE.contains(from));
        bench.write(name, CASE.replace(from, to));
    };
    changed("unknown.toml", "cell = ", "cel = ");
    changed("unitless.toml", "\"300 cP\"", "\"300\"");
    changed("negative.toml", "\"300 cP\"", "\"-300 cP\"");
    bench
}

#[test]
fn bad_input_gets_its_status_and_a_sentence() {
    let bench = bench();
    let before = listing(&bench);
    let tables: [(&str, &[Refusal]); 8] = [
        ("xct2particles", &XCT2PARTICLES),
        ("build-bondline", &BUILD_BONDLINE),
        ("mpm-run", &MPM_RUN),
        ("wp-metrics", &WP_METRICS),
        ("shear-stats", &SHEAR_STATS),
        ("particles", &PARTICLES),
        ("bond-figures", &BOND_FIGURES),
        ("synth-xct", &SYNTH_XCT),
    ];
    let mut wrong = Vec::new();
    for (tool, table) in tables {
        for (line, status, sentence) in table {
            let arguments: Vec<_> = line.split(' ').collect();
            let output = bench.run(tool, &arguments);
            let said = said(&output);
            let told = sentence.iter().all(|part| said.contains(part));
            let panicked = said.contains("panicked");
            if output.status.code() != Some(*status) || !told || panicked {
                let code = output.status.code();
                wrong.push(format!(
                    "{tool} {line}\n  exit {code:?}, expected {status}; {sentence:?} in: {said}"
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(listing(&bench), before, "something was left behind");
}

fn listing(bench: &Workbench) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(bench.folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
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
        assert!(bench.done(tool, &["--generate", "man"]).contains(".TH"));
        for shell in ["bash", "zsh", "fish"] {
            assert!(bench.done(tool, &["--generate", shell]).contains(tool));
        }
        let subcommand: &[&str] = match tool {
            "particles" => &["sum"],
            "bond-figures" => &["slice"],
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
        "wp-metrics -q run/final.mpts --profile -",
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
    let output = bench
        .shell("trap '' XFSZ; ulimit -f 16; mpm-run -q case.toml --particles bond.mpts -o run");
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
