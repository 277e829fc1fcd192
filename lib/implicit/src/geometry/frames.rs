//! The two reference frames of a scene, that of the moving body and that of all others, and the gap between them.

use physics::{Boundary, Motion, Scene, Stop, VoxelBlock};

use super::lattice::{ALIGNMENT_TOLERANCE, Moving};

/// Refuses motions that would move walls off the grid's faces.
pub(super) fn check_motions(scene: &Scene, frames: &Frames) -> Result<(), String> {
    let (low, high) = (scene.grid.min_m, scene.grid.max_m());
    let tolerance = ALIGNMENT_TOLERANCE * scene.grid.cell_m;
    if frames.moving.is_some() && scene.boundary[1] == Boundary::Periodic {
        return Err(
            "a body moves along y between periodic sides: give other sides normal to y".into(),
        );
    }
    for (index, body) in scene.bodies.iter().enumerate() {
        let through = |block: &VoxelBlock, a: usize| {
            let spans =
                block.origin()[a] <= low[a] + tolerance && block.max()[a] >= high[a] - tolerance;
            spans && block.dims()[a] == 1
        };
        if let Motion::Constant(v) = body.motion {
            for a in [0, 2].into_iter().filter(|&a| v[a] != 0.0) {
                if !body.blocks.iter().all(|block| through(block, a)) {
                    return Err(format!(
                        "body '{}' moves along {} and ends within the domain: with the implicit scheme, a wall that moves \
                         in its own plane must reach from side to side",
                        body.name,
                        ["x", "y", "z"][a]
                    ));
                }
            }
        }
        let Some(moving) = frames.moving.filter(|moving| moving.body != index) else {
            continue;
        };
        for block in &body.blocks {
            let Some([from, to]) = solid_extent(block) else {
                continue;
            };
            let [bottom, top] = frames.gap;
            // A domain may end within its last row of cells.
            let (beside, along) = match moving.down {
                true => (
                    to > bottom + tolerance,
                    from <= bottom + tolerance && to > high[1] - scene.grid.cell_m,
                ),
                false => (
                    from < top - tolerance,
                    to >= top - tolerance && from <= low[1] + tolerance,
                ),
            };
            if beside && !(along && block.dims()[1] == 1) {
                return Err(format!(
                    "body '{}' stands beside the path of '{}' and is not uniform along it: with the implicit scheme, \
                     walls there must continue unchanged to the side of the domain",
                    body.name, scene.bodies[moving.body].name
                ));
            }
        }
    }
    Ok(())
}

/// The body that moves along y, if one does.
fn moving(scene: &Scene) -> Result<Option<Moving>, String> {
    let mut found = None;
    for (index, body) in scene.bodies.iter().enumerate() {
        let down = match body.motion {
            Motion::Fixed => continue,
            Motion::Clamped => true,
            Motion::Constant([_, 0.0, _]) => continue,
            Motion::Constant([0.0, y, 0.0]) => y < 0.0,
            Motion::Constant(_) => {
                return Err(format!(
                    "body '{}' moves along y and sideways: the implicit scheme moves bodies along y, or walls within their own plane",
                    body.name
                ));
            }
        };
        if found.replace(Moving { body: index, down }).is_some() {
            return Err(format!(
                "two bodies move along y, the second of them '{}': the implicit scheme accepts one",
                body.name
            ));
        }
    }
    Ok(found)
}

/// The gap and the body that moves.
pub(super) struct Frames {
    /// y of the low and the high side of the gap, m.
    pub(super) gap: [f64; 2],
    pub(super) moving: Option<Moving>,
}

impl Frames {
    /// The gap lies between the moving body and the nearest face of another body ahead of it, else the side of the domain.
    /// Without a moving body it has no height and lies at the low side of the domain.
    pub(super) fn new(scene: &Scene) -> Result<Self, String> {
        let [low, high] = [scene.grid.min_m[1], scene.grid.max_m()[1]];
        let moving = moving(scene)?;
        let Some(Moving { body, down }) = moving else {
            return Ok(Self {
                gap: [low; 2],
                moving,
            });
        };
        let solid = scene.bodies[body].blocks.iter().filter_map(solid_extent);
        let (bottom, top) = solid.fold((f64::INFINITY, f64::NEG_INFINITY), |so_far, [from, to]| {
            (so_far.0.min(from), so_far.1.max(to))
        });
        let tolerance = ALIGNMENT_TOLERANCE * scene.grid.cell_m;
        // The gap ends at the first face of another body ahead of the moving one.
        let others = scene.bodies.iter().enumerate().filter(|at| at.0 != body);
        let blocks = others.flat_map(|(_, body)| &body.blocks);
        let ends = blocks.filter_map(solid_extent).flatten();
        let gap = match down {
            true => [
                ends.filter(|y| *y <= bottom + tolerance)
                    .fold(low, f64::max),
                bottom,
            ],
            false => [
                top,
                ends.filter(|y| *y >= top - tolerance).fold(high, f64::min),
            ],
        };
        if let Stop::Closed { travel_m } = scene.stop
            && travel_m > gap[1] - gap[0] + tolerance
        {
            // Rounded down, so that the suggested travel does not exceed the gap.
            let most = (1e10 * (gap[1] - gap[0]) + 1e-3).floor() / 1e4;
            let help = match most > 0.0 {
                true => format!("; use --set clamp.travel=\"{most} um\""),
                false => String::new(),
            };
            return Err(format!(
                "the clamp's travel is {:.4} um, but the bodies meet after {most:.4} um{help}",
                1e6 * travel_m
            ));
        }
        Ok(Self { gap, moving })
    }
}

/// y of the outer sides of the first and the last layer of a block that holds solid voxels.
fn solid_extent(block: &VoxelBlock) -> Option<[f64; 2]> {
    let [_, ny, nz] = block.dims();
    let holds = |j: &usize| (0..nz).any(|k| block.row(*j, k).iter().any(|&word| word != 0));
    let y = |j: usize| block.origin()[1] + j as f64 * block.voxel()[1];
    let (first, last) = ((0..ny).find(holds)?, (0..ny).rfind(holds)?);
    Some([y(first), y(last + 1)])
}
