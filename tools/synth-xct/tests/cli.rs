//! The command line of synth-xct: exit statuses, the file it writes, its label.

use std::path::Path;
use std::process::{Command, Output};

fn synth(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_synth-xct"))
        .args(arguments)
        .output()
        .unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

const SMALL: [&str; 6] = ["--adhesive", "pf", "--size", "40x64x32", "--seed", "3"];

fn grow(folder: &Path, name: &str, more: &[&str]) -> (Vec<u8>, String) {
    let path = folder.join(name);
    let mut arguments = SMALL.to_vec();
    arguments.extend_from_slice(more);
    arguments.extend(["-o", path.to_str().unwrap()]);
    let output = synth(&arguments);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    (std::fs::read(path).unwrap(), said(&output))
}

#[test]
fn the_stack_reads_back_with_its_voxel_size_and_only_the_three_labels() {
    let folder = tempfile::tempdir().unwrap();
    let (bytes, report) = grow(folder.path(), "a.tif", &[]);
    assert!(report.contains("SYNTHETIC"), "{report}");
    assert!(report.contains("porosity"), "{report}");
    let stack = voxels::Stack::open(&[folder.path().join("a.tif")]).unwrap();
    assert_eq!(stack.dims(), [40, 64, 32]);
    let edge = stack.voxel_size().unwrap().cube_edge().unwrap();
    assert!((edge - 1.45e-6).abs() < 1e-12, "{edge}");
    let pixels = &bytes[bytes.len() - 40 * 64 * 32..];
    let count = |label: u8| pixels.iter().filter(|&&p| p == label).count();
    let [void, wood, adhesive] = [0, 128, 255].map(count);
    println!("void {void}, wood {wood}, adhesive {adhesive}");
    assert_eq!(void + wood + adhesive, pixels.len());
    // 64 rows of 1.45 um over six, in whole cells of two voxels: 10 voxels of slab.
    assert_eq!(adhesive, 10 * 40 * 32);
    let note = b"SYNTHETIC hybrid poplar";
    assert!(bytes.windows(note.len()).any(|w| w == note));
    assert!(folder.path().join("a.tif.provenance.json").exists());
}

#[test]
fn the_same_arguments_give_the_same_bytes_for_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let (one, _) = grow(folder.path(), "one.tif", &["--threads", "1"]);
    let (two, _) = grow(folder.path(), "two.tif", &["--threads", "2"]);
    assert_eq!(one, two);
    let mut arguments = SMALL.to_vec();
    arguments.extend(["-q", "-o", "-"]);
    let piped = synth(&arguments);
    assert_eq!(piped.stdout, one);
    assert_eq!(said(&piped), "");
}

#[test]
fn the_stack_names_the_grain_angle_that_was_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let (bytes, _) = grow(folder.path(), "a.tif", &["--grain-angle", "10 deg"]);
    let note = b"adhesive, grain angle 10.000 deg (not a scan)";
    assert!(bytes.windows(note.len()).any(|w| w == note));
    let steep = [&SMALL[..], &["--grain-angle", "30.0001 deg", "-o", "-"]].concat();
    let output = synth(&steep);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        said(&output).contains("grain angle of 30.0001 degrees"),
        "{}",
        said(&output)
    );
}
