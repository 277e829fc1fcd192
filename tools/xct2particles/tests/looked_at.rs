//! Looks at a specimen before anything is run: previews, specks, wood and void exchanged.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use particle_file::ParticleFile;
use voxels::TiffWriter;

const ACER: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../pipelines/examples/acer/bondline-acer-64x192x128.tif"
);
const VOXEL: [&str; 2] = ["--voxel", "1.45um"];

fn run(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_xct2particles"));
    command.args(arguments).output().unwrap()
}

/// Runs, and gives what was said.
fn said(arguments: &[&str], status: i32) -> String {
    let output = run(arguments);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {said}");
    said
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

#[test]
fn a_preview_is_drawn_of_three_cuts_and_needs_no_other_output() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("look.png");
    said(&[ACER, VOXEL[0], VOXEL[1], "--preview", text(&picture)], 0);
    let png = fs::read(&picture).unwrap();
    assert!(png.starts_with(b"\x89PNG"));
    // Three panels, side by side.
    let side = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    assert!(side(16) > side(20), "{} x {}", side(16), side(20));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    let refused = said(&[ACER, VOXEL[0], VOXEL[1], "--preview", "look.svg"], 2);
    assert!(refused.contains("end in .png"), "{refused}");
}

#[test]
fn wood_and_void_that_look_exchanged_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let (target, picture) = (path("o.mpts"), path("look.png"));
    let exchanged = "void=128,wood=0,adhesive=255";
    let given = [
        ACER,
        VOXEL[0],
        VOXEL[1],
        "--labels",
        exchanged,
        "-o",
        text(&target),
    ];
    let refused = said(&[&given[..], &["--preview", text(&picture)]].concat(), 2);
    for part in [
        "wood and void look exchanged",
        "across z",
        "--yes-really",
        "--labels",
    ] {
        assert!(refused.contains(part), "{refused}");
    }
    // To be looked at.
    assert!(picture.exists() && !target.exists());
    let warned = said(&[&given[..], &["--yes-really"]].concat(), 0);
    assert!(warned.contains("warning: wood and void"), "{warned}");
    assert!(target.exists());
    // By grey values too: void is brighter than wood.
    let bright = "wood=..64,adhesive=200..";
    said(
        &[
            ACER,
            VOXEL[0],
            VOXEL[1],
            "--grey",
            bright,
            "-o",
            text(&target),
        ],
        2,
    );
    let right = said(&[ACER, VOXEL[0], VOXEL[1], "-o", text(&target)], 0);
    assert!(!right.contains("warning"), "{right}");
    let other = [
        "--labels",
        "void=0,wood=255,adhesive=128",
        "-o",
        text(&target),
    ];
    let warned = said(&[&[ACER, VOXEL[0], VOXEL[1]], &other[..]].concat(), 0);
    assert!(!warned.contains("exchanged"), "{warned}");
}

/// Bands along y of wood, adhesive and wood, with voxels of noise.
fn stack(path: &Path, noise: &[([usize; 3], u8)]) {
    let dims = [20, 30, 10];
    let mut bytes = Vec::new();
    let mut writer = TiffWriter::new(&mut bytes, dims, 1.45e-6).unwrap();
    for z in 0..dims[2] {
        let mut page: Vec<u8> = (0..dims[0] * dims[1])
            .map(|i| [128, 0, 255, 0, 128][i / dims[0] / 6])
            .collect();
        for &([x, y, at], label) in noise {
            if at == z {
                page[y * dims[0] + x] = label;
            }
        }
        writer.write_page(&page).unwrap();
    }
    writer.finish().unwrap();
    fs::write(path, bytes).unwrap();
}

#[test]
fn specks_are_taken_out_where_that_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let columns = |name: &str, more: &[&str]| {
        let (input, target) = (path(name), path("o.mpts"));
        let said = said(&[&[text(&input), "-o", text(&target)], more].concat(), 0);
        let file = ParticleFile::open(&target).unwrap();
        let bits = ["wood", "adhesive"].map(|b| file.block_named(b).unwrap().1.words().to_vec());
        let noted = file.header().attribute("despeckle").map(str::to_owned);
        (bits, said, noted)
    };
    stack(&path("clean.tif"), &[]);
    // Adhesive in wood and in void, a pair of it, wood in adhesive, void in wood.
    let noise = [
        ([3, 2, 4], 255),
        ([10, 20, 5], 255),
        ([5, 9, 2], 255),
        ([6, 9, 2], 255),
        ([8, 15, 3], 128),
        ([15, 27, 7], 0),
    ];
    stack(&path("noisy.tif"), &noise);
    let (clean, _, _) = columns("clean.tif", &[]);
    let (noisy, said, noted) = columns("noisy.tif", &[]);
    assert!(noisy != clean && !said.contains("despeckled") && noted.is_none());
    let (single, said, _) = columns("noisy.tif", &["--despeckle", "1"]);
    assert!(
        said.contains("4 pieces of at most 1 voxels") && single != clean,
        "{said}"
    );
    assert!(
        said.contains("2 voxels of adhesive, 1 of wood, 1 of void"),
        "{said}"
    );
    let (both, said, noted) = columns("noisy.tif", &["--despeckle", "2"]);
    assert!(said.contains("5 pieces of at most 2 voxels"), "{said}");
    assert_eq!((both, noted.as_deref()), (clean.clone(), Some("2")));
    assert_eq!(columns("clean.tif", &["--despeckle", "2"]).0, clean);
}

#[test]
fn an_edge_in_the_wrong_unit_is_doubted() {
    for (edge, doubted) in [
        ("1.45mm", true),
        ("1.45nm", true),
        ("20um", false),
        ("0.1um", false),
    ] {
        let said = said(&[ACER, "--voxel", edge, "-o", "-"], 0);
        assert_eq!(
            said.contains("is the unit right?"),
            doubted,
            "{edge}: {said}"
        );
    }
}

#[test]
fn a_folder_of_temporary_files_that_is_not_there_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let [stack, head] = ["a.txt", "a.mhd"].map(|name| folder.path().join(name));
    fs::write(&stack, "0 1").unwrap();
    fs::write(&head, "NDims = 3\nDimSize = 2 1 1\nElementType = MET_UCHAR\nBinaryData = False\nElementDataFile = a.txt\n").unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_xct2particles"));
    command.args([text(&head), "--voxel", "1.45um", "-o", "-"]);
    let output = command.env("TMPDIR", "/none").output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(
        said.contains("'/none'") && said.contains("set TMPDIR"),
        "{said}"
    );
}
