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

/// A VOXEL that was not given once was 1.45 um, and runs of days were started of one's own stacks.
#[test]
fn own_stacks_have_their_own_voxel_and_runs_that_end_soon() {
    let Some(planned) = lines(&["XCT_PF=a.tif", "runs"]) else {
        return;
    };
    assert!(!planned.contains("--voxel"), "{planned}");
    let runs: Vec<&str> = planned
        .lines()
        .filter(|line| line.contains("mpm-run "))
        .collect();
    assert_eq!(runs.len(), 4, "{planned}");
    let finer = "--set grid.cell=\"1 voxel\" --set contact.influence_length=\"0.02 cell\"";
    for (run, cells) in [("implicit", ""), ("implicit-finer", finer)] {
        let run = format!("-o out/xct/pf/{run}");
        let line = runs.iter().find(|line| line.ends_with(&run)).expect(&run);
        assert!(
            line.contains(cells) && line.contains("grid.cell") != cells.is_empty(),
            "{line}"
        );
    }
    let set = "SET=adhesive.viscosity=500 cP clamp.max_pressure=\"1 MPa\"";
    let planned = lines(&["XCT_PF=a.tif", "VOXEL=.725E3nm", "CELL=1.5 um", set, "runs"]).unwrap();
    for wanted in [
        "--voxel '.725E3nm'",
        "--set grid.cell='1.5 um'",
        "--set 'adhesive.viscosity=500 cP' --set 'clamp.max_pressure=\"1 MPa\"' ",
    ] {
        assert!(planned.contains(wanted), "{wanted}: {planned}");
    }
    let refused = plan(&["SET=grid.cell=1 um", "runs"]).unwrap();
    assert!(said(&refused).contains("give CELL="), "{}", said(&refused));
}

/// Names that make reads as its own once gave make's own messages, or another file.
#[test]
fn stacks_may_be_called_anything_and_folders_of_results_are_refused_in_a_sentence() {
    for name in [
        "a b  c.tif",
        "a:b=c.tif",
        "a#b.tif",
        "a;b.tif",
        "a$b$(c).tif",
        "s[1].tif",
        "*?.tif",
        "it's.tif",
        "a\"b\\c.tif",
        "%,(.tif",
    ] {
        let Some(lines) = lines(&[&format!("XCT_PF={name}"), "out/xct/pf/experiment.mpts"]) else {
            return;
        };
        let named = format!("xct2particles '{}' ", name.replace('\'', "'\\''"));
        assert!(lines.contains(&named), "{lines}");
        let refused = plan(&[&format!("OUT=out/{name}"), "table2"]).unwrap();
        let told = said(&refused);
        assert!(
            !refused.status.success()
                && told.contains("the name of the folder of results is made of"),
            "{told}"
        );
        assert_eq!(told.trim().lines().count(), 1, "{told}");
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
        let Some(output) = plan(&[jobs, "BUILT=", "CARGO=true", "ERROR=no", "table2"]) else {
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
    let laid = "--slab '55.1 um' --turn-top '90' --normal 'y' -o out/wood/pva-pf/bond.mpts";
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
        planned.contains("out/wood/bottom.mpts --plane '139.2 um'"),
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
