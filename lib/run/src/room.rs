//! Room for the adhesive of a run's press.

use bondline::{Press, Room};
use particle_file::BitsRef;
use physics::{Boundary, VoxelBlock, Water};
use units::Axis;

use crate::resolve::Setup;

/// The room of the press of `setup`. `None` without a clamp, where adhesive can leave through open sides, and for scenes that
/// are not two adherends, each one block as wide as the domain.
pub(crate) fn room(setup: &Setup) -> Option<Room> {
    let scene = &setup.scene;
    let ends = [scene.grid.min_m, scene.grid.max_m()];
    let adherend = |body: usize| -> Option<(&VoxelBlock, BitsRef)> {
        let [block] = scene.bodies.get(body)?.blocks.as_slice() else {
            return None;
        };
        let near = |a: f64, b: f64| (a - b).abs() < 0.5 * scene.grid.cell_m;
        let wide = [0, 2].into_iter().all(|axis| {
            near(block.origin()[axis], ends[0][axis]) && near(block.max()[axis], ends[1][axis])
        });
        let bits = BitsRef::from_words(block.dims(), block.bits())?;
        wide.then_some((block, bits))
    };
    let (travel_m, bottom, top) = (setup.initial_gap_m?, scene.bottom?, scene.top?);
    let ((low, below), (high, above)) = (adherend(bottom)?, adherend(top)?);
    if scene.bodies.len() != 2 {
        return None;
    }
    let voxel_m3 = |block: &VoxelBlock| block.voxel().iter().product::<f64>();
    let ratio = |water: &Water| (1.0 + water.least()) / (1.0 + water.start());
    let stays = scene.liquid.water.as_ref().map_or(1.0, ratio);
    Room::of(&Press {
        adherends: [(below, voxel_m3(low)), (above, voxel_m3(high))],
        normal: Axis::Y,
        area_m2: scene.grid.area_m2(),
        apart_m: high.origin()[1] - travel_m - low.max()[1],
        adhesive_m3: stays * setup.liquid.volume_m3,
        periodic: scene.boundary.map(|side| side == Boundary::Periodic),
        open: scene.boundary.map(|side| side == Boundary::Open),
    })
}
