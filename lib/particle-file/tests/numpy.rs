//! The NumPy reader in readers/python agrees with the library, where Python and NumPy exist.

use std::path::Path;
use std::process::Command;

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material};

/// Prints what a wrong order of axes, rows or bytes would change.
const SCRIPT: &str = "
import sys, numpy, mpts
head, arrays = mpts.read(sys.argv[1])
print(head['kind'], head['step'], head['particles'], head['attributes']['gap_m'])
for name, a in arrays.items():
    weights = numpy.arange(1, a.size + 1)
    print(name, a.dtype, a.shape, int(a.ravel().astype(numpy.int64) @ weights))
";

#[test]
fn numpy_reads_what_was_written() {
    let works = |c: &mut Command| c.output().is_ok_and(|o| o.status.success());
    if !works(Command::new("python3").args(["-c", "import numpy"])) {
        println!("skipped: python3 with numpy is not installed here");
        return;
    }
    let dims = [70, 3, 2];
    let wood = BitGrid::from_fn(dims, |x, y, z| (3 * x + 5 * y + 7 * z) % 4 == 0);
    let position: Vec<f32> = (0..15).map(|i| (i * i) as f32).collect();
    let label: Vec<u32> = (0..5).map(|i| 1_000_000 * i).collect();
    let mut header = Header::new(Kind::State, 1.45e-6, 2, [0.0; 3], [1e-4; 3]);
    header.step = 42;
    header.set_attribute("gap_m", 1.5e-5);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("state.mpts");
    let block = Block::new("wood-top", Material::Rigid, [0.0; 3], 1.45e-6, &wood);
    Draft::new(header)
        .block(block, &wood)
        .column("position", 3, &position)
        .column("label", 1, &label)
        .blob("notes", &[9, 8, 7])
        .write_to(&mut std::fs::File::create(&path).unwrap())
        .unwrap();

    let line = |array: &str, values: Vec<i64>| {
        let weighted: i64 = (1..).zip(values).map(|(i, v)| i * v).sum();
        format!("{array} {weighted}")
    };
    let [nx, ny, nz] = dims;
    let voxels = (0..nx * ny * nz).map(|i| i64::from(wood.get(i % nx, i / nx % ny, i / nx / ny)));
    let positions = position.iter().map(|&x| x as i64).collect();
    let expected = [
        "2 42 5 0.000015".to_owned(),
        line("wood-top bool (2, 3, 70)", voxels.collect()),
        line("position float32 (5, 3)", positions),
        line(
            "label uint32 (5, 1)",
            label.iter().map(|&x| x.into()).collect(),
        ),
        line("notes uint8 (3, 1)", vec![9, 8, 7]),
    ];
    let readers = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../readers/python/bondline");
    let output = Command::new("python3")
        .args(["-c", SCRIPT])
        .arg(&path)
        .env("PYTHONPATH", readers)
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(said.lines().collect::<Vec<_>>(), expected, "{errors}");
}
