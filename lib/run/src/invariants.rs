//! Checks of a state that no scheme may take for granted: liquid in wood, liquid where it
//! cannot have flowed, liquid volume.

use physics::{LiquidState, Motion, RigidBody, Scene, VoxelBlock};

/// What was found in a state; counts of material points.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Invariants {
    /// Points inside a rigid body.
    pub points_in_wood: u64,
    /// Points deeper than one spacing inside a rigid body: beyond the discretisation.
    pub points_deep_in_wood: u64,
    /// Deepest of them below the nearest open voxel face, m.
    pub deepest_m: f64,
    /// Points in voids that no open path connects to the bond plane.
    pub points_in_unreachable_voids: u64,
    /// Current over initial volume of the liquid, minus one.
    pub volume_change: f64,
}

/// Checks `liquid`, whose volume was `initial_volume` (m3) at the start, with the bodies
/// displaced by `displacements` (m).
pub fn check(
    scene: &Scene,
    initial_volume: f64,
    liquid: &LiquidState,
    displacements: &[[f64; 3]],
) -> Invariants {
    let spacing = 0.5 * scene.grid.cell_m;
    let reachable: Vec<Option<Reachable>> = scene
        .bodies
        .iter()
        .map(|b| Reachable::of(b, scene))
        .collect();
    let mut found = Invariants::default();
    for position in &liquid.position {
        let at = position.map(f64::from);
        for ((body, shift), reachable) in scene.bodies.iter().zip(displacements).zip(&reachable) {
            let own: [f64; 3] = std::array::from_fn(|a| at[a] - shift[a]);
            if let Some(block) = body.blocks.iter().find(|b| b.contains(own)) {
                let depth = depth_in(block, own, 4.0 * scene.grid.cell_m);
                found.points_in_wood += 1;
                found.points_deep_in_wood += u64::from(depth > spacing);
                found.deepest_m = found.deepest_m.max(depth);
            } else if reachable.as_ref().is_some_and(|r| r.is_closed_void(own)) {
                found.points_in_unreachable_voids += 1;
            }
        }
    }
    let volume: f64 = liquid.volume.iter().map(|&v| f64::from(v)).sum();
    found.volume_change = volume / initial_volume - 1.0;
    found
}

/// Distance from `point` in a solid voxel to the nearest face of an open one along an axis,
/// looking no further than `far`.
fn depth_in(block: &VoxelBlock, point: [f64; 3], far: f64) -> f64 {
    let (origin, voxel, dims) = (block.origin(), block.voxel(), block.dims());
    let index: [usize; 3] =
        std::array::from_fn(|a| (((point[a] - origin[a]) / voxel[a]) as usize).min(dims[a] - 1));
    let mut nearest = far;
    for a in 0..3 {
        for up in [false, true] {
            let mut at = index;
            loop {
                let face = origin[a] + (at[a] + usize::from(up)) as f64 * voxel[a];
                let distance = (face - point[a]).abs();
                if distance >= nearest {
                    break;
                }
                let next = if up {
                    at[a].checked_add(1)
                } else {
                    at[a].checked_sub(1)
                };
                let open = next.is_none_or(|n| {
                    at[a] = n;
                    !block.solid(at[0], at[1], at[2])
                });
                if open {
                    nearest = distance;
                    break;
                }
            }
        }
    }
    nearest
}

/// The voids of one adherend that open paths through voxel faces connect to its bond surface.
///
/// The bond plane is the only way from one adherend to the other, so each can be flooded alone.
struct Reachable<'a> {
    block: &'a VoxelBlock,
    seen: Vec<u64>,
}

impl<'a> Reachable<'a> {
    /// `None` for bodies that are not one voxel block next to the bond plane.
    fn of(body: &'a RigidBody, scene: &Scene) -> Option<Self> {
        let [block] = body.blocks.as_slice() else {
            return None;
        };
        if block.dims()[0] * block.dims()[1] < 4 {
            return None;
        }
        let is_top = scene.top.is_some_and(|i| scene.bodies[i].name == body.name)
            || matches!(body.motion, Motion::Clamped);
        let surface = if is_top { 0 } else { block.dims()[1] - 1 };
        let mut found = Self {
            block,
            seen: vec![0; block.bits().len()],
        };
        found.flood(surface);
        Some(found)
    }

    fn flood(&mut self, surface: usize) {
        let [nx, ny, nz] = self.block.dims();
        let mut front: Vec<[usize; 3]> = Vec::new();
        for k in 0..nz {
            for i in 0..nx {
                self.visit([i, surface, k], &mut front);
            }
        }
        while let Some([i, j, k]) = front.pop() {
            let mut go = |ok: bool, at: [usize; 3]| {
                if ok {
                    self.visit(at, &mut front);
                }
            };
            go(i > 0, [i.wrapping_sub(1), j, k]);
            go(i + 1 < nx, [i + 1, j, k]);
            go(j > 0, [i, j.wrapping_sub(1), k]);
            go(j + 1 < ny, [i, j + 1, k]);
            go(k > 0, [i, j, k.wrapping_sub(1)]);
            go(k + 1 < nz, [i, j, k + 1]);
        }
    }

    fn bit(&self, [i, j, k]: [usize; 3]) -> (usize, u64) {
        let words_per_row = self.block.dims()[0].div_ceil(64);
        (
            (k * self.block.dims()[1] + j) * words_per_row + i / 64,
            1 << (i % 64),
        )
    }

    fn visit(&mut self, at: [usize; 3], front: &mut Vec<[usize; 3]>) {
        let (word, mask) = self.bit(at);
        if self.seen[word] & mask == 0 && !self.block.solid(at[0], at[1], at[2]) {
            self.seen[word] |= mask;
            front.push(at);
        }
    }

    /// Whether `point` (in the body's frame) is in an open voxel of the block that was not reached.
    fn is_closed_void(&self, point: [f64; 3]) -> bool {
        let (origin, voxel, dims) = (self.block.origin(), self.block.voxel(), self.block.dims());
        let mut at = [0; 3];
        for a in 0..3 {
            let x = (point[a] - origin[a]) / voxel[a];
            if !(x >= 0.0 && x < dims[a] as f64) {
                return false;
            }
            at[a] = x as usize;
        }
        let (word, mask) = self.bit(at);
        !self.block.solid(at[0], at[1], at[2]) && self.seen[word] & mask == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Floor at j = 0, a closed lumen at (2, 2) and an open one at x = 5.
    fn block() -> VoxelBlock {
        VoxelBlock::from_fn([0.0; 3], [1.0; 3], [8, 5, 3], |i, j, k| {
            !((i == 2 && j == 2 && k == 1) || (i == 5 && j >= 1))
        })
    }

    #[test]
    fn depth_is_measured_to_the_nearest_open_face() {
        let block = block();
        assert!((depth_in(&block, [5.0 - 0.25, 2.5, 1.5], 4.0) - 0.25).abs() < 1e-12);
        assert!((depth_in(&block, [0.9, 2.5, 0.4], 4.0) - 0.4).abs() < 1e-12);
    }

    #[test]
    fn closed_lumens_are_unreachable() {
        let block = block();
        let mut r = Reachable {
            block: &block,
            seen: vec![0; block.bits().len()],
        };
        r.flood(4);
        assert!(r.is_closed_void([2.5, 2.5, 1.5]));
        assert!(!r.is_closed_void([5.5, 1.5, 1.5]));
        assert!(!r.is_closed_void([0.5, 0.5, 0.5]), "wood is no void");
    }
}
