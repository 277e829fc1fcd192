//! Harm that the system or somebody else does to the tools: an error stream that fails, names that are
//! no text or steer a terminal, devices without an end, disks that are full, files that change under a run.

use std::ffi::{OsStr, OsString};
use std::fs;
use std::os::unix::ffi::OsStrExt;

use crate::workbench::{TOOLS, Workbench, press, said};

/// `eprintln!` panicked: exit 101, and a run was lost without a checkpoint.
#[test]
fn a_failing_standard_error_ends_nothing() {
    let bench = Workbench::with_bond();
    for tool in TOOLS {
        bench.ends(2, &format!("{tool} --no-such-option 2>/dev/full"), "");
    }
    let run = "mpm-run case.toml --particles bond.mpts -o run";
    bench.done(&format!("{run} -v 2>/dev/full"));
    assert!(bench.path("run/final.mpts").exists());
    bench.ends(2, &format!("{run} 2>/dev/full"), "");
    // Help that is not printed.
    bench.ends(1, "particles --help >/dev/full", "");
}

/// All tools panicked.
#[test]
fn an_argument_that_is_no_text_is_refused_or_used() {
    let bench = Workbench::with_bond();
    let named = |ending: &str| {
        [OsStr::from_bytes(b"od\xffd"), OsStr::new(ending)]
            .into_iter()
            .collect::<OsString>()
    };
    for name in TOOLS {
        let output = bench.tool(name).arg(named("")).output().unwrap();
        let code = output.status.code();
        assert!(matches!(code, Some(2 | 3)), "{name}: {code:?}");
        assert!(!said(&output).contains("panicked"), "{name}");
    }
    fs::copy(
        bench.path("specimen.npy"),
        bench.folder().join(named(".npy")),
    )
    .unwrap();
    fs::copy(bench.path("case.toml"), bench.folder().join(named(".toml"))).unwrap();
    // A word that begins with a point is the odd name with this ending.
    for line in [
        "xct2particles .npy --voxel 1.45um -o .mpts",
        "build-bondline .mpts -o .bond",
        "mpm-run .toml --particles .bond --set clamp.stop=20ns -o .run",
        "wp-metrics .run/final.mpts -o .csv",
        "shear-stats .run/final.mpts -o .s.csv",
        "particles export .run/final.mpts -o .pvd",
        "bond-figures slice .run/final.mpts -o .svg",
    ] {
        let mut words = line.split(' ');
        let mut tool = bench.tool(words.next().unwrap());
        tool.args(words.map(|word| match word.starts_with('.') {
            true => named(word),
            false => word.into(),
        }));
        let output = tool.output().unwrap();
        assert!(output.status.success(), "{line}: {}", said(&output));
    }
    assert!(fs::metadata(bench.folder().join(named(".svg"))).is_ok_and(|m| m.len() > 0));
}

/// Names went to tables as formulas and to the terminal as they were.
#[test]
fn names_are_no_formulas_and_do_not_steer_a_terminal() {
    let bench = Workbench::with_bond();
    for name in ["=1+1.mpts", "+a.mpts", "@a.mpts"] {
        fs::copy(bench.path("specimen.mpts"), bench.path(name)).unwrap();
        assert_eq!(bench.measured(name).rows[0][0], format!("'{name}"));
    }
    bench.ends(3, "particles sum '\u{1b}[2Jabsent'", "\\u{1b}[2Jabsent");
    fs::copy(bench.path("bond.mpts"), bench.path("\u{1b}[2J")).unwrap();
    for command in ["sum", "info", "check"] {
        let told = bench.done(&format!("particles {command} '\u{1b}[2J'"));
        assert!(
            told.contains("\\u{1b}[2J") && !told.contains('\u{1b}'),
            "{told}"
        );
    }
    bench.ends(
        2,
        "bond-figures table2 --run +a:b=x.csv -o t.csv",
        "formula",
    );
}

/// They were spooled to the disk or read into memory to their end, which does not come.
#[test]
fn devices_without_an_end_are_refused_at_once() {
    let bench = Workbench::with_bond();
    let header =
        "NDims = 3\nDimSize = 4 4 4\nElementType = MET_UCHAR\nElementDataFile = /dev/zero\n";
    bench.write("zero.mhd", header);
    for (line, code) in [
        ("xct2particles /dev/zero --voxel 1um -o O", 3),
        ("xct2particles - --voxel 1um -o O < /dev/zero", 3),
        ("xct2particles zero.mhd --voxel 1um -o O", 3),
        ("wp-metrics - < /dev/zero", 3),
        ("build-bondline - -o O < /dev/zero", 3),
        ("particles sum /dev/zero", 3),
        ("shear-stats /dev/zero", 3),
        ("mpm-run case.toml --particles /dev/zero -o O", 3),
        ("mpm-run /dev/zero --particles bond.mpts -o O", 2),
        ("bond-figures slice - -o O.svg < /dev/zero", 3),
        ("bond-figures map --map a=- -o O.svg < /dev/zero", 3),
        ("bond-figures map --map a=/dev/zero -o O.svg", 3),
        ("bond-report --table a=/dev/zero -o O.html", 3),
        ("bond-report --state a=/dev/zero -o O.html", 3),
    ] {
        bench.ends(
            code,
            &format!("ulimit -v 4000000 -f 600000; timeout 60 {line}"),
            "",
        );
    }
    assert!(bench.names("").iter().all(|name| !name.starts_with('O')));
}

/// The run mapped its bond file: truncated, SIGBUS killed it, and changed, it spoilt snapshots.
#[test]
fn a_bond_file_that_changes_under_a_run_changes_nothing() {
    let bench = Workbench::with_bond();
    bench.press("whole", &[], "");
    bench.done(&format!(
        "{} & until test -e cut/snapshots/0000.mpts || ! kill -0 $!; do :; done; truncate -s 100 bond.mpts; wait $!",
        press("cut", &[], "")
    ));
    assert_eq!(bench.sum("cut/final.mpts"), bench.sum("whole/final.mpts"));
}

/// It left a folder with some of its parts.
#[test]
fn a_failed_series_leaves_nothing() {
    let bench = Workbench::with_bond();
    bench.damage("bond.mpts", "spoilt.mpts", 3000);
    let before = bench.names("");
    bench.ends(
        3,
        "particles export bond.mpts spoilt.mpts -o s.pvd",
        "damaged",
    );
    assert_eq!(bench.names(""), before);
}

/// A disk that is full, played by a limit on the size of files: SIGXFSZ ended a tool in the middle of its
/// write, and its temporary file stayed.
#[test]
fn a_full_disk_is_a_failed_write_that_leaves_nothing() {
    let bench = Workbench::with_bond();
    let before = bench.names("");
    for line in [
        "xct2particles -q specimen.npy --voxel 1.45um -o new",
        "build-bondline -q specimen.mpts -o new",
        "particles export -f csv bond.mpts -o new",
    ] {
        bench.ends(1, &format!("ulimit -f 1; {line}"), "cannot write 'new'");
        assert_eq!(bench.names(""), before, "{line}");
    }
    // In the middle of a run.
    let run = press("run", &[], "");
    bench.ends(1, &format!("ulimit -f 16; {run}"), "cannot write run/");
    assert!(!bench.path("run/final.mpts").exists());
    let left = fs::read_dir(bench.path("run/snapshots"))
        .into_iter()
        .flatten();
    assert_eq!(left.count(), 0);
}
