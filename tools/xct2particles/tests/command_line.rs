//! The tool as a process: exit statuses, sentences, outputs that are whole or absent.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use particle_file::ParticleFile;
use tempfile::TempDir;
use voxels::TiffWriter;

const DIMS: [usize; 3] = [70, 20, 10];
const LABELS: &str = "void=0,wood=128,adhesive=255";

/// Bands along y: wood, adhesive, void, wood.
fn label(y: usize) -> u8 {
    [128, 255, 0, 128][y / 5]
}

/// A folder with the labelled stack `stack.tif`, voxel edge 1.45 um.
fn folder() -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("stack.tif");
    fs::write(&path, stack_bytes(|_, y, _| label(y))).unwrap();
    (folder, path)
}

fn stack_bytes(label: impl Fn(usize, usize, usize) -> u8) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut writer = TiffWriter::new(&mut bytes, DIMS, 1.45e-6).unwrap();
    for z in 0..DIMS[2] {
        let page: Vec<u8> = (0..DIMS[0] * DIMS[1])
            .map(|i| label(i % DIMS[0], i / DIMS[0], z))
            .collect();
        writer.write_page(&page).unwrap();
    }
    writer.finish().unwrap();
    bytes
}

fn tool() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_xct2particles"));
    command.stdin(Stdio::null());
    command
}

fn run(arguments: &[&str]) -> Output {
    tool().args(arguments).output().unwrap()
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Runs, expects the exit status and each of `said` in one line on standard error.
fn refused(arguments: &[&str], status: i32, said: &[&str]) {
    let output = run(arguments);
    let sentence = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(
        output.status.code(),
        Some(status),
        "{arguments:?}: {sentence}"
    );
    for part in said {
        assert!(sentence.contains(part), "{arguments:?}: {sentence}");
    }
    assert!(!sentence.contains("panicked"), "{sentence}");
    assert!(output.stdout.is_empty());
}

fn counts(file: &ParticleFile) -> [u64; 2] {
    ["wood", "adhesive"].map(|name| file.block_named(name).unwrap().1.count())
}

#[test]
fn a_stack_becomes_two_blocks_with_counts_on_standard_error() {
    let (folder, stack) = folder();
    let target = folder.path().join("out.mpts");
    let output = run(&[text(&stack), "-o", text(&target)]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    // Voxel size from the file, labels guessed; a quarter of the voxels is adhesive.
    for part in [
        "1.450000 um, from ImageJ metadata",
        "guessed: void=0,wood=128,adhesive=255",
        "7000 voxels  0.500000",
        "3500 voxels  0.250000",
        "bond area   1471.8 um2",
        "over it 7.2500 um",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert!(output.stdout.is_empty());
    let file = ParticleFile::open(&target).unwrap();
    assert_eq!(counts(&file), [7000, 3500]);
    let (block, bits) = file.block_named("adhesive").unwrap();
    assert!((block.voxel_m - 1.45e-6).abs() < 1e-18);
    for (y, expected) in (0..DIMS[1]).map(|y| (y, label(y) == 255)) {
        assert_eq!(bits.get(69, y, 9), expected, "{y}");
    }
    let provenance = &file.header().provenance[0];
    assert_eq!(provenance.tool, "xct2particles");
    assert_eq!(provenance.inputs[0].0, text(&stack));
}

#[test]
fn standard_input_standard_output_and_crops() {
    let (_folder, stack) = folder();
    let whole = run(&["-q", text(&stack), "-o", "-"]);
    assert_eq!(whole.status.code(), Some(0));
    assert!(whole.stderr.is_empty());
    // A redirected file and a pipe.
    let crop = [
        "-",
        "--crop",
        "6:70,4:11,0:3",
        "--labels",
        LABELS,
        "-o",
        "-",
    ];
    let redirected = tool()
        .args(crop)
        .stdin(fs::File::open(&stack).unwrap())
        .output()
        .unwrap();
    let mut piped = tool()
        .args(crop)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let bytes = fs::read(&stack).unwrap();
    piped.stdin.take().unwrap().write_all(&bytes).unwrap();
    let piped = piped.wait_with_output().unwrap();
    assert_eq!(piped.status.code(), Some(0));
    assert_eq!(piped.stdout, redirected.stdout);
    let file = ParticleFile::from_bytes(&piped.stdout).unwrap();
    assert_eq!(counts(&file), [64 * 3, 64 * 5 * 3]);
    assert_eq!(file.header().attribute("crop"), Some("6:70,4:11,0:3"));
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let (folder, stack) = folder();
    let target = folder.path().join("out.mpts");
    let columns = |threads: &str| {
        let output = run(&[
            "-q",
            "--threads",
            threads,
            text(&stack),
            "-o",
            text(&target),
        ]);
        assert_eq!(output.status.code(), Some(0));
        let file = ParticleFile::open(&target).unwrap();
        ["wood", "adhesive"].map(|name| file.block_named(name).unwrap().1.words().to_vec())
    };
    assert_eq!(columns("1"), columns("2"));
}

#[test]
fn labels_and_voxel_size_that_nothing_states_are_asked_for() {
    let (folder, stack) = folder();
    let target = folder.path().join("out.mpts");
    // The resolution unit and the description begin with these bytes; blot them out.
    let mut bytes = fs::read(&stack).unwrap();
    let at = bytes.windows(7).position(|w| w == b"ImageJ=").unwrap();
    bytes[at..at + 7].copy_from_slice(b"Nothing");
    fs::write(&stack, &bytes).unwrap();
    refused(
        &[text(&stack), "-o", text(&target)],
        2,
        &["--voxel", "stack.tif"],
    );
    fs::write(&stack, stack_bytes(|_, y, z| label(y).max(z as u8))).unwrap();
    refused(
        &[text(&stack), "-o", text(&target)],
        2,
        &["--labels", "page 4 of 10", "holds 3"],
    );
    // 255 beside 0 may be either.
    fs::write(&stack, stack_bytes(|_, y, _| label(y) / 255 * 255)).unwrap();
    refused(
        &[text(&stack), "-o", text(&target)],
        2,
        &["--labels", "255"],
    );
    // 0 and 128 are undamaged wood.
    fs::write(&stack, stack_bytes(|_, y, _| label(y).min(128))).unwrap();
    let output = run(&[text(&stack), "-o", text(&target)]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.success() && said.contains("without adhesive"),
        "{said}"
    );
}

#[test]
fn a_voxel_size_against_the_files_own_is_taken_with_a_warning() {
    let (_folder, stack) = folder();
    let said = |edge: &str| {
        let output = run(&[text(&stack), "--voxel", edge, "-q", "-o", "/dev/null"]);
        assert_eq!(output.status.code(), Some(0));
        String::from_utf8(output.stderr).unwrap()
    };
    assert_eq!(said("1.45 um"), "");
    let warning = said("2.9 um");
    assert!(
        warning.contains("1.45 x 1.45 x 1.45 um; --voxel is taken"),
        "{warning}"
    );
}

#[test]
fn huge_declared_sizes_fit_into_little_memory() {
    let (folder, stack) = folder();
    let mut bytes = fs::read(&stack).unwrap();
    // Width (tag 256) and height (tag 257), type LONG, count 1, of the first page.
    for tag in [0_u8, 1] {
        let entry = [tag, 1, 4, 0, 1, 0, 0, 0];
        let at = bytes.windows(8).position(|w| w == entry).unwrap();
        bytes[at + 8..at + 12].copy_from_slice(&0x7fff_ffff_u32.to_le_bytes());
    }
    let target = folder.path().join("out.mpts");
    fs::write(&stack, bytes).unwrap();
    let limited = format!(
        "ulimit -v 400000; exec {} {} --threads 2 -o {}",
        env!("CARGO_BIN_EXE_xct2particles"),
        text(&stack),
        text(&target)
    );
    let output = Command::new("sh").args(["-c", &limited]).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.contains("page 1"), "{said}");
}

/// Undamaged wood: labels guessed or named, grey values given or proposed; two values that may be
/// wood or adhesive are not guessed.
#[test]
fn a_stack_without_adhesive_is_a_specimen_of_wood() {
    let folder = tempfile::tempdir().unwrap();
    let raw = |name: &str, wood: u8| {
        let path = folder.path().join(name);
        let voxels = (0..20 * 10 * 5).map(|i| if i / 20 % 10 < 6 { wood } else { 0 });
        fs::write(&path, voxels.collect::<Vec<u8>>()).unwrap();
        path
    };
    let (labels, mask) = (raw("labels.raw", 128), raw("mask.raw", 255));
    let target = folder.path().join("wood.mpts");
    let volume = ["--dims", "20x10x5", "--type", "u8", "--voxel", "1.45um"];
    for (path, more) in [
        (&labels, &[][..]),
        (&mask, &["--labels", "void=0,wood=255"]),
        (&mask, &["--grey", "wood=90.."]),
        (&mask, &["--grey", "auto-wood"]),
    ] {
        let start = [&[text(path)], &volume[..], more].concat();
        let output = run(&[&start[..], &["-o", text(&target)]].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{said}");
        assert!(said.contains("undamaged wood"), "{said}");
        let file = ParticleFile::open(&target).unwrap();
        assert_eq!(counts(&file), [600, 0], "{more:?}");
    }
    let refused = run(&[&[text(&mask)], &volume[..], &["-o", "-"]].concat());
    let said = String::from_utf8_lossy(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2), "{said}");
    assert!(said.contains("--labels"), "{said}");
}

#[test]
fn a_tilted_specimen_is_turned_level_and_told() {
    let folder = tempfile::tempdir().unwrap();
    let stack = folder.path().join("tilted.tif");
    // The bands rise by 0.05 along x, 0.0507 by the steps of their voxels: 2.90 degrees about z.
    let up = |x: usize| (0.05 * (x as f64 - 34.5)).round() as isize;
    let tilted = |x: usize, y: usize, _| label((y as isize - up(x)).clamp(0, 19) as usize);
    fs::write(&stack, stack_bytes(tilted)).unwrap();
    let target = folder.path().join("level.mpts");
    let output = run(&[text(&stack), "--level", "y", "-o", text(&target)]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert!(
        said.contains("turned by 0.00, 0.00 and 2.90 ")
            && said.contains("68 x 16 x 10 voxels are left"),
        "{said}"
    );
    let file = ParticleFile::open(&target).unwrap();
    assert_eq!(file.header().attribute("level"), Some("y"));
    let (block, bits) = file.block_named("adhesive").unwrap();
    assert_eq!(block.dims, [68, 16, 10]);
    // Five layers, but for the steps of the bands that turning does not make smooth.
    let layers = bits.counts_along(1);
    let full = layers.iter().filter(|count| **count > 600).count();
    let some = layers.iter().filter(|count| **count > 90).count();
    assert!(full >= 4 && some <= 6, "{layers:?}");
}

/// A slab of five layers was said to be 2.5 layers thick, and its file to have its bond across y.
#[test]
fn a_specimen_that_is_levelled_across_x_has_its_bond_there() {
    let folder = tempfile::tempdir().unwrap();
    let stack = folder.path().join("across.tif");
    let across = |x: usize, _, _| {
        [128, 255, 128, 0][(x >= 30) as usize + (x >= 35) as usize + (x == 69) as usize]
    };
    fs::write(&stack, stack_bytes(across)).unwrap();
    let target = folder.path().join("level.mpts");
    let output = run(&[text(&stack), "--level", "x", "-o", text(&target)]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let area = "bond area   420.5 um2 (y times z), adhesive volume over it 7.2500 um";
    assert!(said.contains(area), "{said}");
    assert!(said.contains("turned by 0.00, 0.00 and 0.00"), "{said}");
    assert_eq!(ParticleFile::open(&target).unwrap().header().normal, 0);
    let other = [text(&stack), "--level", "y", "-o", "-"];
    refused(
        &other,
        2,
        &["--level y: the bond lies across x, not across y"],
    );
}
