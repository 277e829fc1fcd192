//! Scenes from `[[body]]` tables: the verification cases.

use physics::{Dimensions, GridBox, Motion, RigidBody, VoxelBlock};

use super::seed::{Lattice, Seeds};
use super::{Corners, Geometry, boundary, cells_along, periodic};
use crate::case::{BodyTable, BodyVelocity, BoxCorners, Case, EdgeLength, MaterialName};
use crate::failure::{RunFailure, refused};

pub(super) fn geometry(case: &Case, dimensions: Dimensions) -> Result<Geometry, RunFailure> {
    let EdgeLength::Metres(cell) = case.grid.cell else {
        return refused(
            "[grid] cell is given in voxels, and [[body]] tables have none: give a length such as \"2.9 um\"",
        );
    };
    let depth = (dimensions == Dimensions::Two).then_some(cell);
    let boundary = boundary(case, dimensions)?;
    let domain = domain(case, depth)?;
    let grid = grid(domain, cell)?;
    periodic::check_whole_cells(&grid, domain, boundary)?;
    let mut lattices = Vec::new();
    let mut bodies: Vec<RigidBody> = Vec::new();
    let mut filled: Vec<(usize, Corners)> = Vec::new();
    for (index, body) in case.body.iter().enumerate() {
        let wrong =
            |said: String| RunFailure::Usage(format!("[[body]] number {}: {said}", index + 1));
        let (min, max) = corners(&body.corners, depth).map_err(wrong)?;
        match body.material {
            MaterialName::Adhesive => {
                let velocity = match body.velocity {
                    None => [0.0; 3],
                    Some(BodyVelocity::Constant(v)) => v,
                    Some(BodyVelocity::Clamp) => {
                        return refused("an adhesive body cannot be driven by the clamp");
                    }
                };
                if let Some((other, _)) = filled.iter().find(|(_, b)| overlap(b, &(min, max))) {
                    return Err(wrong(format!(
                        "it overlaps number {}, but adhesive bodies must not overlap",
                        other + 1
                    )));
                }
                filled.push((index, (min, max)));
                let spacing = cell / f64::from(case.grid.points_per_direction);
                let lattice = Lattice::new(min, max, spacing, depth, velocity);
                inside(&lattice, &grid).map_err(wrong)?;
                lattices.push(lattice);
            }
            MaterialName::Rigid => {
                let parts = periodic::parts_inside((min, max), &grid, boundary, dimensions);
                add_rigid(&mut bodies, body, parts, case.clamp.is_some())?;
            }
        }
    }
    let moving = bodies.iter().position(|b| b.motion != Motion::Fixed);
    let fixed = bodies.iter().position(|b| b.motion == Motion::Fixed);
    let named = |name: &str| bodies.iter().position(|b| b.name == name);
    Ok(Geometry {
        grid,
        seeds: Seeds::Boxes(lattices),
        bottom: named("bottom").or(fixed),
        top: named("top").or(moving),
        bodies,
        travel_m: (case.clamp.as_ref())
            .and_then(|clamp| clamp.travel)
            .map(|travel| travel.si()),
        normal: units::Axis::Y,
    })
}

/// Whether two boxes overlap by more than the rounding of a common face.
fn overlap(a: &Corners, b: &Corners) -> bool {
    (0..3).all(|i| {
        let shared = a.1[i].min(b.1[i]) - a.0[i].max(b.0[i]);
        shared > 1e-6 * (a.1[i] - a.0[i]).min(b.1[i] - b.0[i])
    })
}

/// Adds a rigid body, or extends the body of the same name and motion.
fn add_rigid(
    bodies: &mut Vec<RigidBody>,
    body: &BodyTable,
    parts: Vec<Corners>,
    clamped: bool,
) -> Result<(), RunFailure> {
    let motion = match body.velocity {
        None => Motion::Fixed,
        Some(BodyVelocity::Constant(v)) if v == [0.0; 3] => Motion::Fixed,
        Some(BodyVelocity::Constant(v)) => Motion::Constant(v),
        Some(BodyVelocity::Clamp) if clamped => Motion::Clamped,
        Some(BodyVelocity::Clamp) => {
            return refused("a [[body]] with velocity = \"clamp\" needs a [clamp] table");
        }
    };
    let name = body.name.clone().unwrap_or_else(|| "wall".into());
    let blocks = (parts.into_iter()).map(|(min, max)| VoxelBlock::solid_box(min, max));
    match bodies
        .iter_mut()
        .find(|b| b.name == name && b.motion == motion)
    {
        Some(same) => same.blocks.extend(blocks),
        None => bodies.push(RigidBody {
            name,
            blocks: blocks.collect(),
            motion,
        }),
    }
    Ok(())
}

fn corners(corners: &BoxCorners, depth: Option<f64>) -> Result<Corners, String> {
    let (mut min, mut max) = (corners.min.map(|q| q.si()), corners.max.map(|q| q.si()));
    if let Some(depth) = depth {
        (min[2], max[2]) = (0.0, depth);
    }
    match (0..3).find(|&a| max[a] <= min[a]) {
        Some(a) => Err(format!(
            "max must be greater than min along {}",
            ["x", "y", "z"][a]
        )),
        None => Ok((min, max)),
    }
}

/// The given domain, or the box around all bodies.
fn domain(case: &Case, depth: Option<f64>) -> Result<Corners, RunFailure> {
    if let Some(domain) = &case.grid.domain {
        return corners(domain, depth)
            .map_err(|e| RunFailure::Usage(format!("[grid] domain: {e}")));
    }
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for body in &case.body {
        let (min, max) = corners(&body.corners, depth).map_err(RunFailure::Usage)?;
        for a in 0..3 {
            low[a] = low[a].min(min[a]);
            high[a] = high[a].max(max[a]);
        }
    }
    Ok((low, high))
}

fn grid((min, max): Corners, cell: f64) -> Result<GridBox, RunFailure> {
    let along = |a: usize| cells_along((max[a] - min[a]) / cell - 1e-6);
    Ok(GridBox {
        cell_m: cell,
        min_m: min,
        cells: [along(0)?, along(1)?, along(2)?],
    })
}

fn inside(liquid: &Lattice, grid: &GridBox) -> Result<(), String> {
    let (amount, max) = (liquid.amount(), grid.max_m());
    for corner in [amount.low_m, amount.high_m] {
        if (0..3).any(|a| corner[a] < grid.min_m[a] || corner[a] > max[a]) {
            return Err(format!(
                "the adhesive body reaches out of the domain at ({:.4e}, {:.4e}, {:.4e}) m",
                corner[0], corner[1], corner[2]
            ));
        }
    }
    Ok(())
}
