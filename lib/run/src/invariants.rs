//! Checks of the final state that hold for any scheme: liquid in wood, liquid in sealed voids, liquid volume.

use bondline::open_voids;
use particle_file::{BitGrid, BitsRef};
use physics::{LiquidState, Motion, RigidBody, Scene, VoxelBlock, Water, WaterState};
use units::Axis;

use crate::crowded_liquid::crowded_fraction;
use crate::moved_bodies::MovedBodies;

/// Results of the checks; counts are of material points.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Invariants {
    /// Points inside a rigid body.
    pub points_in_wood: u64,
    /// Points deeper inside a rigid body than half a cell, the resolution of walls.
    pub points_deep_in_wood: u64,
    /// Depth of the deepest point in a rigid body: distance to the nearest place in the domain outside all bodies, m.
    pub deepest_m: f64,
    /// Points in voids without an open path to the bond surface.
    pub points_in_unreachable_voids: u64,
    /// Current over initial volume of the liquid, minus one. Water given off to the walls counts as present.
    pub volume_change: f64,
    /// Fraction of the liquid's volume in excess of one and a half times the volume of blocks of two cells.
    pub crowded: f64,
    /// Water balance of a liquid that loses water.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub water: Option<WaterAccount>,
}

/// Water balance of a liquid that loses water to the walls.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct WaterAccount {
    /// Water in the walls, kg.
    pub water_in_walls_kg: f64,
    /// Fraction of the water that the balance misses: not in points or walls, and not gone with points that left.
    pub water_missing: f64,
    /// Mean solids content of the liquid, by mass.
    pub solids_content: f64,
}

impl Invariants {
    /// Adds the water balance of a liquid of `initial_volume` (m3) at the start.
    pub(crate) fn with_water(self, water: Option<WaterState>, initial_volume: f64) -> Self {
        let Some(state) = water else {
            return self;
        };
        Self {
            volume_change: self.volume_change + state.given_off_m3 / initial_volume,
            water: Some(WaterAccount {
                water_in_walls_kg: Water::mass(state.in_walls_m3),
                water_missing: state.missing,
                solids_content: state.solids,
            }),
            ..self
        }
    }
}

/// Checks `liquid`, of `initial_volume` (m3) at the start, with bodies displaced by `displacements` (m).
pub(crate) fn check(
    scene: &Scene,
    initial_volume: f64,
    liquid: &LiquidState,
    displacements: &[[f64; 3]],
) -> Invariants {
    let spacing = 0.5 * scene.grid.cell_m;
    let bodies = scene.bodies.iter();
    let reachable: Vec<_> = bodies.map(|b| OpenVoids::of(b, scene)).collect();
    let placed = MovedBodies {
        scene,
        displacements,
    };
    let mut found = Invariants::default();
    for position in &liquid.position {
        let at = position.map(f64::from);
        if placed.voxel(at).is_some() {
            let depth = placed.depth(at, 4.0 * scene.grid.cell_m);
            found.points_in_wood += 1;
            found.points_deep_in_wood += u64::from(depth > spacing);
            found.deepest_m = found.deepest_m.max(depth);
            continue;
        }
        let sealed = |(shift, reachable): (&[f64; 3], &Option<OpenVoids>)| {
            let own: [f64; 3] = std::array::from_fn(|a| at[a] - shift[a]);
            reachable.as_ref().is_some_and(|r| r.is_sealed_at(own))
        };
        let voids = displacements
            .iter()
            .zip(&reachable)
            .filter(|&pair| sealed(pair));
        found.points_in_unreachable_voids += voids.count() as u64;
    }
    let volume: f64 = liquid.volume.iter().map(|&v| f64::from(v)).sum();
    found.volume_change = volume / initial_volume - 1.0;
    found.crowded = crowded_fraction(scene, liquid);
    found
}

/// The open voids of an adherend, which are connected to its bond surface.
struct OpenVoids<'a> {
    block: &'a VoxelBlock,
    open: BitGrid,
}

impl<'a> OpenVoids<'a> {
    /// `None` for bodies of several blocks.
    fn of(body: &'a RigidBody, scene: &Scene) -> Option<Self> {
        let [block] = body.blocks.as_slice() else {
            return None;
        };
        let is_top = scene.top.is_some_and(|i| scene.bodies[i].name == body.name)
            || matches!(body.motion, Motion::Clamped);
        let surface = if is_top { 0 } else { block.dims()[1] - 1 };
        let wood = BitsRef::from_words(block.dims(), block.bits())?;
        let open = open_voids(wood, Axis::Y, surface, [false; 3]);
        Some(Self { block, open })
    }

    /// Whether `point` (in the body's frame) lies in a sealed void of the block.
    fn is_sealed_at(&self, point: [f64; 3]) -> bool {
        let closed = |[x, y, z]: [usize; 3]| !self.block.solid(x, y, z) && !self.open.get(x, y, z);
        self.block.voxel_at(point).is_some_and(closed)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use std::array::from_fn;

    use physics::{Dimensions, GridBox};

    use super::*;
    use crate::verdict::tests::setup;

    /// Floor at j = 0, a closed lumen at (2, 2) and an open one at x = 5.
    pub(crate) fn block() -> VoxelBlock {
        VoxelBlock::from_fn([0.0; 3], [1.0; 3], [8, 5, 3], |i, j, k| {
            !((i == 2 && j == 2 && k == 1) || (i == 5 && j >= 1))
        })
    }

    /// A domain of 8 x 6 x 3 cells of 1 m with `bodies`.
    pub(crate) fn scene(bodies: Vec<VoxelBlock>) -> Scene {
        let body = |(i, block): (usize, VoxelBlock)| RigidBody {
            name: format!("body {i}"),
            blocks: vec![block],
            motion: Motion::Fixed,
        };
        Scene {
            dimensions: Dimensions::Three,
            grid: GridBox {
                cell_m: 1.0,
                min_m: [0.0; 3],
                cells: [8, 6, 3],
            },
            bodies: bodies.into_iter().enumerate().map(body).collect(),
            bottom: None,
            top: None,
            ..setup().scene
        }
    }

    /// Liquid of 1 m3 at each of these places.
    pub(crate) fn at<const N: usize>(position: [[f32; 3]; N]) -> LiquidState {
        LiquidState {
            position: position.to_vec(),
            volume: vec![1.0; N],
            ..LiquidState::default()
        }
    }

    /// Depths are capped at four cells.
    #[test]
    fn a_point_in_a_domain_full_of_wood_is_four_cells_deep() {
        let mut scene = scene(vec![VoxelBlock::solid_box([-9.0; 3], [99.0; 3])]);
        scene.grid.cell_m = 0.5;
        let found = check(&scene, 1.0, &at([[2.0, 1.5, 0.75]]), &[[0.0; 3]]);
        assert_eq!((found.deepest_m, found.points_deep_in_wood), (2.0, 1));
    }

    /// A void that winds along every axis both ways, in voxels of 2 x 4 x 8 m away from the origin.
    #[test]
    fn a_winding_void_is_reached_from_the_bond_alone() {
        let path = |i: usize, j: usize, k: usize| match k {
            0 => matches!((i, j), (3, 2..=3) | (2, 1..=2)),
            1 => matches!((i, j), (2, 1) | (4, 0..=2)),
            _ => matches!((i, j), (2, 1) | (3, 0..=1) | (4, 0)),
        };
        let (low, voxel, dims) = ([10.0, 20.0, 30.0], [2.0, 4.0, 8.0], [5, 4, 3]);
        let block = |floor: bool| {
            let wood = |i: usize, j: usize, k: usize| {
                !path(i, j, k) && [i, j, k] != [0, 2, 2] || floor && j == 0
            };
            VoxelBlock::from_fn(low, voxel, dims, wood)
        };
        let mut scene = scene(vec![block(false)]);
        // Voxels whose centre lies in a closed void.
        let closed = |scene: &Scene| {
            let reachable = OpenVoids::of(&scene.bodies[0], scene).unwrap();
            let all = (0..60).map(|n| [n % 5, n / 5 % 4, n / 20]);
            let middle = |at: [usize; 3]| from_fn(|a| low[a] + (at[a] as f64 + 0.5) * voxel[a]);
            let closed = all.filter(|&at| reachable.is_sealed_at(middle(at)));
            closed.collect::<Vec<_>>()
        };
        assert_eq!(closed(&scene), [[0, 2, 2]]);
        // For an upper adherend the bond surface is below: the path comes down to j = 0.
        scene.top = Some(0);
        assert_eq!(closed(&scene), [[0, 2, 2]]);
        scene.bodies[0].blocks[0] = block(true);
        // The path except its voxels at j = 0, and the closed void.
        assert_eq!(closed(&scene).len(), 10);
    }

    /// Bodies are checked at their displaced place.
    #[test]
    fn a_displaced_body_is_looked_at_where_it_is() {
        let shift = [0.5, -3.0, 2.0];
        // Wood with a void at the bond, i = 1, and a closed one, i = 3.
        let block =
            VoxelBlock::from_fn([10.0, 20.0, 30.0], [2.0, 4.0, 8.0], [5, 4, 3], |i, j, k| {
                !(i == 1 && j == 3 && k == 1 || i == 3 && j == 1 && k == 1)
            });
        let mut scene = scene(vec![block]);
        scene.grid.cells = [40, 60, 80];
        // In the void at the bond, in the closed one, a quarter under the side of the block, and 1
        // under the floor of the void at the bond.
        let places = [(13.0, 34.0), (17.0, 26.0), (19.75, 29.0), (13.0, 31.0)];
        let moved = |(x, y)| from_fn(|a| ([x, y, 42.0][a] + shift[a]) as f32);
        let liquid = at(places.map(moved));
        let found = check(&scene, 5.0, &liquid, &[shift]);
        assert_eq!(found.points_in_unreachable_voids, 1);
        assert_eq!((found.points_in_wood, found.points_deep_in_wood), (2, 1));
        assert!((found.deepest_m - 1.0).abs() < 1e-5, "{}", found.deepest_m);
        assert!((found.volume_change + 0.2).abs() < 1e-6);
    }
}
