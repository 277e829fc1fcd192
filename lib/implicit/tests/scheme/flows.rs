//! Liquid in free flight, and liquid driven across rods by its weight.

use physics::{Boundary, Motion, Scheme, VoxelBlock, WallLaw};

use crate::plain;
use crate::runs::{advance, solved};

/// Liquid in free flight keeps its velocity, but for the tiny friction that every face has.
#[test]
fn liquid_that_nothing_holds_keeps_its_velocity() {
    let (h, speed) = (1e-6, 0.25);
    let mut scene = plain::scene(h, [8, 8, 1]);
    scene.points = plain::fill([0.0, 2.0 * h, 0.0], [0.5 * h, 0.5 * h, h], [16, 6, 1]);
    scene.points.velocity.fill([speed, 0.0, 0.0]);
    scene.boundary[0] = Boundary::Periodic;
    scene.wall = WallLaw::Frictionless;
    let mut scheme = solved(&scene, 1e-6);
    (0..3).for_each(|_| _ = advance(&mut scheme, 1e-5));
    assert_eq!(scheme.objection(), None);
    for v in scheme.liquid().velocity {
        let off = [f64::from(v[0]) - speed, f64::from(v[1])].map(f64::abs);
        assert!(off[0] < 5e-4 && off[1] < 1e-5, "{v:?}");
    }
}

/// Mean velocity across square rods of six voxels every twelve in plane strain, in cells of `finer` to a voxel: by the power that
/// the weight gives off, for points sample the profile.
fn across_rods(finer: usize) -> f64 {
    let (voxel, n) = (2e-6, 12 * finer);
    let cell = voxel / finer as f64;
    let mut scene = plain::scene(cell, [n, n, 1]);
    (scene.boundary[0], scene.boundary[1]) = (Boundary::Periodic, Boundary::Periodic);
    scene.gravity[0] = 1e3;
    let [low, high] = [3.0, 9.0].map(|at| at * voxel);
    let rod = VoxelBlock::solid_box([low, low, 0.0], [high, high, cell]);
    scene.bodies = vec![plain::body("rod", vec![rod], Motion::Fixed)];
    let points = &mut scene.points;
    *points = plain::fill([0.0; 3], [cell; 3], [n, n, 1]);
    let within = |x: f64| (low..high).contains(&x);
    (points.position).retain(|x| !(within(x[0]) && within(x[1])));
    points.velocity.truncate(points.position.len());
    points.volume.truncate(points.position.len());
    let mut scheme = solved(&scene, 1e-7);
    advance(&mut scheme, 1e-3);
    let found = scheme.diagnostics();
    found.viscous_power / (scene.liquid.density * scene.gravity[0] * found.volume)
}

/// Past corners the discretisation error is of order h^1.09. Rods of other sizes, in three dimensions: permeability.rs.
#[test]
fn flow_across_rods_in_plane_strain_is_that_of_finer_cells() {
    let [one, coarse, fine] = [1, 4, 8].map(across_rods);
    let reference = fine + (fine - coarse) / (2.0_f64.powf(1.09) - 1.0);
    let [one, four] = [one, coarse].map(|v| v / reference - 1.0);
    println!("rods in plane strain: one cell a voxel {one:+.4}, four {four:+.4}");
    assert!(one.abs() < 0.04 && four.abs() < 0.01);
}
