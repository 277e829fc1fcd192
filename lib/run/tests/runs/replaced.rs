//! Earlier runs in a folder: kept, continued or replaced; files that are not the run's own.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;

use particle_file::{Draft, Header, Kind, Provenance};
use run::{Mode, RunFailure};

use crate::bench::{Bench, END, OVERWRITE, PLAIN, RESUME, everything, has};

/// Names of the files that a run writes.
const NAMES: [&str; 8] = [
    "final.mpts",
    "checkpoint.mpts",
    "summary.json",
    "history.csv",
    "resolved.toml",
    ".mpm-run.tmp",
    "snapshots/0001.mpts",
    "snapshots/.mpm-run.tmp",
];

const MODES: [Mode; 3] = [PLAIN, RESUME, OVERWRITE];

/// A folder with the mark of a run folder but without a run.
fn marked() -> Bench {
    let bench = Bench::explicit();
    fs::create_dir_all(bench.path("run/snapshots")).unwrap();
    bench.write("run/bondline-run.toml", "");
    bench
}

/// Asserts that a run is refused with `sentence` and changes nothing except an empty mark.
fn refused(bench: &Bench, mode: Mode, sentence: &str) {
    let content = || {
        let mut files = bench.everything();
        files.remove("bondline-run.toml");
        files
    };
    let before = content();
    match bench.run("run", mode, END, &[]) {
        Err(RunFailure::Usage(said)) => has(&said, &[sentence]),
        ended => panic!("{sentence}: {ended:?}"),
    }
    assert!(content() == before, "{sentence}: something was touched");
}

fn refused_always(bench: &Bench, sentence: &str) {
    for mode in MODES {
        refused(bench, mode, sentence);
    }
}

/// Inputs, links, folders, and files in an unmarked folder, of which none is known to be a run's.
#[test]
fn what_stands_at_a_name_of_the_runs_and_is_not_its_own_is_refused() {
    type Put = fn(&Bench, &Path);
    let not_its_file = "not a file of the run's own";
    let cases: [(&str, Put); 4] = [
        ("read by this run", |bench, place| {
            fs::hard_link(bench.path("case.toml"), place).unwrap();
        }),
        (not_its_file, |bench, place| {
            bench.write("elsewhere", "theirs");
            symlink(bench.path("elsewhere"), place).unwrap();
        }),
        (not_its_file, |_, place| fs::create_dir(place).unwrap()),
        ("not marked as a run folder", |bench, place| {
            fs::write(place, "theirs").unwrap();
            bench.remove("run/bondline-run.toml");
        }),
    ];
    for (sentence, put) in cases {
        for name in NAMES {
            let bench = marked();
            put(&bench, &bench.path("run").join(name));
            refused_always(&bench, sentence);
        }
    }
    let bench = marked();
    bench.remove("run/bondline-run.toml");
    bench.write("run/snapshots/photo.jpg", "theirs");
    refused_always(&bench, "not marked as a run folder");
    let bench = marked();
    fs::remove_dir(bench.path("run/snapshots")).unwrap();
    fs::create_dir(bench.path("elsewhere")).unwrap();
    symlink("../elsewhere", bench.path("run/snapshots")).unwrap();
    refused_always(&bench, "not a folder of the run's own");
}

#[test]
fn a_folder_with_other_names_becomes_a_run_folder() {
    let bench = Bench::explicit();
    fs::create_dir(bench.path("run")).unwrap();
    for name in ["notes.txt", "final.tmp", "history.csv.tmp"] {
        bench.write(&format!("run/{name}"), name);
    }
    bench.ran("run", PLAIN, END);
    assert_eq!(bench.bytes("run/notes.txt"), b"notes.txt");
}

#[test]
fn what_cannot_be_a_run_folder_or_its_mark_is_refused() {
    let bench = Bench::explicit();
    bench.write("file", "theirs");
    bench.write("elsewhere", "");
    for folder in ["linked", "case"] {
        fs::create_dir(bench.path(folder)).unwrap();
    }
    symlink("../elsewhere", bench.path("linked/bondline-run.toml")).unwrap();
    bench.write("case/bondline-run.toml", bench.bytes("case.toml"));
    for (folder, sentence) in [
        ("file", "is a file"),
        ("linked", "not the mark"),
        ("case", "not the mark"),
    ] {
        for mode in MODES {
            let said = bench.run(folder, mode, END, &[]).unwrap_err();
            has(&said.to_string(), &[sentence]);
        }
    }
    assert_eq!(bench.bytes("file"), b"theirs");
    assert_eq!(bench.bytes("elsewhere"), b"");
}

#[test]
fn only_states_and_checkpoints_of_a_run_are_replaced() {
    let file = |kind, tool: &str| {
        let mut header = Header::new(kind, 1.0, 1, [0.0; 3], [1.0; 3]);
        header.provenance.push(Provenance {
            tool: tool.into(),
            ..Provenance::default()
        });
        let mut bytes = Vec::new();
        Draft::new(header).write_to(&mut bytes).unwrap();
        bytes
    };
    let foreign = [
        ("final.mpts", file(Kind::State, "another")),
        ("final.mpts", file(Kind::Specimen, "mpm-run")),
        ("final.mpts", b"theirs".into()),
        ("snapshots/0001.mpts", file(Kind::State, "another")),
        ("snapshots/12345.mpts", b"theirs".into()),
        ("checkpoint.mpts", file(Kind::State, "mpm-run")),
        ("checkpoint.mpts", b"theirs".into()),
    ];
    for (name, bytes) in foreign {
        let bench = marked();
        bench.write(&format!("run/{name}"), bytes);
        refused(&bench, OVERWRITE, "not a file that a run wrote");
    }
    let bench = marked();
    bench.write("run/final.mpts", file(Kind::State, "mpm-run"));
    bench.write("run/checkpoint.mpts", file(Kind::Checkpoint, "mpm-run"));
    bench.ran("run", OVERWRITE, END);
}

/// A new run removes the files of the earlier one only.
#[test]
fn another_run_goes_with_its_files_and_foreign_ones_stay() {
    let bench = Bench::explicit();
    bench.ran("run", PLAIN, END);
    let theirs = [
        "snapshots/photo.jpg",
        "snapshots/12.mpts",
        "snapshots/00001.mpts",
        "wp.csv",
        "final.tmp",
    ];
    // Leftovers of a killed run are removed too.
    for name in (theirs.iter()).chain(&[".mpm-run.tmp", "snapshots/.mpm-run.tmp"]) {
        bench.write(&format!("run/{name}"), name);
    }
    assert!(bench.path("run/snapshots/0002.mpts").exists());
    let fewer = ["output.snapshots=0"];
    bench.run("run", OVERWRITE, END, &fewer).unwrap();
    let mut files = bench.everything();
    for name in theirs {
        assert_eq!(files.remove(name).as_deref(), Some(name.as_bytes()));
    }
    bench.run("alone", OVERWRITE, END, &fewer).unwrap();
    assert!(files.keys().eq(everything(&bench.path("alone")).keys()));
}

#[test]
fn a_run_is_not_replaced_unasked() {
    let names = ["history.csv", "final.mpts", "checkpoint.mpts"];
    for kept in names {
        let bench = Bench::explicit();
        let steps = if kept == "checkpoint.mpts" { 9 } else { END };
        bench.ran("run", PLAIN, steps);
        for name in names.into_iter().filter(|name| *name != kept) {
            let _ = fs::remove_file(bench.path("run").join(name));
        }
        refused(&bench, PLAIN, "already holds a run");
    }
    // A started run without a checkpoint: the same case starts again, another one does not.
    let bench = Bench::explicit();
    bench.ran("run", PLAIN, END);
    bench.remove("run/final.mpts");
    let other = ["adhesive.viscosity=2 Pa s"];
    let said = "holds another run (adhesive.viscosity is \"2 Pa s\", was ";
    bench.refuses(RESUME, &other, &[said]);
    bench.ran("run", RESUME, END);
}

#[test]
fn a_run_that_has_ended_is_left_but_for_what_a_kill_left() {
    let bench = Bench::explicit();
    bench.ran("run", RESUME, 9);
    let checkpoint = bench.bytes("run/checkpoint.mpts");
    bench.ran("run", RESUME, END);
    let ended = bench.everything();
    // Killed before the checkpoint was removed.
    bench.write("run/checkpoint.mpts", &checkpoint);
    bench.write("run/.mpm-run.tmp", "half");
    assert!(bench.run("run", RESUME, END, &[]).unwrap().is_none());
    assert!(bench.everything() == ended);
    // Nor is that checkpoint continued at another Courant number.
    bench.write("run/checkpoint.mpts", &checkpoint);
    let changed = ["integrator.cfl=0.3", "clamp.stop=5 us"];
    let said = [
        "another run (clamp.stop is \"5 us\", was ",
        "integrator.cfl is 0.3, was ",
    ];
    bench.refuses(RESUME, &changed, &said);
    bench.write("run/checkpoint.mpts", "theirs");
    assert!(bench.run("run", RESUME, END, &[]).unwrap().is_none());
    assert_eq!(bench.bytes("run/checkpoint.mpts"), b"theirs");
}

/// Later snapshots are removed: a run at another Courant number may never take their steps.
#[test]
fn what_came_after_the_checkpoint_goes() {
    let bench = Bench::explicit();
    bench.ran("run", RESUME, 9);
    bench.write("run/snapshots/0009.mpts", "theirs");
    refused(&bench, RESUME, "not a file that a run wrote");
    let first = bench.bytes("run/snapshots/0000.mpts");
    for name in ["0009.mpts", "12345.mpts", "77.mpts"] {
        bench.write(&format!("run/snapshots/{name}"), &first);
    }
    let seen = || {
        // At the first step of the continued run.
        assert!(!bench.path("run/summary.json").exists());
        let kept = ["0009.mpts", "12345.mpts", "77.mpts", "0000.mpts"]
            .map(|name| bench.path("run/snapshots").join(name).exists());
        assert_eq!(kept, [false, false, true, true]);
        assert!(bench.bytes("run/snapshots/0000.mpts") == first);
        false
    };
    let ended = bench.run_told("run", RESUME, &seen, &mut |_, _| {}, &[]);
    assert!(ended.unwrap().is_some());
}

#[test]
fn a_checkpoint_of_another_case_or_damaged_is_refused_or_replaced() {
    let bench = Bench::explicit();
    bench.ran("run", RESUME, 9);
    let before = bench.everything();
    let other = ["adhesive.viscosity=2 Pa s"];
    let why = "(adhesive.viscosity is \"2 Pa s\", was ";
    match bench.run("run", RESUME, END, &other) {
        Err(RunFailure::Usage(said)) => has(&said, &["another case", why]),
        ended => panic!("{ended:?}"),
    }
    assert!(bench.everything() == before);
    let whole = bench.bytes("run/checkpoint.mpts");
    bench.write("run/checkpoint.mpts", &whole[..whole.len() / 2]);
    let damaged = bench.run("run", RESUME, END, &[]);
    assert!(matches!(damaged, Err(RunFailure::Data(_))), "{damaged:?}");
    bench.write("run/checkpoint.mpts", whole);
    let both = Mode {
        resume: true,
        ..OVERWRITE
    };
    let ended = bench.run("run", both, END, &other).unwrap();
    assert!(ended.is_some_and(|summary| summary.end == run::End::Time));
}
