//! Folders as a run may find them.

use std::fs;
use std::os::unix::fs::symlink;

use super::{ended, put};
use crate::workbench::Workbench;

/// A folder laid out before a run, and how the run into `run` ends with no option, `--resume` and
/// `--overwrite`.
pub struct Layout {
    pub name: &'static str,
    pub lay: fn(&Workbench),
    /// Arguments in place of `case.toml --particles bond.mpts -o run`.
    pub arguments: &'static str,
    pub codes: [i32; 3],
}

const PLAIN: &str = "case.toml --particles bond.mpts -o run";

fn marked(bench: &Workbench) {
    put(bench, "run/bondline-run.toml");
    bench.write("run/bondline-run.toml", "");
}

/// 314e630 lost a file in those marked "lost".
pub fn layouts() -> Vec<Layout> {
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
