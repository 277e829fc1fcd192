//! Room for the adhesive of a run's press.

use bondline::{Press, Room};
use particle_file::BitsRef;
use physics::{Boundary, VoxelBlock, Water};
use units::Axis;

use crate::resolve::Setup;

/// The room of the press of `setup`. `None` without a clamp, where adhesive can leave through open sides, and for scenes that
/// are not two adherends, each one block as wide as the domain.
pub(crate) fn room(setup: &Setup) -> Option<Room> {
    let (scene, travel_m) = (&setup.scene, setup.initial_gap_m?);
    let area_m2 = scene.grid.area_m2();
    let adherend = |body: Option<usize>| -> Option<(&VoxelBlock, (BitsRef, f64))> {
        let [block] = scene.bodies.get(body?)?.blocks.as_slice() else {
            return None;
        };
        let ([x0, _, z0], [x1, _, z1]) = (block.origin(), block.max());
        let is_wide = ((x1 - x0) * (z1 - z0) / area_m2 - 1.0).abs() < 1e-3;
        let bits = BitsRef::from_words(block.dims(), block.bits())?;
        is_wide.then_some((block, (bits, block.voxel().iter().product())))
    };
    let ((low, bottom), (high, top)) = (adherend(scene.bottom)?, adherend(scene.top)?);
    let apart_m = high.origin()[1] - travel_m - low.max()[1];
    let ratio = |water: &Water| (1.0 + water.least()) / (1.0 + water.start());
    let stays = scene.liquid.water.as_ref().map_or(1.0, ratio);
    let press = Press {
        adherends: [bottom, top],
        normal: Axis::Y,
        area_m2,
        // Less than a voxel is the film of a closed bond.
        apart_m: if apart_m.abs() < high.voxel()[1] {
            0.0
        } else {
            apart_m
        },
        adhesive_m3: stays * setup.liquid.volume_m3,
        periodic: scene.boundary.map(|side| side == Boundary::Periodic),
        open: scene.boundary.map(|side| side == Boundary::Open),
    };
    (scene.bodies.len() == 2).then(|| Room::of(&press))?
}
