//! Run folders: what one may replace, and what it may not.

mod layouts;

use std::fs;
use std::path::Path;

use studies::crash::{campaign, chains, faults, full_disk, together};

use crate::workbench::{Workbench, said};
use layouts::layouts;

const FAST: [&str; 2] = ["clamp.stop=0.05 us", "output.snapshots=2"];

/// `run` as the run of this case left it.
fn ended(bench: &Workbench) {
    bench.pressed("run", &FAST, &[]);
}

fn put(bench: &Workbench, name: &str) {
    let path = bench.path(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, format!("the user's own {name}")).unwrap();
}

/// Runs side by side ended in lines of which none said whose it was.
#[test]
fn the_closing_line_names_the_run() {
    let bench = Workbench::with_bond();
    let arguments = [
        "case.toml",
        "--particles",
        "bond.mpts",
        "-o",
        "third",
        "--set",
    ];
    let output = bench.run(
        "mpm-run",
        &[&arguments[..], &["clamp.stop=0.05 us"]].concat(),
    );
    let said = said(&output);
    assert!(said.contains("third: The run reached its time"), "{said}");
}

/// Every file below `folder`, links as where they point, folders as such.
fn everything(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let kind = fs::symlink_metadata(&path).unwrap().file_type();
        let name = path.display().to_string();
        if kind.is_symlink() {
            let target = fs::read_link(&path).unwrap();
            found.push((name, target.to_str().unwrap().into()));
        } else if kind.is_dir() {
            found.extend(everything(&path));
        } else {
            found.push((name, fs::read(&path).unwrap()));
        }
    }
    found
}

/// Whether a run wrote this file: what is replaced may change, all else may not.
fn is_ours(bytes: &[u8], name: &str) -> bool {
    let text = String::from_utf8_lossy(bytes);
    let ours = ["MPTS", "step,time_s", "\"end\"", "[grid]", "# A run folder"];
    let in_run =
        name.contains("/run/") && !name.ends_with("/case.toml") && !name.ends_with("bond.mpts");
    in_run && ours.iter().any(|mark| text.contains(mark))
}

#[test]
fn nothing_foreign_is_lost_in_any_layout() {
    let made = Workbench::with_bond();
    let mut wrong = Vec::new();
    for layout in layouts() {
        for (more, code) in ["", "--resume", "--overwrite"]
            .into_iter()
            .zip(layout.codes)
        {
            let bench = Workbench::new();
            for file in ["case.toml", "bond.mpts"] {
                fs::copy(made.path(file), bench.path(file)).unwrap();
            }
            (layout.lay)(&bench);
            let before = everything(bench.folder());
            let mut arguments = vec!["-q"];
            arguments.extend(layout.arguments.split(' '));
            for change in FAST {
                arguments.extend(["--set", change]);
            }
            arguments.extend(Some(more).filter(|more| !more.is_empty()));
            let output = bench.run("mpm-run", &arguments);
            let case = format!("{} {more}", layout.name);
            let told = said(&output);
            if output.status.code() != Some(code) || told.contains("panicked") {
                wrong.push(format!("{case}: {:?}: {told}", output.status.code()));
            }
            // What the argument parser refuses it says in lines of its own.
            let sentences = if told.starts_with("error:") {
                1
            } else {
                told.lines().filter(|l| !l.starts_with("warning")).count()
            };
            if code != 0 && sentences != 1 {
                wrong.push(format!("{case}: not one sentence: {told}"));
            }
            for (name, bytes) in &before {
                // A refusal touches nothing at all, a run nothing foreign; an empty mark is filled in.
                let kept = fs::read_link(name).map_or_else(
                    |_| fs::read(name).ok(),
                    |target| Some(target.to_str().unwrap().into()),
                );
                let may_change = (code == 0 && is_ours(bytes, name)) || bytes.is_empty();
                if kept.as_ref() != Some(bytes) && !may_change {
                    wrong.push(format!("{case}: {name} was lost or changed"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A folder of a version without marks is refused, and replaced where its owner says so.
#[test]
fn a_run_folder_without_a_mark_is_replaced_only_when_vouched_for() {
    let bench = Workbench::with_bond();
    bench.pressed("run", &FAST, &[]);
    fs::remove_file(bench.path("run/bondline-run.toml")).unwrap();
    let other = ["clamp.stop=0.04 us"];
    for more in [&["--overwrite"][..], &["--resume"], &[]] {
        let refused = bench.press("run", &other, more);
        assert_eq!(refused.status.code(), Some(2));
        assert!(
            said(&refused).contains("not marked as a run folder"),
            "{}",
            said(&refused)
        );
    }
    // Nor is it vouched for that it ended well.
    let refused = bench.press("run", &FAST, &["--resume"]);
    assert_eq!(refused.status.code(), Some(2), "{}", said(&refused));
    assert!(!bench.path("run/bondline-run.toml").exists());
    bench.write("run/bondline-run.toml", "");
    bench.pressed("run", &other, &["--overwrite"]);
}

/// 314e630 made the folder anew and ended well, without a history.
#[test]
fn a_run_whose_folder_is_moved_away_fails() {
    let bench = Workbench::with_bond();
    let removed = bench.shell(
        "mpm-run -q case.toml --particles bond.mpts -o run --set output.history_every=1ns \
         --set integrator.cfl=0.05 & until test -s run/history.csv; do sleep 0.01; done; \
         mv run gone; wait $! && exit 9 || exit $?",
    );
    assert_eq!(removed.status.code(), Some(1), "{}", said(&removed));
    assert!(
        said(&removed).contains("cannot write run"),
        "{}",
        said(&removed)
    );
    assert!(!bench.path("run").exists());
}

/// 314e630 let both end well, with the files of either.
#[test]
fn the_second_of_two_runs_into_a_folder_is_refused() {
    for row in [
        together::at_once(10).unwrap(),
        together::meanwhile(10).unwrap(),
    ] {
        println!("{}", row.line());
        assert!(row.wrong.is_empty(), "{:?}", row.wrong);
    }
}

/// `make crash` in short: every 19th kill and failing call, every 29th byte.
#[test]
fn a_run_killed_anywhere_goes_on_to_the_same_end() {
    let mut rows = Vec::new();
    if faults::available() {
        rows.extend(campaign::rows(19, |_| {}).unwrap());
        rows.extend(chains::rows(4, |_| {}).unwrap());
    } else {
        println!("skipped: strace is not installed or may not trace");
    }
    if full_disk::available() {
        rows.extend(full_disk::rows(29, |_| {}).unwrap());
    } else {
        println!("skipped: prlimit is not installed");
    }
    for row in rows {
        println!("{}", row.line());
        assert!(row.wrong.is_empty(), "{}: {:?}", row.series, row.wrong);
    }
}
