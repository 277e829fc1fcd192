//! `make` again after something has changed: its tables are those of `make` from nothing, and what has
//! not changed is not made again.

use std::fs;
use std::time::{Duration, SystemTime};

use studies::outputs;
use voxels::TiffWriter;

use crate::clone::{clone, make, table};
use crate::workbench::{Workbench, grooved, npy, npy_header, said};

/// The table after a change, which is not that before, and is that of a folder of its own.
struct Kept<'a> {
    bench: &'a Workbench,
    before: Option<String>,
    changes: usize,
}

impl<'a> Kept<'a> {
    fn new(bench: &'a Workbench) -> Self {
        Self {
            bench,
            before: None,
            changes: 0,
        }
    }

    fn changed(&mut self, what: &str, arguments: &[&str]) {
        self.changes += 1;
        let now = table(self.bench, "kept", arguments);
        let anew = table(self.bench, &format!("anew{}", self.changes), arguments);
        assert_eq!(
            now, anew,
            "{what}: left is what an earlier make left, right is from nothing"
        );
        assert_ne!(now, self.before, "{what} changes nothing");
        self.before = now;
    }
}

/// Writes a file that looks older than all else.
fn old(bench: &Workbench, name: &str, content: &[u8]) {
    bench.write(name, content);
    let file = fs::File::options().write(true).open(bench.path(name));
    let moment = SystemTime::UNIX_EPOCH + Duration::from_secs(1_700_000_000);
    file.and_then(|file| file.set_modified(moment)).unwrap();
}

/// A slice as a TIFF of its labels.
fn slice(z: usize, label: fn(usize, usize, usize) -> u8) -> Vec<u8> {
    let mut bytes = Vec::new();
    let page: Vec<u8> = (0..16 * 32).map(|i| label(i % 16, i / 16, z)).collect();
    let mut tiff = TiffWriter::new(&mut bytes, [16, 32, 1], 1.45e-6, "").unwrap();
    tiff.write_page(&page).and_then(|()| tiff.finish()).unwrap();
    bytes
}

/// A stack with another label in the wood of its left half.
fn labelled(x: usize, y: usize, z: usize) -> u8 {
    match grooved(x, y, z) {
        128 if x < 8 && y < 14 => 77,
        label => label,
    }
}

/// One with wood in all but a few rows of the upper half.
fn filled(x: usize, y: usize, z: usize) -> u8 {
    if (16..26).contains(&y) {
        128
    } else {
        grooved(x, y, z)
    }
}

#[test]
fn whatever_changes_the_table_is_that_of_make_from_nothing() {
    let bench = clone();
    for (seed, name) in [("501", "a.tif"), ("502", "b.tif")] {
        bench.done(&format!(
            "synth-xct -q --adhesive pf --size 24x64x24 --seed {seed} -o {name}"
        ));
    }
    let (a, b) = (bench.read("a.tif"), bench.read("b.tif"));
    let mut kept = Kept::new(&bench);
    kept.changed("a stack", &["XCT_PF=a.tif"]);
    old(&bench, "b.tif", &b);
    kept.changed("another, older stack", &["XCT_PF=b.tif"]);
    old(&bench, "b.tif", &a);
    kept.changed("an older file at its place", &["XCT_PF=b.tif"]);
    kept.changed("VOXEL", &["XCT_PF=b.tif", "VOXEL=0.725 um"]);
    kept.changed("CELL", &["XCT_PF=b.tif", "VOXEL=0.725 um", "CELL=1 voxel"]);
    let set = "SET=clamp.stop=2 us adhesive.viscosity=500 cP";
    kept.changed("SET", &["XCT_PF=b.tif", set]);
    let both = "RUNS=implicit implicit-frictionless";
    kept.changed("RUNS", &["XCT_PF=b.tif", both]);
    kept.changed(
        "RUNS narrowed",
        &["XCT_PF=b.tif", "RUNS=implicit-frictionless"],
    );
    kept.changed("the adhesive", &["XCT_PVA_PF=b.tif"]);
    kept.changed("ERROR", &["XCT_PVA_PF=b.tif", "XCT_PF=a.tif", "ERROR=yes"]);
    kept.changed("a synthetic stack", &[]);
    kept.changed("one's own again", &["XCT_PF=b.tif"]);
    let case = bench.text("pipelines/cases/pf-implicit.toml");
    bench.write(
        "pipelines/cases/pf-implicit.toml",
        case.replace("1300 cP", "12 Pa s"),
    );
    kept.changed("a case", &["XCT_PF=b.tif"]);
}

/// Data beside a header, edited in place; slices, one of them edited, one more.
#[test]
fn what_a_stack_consists_of_is_looked_at() {
    let bench = clone();
    let mut kept = Kept::new(&bench);
    let dims = [16, 32, 16];
    let header = npy_header(dims, "False").len();
    let raw = |label: fn(usize, usize, usize) -> u8| npy(dims, label).split_off(header);
    bench.write("c.mhd", "ObjectType = Image\nNDims = 3\nDimSize = 16 32 16\nElementType = MET_UCHAR\nElementSpacing = 0.00145 0.00145 0.00145\nElementDataFile = c.raw\n");
    bench.write("c.raw", raw(labelled));
    let stack = ["XCT_PF=c.mhd", "VOXEL=1.45 um"];
    let labels = |labels| [&stack[..], &[labels]].concat();
    let wood = labels("LABELS=void=0,wood=128|77,adhesive=255");
    kept.changed("a header", &wood);
    kept.changed("LABELS", &labels("LABELS=void=0|77,wood=128,adhesive=255"));
    old(&bench, "c.raw", &raw(grooved));
    kept.changed("data of a header", &wood);
    fs::create_dir(bench.path("slices")).unwrap();
    for z in 0..12 {
        bench.write(&format!("slices/s{z:02}.tif"), slice(z, grooved));
    }
    let slices = ["XCT_PF=slices", "VOXEL=1.45 um"];
    kept.changed("slices", &slices);
    old(&bench, "slices/s07.tif", &slice(7, filled));
    kept.changed("a slice edited in place", &slices);
    for z in [12, 13] {
        old(&bench, &format!("slices/s{z}.tif"), &slice(z, grooved));
    }
    kept.changed("more slices", &slices);
    bench.done("rm slices/s1[23].tif");
    kept.changed("fewer slices", &slices);
    kept.changed("NORMAL", &["XCT_PF=slices", "VOXEL=1.45 um", "NORMAL=x"]);
}

#[test]
fn undamaged_wood_and_species_follow_what_they_are_made_of() {
    let bench = clone();
    for (seed, name) in [("503", "w.tif"), ("504", "v.tif")] {
        bench.done(&format!(
            "synth-xct -q --adhesive none --size 24x64x24 --seed {seed} -o {name}"
        ));
    }
    let mut kept = Kept::new(&bench);
    for (what, options) in [
        ("wood", &["PLANE=46.4 um", "SLAB=11.6 um"][..]),
        ("SLAB", &["PLANE=46.4 um", "SLAB=23.2 um"]),
        ("TURN", &["PLANE=46.4 um", "SLAB=23.2 um", "TURN=180"]),
        ("PLANE", &["PLANE=40.6 um", "SLAB=23.2 um", "TURN=180"]),
        ("XCT_TOP", &["XCT_TOP=v.tif", "SLAB=23.2 um"]),
    ] {
        kept.changed(what, &[&["XCT_BOTTOM=w.tif"], options].concat());
    }
    let sum = |slab: &str| {
        let bond = "out/species/birch-1/bond.mpts";
        let size = ["BUILT=1", "SPECIES_SIZE=24x64x24", "SPECIES_PLANE=46.4 um"];
        let made = make(&bench, &[&size[..], &[slab, bond]].concat());
        assert!(made.status.success(), "{}", said(&made));
        bench.sum(bond)
    };
    let [thin, thick] = ["SPECIES_SLAB=11.6 um", "SPECIES_SLAB=14.5 um"].map(sum);
    assert_ne!(thin, thick);
    assert_eq!(sum("SPECIES_SLAB=11.6 um"), thin);
}

#[test]
fn what_has_not_changed_is_not_made_again() {
    let bench = clone();
    bench.write("a.npy", npy([16, 32, 16], grooved));
    let goals = [
        "BUILT=1",
        "OUT=o",
        "XCT_PF=a.npy",
        "VOXEL=1.45 um",
        "FORMATS=svg",
        "o/table2.csv",
        "o/figures/pf-map.svg",
    ];
    let again = |more: &[&str]| {
        let made = make(&bench, &[&goals, more].concat());
        assert!(made.status.success(), "{}", said(&made));
        String::from_utf8(made.stdout).unwrap()
    };
    let planned = |more: &[&str]| again(&[&["-n"], more].concat());
    assert_eq!(planned(&[]).lines().count(), 7, "{}", planned(&[]));
    again(&[]);
    let written = || {
        ["o/table2.csv", "o/pf/implicit/final.mpts"]
            .map(|name| fs::metadata(bench.path(name)).unwrap().modified().unwrap())
    };
    let before = written();
    assert_eq!(planned(&[]), "");
    // Newer, of the same content, also of what comes between.
    bench.done("touch a.npy o/pf/bond.mpts pipelines/cases/pf-implicit.toml");
    assert_eq!(planned(&[]), "");
    again(&[]);
    again(&["JOBS=3", "RUN_THREADS=2", "YES=1", "V=1", "-j8"]);
    assert_eq!(written(), before);
    // A width is of figures alone; a lost file beside a table is made again with it.
    let wide = planned(&["FIGURE_WIDTH=84 mm"]);
    assert!(
        wide.lines().count() == 1 && wide.contains("bond-figures map"),
        "{wide}"
    );
    fs::remove_file(bench.path("o/pf/implicit/map.csv")).unwrap();
    let lost = planned(&[]);
    assert!(
        lost.contains("wp-metrics") && !lost.contains("mpm-run"),
        "{lost}"
    );
    // A tool that is another program makes again what it makes.
    let real = outputs::bin_folder().join("wp-metrics");
    let script = format!(
        "#!/bin/sh\necho measured >>measured\nexec '{}' \"$@\"\n",
        real.display()
    );
    bench.write("script", script);
    bench.done("chmod +x script; mv -f script target/release/wp-metrics");
    again(&[]);
    assert_eq!(bench.text("measured"), "measured\n".repeat(2));
    assert_eq!(written()[1], before[1], "the run was made again");
}
