//! Harm that the system or somebody else does to the tools: an error stream that fails, names that are
//! no text or steer a terminal, devices without an end, files that change under a run.

use std::ffi::OsStr;
use std::fs;
use std::os::unix::ffi::OsStrExt;

use crate::workbench::{TOOLS, Workbench, press_arguments, said, tool};

/// `eprintln!` panicked: exit 101, and a run was lost without a checkpoint.
#[test]
fn a_failing_standard_error_ends_nothing() {
    let bench = Workbench::with_bond();
    for tool in TOOLS {
        let output = bench.shell(&format!("{tool} --no-such-option 2>/dev/full"));
        assert_eq!(output.status.code(), Some(2), "{tool}");
    }
    let output = bench.shell("mpm-run case.toml --particles bond.mpts -o run -v 2>/dev/full");
    assert_eq!(output.status.code(), Some(0));
    assert!(bench.path("run/final.mpts").exists());
    let output = bench.shell("mpm-run case.toml --particles bond.mpts -o run 2>/dev/full");
    assert_eq!(output.status.code(), Some(2), "a refusal keeps its status");
    let output = bench.shell("particles --help >/dev/full");
    assert_eq!(output.status.code(), Some(1), "help that is not printed");
}

/// All tools panicked.
#[test]
fn an_argument_that_is_no_text_is_refused_or_used() {
    let bench = Workbench::with_bond();
    let odd = OsStr::from_bytes(b"od\xffd");
    for name in TOOLS {
        let output = tool(name)
            .arg(odd)
            .current_dir(bench.folder())
            .output()
            .unwrap();
        let code = output.status.code();
        assert!(
            matches!(code, Some(2 | 3)),
            "{name}: {code:?} {}",
            said(&output)
        );
        assert!(!said(&output).contains("panicked"), "{name}");
    }
    let named = |ending: &str| {
        let mut path = bench.path("").into_os_string();
        path.push(odd);
        path.push(ending);
        path
    };
    let done = |name: &str, words: &[&OsStr]| {
        let output = bench.command(name, &[]).args(words).output().unwrap();
        assert!(output.status.success(), "{name}: {}", said(&output));
    };
    let text = OsStr::new;
    fs::copy(bench.path("specimen.npy"), named(".npy")).unwrap();
    fs::copy(bench.path("case.toml"), named(".toml")).unwrap();
    let at = [text("--voxel"), text("1.45um"), text("-o"), &named(".mpts")];
    done(
        "xct2particles",
        &[&[named(".npy").as_os_str()], at.as_slice()].concat(),
    );
    done(
        "build-bondline",
        &[&named(".mpts"), text("-o"), &named("-bond.mpts")],
    );
    let run = [
        text("--particles"),
        &named("-bond.mpts"),
        text("-o"),
        &named("-run"),
    ];
    done(
        "mpm-run",
        &[&[named(".toml").as_os_str()], run.as_slice()].concat(),
    );
    let last = fs::canonicalize(named("-run")).unwrap().join("final.mpts");
    done(
        "wp-metrics",
        &[last.as_os_str(), text("-o"), &named(".csv")],
    );
    done(
        "shear-stats",
        &[last.as_os_str(), text("-o"), &named("-s.csv")],
    );
    done(
        "particles",
        &[text("export"), last.as_os_str(), text("-o"), &named(".pvd")],
    );
    done(
        "bond-figures",
        &[text("slice"), last.as_os_str(), text("-o"), &named(".svg")],
    );
    assert!(fs::metadata(named(".svg")).is_ok_and(|m| m.len() > 0));
}

/// Names went to tables as formulas and to the terminal as they were.
#[test]
fn names_are_no_formulas_and_do_not_steer_a_terminal() {
    let bench = Workbench::with_bond();
    let names = ["=1+1.mpts", "+a.mpts", "@a.mpts"];
    for name in names {
        fs::copy(bench.path("specimen.mpts"), bench.path(name)).unwrap();
        let table = bench.done("wp-metrics", &["-q", name]);
        let row = table.lines().nth(1).unwrap();
        assert!(row.starts_with(&format!("'{name},")), "{row}");
    }
    let output = bench.run("particles", &["sum", "\u{1b}[2Jabsent"]);
    assert!(
        said(&output).contains("\\u{1b}[2Jabsent"),
        "{}",
        said(&output)
    );
    fs::copy(bench.path("bond.mpts"), bench.path("\u{1b}[2J")).unwrap();
    for command in ["sum", "info", "check"] {
        let told = bench.done("particles", &[command, "\u{1b}[2J"]);
        assert!(
            told.contains("\\u{1b}[2J") && !told.contains('\u{1b}'),
            "{told}"
        );
    }
    let output = bench.run(
        "bond-figures",
        &["table2", "--run", "+a:b=x.csv", "-o", "t.csv"],
    );
    assert!(said(&output).contains("formula"), "{}", said(&output));
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
        let output = bench.shell(&format!("ulimit -v 4000000 -f 600000; timeout 60 {line}"));
        assert_eq!(
            output.status.code(),
            Some(code),
            "{line}: {}",
            said(&output)
        );
    }
    assert!(bench.names("").iter().all(|name| !name.starts_with('O')));
}

/// The run mapped its bond file: truncated, SIGBUS killed it, and changed, it spoilt snapshots.
#[test]
fn a_bond_file_that_changes_under_a_run_changes_nothing() {
    let bench = Workbench::with_bond();
    bench.pressed("whole", &[], &[]);
    let kept = bench.read("bond.mpts");
    let mut run = bench
        .command("mpm-run", &press_arguments("cut", &[], &[]))
        .spawn()
        .unwrap();
    let begun = bench.path("cut/snapshots/0000.mpts");
    let waiting = std::time::Instant::now();
    while !begun.exists() && run.try_wait().unwrap().is_none() {
        assert!(waiting.elapsed().as_secs() < 60, "no snapshot");
    }
    fs::OpenOptions::new()
        .write(true)
        .open(bench.path("bond.mpts"))
        .and_then(|file| file.set_len(100))
        .unwrap();
    let ended = run.wait().unwrap();
    bench.write("bond.mpts", kept);
    assert!(ended.success(), "{ended}");
    assert_eq!(bench.sum("cut/final.mpts"), bench.sum("whole/final.mpts"));
}

/// It left a folder with some of its parts.
#[test]
fn a_failed_series_leaves_nothing() {
    let bench = Workbench::with_bond();
    let mut spoilt = bench.read("bond.mpts");
    let at = spoilt.len() - 3000;
    spoilt[at] ^= 4;
    bench.write("spoilt.mpts", spoilt);
    let before = bench.names("");
    let output = bench.run(
        "particles",
        &["export", "bond.mpts", "spoilt.mpts", "-o", "s.pvd"],
    );
    assert_eq!(output.status.code(), Some(3), "{}", said(&output));
    assert_eq!(bench.names(""), before);
    bench.done(
        "particles",
        &["export", "bond.mpts", "specimen.mpts", "-o", "s.pvd"],
    );
    assert!(bench.path("s.parts/0000-adhesive.vti").exists());
}

/// SIGXFSZ ended a tool in the middle of its write, and its temporary file stayed.
#[test]
fn a_limit_on_the_size_of_files_is_a_failed_write() {
    let bench = Workbench::with_bond();
    let before = bench.names("");
    for line in [
        "xct2particles -q specimen.npy --voxel 1.45um -o new",
        "build-bondline -q specimen.mpts -o new",
        "particles export -f csv bond.mpts -o new",
    ] {
        let output = bench.shell(&format!("ulimit -f 1; {line}"));
        assert_eq!(output.status.code(), Some(1), "{line}: {}", said(&output));
        assert!(
            said(&output).contains("cannot write 'new'"),
            "{}",
            said(&output)
        );
        assert_eq!(bench.names(""), before, "{line}");
    }
}
