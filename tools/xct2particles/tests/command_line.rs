//! The tool as a process: exit statuses, sentences, outputs that are whole or absent.

use std::fs;
use std::io::{Read, Write};
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
fn wrong_usage_is_exit_2() {
    let (folder, stack) = folder();
    let target = folder.path().join("out.mpts");
    let case = |arguments: &[&str], said: &[&str]| {
        let mut all = vec![text(&stack), "-o", text(&target)];
        all.extend(arguments);
        refused(&all, 2, said);
        assert!(!target.exists(), "{arguments:?}");
    };
    case(
        &["--labels", "wood=128,adhesive=255"],
        &["no label is given for void"],
    );
    case(
        &["--labels", "void=0,wood=7,adhesive=255"],
        &["page 1 of 10", "column 0, row 0", "holds 128"],
    );
    case(
        &["--labels", "void=0,wood=1:2:3,adhesive=255"],
        &["holds 128"],
    );
    case(
        &["--labels", LABELS, "--grey", "wood=1..2,adhesive=3.."],
        &["cannot be used with"],
    );
    case(&["--grey", "adhesive=1..2"], &["wood"]);
    case(&["--crop", "0:71,0:20,0:10"], &["along x", "70 voxels"]);
    case(&["--crop", "0:7"], &["x0:x1,y0:y1,z0:z1"]);
    case(&["--voxel", "1.45"], &["no unit", "um"]);
    case(&["--voxel", "-1.45 um"], &["greater than zero"]);
    case(&["--unheard-of"], &["--unheard-of"]);
    refused(&["-o", text(&target)], 2, &["STACK"]);
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
fn unreadable_data_is_exit_3() {
    let (folder, stack) = folder();
    let target = folder.path().join("out.mpts");
    let case = |stack: &Path, said: &[&str]| {
        refused(&[text(stack), "-o", text(&target)], 3, said);
        assert!(!target.exists());
    };
    case(&folder.path().join("missing.tif"), &["missing.tif"]);
    let bytes = fs::read(&stack).unwrap();
    let cut = folder.path().join("cut.tif");
    fs::write(&cut, &bytes[..bytes.len() - 1]).unwrap();
    case(&cut, &["cut.tif', page 10", "truncated"]);
    fs::write(&cut, b"PK\x03\x04").unwrap();
    case(&cut, &["its archive cannot be read"]);
    fs::write(&cut, b"PK").unwrap();
    case(&cut, &["it is not a stack"]);
    fs::write(&cut, b"").unwrap();
    case(&cut, &["it is not a stack"]);
    let empty = folder.path().join("empty");
    fs::create_dir(&empty).unwrap();
    case(&empty, &["no slices"]);
    refused(&["-", "-o", text(&target)], 3, &["standard input"]);
}

#[test]
fn outputs_that_cannot_be_written_are_exit_1_and_leave_nothing() {
    let (folder, stack) = folder();
    refused(&[text(&stack), "-o", "/dev/full"], 1, &["/dev/full"]);
    refused(
        &[text(&stack), "-o", "/proc/none/out.mpts"],
        1,
        &["/proc/none/out.mpts"],
    );
    refused(&[text(&stack), "-o", text(folder.path())], 1, &["folder"]);
    let full = tool()
        .args([text(&stack), "-o", "-"])
        .stdout(fs::File::options().write(true).open("/dev/full").unwrap())
        .output()
        .unwrap();
    assert_eq!(full.status.code(), Some(1));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn a_closed_pipe_ends_quietly() {
    // Larger than a pipe's buffer, so that the tool is still writing when it closes.
    let folder = tempfile::tempdir().unwrap();
    let stack = folder.path().join("large.tif");
    let dims = [640, 640, 20];
    let mut writer = TiffWriter::new(fs::File::create(&stack).unwrap(), dims, 1e-6).unwrap();
    for z in 0..dims[2] {
        writer
            .write_page(&vec![[0, 1, 2][z % 3]; 640 * 640])
            .unwrap();
    }
    writer.finish().unwrap();
    let mut child = tool()
        .args(["-q", text(&stack), "-o", "-"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = [0; 8];
    let mut pipe = child.stdout.take().unwrap();
    pipe.read_exact(&mut first).unwrap();
    drop(pipe);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty());
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

#[test]
fn help_version_and_man_page() {
    for (argument, part) in [
        ("--help", "Examples:"),
        ("--version", "xct2particles "),
        ("--generate=man", ".TH"),
    ] {
        let output = run(&[argument]);
        assert_eq!(output.status.code(), Some(0), "{argument}");
        assert!(
            String::from_utf8_lossy(&output.stdout).contains(part),
            "{argument}"
        );
    }
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
