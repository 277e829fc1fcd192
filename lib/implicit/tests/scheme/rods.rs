//! Flow across rods of voxels, against that of ever finer cells.

use physics::{Boundary, Scene, VoxelBlock};

use crate::plain;
use crate::runs::{advance, append, driven, mean_velocity, solved};

/// Edge of a voxel, m, and voxels between the axes of rods.
const VOXEL: f64 = 2e-6;
const PITCH: usize = 12;

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
    let mut scene = plain::scene(cell, [PITCH * finer, PITCH * finer, 1]);
    scene.boundary[1] = Boundary::Periodic;
    let size = [VOXEL, VOXEL, cell];
    let rod = VoxelBlock::from_fn([0.0; 3], size, [PITCH, PITCH, 1], |i, j, _| solid(i, j));
    for (i, j) in (0..PITCH * PITCH).map(|at| (at % PITCH, at / PITCH)) {
        if !solid(i, j) {
            let low = [i as f64 * VOXEL, j as f64 * VOXEL, 0.0];
            let points = plain::fill(low, [cell; 3], [finer, finer, 1]);
            append(&mut scene.points, points);
        }
    }
    driven(scene, vec![rod], 1e3)
}

#[test]
fn flow_across_rods_of_voxels_is_that_of_finer_cells() {
    for round in [false, true] {
        for thick in [2.0, 4.0, 6.0, 8.0, 10.0] {
            let [one, two, coarse, fine] = [1, 2, 4, 8].map(|finer| {
                let scene = scene(thick, round, finer);
                let mut scheme = solved(&scene, 1e-7);
                advance(&mut scheme, 1e-3);
                mean_velocity(&scene, &scheme)
            });
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
