//! Earlier runs in a folder: kept, continued or replaced, and what is not the run's own.

use std::fs;
use std::os::unix::fs::symlink;

use particle_file::{Draft, Header, Kind, Provenance};
use run::{Mode, RunFailure};

use crate::bench::{Bench, END, OVERWRITE, PLAIN, RESUME, everything};

/// Names at which a run writes.
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

/// A folder marked as a run folder, with no run in it.
fn marked() -> Bench {
    let bench = Bench::explicit();
    fs::create_dir_all(bench.path("run/snapshots")).unwrap();
    fs::write(bench.path("run/bondline-run.toml"), "").unwrap();
    bench
}

/// Asserts that a run is refused with `sentence` and touches nothing but an empty mark.
fn refused(bench: &Bench, mode: Mode, sentence: &str) {
    let content = || {
        let mut files = bench.everything();
        files.remove("bondline-run.toml");
        files
    };
    let before = content();
    match bench.run("run", mode, END, &[]) {
        Err(RunFailure::Usage(said)) => assert!(said.contains(sentence), "{said}"),
        ended => panic!("{sentence}: {ended:?}"),
    }
    assert!(content() == before, "{sentence}: something was touched");
}

/// The case read would have been replaced by 314e630 at five of these names.
#[test]
fn an_input_at_a_name_of_the_runs_is_refused() {
    for name in NAMES {
        let bench = marked();
        fs::hard_link(bench.path("case.toml"), bench.path("run").join(name)).unwrap();
        for mode in [PLAIN, RESUME, OVERWRITE] {
            refused(&bench, mode, "read by this run");
        }
    }
}

#[test]
fn links_and_folders_at_names_of_the_runs_are_refused() {
    for name in NAMES {
        let [linked, taken] = [marked(), marked()];
        fs::write(linked.path("elsewhere"), "theirs").unwrap();
        symlink(linked.path("elsewhere"), linked.path("run").join(name)).unwrap();
        fs::create_dir(taken.path("run").join(name)).unwrap();
        for bench in [linked, taken] {
            refused(&bench, OVERWRITE, "not a file of the run's own");
        }
    }
    let bench = marked();
    fs::remove_dir(bench.path("run/snapshots")).unwrap();
    fs::create_dir(bench.path("elsewhere")).unwrap();
    symlink("../elsewhere", bench.path("run/snapshots")).unwrap();
    refused(&bench, OVERWRITE, "not a folder of the run's own");
}

/// Nothing in a folder that is not marked is known to be a run's.
#[test]
fn names_of_the_runs_in_a_folder_without_a_mark_are_refused() {
    for name in NAMES.into_iter().chain(["snapshots/photo.jpg"]) {
        let bench = Bench::explicit();
        fs::create_dir_all(bench.path("run/snapshots")).unwrap();
        fs::write(bench.path("run").join(name), "theirs").unwrap();
        for mode in [PLAIN, RESUME, OVERWRITE] {
            refused(&bench, mode, "not marked as a run folder");
        }
    }
    let bench = Bench::explicit();
    fs::create_dir(bench.path("run")).unwrap();
    for name in ["notes.txt", "final.tmp", "history.csv.tmp"] {
        fs::write(bench.path("run").join(name), name).unwrap();
    }
    bench.ran("run", PLAIN, END);
    assert_eq!(fs::read(bench.path("run/notes.txt")).unwrap(), b"notes.txt");
}

#[test]
fn what_cannot_be_a_run_folder_or_its_mark_is_refused() {
    let bench = Bench::explicit();
    fs::write(bench.path("file"), "theirs").unwrap();
    fs::create_dir(bench.path("linked")).unwrap();
    fs::write(bench.path("elsewhere"), "").unwrap();
    symlink("../elsewhere", bench.path("linked/bondline-run.toml")).unwrap();
    fs::create_dir(bench.path("case")).unwrap();
    fs::copy(
        bench.path("case.toml"),
        bench.path("case/bondline-run.toml"),
    )
    .unwrap();
    for (folder, sentence) in [
        ("file", "is a file"),
        ("linked", "not the mark"),
        ("case", "not the mark"),
    ] {
        for mode in [PLAIN, RESUME, OVERWRITE] {
            let said = bench.run(folder, mode, END, &[]).unwrap_err().to_string();
            assert!(said.contains(sentence), "{folder}: {said}");
        }
    }
    assert_eq!(fs::read(bench.path("file")).unwrap(), b"theirs");
    assert_eq!(fs::read(bench.path("elsewhere")).unwrap(), b"");
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
        fs::write(bench.path("run").join(name), bytes).unwrap();
        refused(&bench, OVERWRITE, "not a file that a run wrote");
    }
    let bench = marked();
    fs::write(bench.path("run/final.mpts"), file(Kind::State, "mpm-run")).unwrap();
    fs::write(
        bench.path("run/checkpoint.mpts"),
        file(Kind::Checkpoint, "mpm-run"),
    )
    .unwrap();
    bench.ran("run", OVERWRITE, END);
}

/// 314e630 removed the snapshots' folder with all in it.
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
    for name in theirs {
        fs::write(bench.path("run").join(name), name).unwrap();
    }
    assert!(bench.path("run/snapshots/0002.mpts").exists());
    // What a killed run leaves goes too.
    for name in [".mpm-run.tmp", "snapshots/.mpm-run.tmp"] {
        fs::write(bench.path("run").join(name), "half").unwrap();
    }
    let fewer = ["output.snapshots=0"];
    bench.run("run", OVERWRITE, END, &fewer).unwrap();
    let mut files = bench.everything();
    for name in theirs {
        assert_eq!(files.remove(name).as_deref(), Some(name.as_bytes()));
    }
    bench.run("alone", OVERWRITE, END, &fewer).unwrap();
    let names: Vec<_> = everything(&bench.path("alone")).into_keys().collect();
    assert_eq!(files.into_keys().collect::<Vec<_>>(), names);
}

#[test]
fn a_run_is_not_replaced_unasked() {
    for kept in ["history.csv", "final.mpts", "checkpoint.mpts"] {
        let bench = Bench::explicit();
        bench.ran(
            "run",
            PLAIN,
            if kept == "checkpoint.mpts" { 9 } else { END },
        );
        for name in ["history.csv", "final.mpts", "checkpoint.mpts"] {
            if name != kept && bench.path("run").join(name).exists() {
                fs::remove_file(bench.path("run").join(name)).unwrap();
            }
        }
        refused(&bench, PLAIN, "already holds a run");
    }
    // Begun, but without a checkpoint to lose: the same case starts again, another does not.
    let bench = Bench::explicit();
    bench.ran("run", PLAIN, END);
    fs::remove_file(bench.path("run/final.mpts")).unwrap();
    let other = bench.run("run", RESUME, END, &["adhesive.viscosity=2 Pa s"]);
    assert!(other.unwrap_err().to_string().contains("holds another run"));
    bench.ran("run", RESUME, END);
}

#[test]
fn a_run_that_has_ended_is_left_but_for_what_a_kill_left() {
    let bench = Bench::explicit();
    bench.ran("run", RESUME, 9);
    let checkpoint = fs::read(bench.path("run/checkpoint.mpts")).unwrap();
    bench.ran("run", RESUME, END);
    let ended = bench.everything();
    // Killed before the checkpoint was removed.
    fs::write(bench.path("run/checkpoint.mpts"), &checkpoint).unwrap();
    fs::write(bench.path("run/.mpm-run.tmp"), "half").unwrap();
    assert!(bench.run("run", RESUME, END, &[]).unwrap().is_none());
    assert!(bench.everything() == ended);
    // At another Courant number that checkpoint is not gone on from, either.
    fs::write(bench.path("run/checkpoint.mpts"), &checkpoint).unwrap();
    let other = bench.run("run", RESUME, END, &["integrator.cfl=0.3"]);
    assert!(other.unwrap_err().to_string().contains("holds another run"));
    fs::write(bench.path("run/checkpoint.mpts"), "theirs").unwrap();
    assert!(bench.run("run", RESUME, END, &[]).unwrap().is_none());
    assert_eq!(
        fs::read(bench.path("run/checkpoint.mpts")).unwrap(),
        b"theirs"
    );
}

/// Snapshots of steps that a run at another Courant number may never take were kept.
#[test]
fn what_came_after_the_checkpoint_goes() {
    let bench = Bench::explicit();
    bench.ran("run", RESUME, 9);
    let summary = bench.path("run/summary.json");
    fs::write(bench.path("run/snapshots/0009.mpts"), "theirs").unwrap();
    refused(&bench, RESUME, "not a file that a run wrote");
    fs::copy(
        bench.path("run/snapshots/0000.mpts"),
        bench.path("run/snapshots/0009.mpts"),
    )
    .unwrap();
    let first = fs::read(bench.path("run/snapshots/0000.mpts")).unwrap();
    let seen = || {
        // At the first step of the continued run.
        assert!(!summary.exists());
        assert!(!bench.path("run/snapshots/0009.mpts").exists());
        assert!(fs::read(bench.path("run/snapshots/0000.mpts")).unwrap() == first);
        false
    };
    let ended = bench.run_told("run", RESUME, &seen, &mut |_, _| {}, &[]);
    assert!(ended.unwrap().is_some());
}

/// 314e630 let both end well, with the files of either.
#[test]
fn a_folder_takes_one_run_at_a_time() {
    let bench = Bench::explicit();
    let other = || {
        for mode in [PLAIN, RESUME, OVERWRITE] {
            let said = bench.run("run", mode, END, &[]).unwrap_err();
            assert!(matches!(said, RunFailure::Usage(_)));
            assert!(
                said.to_string().contains("another run is writing"),
                "{said}"
            );
        }
        false
    };
    let ended = bench.run_told("run", PLAIN, &other, &mut |_, _| {}, &[]);
    assert!(ended.unwrap().is_some());
}

#[test]
fn a_checkpoint_of_another_case_or_damaged_is_refused_or_replaced() {
    let bench = Bench::explicit();
    bench.ran("run", RESUME, 9);
    let before = bench.everything();
    let other = ["adhesive.viscosity=2 Pa s"];
    match bench.run("run", RESUME, END, &other) {
        Err(RunFailure::Data(said)) => {
            assert!(said.contains("another case"), "{said}");
            assert!(
                said.contains("(adhesive.viscosity is \"2 Pa s\", was "),
                "{said}"
            );
        }
        ended => panic!("{ended:?}"),
    }
    assert!(bench.everything() == before);
    let checkpoint = bench.path("run/checkpoint.mpts");
    let whole = fs::read(&checkpoint).unwrap();
    fs::write(&checkpoint, &whole[..whole.len() / 2]).unwrap();
    let damaged = bench.run("run", RESUME, END, &[]);
    assert!(matches!(damaged, Err(RunFailure::Data(_))), "{damaged:?}");
    fs::write(&checkpoint, whole).unwrap();
    let both = Mode {
        resume: true,
        ..OVERWRITE
    };
    let ended = bench.run("run", both, END, &other).unwrap();
    assert!(ended.is_some_and(|summary| summary.end == run::End::Time));
}
