//! Scenes that the grid cannot hold are refused.

#[path = "common/plain.rs"]
mod plain;

use implicit::{Implicit, Settings};
use physics::{Boundary, Motion, RigidBody, Scene, VoxelBlock};

/// Liquid between a floor and a plate in 8 x 8 cells of 1 m, with one more body.
fn refusal(plate: Motion, low: [f64; 2], high: [f64; 2], motion: Motion) -> Option<String> {
    let block = |low: [f64; 2], high: [f64; 2]| {
        vec![VoxelBlock::solid_box(
            [low[0], low[1], 0.0],
            [high[0], high[1], 1.0],
        )]
    };
    let bodies: Vec<RigidBody> = vec![
        plain::body("floor", block([0.0, 0.0], [8.0, 1.0]), Motion::Fixed),
        plain::body("plate", block([0.0, 6.0], [6.0, 7.0]), plate),
        plain::body("other", block(low, high), motion),
    ];
    let scene = Scene {
        bodies,
        points: plain::fill([2.0, 2.0, 0.0], [1.0; 3], [2, 2, 1]),
        ..plain::scene(1.0, [8, 8, 1])
    };
    Implicit::new(&scene, Settings::default()).err()
}

#[test]
fn what_the_grid_cannot_hold_is_refused() {
    let (down, still) = (Motion::Constant([0.0, -1.0, 0.0]), Motion::Fixed);
    assert_eq!(refusal(down, [7.0, 1.0], [8.0, 8.0], still), None);
    assert_eq!(
        refusal(
            still,
            [0.0, 7.0],
            [8.0, 8.0],
            Motion::Constant([1.0, 0.0, 0.0])
        ),
        None
    );
    for (plate, low, high, motion, said) in [
        (down, [7.0, 5.0], [8.0, 6.5], still, "not alike along it"),
        (
            still,
            [6.0, 2.0],
            [7.0, 3.0],
            Motion::Constant([1.0, 0.0, 0.0]),
            "ends within the domain",
        ),
        (
            down,
            [7.0, 1.0],
            [8.0, 8.0],
            Motion::Constant([0.0, -1.0, 0.0]),
            "two bodies move along y",
        ),
        (
            Motion::Constant([1.0, -1.0, 0.0]),
            [7.0, 1.0],
            [8.0, 8.0],
            still,
            "along y and aside",
        ),
        (
            down,
            [7.2, 1.0],
            [8.0, 8.0],
            still,
            "off the lattice along x",
        ),
    ] {
        let refused = refusal(plate, low, high, motion).unwrap_or_default();
        assert!(refused.contains(said), "{said}: {refused}");
    }
}

#[test]
fn a_body_that_moves_along_y_has_no_periodic_sides_there() {
    let body = |name: &str, from: f64, motion| {
        let block = VoxelBlock::solid_box([0.0, from, 0.0], [8.0, from + 1.0, 1.0]);
        plain::body(name, vec![block], motion)
    };
    let scene = Scene {
        bodies: vec![
            body("floor", 0.0, Motion::Fixed),
            body("plate", 6.0, Motion::Constant([0.0, -1.0, 0.0])),
        ],
        points: plain::fill([2.0, 2.0, 0.0], [1.0; 3], [2, 2, 1]),
        boundary: [Boundary::Symmetry, Boundary::Periodic, Boundary::Symmetry],
        ..plain::scene(1.0, [8, 8, 1])
    };
    let refused = Implicit::new(&scene, Settings::default()).err().unwrap();
    assert!(refused.contains("periodic sides"), "{refused}");
}

/// Layers without wood at the bond belong to the gap.
#[test]
fn a_block_whose_last_layers_are_empty_is_taken() {
    let floor = VoxelBlock::from_fn([0.0; 3], [1.0; 3], [8, 3, 1], |_, j, _| j < 1);
    let plate = VoxelBlock::solid_box([0.0, 6.0, 0.0], [8.0, 7.0, 1.0]);
    let down = Motion::Constant([0.0, -1.0, 0.0]);
    let scene = Scene {
        bodies: vec![
            plain::body("floor", vec![floor], Motion::Fixed),
            plain::body("plate", vec![plate], down),
        ],
        points: plain::fill([2.0, 2.0, 0.0], [1.0; 3], [2, 2, 1]),
        ..plain::scene(1.0, [8, 8, 1])
    };
    assert_eq!(Implicit::new(&scene, Settings::default()).err(), None);
}
