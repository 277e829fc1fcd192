//! Tests of points that come to a wall.

use physics::VoxelBlock;

use super::*;
use crate::lanes::Lanes8;
use crate::stages::Present;
use crate::tiles::Point;

/// A point of an eighth of a cell goes down to y = 2.75 at `v` (m/s) onto a floor of y = 3 that
/// rises at 1 m/s: its velocity, the floor's momentum and how many points were stopped and trapped.
fn landed(v: Real) -> ([Real; 3], f64, [u64; 2]) {
    let lattice = Lattice::cube(8, Boundary::Open);
    let present = Present {
        three: true,
        contact: true,
        ..Present::default()
    };
    let node = [5, 4, 5];
    let mut tile = Tile::new(lattice.tile_key(node), &lattice, present, 1);
    tile.bodies = 1;
    let point = Point {
        id: 0,
        place: Lanes4([0.0, -0.25, 0.0, 0.125]),
        motion: Lanes4([2.0, v, 0.0, 0.0]),
        stress: Lanes8::ZERO,
        affine: [Lanes4::ZERO; 3],
    };
    tile.points.push(&point, 0, false);
    let floor = [BlockShape {
        origin: [0.0; 3],
        voxel: [8.0, 3.0, 8.0],
        solid: VoxelBlock::solid_box([0.0; 3], [8.0, 3.0, 8.0]),
    }];
    let bodies = [Obstacle {
        parts: &floor,
        from: [0.0; 3],
        to: [0.0; 3],
        velocity: [0.0, 1.0, 0.0],
    }];
    let mut d = Lanes4([0.1, -1.25, 0.0, 0.125]);
    collide(&mut tile, 0, node, &mut d, &lattice, &bodies);
    assert!((d.0[1] + 1.0).abs() < 1e-4 && d.0[0] == 0.1, "{d:?}");
    let [x, y, z, _] = tile.points.motion[0].0;
    let hits = [tile.hits.count, tile.hits.trapped];
    ([x, y, z], tile.push[0][1], hits)
}

#[test]
fn a_stopped_point_is_no_faster_towards_the_body_than_the_body() {
    assert_eq!(landed(-30.0), ([2.0, 1.0, 0.0], -31.0 / 8.0, [1, 0]));
    assert_eq!(landed(0.5), ([2.0, 1.0, 0.0], -0.5 / 8.0, [1, 0]));
    assert_eq!(landed(5.0), ([2.0, 5.0, 0.0], 0.0, [1, 0]), "it flies away");
}
