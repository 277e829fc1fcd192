//! Edges of boxes and of voxels, and where their walls go on.

use physics::VoxelBlock;

use super::*;
use crate::geometry::tests::{domain, solids};

/// The edges along `axis` of blocks given in the plane across it.
fn edges(axis: usize, boxes: &[[[f64; 2]; 2]]) -> Vec<Reentrant> {
    edges_within(axis, boxes, [1.0; 2])
}

fn edges_within(axis: usize, boxes: &[[[f64; 2]; 2]], low: [f64; 2]) -> Vec<Reentrant> {
    let block = |[low, high]: &[[f64; 2]; 2]| {
        let (mut from, mut to) = ([0.0; 3], [6.0; 3]);
        for (n, &t) in ACROSS[axis].iter().enumerate() {
            (from[t], to[t]) = (low[n], high[n]);
        }
        VoxelBlock::solid_box(from, to)
    };
    let solids = solids(domain([6; 3], 3), vec![boxes.iter().map(block).collect()]);
    let mut found = Vec::new();
    let across = Across {
        axis,
        along: 3.0,
        low,
        high: [5.0; 2],
    };
    solids.reentrant(&across, &mut found);
    found
}

#[test]
fn edges_are_where_one_quadrant_is_solid() {
    for axis in 0..3 {
        let edge = |at, above, straight| Reentrant {
            at,
            above,
            straight,
        };
        let one = edges(axis, &[[[0.0, 0.0], [2.25, 3.5]]]);
        assert_eq!(one, [edge([2.25, 3.5], [false; 2], LONG)], "{axis}");
        // Beside another block the wall goes on; its own edge is out of reach.
        let boxes = [[[0.0, 0.0], [2.25, 3.5]], [[2.25, 0.0], [6.0, 3.5]]];
        assert_eq!(edges(axis, &boxes), [], "{axis}");
        // A tooth half a cell wide.
        let tooth = edges(axis, &[[[2.5, 4.0], [3.0, 6.0]]]);
        let right = edge([3.0, 4.0], [false, true], 0.5);
        assert_eq!(tooth, [edge([2.5, 4.0], [true; 2], 0.5), right], "{axis}");
    }
}

/// A wall that ends at a symmetry plane, or at another block, runs on beyond it; the edges beyond the plane are images.
#[test]
fn edges_and_walls_go_on_beyond_planes_and_blocks() {
    for axis in 0..3 {
        let edge = |at, above, straight| Reentrant {
            at,
            above,
            straight,
        };
        let half = edges_within(axis, &[[[0.0, 2.0], [0.5, 6.0]]], [-1.0, 1.0]);
        let right = edge([0.5, 2.0], [false, true], 1.0);
        let image = edge([-0.5, 2.0], [true; 2], 1.0);
        assert_eq!(half, [right, image], "{axis}");
        let whole = [[[3.0, 2.0], [4.0, 6.0]]];
        let pieces = [[[3.0, 2.0], [3.5, 6.0]], [[3.5, 2.0], [4.0, 6.0]]];
        let beyond = [[[-9.0, 2.0], [0.5, 6.0]]];
        assert_eq!(edges_within(axis, &beyond, [-1.0, 1.0]), half, "{axis}");
        let [whole, pieces] = [edges(axis, &whole), edges(axis, &pieces)];
        assert_eq!(whole, pieces, "{axis}");
        assert_eq!(whole[0].straight, 1.0, "{axis}");
    }
}

#[test]
fn edges_of_voxels_are_those_by_probes() {
    let block = VoxelBlock::from_fn(
        [0.3, -0.2, 0.1],
        [0.5, 0.75, 1.0],
        [130, 9, 7],
        |i, j, k| (i * i + 3 * j * k + j + 5 * k) % 7 < 3,
    );
    let mut domain = domain([70, 7, 7], 3);
    domain.boundary = [Boundary::Open; 3];
    let solids = solids(domain, vec![vec![block]]);
    let mut count = 0;
    for axis in 0..3 {
        let [s, t] = ACROSS[axis];
        for n in 0..200 {
            let part = |of: f64| f64::from(n) * of % 1.0;
            let point = [part(0.317) * 65.0, part(0.731) * 6.0, part(0.093) * 6.0];
            let mut found = Vec::new();
            let across = Across {
                axis,
                along: point[axis],
                low: [point[s] - 1.3, point[t] - 1.3],
                high: [point[s] + 1.3, point[t] + 1.3],
            };
            solids.reentrant(&across, &mut found);
            let mut expected = 0;
            for j in 0..140 {
                for k in 0..140 {
                    let corner =
                        |a: usize, n: i32| [0.3, -0.2, 0.1][a] + f64::from(n) * [0.5, 0.75, 1.0][a];
                    let at = [corner(s, j), corner(t, k)];
                    if (at[0] - point[s]).abs() > 1.3 || (at[1] - point[t]).abs() > 1.3 {
                        continue;
                    }
                    let solid = |x: f64, y: f64| {
                        let mut probe = point;
                        (probe[s], probe[t]) = (at[0] + x, at[1] + y);
                        usize::from(solids.at(probe).is_some())
                    };
                    let around = solid(0.1, 0.1) + solid(-0.1, 0.1) + solid(0.1, -0.1);
                    expected += usize::from(around + solid(-0.1, -0.1) == 1);
                }
            }
            assert_eq!(found.len(), expected, "{axis} {point:?}");
            count += expected;
        }
    }
    assert!(count > 300, "{count}");
}
