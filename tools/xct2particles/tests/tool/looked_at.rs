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
        "in cuts normal to z",
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
    assert!(!other.contains("look exchanged"), "{other}");
    let cracked = |_, y: usize, z| match y {
        10..14 => 0,
        9 | 14 => [0, 255][z % 2],
        _ => [128, 255][y / 3 % 2],
    };
    bench.write("crack.tif", tiff([20, 24, 10], cracked));
    told(&bench, "crack.tif -o o.mpts", 0, &[]);
}

/// Walls that the resolution broke leave corners, which are many pieces of wood in one of void.
#[test]
fn broken_thin_walls_are_not_exchanged_phases() {
    let bench = bench();
    // Walls of two voxels around lumens of 12, and corners of 4 that stay of them.
    let wall = |i: usize| i % 14 < 2;
    let corner = |i: usize| (i + 1) % 14 < 4;
    bench.write(
        "whole.tif",
        tiff([70, 70, 8], |x, y, _| u8::from(wall(x) || wall(y))),
    );
    bench.write(
        "broken.tif",
        tiff([70, 70, 8], |x, y, _| u8::from(corner(x) && corner(y))),
    );
    for stack in ["whole.tif", "broken.tif"] {
        let said = told(
            &bench,
            &format!("{stack} --labels void=0,wood=1 -o o.mpts"),
            0,
            &[],
        );
        assert!(!said.contains("exchanged"), "{stack}: {said}");
    }
    let exchanged = "whole.tif --labels void=1,wood=0 -o o.mpts";
    told(&bench, exchanged, 2, &["wood and void look exchanged"]);
}

/// A crop near a thick bond line has more adhesive than wood; what borders on lumens tells wood from adhesive.
#[test]
fn adhesive_is_taken_for_wood_only_where_it_has_the_lumens() {
    let bench = bench();
    let label = |x: usize, y: usize, _| match y {
        20..60 => 2,
        _ => u8::from(x % 7 < 2 || y % 7 < 2),
    };
    bench.write("near.tif", tiff([70, 80, 8], label));
    let run = |labels: &str| {
        told(
            &bench,
            &format!("near.tif --labels {labels} -o o.mpts"),
            0,
            &[],
        )
    };
    let said = run("void=0,wood=1,adhesive=2");
    assert!(!said.contains("exchanged"), "{said}");
    let said = run("void=0,wood=2,adhesive=1");
    assert!(said.contains("are the labels exchanged?"), "{said}");
}

/// Grey values brought noise along without a word.
#[test]
fn specks_are_told_and_taken_out_where_that_is_asked_for() {
    let bench = bench();
    let band = |y: usize| [128, 0, 255, 0, 128][y / 6];
    let speckled = |x: usize, y: usize, z: usize| match x % 4 + y % 4 + z % 4 {
        0 => 128,
        _ => band(y),
    };
    bench.write("clean.tif", tiff([20, 30, 10], |_, y, _| band(y)));
    bench.write("speckled.tif", tiff([20, 30, 10], speckled));
    let grey = "--grey wood=90..200,adhesive=201.. -o o.mpts";
    let made = |arguments: &str, parts: &[&str]| {
        let said = told(&bench, &format!("{arguments} {grey}"), 0, parts);
        (bits(&open(&bench, "o.mpts")), said)
    };
    let noise = ["of at most 4 voxels look like noise: --despeckle 4"];
    let (noisy, _) = made("speckled.tif", &noise);
    let (clean, said) = made("clean.tif", &[]);
    assert!(
        noisy != clean && !said.contains("look like noise"),
        "{said}"
    );
    let done = ["pieces of at most 1 voxels", "of wood, 0 of void"];
    let (despeckled, said) = made("speckled.tif --despeckle 1", &done);
    assert!(despeckled == clean && !said.contains("look like noise"));
    let file = open(&bench, "o.mpts");
    assert_eq!(file.header().attribute("despeckle"), Some("1"));
}

#[test]
fn a_folder_of_temporary_files_that_is_not_there_is_named() {
    let bench = bench();
    bench.write("a.txt", b"0 1");
    bench.write("a.mhd", b"NDims = 3\nDimSize = 2 1 1\nElementType = MET_UCHAR\nBinaryData = False\nElementDataFile = a.txt\n");
    let run = bench.shell("TMPDIR=/none $TOOL a.mhd --voxel 1.45um -o -");
    run.refused(3, "'/none'").refused(3, "set TMPDIR");
}
