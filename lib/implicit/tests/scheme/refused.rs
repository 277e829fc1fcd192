//! Scenes that the grid cannot represent are refused.

use implicit::{Implicit, Settings};
use physics::{Boundary, Motion, Scene, Stop, VoxelBlock};

use crate::plain;
use crate::runs::block;

const STILL: Motion = Motion::Fixed;
const DOWN: Motion = Motion::Constant([0.0, -1.0, 0.0]);
const ASIDE: Motion = Motion::Constant([1.0, 0.0, 0.0]);
const SLANTING: Motion = Motion::Constant([1.0, -1.0, 0.0]);

/// The refusal of a scene of liquid among bodies in 8 x 8 cells of 1 m, if any; `side` is normal to y.
fn refusal(bodies: Vec<(&str, VoxelBlock, Motion)>, side: Boundary) -> Option<String> {
    let body = |(name, block, motion)| plain::body(name, vec![block], motion);
    let scene = Scene {
        bodies: bodies.into_iter().map(body).collect(),
        points: plain::fill([2.0, 2.0, 0.0], [1.0; 3], [2, 2, 1]),
        boundary: [Boundary::Symmetry, side, Boundary::Symmetry],
        ..plain::scene(1.0, [8, 8, 1])
    };
    Implicit::new(&scene, Settings::default()).err()
}

#[test]
fn what_the_grid_cannot_hold_is_refused() {
    let shaft = ([7.0, 1.0], [8.0, 8.0]);
    for (plate, (low, high), other, said) in [
        (DOWN, shaft, STILL, None),
        (STILL, ([0.0, 7.0], [8.0, 8.0]), ASIDE, None),
        (
            DOWN,
            ([7.0, 5.0], [8.0, 6.5]),
            STILL,
            Some("not uniform along it"),
        ),
        (
            STILL,
            ([6.0, 2.0], [7.0, 3.0]),
            ASIDE,
            Some("ends within the domain"),
        ),
        (DOWN, shaft, DOWN, Some("two bodies move along y")),
        (SLANTING, shaft, STILL, Some("along y and sideways")),
        (
            DOWN,
            ([7.2, 1.0], [8.0, 8.0]),
            STILL,
            Some("off the grid along x"),
        ),
    ] {
        let bodies = vec![
            ("floor", block(1.0, [0.0, 0.0], [8.0, 1.0]), STILL),
            ("plate", block(1.0, [0.0, 6.0], [6.0, 7.0]), plate),
            ("other", block(1.0, low, high), other),
        ];
        match (refusal(bodies, Boundary::Symmetry), said) {
            (Some(refused), Some(said)) => assert!(refused.contains(said), "{said}: {refused}"),
            (refused, said) => assert_eq!(refused.as_deref(), said),
        }
    }
}

/// Layers without wood at the bond belong to the gap; a body that moves along y has no periodic sides there.
#[test]
fn a_block_whose_last_layers_are_empty_is_taken_and_periodic_sides_are_not() {
    let floor = VoxelBlock::from_fn([0.0; 3], [1.0; 3], [8, 3, 1], |_, j, _| j < 1);
    let bodies = vec![
        ("floor", floor, STILL),
        ("plate", block(1.0, [0.0, 6.0], [8.0, 7.0]), DOWN),
    ];
    assert_eq!(refusal(bodies.clone(), Boundary::Symmetry), None);
    let refused = refusal(bodies, Boundary::Periodic).unwrap_or_default();
    assert!(refused.contains("periodic sides"), "{refused}");
}

/// A ridge that would enter a groove, and how far the plate may go.
#[test]
fn a_way_beyond_the_first_ridge_is_refused_with_the_way_to_it() {
    let bodies = [
        ("ridge", block(1.0, [0.0, 0.0], [1.0, 3.0]), STILL),
        ("plate", block(1.0, [1.0, 6.0], [8.0, 7.0]), DOWN),
    ];
    let bodies = bodies.map(|(name, block, motion)| plain::body(name, vec![block], motion));
    let scene = |travel_m| Scene {
        bodies: bodies.to_vec(),
        points: plain::fill([2.0, 2.0, 0.0], [1.0; 3], [2, 2, 1]),
        stop: Stop::Closed { travel_m },
        ..plain::scene(1.0, [8, 8, 1])
    };
    let said = |travel_m| Implicit::new(&scene(travel_m), Settings::default()).err();
    assert_eq!(said(3.0), None);
    let most = "; use --set clamp.travel=\"3000000 um\"";
    assert!(said(5.0).is_some_and(|said| said.ends_with(most)));
}
