//! No output replaces a file that is read, another output or a file of somebody else's.

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
