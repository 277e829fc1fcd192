//! Uses of a forged stack.

use std::fs;

use voxels::{Crop, Grey, Phases, Stack, VoxelEdge, segment};

use crate::readers::scratch;

/// Opens a stack, reads its voxel size and segments it whole, by labels and by grey values.
pub(crate) fn feed(name: &str, bytes: &[u8]) -> bool {
    let folder = scratch();
    let path = folder.join(name);
    // What a MetaImage may point to.
    let data = [0_u8, 1, 2, 128, 255].repeat(240);
    if fs::write(&path, bytes)
        .and_then(|()| fs::write(folder.join("a.raw"), data))
        .is_err()
    {
        return false;
    }
    let Ok(stack) = Stack::open(&[path]) else {
        return false;
    };
    // A refusal for want of a voxel size does not keep the user from giving one.
    let _ = VoxelEdge::resolve(None, stack.voxel_size(), stack.name());
    let crop = Crop::whole(stack.dims());
    let grey: Option<Grey> = "wood=0.5..1.5,adhesive=1.6..".parse().ok();
    let ways = [Some(Phases::Guess), grey.map(Phases::Grey)];
    let segmented = |phases: &Phases| segment(&stack, phases, &crop, || {}).is_ok();
    ways.iter()
        .flatten()
        .filter(|phases| segmented(phases))
        .count()
        > 0
}
