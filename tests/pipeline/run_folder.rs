//! What a run folder may replace, and what it may not.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;

use studies::crash::{campaign, chains, faults, full_disk, together};

use crate::workbench::{Workbench, said};

const FAST: [&str; 2] = ["clamp.stop=0.05 us", "output.snapshots=2"];

/// A folder laid out before a run, and how the run into `run` ends with no option, `--resume` and
/// `--overwrite`.
struct Layout {
    name: &'static str,
    lay: fn(&Workbench),
    /// Arguments in place of `case.toml --particles bond.mpts -o run`.
    arguments: &'static str,
    codes: [i32; 3],
}

const PLAIN: &str = "case.toml --particles bond.mpts -o run";

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

fn marked(bench: &Workbench) {
    put(bench, "run/bondline-run.toml");
    bench.write("run/bondline-run.toml", "");
}

/// 314e630 lost a file in those marked "lost".
fn layouts() -> Vec<Layout> {
    let layout = |name, arguments, codes, lay| Layout {
        name,
        lay,
        arguments,
        codes,
    };
    vec![
        // Lost, but for the first: the folder of the snapshots was removed with all in it.
        layout("foreign files beside", PLAIN, [0, 0, 0], |b| {
            put(b, "run/notes.txt");
            put(b, "run/final.tmp.bak");
        }),
        layout("photo among no snapshots, no mark", PLAIN, [2, 2, 2], |b| {
            put(b, "run/snapshots/photo.jpg");
        }),
        layout("photo among no snapshots, marked", PLAIN, [0, 0, 0], |b| {
            marked(b);
            put(b, "run/snapshots/photo.jpg");
        }),
        layout("photo among the snapshots", PLAIN, [2, 0, 0], |b| {
            ended(b);
            put(b, "run/snapshots/photo.jpg");
            put(b, "run/snapshots/12.mpts");
            put(b, "run/snapshots/deep/0001.mpts");
        }),
        layout("a snapshot's name taken", PLAIN, [2, 0, 2], |b| {
            ended(b);
            put(b, "run/snapshots/0007.mpts");
        }),
        layout("a snapshot's name taken before", PLAIN, [2, 2, 2], |b| {
            marked(b);
            put(b, "run/snapshots/0001.mpts");
        }),
        // Lost.
        layout("no mark, text named as ours", PLAIN, [2, 2, 2], |b| {
            put(b, "run/summary.json");
            put(b, "run/resolved.toml");
        }),
        layout("no mark, unfinished file", PLAIN, [2, 2, 2], |b| {
            put(b, "run/.mpm-run.tmp");
        }),
        layout("no mark, history", PLAIN, [2, 2, 2], |b| {
            put(b, "run/history.csv");
        }),
        layout("a stranger's final state", PLAIN, [2, 2, 2], |b| {
            marked(b);
            put(b, "run/final.mpts");
        }),
        layout("a stranger's checkpoint", PLAIN, [2, 3, 2], |b| {
            marked(b);
            put(b, "run/checkpoint.mpts");
        }),
        // Lost: an input that stood at a name of the run's.
        layout(
            "the bond as checkpoint",
            "case.toml --particles run/checkpoint.mpts -o run",
            [2, 2, 2],
            |b| {
                marked(b);
                fs::rename(b.path("bond.mpts"), b.path("run/checkpoint.mpts")).unwrap();
            },
        ),
        layout(
            "the bond as final state through a link, no mark",
            "case.toml --particles bond.mpts -o run",
            [2, 2, 2],
            |b| {
                fs::create_dir(b.path("run")).unwrap();
                fs::rename(b.path("bond.mpts"), b.path("run/final.mpts")).unwrap();
                symlink("run/final.mpts", b.path("bond.mpts")).unwrap();
            },
        ),
        layout(
            "the case as resolved case of an ended run",
            "run/resolved.toml --particles bond.mpts -o ./run/../run",
            [2, 2, 2],
            ended,
        ),
        layout("the case by a hard link", PLAIN, [2, 2, 2], |b| {
            marked(b);
            fs::hard_link(b.path("case.toml"), b.path("run/summary.json")).unwrap();
        }),
        layout("the case as unfinished file", PLAIN, [2, 2, 2], |b| {
            marked(b);
            fs::hard_link(b.path("case.toml"), b.path("run/.mpm-run.tmp")).unwrap();
        }),
        layout(
            "the case as mark",
            "run/bondline-run.toml --particles bond.mpts -o run",
            [2, 2, 2],
            |b| {
                fs::create_dir(b.path("run")).unwrap();
                fs::copy(b.path("case.toml"), b.path("run/bondline-run.toml")).unwrap();
            },
        ),
        layout(
            "the case in the folder",
            "run/case.toml --particles run/bond.mpts -o run",
            [0, 0, 0],
            |b| {
                fs::create_dir(b.path("run")).unwrap();
                fs::copy(b.path("case.toml"), b.path("run/case.toml")).unwrap();
                fs::copy(b.path("bond.mpts"), b.path("run/bond.mpts")).unwrap();
            },
        ),
        // Lost: the target's content, or the target.
        layout("snapshots elsewhere", PLAIN, [2, 2, 2], |b| {
            marked(b);
            put(b, "elsewhere/0000.mpts");
            symlink("../elsewhere", b.path("run/snapshots")).unwrap();
        }),
        layout("snapshots is a file", PLAIN, [2, 2, 2], |b| {
            marked(b);
            put(b, "run/snapshots");
        }),
        layout("history elsewhere", PLAIN, [2, 2, 2], |b| {
            marked(b);
            put(b, "elsewhere.csv");
            symlink("../elsewhere.csv", b.path("run/history.csv")).unwrap();
        }),
        layout("unfinished file elsewhere", PLAIN, [2, 2, 2], |b| {
            marked(b);
            put(b, "elsewhere.csv");
            symlink("../elsewhere.csv", b.path("run/.mpm-run.tmp")).unwrap();
        }),
        layout("mark elsewhere", PLAIN, [2, 2, 2], |b| {
            fs::create_dir(b.path("run")).unwrap();
            b.write("elsewhere.toml", "");
            symlink("../elsewhere.toml", b.path("run/bondline-run.toml")).unwrap();
        }),
        layout("history is a folder", PLAIN, [2, 2, 2], |b| {
            marked(b);
            put(b, "run/history.csv/notes.txt");
        }),
        // Lost: names of the temporary files.
        layout("names of old temporary files", PLAIN, [0, 0, 0], |b| {
            for name in [
                "final.tmp",
                "summary.tmp",
                "resolved.tmp",
                "history.csv.tmp",
            ] {
                put(b, &format!("run/{name}"));
            }
        }),
        layout("a file in place of the folder", PLAIN, [2, 2, 2], |b| {
            put(b, "run");
        }),
        layout(
            "no name",
            "case.toml --particles bond.mpts -o ",
            [2, 2, 2],
            |b| put(b, "history.csv"),
        ),
        layout("an empty folder", PLAIN, [0, 0, 0], |b| {
            fs::create_dir(b.path("run")).unwrap();
        }),
    ]
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
