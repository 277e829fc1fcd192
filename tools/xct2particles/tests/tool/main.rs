//! The tool as a process: exit statuses, sentences, outputs that are whole or absent. Formats are tested in `lib/voxels`.

mod grey_values;
mod looked_at;
mod stacks;
#[path = "../../../workbench.rs"]
mod workbench;

use std::path::Path;

use particle_file::ParticleFile;
use voxels::TiffWriter;
use workbench::Bench;

fn bench() -> Bench {
    Bench::new(env!("CARGO_BIN_EXE_xct2particles"))
}

/// A folder with `acer.tif`, the bond of maple of the examples.
fn with_acer() -> Bench {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let acer = top.join("pipelines/examples/acer/bondline-acer-64x192x128.tif");
    let bench = bench();
    std::os::unix::fs::symlink(acer, bench.path("acer.tif")).unwrap();
    bench
}

/// What a run of this line says, which ends with this status and has these parts.
#[track_caller]
fn told(bench: &Bench, line: &str, status: i32, parts: &[&str]) -> String {
    let ended = parts
        .iter()
        .fold(bench.run(line).refused(status, ""), |ended, part| {
            ended.refused(status, part)
        });
    assert!(!ended.said.contains("panicked"), "{}", ended.said);
    assert!(ended.stdout.is_empty() || status == 0);
    ended.said
}

fn open(bench: &Bench, name: &str) -> ParticleFile {
    ParticleFile::open(bench.path(name)).unwrap()
}

/// A TIFF with voxels of 1.45 um.
fn tiff([nx, ny, nz]: [usize; 3], label: impl Fn(usize, usize, usize) -> u8) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut writer = TiffWriter::new(&mut bytes, [nx, ny, nz], 1.45e-6, "").unwrap();
    for z in 0..nz {
        let page: Vec<u8> = (0..nx * ny).map(|i| label(i % nx, i / nx, z)).collect();
        writer.write_page(&page).unwrap();
    }
    writer.finish().unwrap();
    bytes
}

/// Voxels of wood and adhesive.
fn counts(file: &ParticleFile) -> [u64; 2] {
    ["wood", "adhesive"].map(|name| file.block_named(name).unwrap().1.count())
}

/// Which voxels are wood and adhesive.
fn bits(file: &ParticleFile) -> [Vec<u64>; 2] {
    ["wood", "adhesive"].map(|name| file.block_named(name).unwrap().1.words().to_vec())
}
