//! Flow across rods of voxels, against that of ever finer cells.

#![allow(clippy::print_stdout, reason = "prints for developers")]

#[path = "common/plain.rs"]
mod plain;

use implicit::{Implicit, Settings};
use physics::{Boundary, Motion, Scene, Scheme, StepLimit, VoxelBlock};

/// Edge of a voxel, m, and voxels between the axes of rods.
const VOXEL: f64 = 2e-6;
const PITCH: usize = 12;
const PULL: f64 = 1e3;

/// Rods along z, square or round, so many voxels thick, in a square array; cells of `finer` to a voxel.
fn scene(thick: f64, round: bool, finer: usize) -> Scene {
    let solid = |i: usize, j: usize| {
        let off = |i: usize| (i as f64 + 0.5 - 0.5 * PITCH as f64).abs();
        match round {
            true => off(i).hypot(off(j)) < 0.5 * thick,
            false => off(i).max(off(j)) < 0.5 * thick,
        }
    };
    let cell = VOXEL / finer as f64;
    let n = PITCH * finer;
    let mut scene = plain::scene(cell, [n, n, 1]);
    let size = [VOXEL, VOXEL, cell];
    let rod = VoxelBlock::from_fn([0.0; 3], size, [PITCH, PITCH, 1], |i, j, _| solid(i, j));
    scene.bodies = vec![plain::body("rod", vec![rod], Motion::Fixed)];
    for (i, j) in (0..PITCH * PITCH)
        .map(|at| (at % PITCH, at / PITCH))
        .filter(|&(i, j)| !solid(i, j))
    {
        let low = [i as f64 * VOXEL, j as f64 * VOXEL, 0.0];
        let points = plain::fill(low, [cell; 3], [finer, finer, 1]);
        scene.points.position.extend(points.position);
        scene.points.velocity.extend(points.velocity);
        scene.points.volume.extend(points.volume);
    }
    scene.boundary[0] = Boundary::Periodic;
    scene.boundary[1] = Boundary::Periodic;
    scene.gravity = [PULL, 0.0, 0.0];
    scene
}

/// Mean velocity by the power of the weight.
fn speed(thick: f64, round: bool, finer: usize) -> f64 {
    let settings = Settings {
        tolerance: 1e-7,
        ..Settings::default()
    };
    let scene = scene(thick, round, finer);
    let mut scheme = Implicit::new(&scene, settings).unwrap();
    let limit = StepLimit {
        time_s: 1e-3,
        travel_m: f64::INFINITY,
    };
    scheme.advance(limit).unwrap();
    scheme.diagnostics().viscous_power / (scene.liquid.density * PULL * scene.liquid_volume())
}

#[test]
fn flow_across_rods_of_voxels_is_that_of_finer_cells() {
    for round in [false, true] {
        for thick in [2.0, 4.0, 6.0, 8.0, 10.0] {
            let [one, two, coarse, fine] = [1, 2, 4, 8].map(|finer| speed(thick, round, finer));
            // Past corners differences have the error h^1.09.
            let reference = fine + (fine - coarse) / (2.0_f64.powf(1.09) - 1.0);
            let [one, two, four] = [one, two, coarse].map(|v| v / reference - 1.0);
            println!(
                "round {round}, {thick} of {PITCH} voxels: {:+.2} %, finer {:+.2} {:+.2}",
                100.0 * one,
                100.0 * two,
                100.0 * four
            );
            // Between the thickest are two cells.
            assert!(one.abs() < if thick < 9.0 { 0.04 } else { 0.08 });
            assert!(four.abs() < 0.01);
        }
    }
}
