//! The Makefile, by what it would run; left out, and said, where there is no `make`.

use std::path::Path;
use std::process::{Command, Output};

use crate::workbench::{TOOLS, said};

/// `make -n` at the top of the repository with the tools taken for built and all else for not; nothing without make.
fn plan(arguments: &[&str]) -> Option<Output> {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut make = Command::new("make");
    // A make that runs the tests would hand its own flags down.
    make.env_remove("MAKEFLAGS").env_remove("MFLAGS");
    let plan = make.args(["-nB", "BUILT=1"]).args(arguments);
    match plan.current_dir(top).output() {
        Ok(output) => Some(output),
        Err(_) => {
            println!("left out: there is no make");
            None
        }
    }
}

fn lines(arguments: &[&str]) -> Option<String> {
    let output = plan(arguments)?;
    assert!(output.status.success(), "{arguments:?}: {}", said(&output));
    Some(String::from_utf8(output.stdout).unwrap())
}

/// `VOXEL=1.45um` once made a cell of "2.9 ", without a unit.
#[test]
fn a_voxel_with_and_without_a_blank_makes_a_cell_of_two() {
    for (voxel, cell, half) in [
        ("1.45um", "2.9 um", "1.45 um"),
        ("1.45 um", "2.9 um", "1.45 um"),
        (".725E3nm", "1450 nm", "725 nm"),
    ] {
        let voxel = format!("VOXEL={voxel}");
        let runs = [
            "out/quick/pf/implicit/final.mpts",
            "out/quick/pf/implicit-finer/final.mpts",
        ];
        for (run, cell) in runs.into_iter().zip([cell, half]) {
            let Some(lines) = lines(&["ERROR=yes", &voxel, run]) else {
                return;
            };
            let wanted = format!("--set grid.cell=\"{cell}\"");
            assert!(lines.contains(&wanted), "{voxel}: {lines}");
        }
    }
}

/// There was no rule for a stack with a blank in its path.
#[test]
fn stacks_may_have_blanks_in_their_path() {
    let folder = tempfile::tempdir().unwrap();
    let stack = folder.path().join("a b  c.tif");
    std::fs::write(&stack, "").unwrap();
    let path = format!("XCT_PF={}", stack.display());
    if let Some(lines) = lines(&[&path, "out/xct/pf/experiment.mpts"]) {
        let named = format!("xct2particles \"{}\"", stack.display());
        assert!(lines.contains(&named), "{lines}");
    }
}

/// The tools were installed with their tables of lines, 215 MB.
#[test]
fn the_tools_are_installed_stripped() {
    let folder = tempfile::tempdir().unwrap();
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut make = Command::new("make");
    make.env_remove("MAKEFLAGS").env_remove("MFLAGS");
    make.args(["-s", "BUILT=1", "install"]);
    make.arg(format!("PREFIX={}", folder.path().display()));
    let Ok(output) = make.current_dir(top).output() else {
        println!("left out: there is no make");
        return;
    };
    assert!(output.status.success(), "{}", said(&output));
    let bin = folder.path().join("bin");
    let mut bytes = 0;
    for name in TOOLS {
        let tool = bin.join(name);
        bytes += tool.metadata().unwrap().len();
        let version = Command::new(tool).arg("--version").output().unwrap();
        assert!(version.status.success(), "{name}");
    }
    println!("installed: {} MB", bytes >> 20);
    assert!(bytes < 60 << 20, "{bytes}");
    assert!(folder.path().join("share/man/man1/bond-sweep.1").is_file());
}

/// The sub-makes set the number of jobs anew, over the one that was asked for.
#[test]
fn jobs_that_were_asked_for_hold_in_sub_makes() {
    for jobs in ["-j3", "-j1", "-j"] {
        let Some(output) = plan(&[jobs, "ERROR=no", "table2"]) else {
            return;
        };
        assert!(output.status.success(), "{jobs}: {}", said(&output));
        let plan = String::from_utf8_lossy(&output.stdout);
        let own = plan
            .lines()
            .filter(|line| line.contains("--no-print-directory"));
        let own: Vec<&str> = own.collect();
        assert!(!own.is_empty(), "{plan}");
        assert!(own.iter().all(|line| !line.contains(" -j")), "{own:?}");
        assert!(!said(&output).contains("forced"), "{}", said(&output));
    }
}

/// Undamaged wood: two stacks or one that is cut, without an experiment, or a sentence.
#[test]
fn undamaged_wood_is_laid_up_and_is_no_experiment() {
    let folder = tempfile::tempdir().unwrap();
    let stack = |name: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, "").unwrap();
        path.display().to_string()
    };
    let (bottom, top) = (stack("a b.tif"), stack("c.tif"));
    let (bottom, top) = (format!("XCT_BOTTOM={bottom}"), format!("XCT_TOP={top}"));
    let (bottom, top) = (bottom.as_str(), top.as_str());
    let goals = [
        "RUNS=implicit",
        "ERROR=no",
        "out/wood/table2.csv",
        "out/wood/figures/pf-map.svg",
    ];
    let two = [&[bottom, top, "SLAB=55.1 um", "TURN=90"][..], &goals].concat();
    let Some(planned) = lines(&two) else {
        return;
    };
    let laid = "--slab \"55.1 um\" --turn-top 90 --normal y -o out/wood/pva-pf/bond.mpts";
    assert!(
        planned.contains("--bottom out/wood/bottom.mpts --top out/wood/top.mpts"),
        "{planned}"
    );
    assert!(
        planned.contains(laid) && !planned.contains("experiment"),
        "{planned}"
    );
    let one = [&[bottom, "PLANE=139.2 um", "SLAB=55.1 um"][..], &goals].concat();
    let Some(planned) = lines(&one) else {
        return;
    };
    assert!(
        planned.contains("out/wood/bottom.mpts --plane \"139.2 um\""),
        "{planned}"
    );
    for (arguments, sentence) in [
        (&[bottom, top][..], "give SLAB="),
        (&[bottom, "SLAB=55.1 um"], "XCT_TOP=, or PLANE="),
        (&[top, "SLAB=55.1 um"], "XCT_TOP needs XCT_BOTTOM"),
        (&[bottom, "XCT_PF=x.tif", "SLAB=55.1 um"], "one kind"),
    ] {
        let refused = plan(arguments).expect("make was there");
        assert!(
            !refused.status.success() && said(&refused).contains(sentence),
            "{arguments:?}: {}",
            said(&refused)
        );
    }
}

/// A variable set twice once took the pictures out of the figures, a comma cut captions in two, and the page had
/// pictures without any.
#[test]
fn figures_and_the_page_name_what_they_draw() {
    let goals = [
        "RUNS=implicit",
        "ERROR=no",
        "out/none/figures/pf-adhesive.svg",
        "out/none/figures/pf-map.svg",
        "out/none/report.html",
    ];
    let Some(planned) = lines(&[&["SCALE=none"][..], &goals].concat()) else {
        return;
    };
    for wanted in [
        "--wood hidden \"PF, synthetic experiment=out/none/pf/experiment.mpts\"",
        "-o out/none/figures/pf-map.svg -o out/none/figures/pf-map.png",
        "--picture \"PF: The adhesive alone, experiment and runs=out/none/figures/pf-adhesive.svg\"",
        "--picture \"Table 2=out/none/figures/table2.svg\"",
    ] {
        assert!(planned.contains(wanted), "{wanted}: {planned}");
    }
}
