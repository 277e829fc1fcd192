//! Particle files to try the tool on, and the tool itself.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material};

/// Voxel edge, m.
pub const VOXEL: f64 = 1.5e-6;
/// Voxels of each adherend.
pub const DIMS: [usize; 3] = [70, 4, 3];

/// Whether a voxel of an adherend is wood.
pub fn is_wood(x: usize, y: usize, z: usize) -> bool {
    (x + 2 * y + 3 * z).is_multiple_of(5)
}

/// A state at `step` microseconds: the upper adherend comes down by a quarter voxel per step
/// from two voxels above the lower one; three liquid points of a
/// voxel's volume each lie between them.
pub fn state(folder: &Path, step: u64) -> PathBuf {
    let wood = BitGrid::from_fn(DIMS, is_wood);
    let mut header = Header::new(Kind::State, VOXEL, 1, [0.0; 3], [1.05e-4, 1.5e-5, 4.5e-6]);
    (header.step, header.time_s) = (step, step as f64 * 1e-6);
    let block = |name, low| Block::new(name, Material::Rigid, [0.0, low, 0.0], VOXEL, &wood);
    let top = (6.0 - 0.25 * step as f64) * VOXEL;
    // Voxels (1, 4, 0), (2, 4, 0) and (69, 5, 2).
    let place = [[1.5, 4.5, 0.5], [2.25, 4.75, 0.25], [69.5, 5.5, 2.5]];
    let position: Vec<f32> = place.iter().flatten().map(|x| (x * VOXEL) as f32).collect();
    let path = folder.join(format!("{step:04}.mpts"));
    Draft::new(header)
        .block(block("wood-bottom", 0.0), &wood)
        .block(block("wood-top", top), &wood)
        .column("position", 3, &position)
        .column("volume", 1, &[3.3e-18_f32, 3.4e-18, 3.5e-18])
        .column("pressure", 1, &[0.0_f32, -1.5, 2.5e6])
        .write_to(&mut File::create(&path).unwrap())
        .unwrap();
    path
}

/// Runs the tool in `folder`.
pub fn particles(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_particles"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

/// Runs the tool, which must succeed, and gives its standard output.
pub fn stdout(folder: &Path, arguments: &[&str]) -> String {
    let output = particles(folder, arguments);
    assert!(
        output.status.success(),
        "{arguments:?}: {}",
        stderr(&output)
    );
    String::from_utf8(output.stdout).unwrap()
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}
