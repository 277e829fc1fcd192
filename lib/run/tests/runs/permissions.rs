//! Permissions of the files of a run folder.

use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;

use crate::bench::{Bench, END, OVERWRITE, RESUME};

fn mode(path: &Path) -> u32 {
    fs::metadata(path).unwrap().permissions().mode() & 0o777
}

fn set(path: &Path, mode: u32) {
    fs::set_permissions(path, Permissions::from_mode(mode)).unwrap();
}

/// Replaced files keep their permissions.
#[test]
fn files_keep_their_modes_when_another_run_takes_their_place() {
    // The second run is stopped and has a checkpoint.
    for (how, first, second) in [(OVERWRITE, END, END), (RESUME, 9, 4)] {
        let bench = Bench::explicit();
        bench.ran("run", how, first);
        let names = bench.everything().into_keys();
        let names: Vec<_> = names.filter(|name| name != "bondline-run.toml").collect();
        let bits = || names.iter().zip([0o600, 0o640].into_iter().cycle());
        assert!(names.len() >= 5, "{names:?}");
        bits().for_each(|(name, bits)| set(&bench.path("run").join(name), bits));
        bench.ran("run", how, second);
        for (name, bits) in bits() {
            assert_eq!(mode(&bench.path("run").join(name)), bits, "{name}");
        }
    }
}

/// A write-protected file stops the run before anything changes.
#[test]
fn a_write_protected_file_is_neither_replaced_nor_removed() {
    for (mode, steps, name) in [
        (OVERWRITE, END, "final.mpts"),
        (OVERWRITE, END, "history.csv"),
        (OVERWRITE, END, "summary.json"),
        (OVERWRITE, END, "snapshots/0000.mpts"),
        (RESUME, 9, "checkpoint.mpts"),
        (RESUME, 9, "history.csv"),
        (RESUME, 9, "resolved.toml"),
    ] {
        let bench = Bench::explicit();
        bench.ran("run", mode, steps);
        set(&bench.path("run").join(name), 0o400);
        let before = bench.everything();
        bench.refuses(mode, &[], &[name, "write-protected"]);
        assert!(bench.everything() == before, "{name}");
        // An ended run writes nothing.
        if steps == END {
            assert!(bench.run("run", RESUME, END, &[]).unwrap().is_none());
        }
    }
}
