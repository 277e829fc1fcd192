//! From stacks of labels to particle files.

use std::fs;

use particle_file::ParticleFile;

use crate::workbench::Bench;
use crate::{bench, bits, counts, open, tiff, told};

const DIMS: [usize; 3] = [70, 20, 10];

/// Bands along y: wood, adhesive, void, wood.
fn label(y: usize) -> u8 {
    [128, 255, 0, 128][y / 5]
}

fn stack() -> Vec<u8> {
    tiff(DIMS, |_, y, _| label(y))
}

/// A folder with the labelled stack `a.tif`.
fn labelled() -> Bench {
    let bench = bench();
    bench.write("a.tif", stack());
    bench
}

#[test]
fn a_stack_becomes_two_blocks_with_counts_on_standard_error() {
    let bench = labelled();
    // Voxel size from the file, labels guessed; a quarter of the voxels is adhesive.
    let said = [
        "1.450000 um, from ImageJ metadata",
        "guessed: void=0,wood=128,adhesive=255",
        "7000 voxels  0.500000",
        "3500 voxels  0.250000",
        "bond area   1471.8 um2",
        "over it 7.2500 um",
    ];
    told(&bench, "a.tif -o o.mpts", 0, &said);
    let file = open(&bench, "o.mpts");
    assert_eq!(counts(&file), [7000, 3500]);
    let (block, adhesive) = file.block_named("adhesive").unwrap();
    assert!((block.voxel_m - 1.45e-6).abs() < 1e-18);
    for y in 0..DIMS[1] {
        assert_eq!(adhesive.get(69, y, 9), label(y) == 255, "{y}");
    }
    let provenance = &file.header().provenance[0];
    assert_eq!(provenance.tool, "xct2particles");
    assert_eq!(provenance.inputs[0].0, "a.tif");
}

#[test]
fn standard_input_standard_output_and_crops() {
    let bench = labelled();
    assert_eq!(told(&bench, "-q a.tif -o -", 0, &[]), "");
    // A redirected file and a pipe.
    let crop = "- --crop 6:70,4:11,0:3 --labels void=0,wood=128,adhesive=255 -o -";
    let redirected = bench.shell(&format!("$TOOL {crop} < a.tif")).done();
    let piped = bench.shell(&format!("cat a.tif | $TOOL {crop}")).done();
    assert_eq!(piped.stdout, redirected.stdout);
    let said = redirected.said;
    assert!(said.contains(", cropped to 64 x 7 x 3 voxels\n"), "{said}");
    let file = ParticleFile::from_bytes(&piped.stdout).unwrap();
    assert_eq!(counts(&file), [64 * 3, 64 * 5 * 3]);
    assert_eq!(file.header().attribute("crop"), Some("6:70,4:11,0:3"));
}

#[test]
fn a_voxel_size_against_the_files_own_is_taken_with_a_warning() {
    let bench = labelled();
    let run = |edge, said: &[&str]| {
        told(
            &bench,
            &format!("a.tif --voxel {edge} -q -o /dev/null"),
            0,
            said,
        )
    };
    assert_eq!(run("1.45um", &[]), "");
    run("2.9um", &["1.45 x 1.45 x 1.45 um; --voxel is taken"]);
}

/// Undamaged wood: labels guessed or named, grey values given or proposed; two values that may be
/// wood or adhesive are not guessed.
#[test]
fn a_stack_without_adhesive_is_a_specimen_of_wood() {
    let bench = bench();
    for (name, wood) in [("labels.raw", 128), ("mask.raw", 255)] {
        let voxels = (0..20 * 10 * 5).map(|i| if i / 20 % 10 < 6 { wood } else { 0 });
        bench.write(name, voxels.collect::<Vec<u8>>());
    }
    let volume = "--dims 20x10x5 --type u8 --voxel 1.45um -o o.mpts";
    for input in [
        "labels.raw",
        "mask.raw --labels void=0,wood=255",
        "mask.raw --grey wood=90..",
        "mask.raw --grey auto-wood",
    ] {
        let said = match input {
            "labels.raw" => "guessed: void=0,wood=128, without adhesive",
            _ => "undamaged wood",
        };
        told(&bench, &format!("{input} {volume}"), 0, &[said]);
        assert_eq!(counts(&open(&bench, "o.mpts")), [600, 0], "{input}");
    }
    told(&bench, &format!("mask.raw {volume}"), 2, &["--labels"]);
}

/// A raw volume, its copy in words of the other byte order, and slices of which one is missing.
#[test]
fn raw_volumes_and_slices_give_the_voxels_that_they_hold() {
    let bench = bench();
    let label = |y: usize| [1, 2, 0, 1][y / 5];
    let all: Vec<u8> = (0..31 * 20 * 6).map(|i| label(i / 31 % 20)).collect();
    bench.write("a.raw", &all);
    bench.write(
        "wide.raw",
        all.iter().flat_map(|l| [0, *l]).collect::<Vec<u8>>(),
    );
    fs::create_dir(bench.path("slices")).unwrap();
    for z in [0, 1, 2, 4, 5, 6] {
        let slice = tiff([31, 20, 1], |_, y, _| label(y));
        bench.write(&format!("slices/s{z}.tif"), &slice);
    }
    let size = "--voxel 2um --labels void=0,wood=1,adhesive=2 -o o.mpts";
    let made = |stack: &str, said: &[&str]| {
        told(&bench, &format!("{stack} {size}"), 0, said);
        bits(&open(&bench, "o.mpts"))
    };
    bench.write("a.tif", tiff([31, 20, 6], |_, y, _| label(y)));
    let expected = made("a.tif", &[]);
    let raw = made("a.raw --dims 31x20x6 --type u8", &[]);
    let wide = made("wide.raw --dims 31x20x6 --type u16be", &[]);
    let slices = made("slices", &["s2.tif' and 'slices/s4.tif' it is 2"]);
    assert!([raw, wide, slices].iter().all(|bits| *bits == expected));
    for (arguments, said) in [
        ("--dims 3x3x3", &[][..]),
        ("--dims 30x20x6 --type u8", &["120 bytes stand", "--type"]),
    ] {
        told(&bench, &format!("a.raw {arguments} {size}"), 2, said);
    }
}

/// A slab of five layers was said to be 2.5 layers thick, and its file to have its bond across y.
#[test]
fn a_specimen_that_is_levelled_across_x_has_its_bond_there() {
    let bench = bench();
    let label = |x: usize| match x {
        30..35 => 255,
        69 => 0,
        _ => 128,
    };
    bench.write("a.tif", tiff(DIMS, |x, _, _| label(x)));
    let said = [
        "bond area   420.5 um2 (y times z), adhesive volume over it 7.2500 um",
        "turned by 0.00, 0.00 and 0.00",
    ];
    told(&bench, "a.tif --level x -o o.mpts", 0, &said);
    let file = open(&bench, "o.mpts");
    assert_eq!(file.header().normal, 0);
    assert_eq!(file.header().attribute("level"), Some("x"));
    let refused = "--level y: the bond lies across x, not across y";
    told(&bench, "a.tif --level y -o -", 2, &[refused]);
}
