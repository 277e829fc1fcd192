//! The Makefile, by what it would run.

use std::process::Output;

use crate::clone::{clone, gnu_make};
use crate::workbench::{TOOLS, root, said};

/// `make` at the top of the repository with the tools taken for built.
fn make(arguments: &[&str]) -> Output {
    let mut make = gnu_make();
    make.arg("BUILT=1").args(arguments).current_dir(root());
    make.output().unwrap()
}

/// The lines that `make` would run, all but the tools taken for not made; all of `wanted` are in them.
fn plan(arguments: &[&str], wanted: &[&str]) -> String {
    let output = make(&[&["-nB"], arguments].concat());
    assert!(output.status.success(), "{arguments:?}: {}", said(&output));
    let planned = String::from_utf8(output.stdout).unwrap();
    for wanted in wanted {
        assert!(planned.contains(wanted), "{wanted}: {planned}");
    }
    planned
}

fn refuse(arguments: &[&str], sentence: &str) {
    let output = make(&[&["-nB"], arguments].concat());
    let told = said(&output);
    assert!(!output.status.success(), "{arguments:?}");
    assert!(told.contains(sentence), "{arguments:?}: {told}");
}

/// A VOXEL that was not given once was 1.45 um, and runs of days were started of one's own stacks.
#[test]
fn own_stacks_have_their_own_voxel_and_runs_that_end_soon() {
    let planned = plan(&["XCT_PF=a.tif", "runs"], &[]);
    assert!(!planned.contains("--voxel"), "{planned}");
    let runs = planned.lines().filter(|line| line.contains("mpm-run "));
    let runs: Vec<&str> = runs.collect();
    assert_eq!(runs.len(), 4, "{planned}");
    let finer = "--set grid.cell=\"1 voxel\" --set contact.influence_length=\"0.02 cell\"";
    for (run, cells) in [("implicit", ""), ("implicit-finer", finer)] {
        let run = format!("-o out/xct/pf/{run}");
        let line = runs.iter().find(|line| line.ends_with(&run)).expect(&run);
        assert!(line.contains(cells), "{line}");
        assert_eq!(line.contains("grid.cell"), !cells.is_empty(), "{line}");
    }
    let set = "SET=adhesive.viscosity=500 cP clamp.max_pressure=\"1 MPa\"";
    plan(
        &["XCT_PF=a.tif", "VOXEL=.725E3nm", "CELL=1.5 um", set, "runs"],
        &[
            "--voxel '.725E3nm'",
            "--set grid.cell='1.5 um'",
            "--set 'adhesive.viscosity=500 cP' --set 'clamp.max_pressure=\"1 MPa\"' ",
        ],
    );
    refuse(&["SET=grid.cell=1 um", "runs"], "give CELL=");
    for set in ["SET=clamp.x", "SET=a = 1", "SET=a=1 b =2"] {
        refuse(&[set, "runs"], "KEY=VALUE is needed");
    }
    let slip =
        "no variable XCT_PFF=, but XCT_BOTTOM= XCT_PF= XCT_PVA_PF= XCT_TOP=: make help lists all.";
    refuse(&["XCT_PFF=a.tif", "runs"], slip);
    refuse(&["THREADS=2", "runs"], "no variable THREADS=: make help");
    refuse(&["SETS=a=1", "runs"], "no variable SETS=, but SET=: make");
    plan(
        &["XCT_PF=a.tif", "BOND=--crop-to-fit --drop-islands", "runs"],
        &["--normal 'y' -o out/xct/pf/bond.mpts '--crop-to-fit' '--drop-islands'"],
    );
}

/// Variables of another kind of specimen, and values that are none, were passed over.
#[test]
fn what_a_variable_cannot_be_is_refused() {
    let scales = "SCALE=tiny: quick, small, medium and full are there.";
    for (given, sentence) in [
        ("SLAB=1 um", "SLAB= is for undamaged wood"),
        ("PLANE=1 um", "PLANE= is for undamaged wood"),
        ("TURN=90", "TURN= is for undamaged wood"),
        ("SCALE=small", "SCALE= is for synthetic specimens alone"),
        ("SCALE=tiny", scales),
        ("ERROR=nein", "ERROR=nein: yes and no are accepted."),
        ("JOBS=0", "JOBS=0: a whole number from 1 to 9999"),
        ("RUNS=implict", "no run 'implict' but flip frictionless"),
        ("RUNS=", "RUNS= names no run: there are flip"),
    ] {
        refuse(&["XCT_PF=a.tif", given, "runs"], sentence);
    }
    refuse(
        &["LABELS=wood=1", "runs"],
        "LABELS= is for your own stacks alone",
    );
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
        let named = format!("xct2particles '{}' ", name.replace('\'', "'\\''"));
        plan(
            &[&format!("XCT_PF={name}"), "out/xct/pf/experiment.mpts"],
            &[&named],
        );
        let folder = [&format!("OUT=out/{name}"), "table2"];
        refuse(&folder, "the name of the folder of results is made of");
    }
}

/// Finer runs, for errors, were made of presses that can never close.
#[test]
fn a_press_that_never_closes_gets_no_error() {
    let folder = tempfile::tempdir_in(root().join("target")).unwrap();
    let out = folder
        .path()
        .strip_prefix(root())
        .unwrap()
        .to_str()
        .unwrap();
    for adhesive in ["pf", "pva-pf"] {
        std::fs::create_dir_all(folder.path().join(adhesive)).unwrap();
    }
    let told = |said: &str| std::fs::write(folder.path().join("pf/voids.txt"), said).unwrap();
    let planned = || plan(&[&format!("OUT={out}"), "RUNS=implicit", "table2"], &[]);
    told("room for 230 % of the adhesive");
    let finer = |adhesive: &str| format!("--finer {out}/{adhesive}/implicit-finer/final.mpts");
    let all = planned();
    assert!(
        all.contains(&finer("pf")) && all.contains(&finer("pva-pf")),
        "{all}"
    );
    told("room for 62 % of the adhesive: at least 24.5 um of the gap will remain");
    let some = planned();
    assert!(
        !some.contains("/pf/implicit-finer") && some.contains(&finer("pva-pf")),
        "{some}"
    );
}

/// The tools were installed with their tables of lines, 215 MB.
#[test]
fn the_tools_are_installed_stripped() {
    let folder = tempfile::tempdir().unwrap();
    let prefix = format!("PREFIX={}", folder.path().display());
    let output = make(&["-s", &prefix, "install"]);
    assert!(output.status.success(), "{}", said(&output));
    let tools = TOOLS.map(|name| folder.path().join("bin").join(name));
    let bytes: u64 = tools
        .iter()
        .map(|tool| tool.metadata().unwrap().len())
        .sum();
    println!("installed: {} MB", bytes >> 20);
    assert!(bytes < 60 << 20, "{bytes}");
    for tool in tools {
        let version = std::process::Command::new(tool).arg("--version").output();
        assert!(version.unwrap().status.success());
    }
    assert!(folder.path().join("share/man/man1/bond-sweep.1").is_file());
}

/// A blank in PREFIX installed into the repository, and DESTDIR was refused.
#[test]
fn the_tools_are_installed_where_prefix_and_destdir_say() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("it's $a #b");
    let prefix = format!("PREFIX={}", place.display());
    let staged = format!("DESTDIR={}/stage d", folder.path().display());
    for (given, below) in [
        (&[prefix.as_str()][..], place.clone()),
        (
            &[&staged, "PREFIX=/opt/bond line"],
            folder.path().join("stage d/opt/bond line"),
        ),
    ] {
        let output = make(&[&["-s", "install"], given].concat());
        assert!(output.status.success(), "{}", said(&output));
        for name in [
            "bin/mpm-run",
            "share/man/man1/mpm-run.1",
            "share/bash-completion/completions/mpm-run",
        ] {
            assert!(below.join(name).is_file(), "{name}");
        }
    }
    let top = std::fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(top, 2, "nothing elsewhere");
}

/// The sub-makes set the number of jobs anew, over the one that was asked for.
#[test]
fn jobs_that_were_asked_for_hold_in_sub_makes() {
    for jobs in ["-j3", "-j1", "-j"] {
        let output = make(&["-nB", jobs, "BUILT=", "CARGO=true", "ERROR=no", "table2"]);
        assert!(output.status.success(), "{jobs}: {}", said(&output));
        let plan = String::from_utf8_lossy(&output.stdout);
        let is_own = |line: &&str| line.contains("--no-print-directory");
        let own: Vec<&str> = plan.lines().filter(is_own).collect();
        assert!(!own.is_empty(), "{plan}");
        assert!(own.iter().all(|line| !line.contains(" -j")), "{own:?}");
        assert!(!said(&output).contains("forced"), "{}", said(&output));
    }
}

/// Tools and studies were all built before the first run. A clone without tools says what it would do.
#[test]
fn the_first_table_comes_before_the_tools_that_it_is_not_made_by() {
    let bench = clone();
    std::fs::remove_dir_all(bench.path("target")).unwrap();
    let planned = bench.done("env -u MAKEFLAGS make -n CARGO=cargo ERROR=no all");
    let order = ["-p mpm-run", "-o - >/dev/null", "--workspace", "--state"];
    let places = order.map(|what| planned.find(what).expect(what));
    assert!(places.is_sorted(), "{places:?}: {planned}");
}

/// Undamaged wood is no experiment: two stacks or one that is cut, or a sentence.
#[test]
fn undamaged_wood_is_laid_up_and_is_no_experiment() {
    let folder = tempfile::tempdir().unwrap();
    let [bottom, top] =
        [("XCT_BOTTOM", "a b.tif"), ("XCT_TOP", "c.tif")].map(|(variable, name)| {
            let path = folder.path().join(name);
            std::fs::write(&path, "").unwrap();
            format!("{variable}={}", path.display())
        });
    let (bottom, top, slab) = (bottom.as_str(), top.as_str(), "SLAB=55.1 um");
    let goals = ["RUNS=implicit", "ERROR=no", "out/wood/table2.csv"];
    let planned = plan(
        &[&[bottom, top, slab, "TURN=90"][..], &goals].concat(),
        &[
            "--bottom out/wood/bottom.mpts --top out/wood/top.mpts",
            "--slab '55.1 um' --turn-top '90' --normal 'y' -o out/wood/pva-pf/bond.mpts",
        ],
    );
    assert!(!planned.contains("experiment"), "{planned}");
    for (arguments, sentence) in [
        (&[bottom, top][..], "give SLAB="),
        (&[bottom, slab], "XCT_TOP=, or PLANE="),
        (&[top, slab], "XCT_TOP needs XCT_BOTTOM"),
        (&[bottom, "XCT_PF=x.tif", slab], "one kind"),
    ] {
        refuse(arguments, sentence);
    }
}

/// A variable set twice once took the pictures out of the figures, a comma cut captions in two, and the page had
/// pictures without any.
#[test]
fn figures_and_the_page_name_what_they_draw() {
    plan(
        &[
            "OUT=out/none",
            "RUNS=flip implicit",
            "ERROR=no",
            "out/none/figures/pf-adhesive.svg",
            "out/none/figures/pf-map.svg",
            "out/none/report.html",
        ],
        &[
            "--wood hidden \"PF, synthetic experiment=out/none/pf/experiment.mpts\"",
            "-o out/none/figures/pf-map.svg -o out/none/figures/pf-map.png",
            "--picture \"PF: The adhesive alone, experiment and runs=out/none/figures/pf-adhesive.svg\"",
            "--experiment \"PF, synthetic experiment=out/none/pf/experiment.csv\"",
            "--picture \"PF: Slice through the end, implicit=",
        ],
    );
}
