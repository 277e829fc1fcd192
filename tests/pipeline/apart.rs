//! No output replaces a file that is read, another output, a file of a run or a sweep or one of somebody else's.

use std::fs;

use crate::workbench::{Workbench, grooved, npy};

const METRICS: &str = "wp-metrics --voxel 1.45um --labels void=0,wood=128,adhesive=255";

/// `specimen.npy` also as `a.mhd` with `a.raw` and as the folder `slices`.
fn bench() -> Workbench {
    let bench = Workbench::with_bond();
    let stack = bench.read("specimen.npy");
    bench.write("a.raw", &stack[stack.len() - 16 * 32 * 16..]);
    bench.write(
        "a.mhd",
        "ObjectType = Image\nNDims = 3\nDimSize = 16 32 16\nElementType = MET_UCHAR\nElementDataFile = a.raw\n",
    );
    bench.write("page.npy", npy([16, 32, 1], grooved));
    bench.convert("page.npy", "page.mpts");
    bench.done(
        "particles export specimen.mpts -o a.tif; mkdir slices
         for i in 3 4; do particles export page.mpts -o slices/00$i.tif; done; rm slices/*.json",
    );
    bench
}

/// Runs a line that must be refused for `sentence` with `kept` as it was.
fn refused(bench: &Workbench, line: &str, kept: &str, sentence: &str) {
    let (before, names) = (bench.read(kept), bench.names(""));
    bench.ends(2, line, sentence);
    assert!(bench.read(kept) == before, "{line}: {kept} was replaced");
    assert_eq!(bench.names(""), names, "{line}");
}

/// A table replaced the data file of a MetaImage, or a slice of a folder, with exit status 0.
#[test]
fn metrics_leave_every_file_of_their_stacks() {
    let bench = bench();
    for (line, kept) in [
        ("a.mhd -o a.raw", "a.raw"),
        ("a.mhd -o b.csv --map ./a.raw", "a.raw"),
        ("a.mhd -o b.csv --profile slices/../a.raw", "a.raw"),
        ("bond.mpts --compare a.mhd -o a.raw", "a.raw"),
        ("bond.mpts a.mhd -o a.raw", "a.raw"),
        ("slices -o slices/004.tif", "slices/004.tif"),
        ("a.mhd --compare slices -o slices/003.tif", "slices/003.tif"),
        ("- -o a.tif < a.tif", "a.tif"),
    ] {
        refused(&bench, &format!("{METRICS} {line}"), kept, "is an input");
    }
    for name in ["a.mhd", "slices"] {
        bench.done(&format!("{METRICS} {name} -o m.csv"));
    }
}

/// Records replaced inputs, other outputs and files that were no records, with exit status 0.
#[test]
fn a_provenance_record_replaces_only_a_record() {
    let bench = bench();
    let (record, picture) = ("y.provenance.json", "y.svg.provenance.json");
    for kept in [record, picture] {
        fs::copy(bench.path("bond.mpts"), bench.path(kept)).unwrap();
    }
    for (line, kept) in [
        ("particles export y.provenance.json -f csv -o y", record),
        ("particles export y.provenance.json -f pvd -o y", record),
        ("wp-metrics bond.mpts y.provenance.json -o y", record),
        ("particles export - -f csv -o y < y.provenance.json", record),
        (
            "bond-figures slice y.svg.provenance.json --normal z -o y.svg",
            picture,
        ),
        (
            "bond-figures slice - --normal z -o y.svg < y.svg.provenance.json",
            picture,
        ),
    ] {
        refused(&bench, line, kept, "is read and would be replaced");
    }
    bench.write(record, "{\"a file\": \"of mine\"}\n");
    for line in [
        "particles export bond.mpts -f npz -o y",
        "particles export bond.mpts -f pvd -o y",
        "wp-metrics bond.mpts -o b.csv --map y",
        "shear-stats bond.mpts -o y",
        "synth-xct -q --adhesive pf --size 64x128x64 -o y",
    ] {
        refused(&bench, line, record, "is not a provenance record");
    }
    let two = "wp-metrics bond.mpts -o m.csv --map m.csv.provenance.json";
    refused(&bench, two, "bond.mpts", "is another output");
    // The record of an earlier output is replaced.
    for _ in 0..2 {
        bench.done("wp-metrics bond.mpts -o m.csv");
    }
}

/// Parts of a series replaced its input and whatever else had their names.
#[test]
fn parts_of_a_series_replace_only_such_parts() {
    let bench = bench();
    let again = "particles export bond.mpts specimen.mpts -o o.pvd";
    bench.done(again);
    let parts = bench.names("o.parts");
    let part = parts.iter().find(|name| name.starts_with("0001")).unwrap();
    let path = format!("o.parts/{part}");
    let own = bench.read(&path);
    bench.done(again);

    bench.write("o.parts/notes.txt", "mine");
    fs::copy(bench.path("bond.mpts"), bench.path(&path)).unwrap();
    let others = |line: &str| {
        let first = bench.read("o.parts/0000-wood-bottom.vti");
        bench.write("o.parts/0000-wood-bottom.vti", [&first[..], b" "].concat());
        refused(&bench, line, &path, "not part of an earlier output");
        // Nothing is moved where one part cannot be.
        assert!(bench.read("o.parts/0000-wood-bottom.vti").ends_with(b" "));
    };
    others(&format!("particles export specimen.mpts {path} -o o.pvd"));
    others(again);
    for foreign in [
        "",
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\">\n",
    ] {
        bench.write(&path, foreign);
        others(again);
    }
    // Asked for by its name, it is nobody's part.
    bench.write(&path, &own);
    bench.done(&format!("particles export bond.mpts -o {path}"));
    others(again);
    fs::remove_file(bench.path(&format!("{path}.provenance.json"))).unwrap();
    bench.done(again);
    assert!(bench.read(&path) == own);
    assert_eq!(bench.read("o.parts/notes.txt"), b"mine");
}

/// Files below a folder, by their paths in it.
fn files(bench: &Workbench, folder: &str) -> Vec<String> {
    let found = bench.done(&format!("cd {folder}; find . -type f | sort"));
    found.lines().map(|name| name[2..].to_owned()).collect()
}

/// Tables, pages and states replaced a run's last state, its history and the plan of a sweep, with exit status 0. A file that
/// runs and sweeps come to write belongs to them from then on: all that are found are tried.
#[test]
fn files_of_runs_and_sweeps_are_written_by_their_own_tools_alone() {
    let bench = Workbench::with_bond();
    bench.write("t.csv", "particles,clamp.stop\nbond.mpts,0.05 us\n");
    bench.done(
        "mpm-run -q case.toml --particles bond.mpts -o r --set clamp.stop=0.05us; ln -s r/snapshots link
         echo of mine >r/notes.txt; wp-metrics -q r/final.mpts -o wp.csv
         bond-sweep plan -q t.csv --case case.toml -o s; bond-sweep run -q s $(cat s/runs.txt)
         mkdir -p s/specimens/1b; cp bond.mpts s/specimens/1b",
    );
    let others = [
        "bond-report --run r --table wp.csv -o",
        "wp-metrics --series r -o",
        "wp-metrics r/final.mpts -o a.csv --profile",
        "wp-metrics r/final.mpts -o a.csv --map",
        "shear-stats --tube '1 m/s,50 um' -o",
        "particles export bond.mpts -f csv -o",
        "bond-figures table2 --run a:b=wp.csv -o",
        "bond-figures table2 --run a:b=wp.csv -o b.csv --errors",
        "synth-xct -q --adhesive pf --size 24x64x24 -o",
        "xct2particles -q specimen.npy --voxel 1.45um -o",
        "build-bondline -q specimen.mpts -o",
        "bond-sweep collect s -o",
        "bond-sweep collect s -o a.csv --cost",
    ];
    let kept = [("r", files(&bench, "r")), ("s", files(&bench, "s"))];
    let mut tried = 0;
    for (folder, names) in kept {
        for (i, name) in names.iter().filter(|name| *name != "notes.txt").enumerate() {
            let path = format!("{folder}/{name}");
            let before = bench.read(&path);
            // Every tool is tried on some, and on each file two tools are.
            for tool in [others[i % others.len()], others[(i + 6) % others.len()]] {
                bench.ends(2, &format!("{tool} {path}"), "");
                assert!(bench.read(&path) == before, "{tool} {path}");
                tried += 1;
            }
        }
    }
    assert!(tried > 2 * others.len(), "{tried}");
    for line in [
        "wp-metrics r/final.mpts -o link/0000.mpts",
        "wp-metrics --series r -o r/checkpoint.mpts",
        "cd r/snapshots; wp-metrics ../final.mpts -o ../history.csv",
    ] {
        bench.ends(2, line, "belongs to the run in '");
    }
    bench.ends(
        2,
        "bond-sweep collect s -o s/runs.txt",
        "belongs to the sweep in '",
    );
    bench.ends(
        2,
        "bond-report --table wp.csv -o wp.csv.provenance.json",
        "is the provenance record of '",
    );
    // Other names in these folders are anybody's.
    bench.done(
        "wp-metrics --series r -o r/series.csv; wp-metrics r/final.mpts -o r/notes.txt
         bond-sweep collect -q s -o s/results.csv",
    );
}
