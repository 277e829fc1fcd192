//! Steady flow in straight channels against closed forms, at every offset of the walls
//! against the cells. Run with `--nocapture` to see the errors.

use super::flow::{Flow, duct, tube_of_voxels, tube_off, worst};
use super::staircase;
use crate::system::WidthRule;
use physics::VoxelBlock;

/// Flux through a plane channel of `n` cells whose lower wall is at `offset`, over the exact
/// one n^3/12 (1 + 6 l/n) per body force, with influence length `slip` in cells.
fn plane_channel(n: f64, offset: f64, slip: f64) -> f64 {
    let height = n as usize + 6;
    let low = 2.0 + offset;
    let walls = vec![
        VoxelBlock::solid_box([-9.0, -9.0, 0.0], [20.0, low, 1.0]),
        VoxelBlock::solid_box([-9.0, low + n, 0.0], [20.0, 99.0, 1.0]),
    ];
    let mut flow = Flow::new([4, height, 1], 2, vec![walls]);
    flow.slip = slip;
    let exact = n.powi(3) / 12.0 * (1.0 + 6.0 * slip / n);
    flow.periodic_flux() / exact
}

#[test]
fn plane_channel_flux_at_every_offset() {
    for (n, tolerance) in [(3.0, 0.01), (6.0, 0.001), (12.0, 0.001)] {
        for slip in [0.0, 0.01, 1.0] {
            let error = worst((0..20).map(|i| plane_channel(n, 0.05 * f64::from(i), slip) - 1.0));
            println!("channel of {n} cells, influence length {slip}: flux error {error:+.4}");
            assert!(error.abs() < tolerance, "{n} cells, slip {slip}: {error}");
        }
    }
}

/// Passages of one and two voxels of half a cell, also where their walls go through the centres
/// of faces.
#[test]
fn passages_of_one_and_two_voxels() {
    for (width, offsets, tolerance) in [(1.0, [0.0, 0.5], 0.01), (0.5, [0.0, 0.5], 0.01)] {
        for offset in offsets {
            let flat = plane_channel(width, offset, 0.0) - 1.0;
            println!("passage of {width} cells, offset {offset}: flux error {flat:+.4}");
            assert!(flat.abs() < tolerance, "{width} at {offset}: {flat}");
        }
    }
    // The walls one cell apart are exact; what is left comes from the other two.
    for (offset, tolerance) in [([0.0; 2], 0.09), ([0.5, 0.0], 0.01), ([0.5, 0.5], 0.07)] {
        let error = duct(1.0, 4.0, offset) - 1.0;
        println!("duct of 1 x 4 cells, walls off by {offset:?}: flux error {error:+.4}");
        assert!(error.abs() < tolerance, "{offset:?}: {error}");
    }
}

/// A channel whose liquid has dried in a sixth of it beside each wall: the rest of n cells flows as between walls, n^3/12, but for the
/// 2/n^2 that means over cells are off where they meet layers of next to no speed. By the mean of four viscosities instead of
/// that of their inverses the next cells would stand too, with four left a flux 62 % too small.
#[test]
fn liquid_flows_between_layers_that_have_dried() {
    for n in [4.0, 8.0] {
        let (layer, middle) = (0.25 * n, 2.0 + 0.75 * n);
        let walls = vec![
            VoxelBlock::solid_box([-9.0, -9.0, 0.0], [20.0, 2.0, 1.0]),
            VoxelBlock::solid_box([-9.0, 2.0 * middle - 2.0, 0.0], [20.0, 99.0, 1.0]),
        ];
        let mut flow = Flow::new([4, (2.0 * middle) as usize, 1], 2, vec![walls]);
        flow.factor = Some(Box::new(move |at: [f64; 3]| {
            match (at[1] - middle).abs() > middle - 2.0 - layer {
                true => 1e6,
                false => 1.0,
            }
        }));
        let error = flow.periodic_flux() / (n.powi(3) / 12.0) - 1.0;
        println!("{n} cells between layers a million times as thick: flux error {error:+.4}");
        assert!((error - 2.0 / (n * n)).abs() < 0.002, "{error}");
    }
}

/// The same channel with other walls' distances would miss by far more than the tolerance.
#[test]
fn a_wall_a_quarter_cell_off_is_seen() {
    let moved = plane_channel(6.25, 0.0, 0.0) * (6.25_f64 / 6.0).powi(3);
    assert!((moved - 1.13).abs() < 0.01, "{moved}");
}

#[test]
fn rectangular_ducts() {
    for (a, b, tolerance) in [
        (6.0, 6.0, 0.01),
        (3.0, 3.0, 0.05),
        (3.0, 12.0, 0.01),
        (12.0, 12.0, 0.005),
    ] {
        for offset in [[0.0, 0.0], [0.25, 0.125], [0.5, 0.25], [0.75, 0.375]] {
            let error = duct(a, b, offset) - 1.0;
            println!("duct {a} x {b} cells, walls off by {offset:?}: flux error {error:+.4}");
            assert!(error.abs() < tolerance, "{a} x {b}, {offset:?}: {error}");
        }
    }
}

/// Tubes of voxels against finite differences in the same staircase, at sixteen places.
#[test]
fn round_tubes_of_voxels() {
    let quarters = [0.0, 0.25, 0.5, 0.75];
    // Of the mean over the places and of the worst one.
    for (voxel, rule, tolerances) in [
        (
            1.0,
            WidthRule::Combined,
            [[0.04, 0.10], [0.02, 0.03], [0.01, 0.02]],
        ),
        (
            0.5,
            WidthRule::Normal,
            [[0.04, 0.10], [0.02, 0.03], [0.02, 0.03]],
        ),
    ] {
        for (radius, [tolerance, limit]) in [1.5, 3.0, 6.0].into_iter().zip(tolerances) {
            let errors: Vec<f64> = (quarters.iter())
                .flat_map(|&y| quarters.map(|z| [y, z]))
                .map(|shift| tube_of_voxels(radius, shift, voxel, rule) - 1.0)
                .collect();
            let n = errors.len() as f64;
            let mean = errors.iter().sum::<f64>() / n;
            let spread = (errors.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / n).sqrt();
            let largest = worst(errors);
            println!(
                "tube of radius {radius} cells, voxel {voxel} cells: flux error {mean:+.3} +- {spread:.3} over {n} places, {largest:+.3} at worst"
            );
            assert!(
                mean.abs() < tolerance && largest.abs() < limit,
                "{mean}, {largest}"
            );
        }
    }
}

/// The same with the voxels off the cells by any part of a cell: per offset along y and z, mean errors of the
/// sixteen places in tubes of 3, 6 and 12 cells.
#[test]
fn tubes_of_voxels_off_the_cells() {
    let quarters = [0.0, 0.25, 0.5, 0.75];
    for (voxel, rule, offsets) in [
        (
            1.0,
            WidthRule::Combined,
            &[
                ([0.0, 0.0], [0.05, 0.02, 0.01]),
                ([0.125, 0.125], [0.05, 0.02, 0.01]),
                ([0.25, 0.0], [0.05, 0.03, 0.01]),
                ([0.25, 0.25], [0.05, 0.03, 0.01]),
                ([0.375, 0.375], [0.20, 0.05, 0.03]),
                ([0.5, 0.0], [0.05, 0.02, 0.015]),
                ([0.5, 0.5], [0.07, 0.03, 0.02]),
            ][..],
        ),
        (
            0.5,
            WidthRule::Normal,
            &[
                ([0.125, 0.125], [0.05, 0.06, 0.04]),
                ([0.25, 0.0], [0.10, 0.02, 0.01]),
                ([0.25, 0.25], [0.16, 0.04, 0.01]),
            ],
        ),
    ] {
        for (off, tolerances) in offsets {
            let means = [1.5, 3.0, 6.0].map(|radius| {
                let places = quarters.iter().flat_map(|&y| quarters.map(|z| [y, z]));
                let errors = places.map(|at| tube_off(radius, at, *off, voxel, rule) - 1.0);
                errors.sum::<f64>() / 16.0
            });
            println!("tubes, voxel {voxel} cells, off by {off:?}: flux errors {means:+.4?}");
            for (mean, tolerance) in means.iter().zip(tolerances) {
                assert!(mean.abs() < *tolerance, "{voxel} {off:?}: {means:?}");
            }
        }
    }
}

/// A square duct of 8 cells with a quarter of it solid, which has one re-entrant edge, at offsets in all of the
/// ranges in which columns of faces meet its walls in other ways.
#[test]
fn one_edge_in_a_duct_of_voxels() {
    let inside =
        |j: usize, k: usize| (2..10).contains(&j) && (2..10).contains(&k) && !(j < 6 && k < 6);
    let exact = staircase::flux(12, inside);
    let (mut worst_error, mut sum) = (0.0_f64, 0.0);
    for y in [0.0, 0.2, 0.4, 0.6, 0.8] {
        for z in [0.0, 0.2, 0.4, 0.6, 0.8] {
            let block = VoxelBlock::from_fn(
                [-99.0, y - 2.0, z - 2.0],
                [999.0, 1.0, 1.0],
                [1, 16, 16],
                |_, j, k| j < 2 || k < 2 || !inside(j - 2, k - 2),
            );
            let mut flow = Flow::new([3, 12, 12], 3, vec![vec![block]]);
            let error = flow.periodic_flux() / exact - 1.0;
            println!("duct with an edge, off by {y}, {z}: flux error {error:+.4}");
            worst_error = worst_error.max(error.abs());
            sum += error.abs() / 25.0;
        }
    }
    println!("mean error {sum:.4}, {worst_error:.4} at worst");
    assert!(worst_error < 0.03 && sum < 0.012, "{worst_error}, {sum}");
}
