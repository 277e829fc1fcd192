//! Looks at a specimen before anything is run: previews, specks, wood and void exchanged.

use std::fs;

use crate::{bench, bits, open, tiff, told, with_acer};

#[test]
fn a_preview_is_drawn_of_three_cuts_and_needs_no_other_output() {
    let bench = with_acer();
    told(&bench, "acer.tif --voxel 1.45um --preview look.png", 0, &[]);
    let png = fs::read(bench.path("look.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG"));
    let folder = bench.path("");
    assert_eq!(fs::read_dir(folder).unwrap().count(), 2);
    // Three panels, and of grey values three more, which are not turned.
    let grey = "acer.tif --voxel 1.45um --grey wood=90..200,adhesive=201.. --preview grey.png";
    let bytes = |line: &str, said| {
        told(&bench, line, 0, said);
        fs::metadata(bench.path("grey.png")).unwrap().len()
    };
    let beside = bytes(grey, &[]);
    let level = bytes(&format!("{grey} --level y"), &["without grey values"]);
    assert!(beside > level + png.len() as u64 / 2, "{beside} {level}");
}

#[test]
fn phases_that_look_exchanged_are_refused() {
    let bench = with_acer();
    let run = |more: &str, status, said: &[&str]| {
        told(
            &bench,
            &format!("acer.tif --voxel 1.45um -o o.mpts {more}"),
            status,
            said,
        )
    };
    let exchanged = "--labels void=128,wood=0,adhesive=255";
    let said = [
        "wood and void look exchanged",
        "across z",
        "--yes-really",
        "--labels",
    ];
    run(&format!("{exchanged} --preview look.png"), 2, &said);
    // To be looked at.
    assert!(bench.path("look.png").exists() && !bench.path("o.mpts").exists());
    run(
        &format!("{exchanged} --yes-really"),
        0,
        &["warning: wood and void"],
    );
    assert!(bench.path("o.mpts").exists());
    // By grey values too: void is brighter than wood.
    run("--grey wood=..64,adhesive=200..", 2, &[]);
    let adhesive = "--labels void=255,wood=128,adhesive=0";
    let said = [
        "void and adhesive look exchanged",
        "along y",
        "--yes-really",
    ];
    run(adhesive, 2, &said);
    run(&format!("{adhesive} --yes-really"), 0, &said[..1]);
    assert!(!run("", 0, &[]).contains("warning"));
    // Adhesive that fills all pores, and a crack in the bond line.
    let other = run("--labels void=0,wood=255,adhesive=128", 0, &[]);
    assert!(!other.contains("exchanged"), "{other}");
    let cracked = |_, y: usize, z| match y {
        10..14 => 0,
        9 | 14 => [0, 255][z % 2],
        _ => [128, 255][y / 3 % 2],
    };
    bench.write("crack.tif", tiff([20, 24, 10], cracked));
    told(&bench, "crack.tif -o o.mpts", 0, &[]);
}

#[test]
fn specks_are_taken_out_where_that_is_asked_for() {
    let bench = bench();
    // Adhesive in wood and in void, a pair of it, wood in adhesive, void in wood.
    let noise = [
        ([3, 2, 4], 255),
        ([10, 20, 5], 255),
        ([5, 9, 2], 255),
        ([6, 9, 2], 255),
        ([8, 15, 3], 128),
        ([15, 27, 7], 0),
    ];
    let band = |y: usize| [128, 0, 255, 0, 128][y / 6];
    let noisy = |x: usize, y: usize, z: usize| {
        let noise = noise.iter().find(|(at, _)| *at == [x, y, z]);
        noise.map_or(band(y), |(_, label)| *label)
    };
    bench.write("clean.tif", tiff([20, 30, 10], |_, y, _| band(y)));
    bench.write("noisy.tif", tiff([20, 30, 10], noisy));
    let columns = |arguments: &str, parts: &[&str]| {
        let said = told(&bench, &format!("{arguments} -o o.mpts"), 0, parts);
        let file = open(&bench, "o.mpts");
        let noted = file.header().attribute("despeckle").map(str::to_owned);
        (bits(&file), said, noted)
    };
    let (clean, ..) = columns("clean.tif", &[]);
    let (bits, said, noted) = columns("noisy.tif", &[]);
    assert!(bits != clean && !said.contains("despeckled") && noted.is_none());
    let single = [
        "4 pieces of at most 1 voxels",
        "2 voxels of adhesive, 1 of wood, 1 of void",
    ];
    assert!(columns("noisy.tif --despeckle 1", &single).0 != clean);
    let both = columns("noisy.tif --despeckle 2", &["5 pieces of at most 2 voxels"]);
    assert_eq!((&both.0, both.2.as_deref()), (&clean, Some("2")));
    assert_eq!(columns("clean.tif --despeckle 2", &[]).0, clean);
    // Grey values brought noise along without a word.
    let speckled = |x: usize, y: usize, z: usize| match x % 4 + y % 4 + z % 4 {
        0 => 128,
        _ => band(y),
    };
    bench.write("speckled.tif", tiff([20, 30, 10], speckled));
    let grey = "--grey wood=90..200,adhesive=201..";
    let noise = ["of at most 4 voxels look like noise: --despeckle 4"];
    columns(&format!("speckled.tif {grey}"), &noise);
    for quiet in ["speckled.tif --despeckle 4", "clean.tif"] {
        let (_, said, _) = columns(&format!("{quiet} {grey}"), &[]);
        assert!(!said.contains("look like noise"), "{said}");
    }
}

#[test]
fn a_folder_of_temporary_files_that_is_not_there_is_named() {
    let bench = bench();
    bench.write("a.txt", b"0 1");
    bench.write("a.mhd", b"NDims = 3\nDimSize = 2 1 1\nElementType = MET_UCHAR\nBinaryData = False\nElementDataFile = a.txt\n");
    let run = bench.shell("TMPDIR=/none $TOOL a.mhd --voxel 1.45um -o -");
    run.refused(3, "'/none'").refused(3, "set TMPDIR");
}
