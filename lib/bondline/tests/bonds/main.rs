//! Bonds before pressing with known results.

mod build;
mod lay_up;

use bondline::{Bond, Error, Opening, PlacedVoxels};
use particle_file::BitGrid;
use units::Axis;

const VOXEL: f64 = 1.45e-6;

fn opening(normal: Axis) -> Opening {
    Opening {
        normal,
        voxels_per_cell: 2,
        gap_m: None,
        tolerance: 0.05,
    }
}

fn placed(grid: &BitGrid) -> PlacedVoxels<'_> {
    PlacedVoxels::at_origin(grid.view(), VOXEL)
}

#[track_caller]
fn refused(found: Result<Bond, Error>, said: &str) {
    let error = found.unwrap_err().to_string();
    assert!(error.contains(said), "{error}");
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-6 * VOXEL
}
