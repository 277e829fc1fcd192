//! The command line of synth-xct: exit statuses, the file it writes, its label.

#[path = "../../workbench.rs"]
mod workbench;

use workbench::Bench;

fn bench() -> Bench {
    Bench::new(env!("CARGO_BIN_EXE_synth-xct"))
}

const SMALL: &str = "--adhesive pf --size 40x64x32 --seed 3";

fn grow(bench: &Bench, name: &str, more: &str) -> (Vec<u8>, String) {
    let said = bench.run(&format!("{SMALL} {more} -o {name}")).done().said;
    (bench.read(name), said)
}

fn contains(bytes: &[u8], note: &str) -> bool {
    bytes.windows(note.len()).any(|w| w == note.as_bytes())
}

#[test]
fn the_stack_reads_back_with_its_voxel_size_and_only_the_three_labels() {
    let bench = bench();
    let (bytes, report) = grow(&bench, "a.tif", "");
    for word in ["SYNTHETIC", "porosity"] {
        assert!(report.contains(word), "{report}");
    }
    let stack = voxels::Stack::open(&[bench.path("a.tif")]).unwrap();
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
    assert!(contains(&bytes, "SYNTHETIC hybrid poplar"));
    assert!(bench.path("a.tif.provenance.json").exists());
}

#[test]
fn the_stack_names_the_grain_angle_that_was_asked_for() {
    let bench = bench();
    let (bytes, _) = grow(&bench, "a.tif", "--grain-angle 10deg");
    assert!(contains(
        &bytes,
        "adhesive, grain angle 10.000 deg (not a scan)"
    ));
    let steep = bench.run(&format!("{SMALL} --grain-angle 30.0001deg -o -"));
    steep.refused(2, "grain angle of 30.0001 degrees");
}
