//! Where the rigid bodies are: point, ray and overlap queries by voxel index arithmetic.

mod block;
mod placed;
mod reentrant;
mod rows;
mod surface;
mod sweep;

use std::sync::Arc;

use physics::{Boundary, RigidBody};

use crate::geometry::Domain;
use block::{Block, Periods, for_each};
use placed::Row;
pub(crate) use reentrant::{Across, LONG, Reentrant};
use rows::Rows;
pub(crate) use surface::{Surface, Wetted};

/// Index of a body in the scene, or [`SIDE`] or [`OPEN`].
pub(crate) type BodyId = u8;
/// Not a body: the symmetry plane at a side of the domain.
pub(crate) const SIDE: BodyId = 255;
/// Not a body: nothing there.
pub(crate) const OPEN: BodyId = 254;
/// Largest number of bodies a scene may have.
pub(crate) const MAX_BODIES: usize = 250;
/// Rays end after this many cells: a lumen this wide has no effect on the wall law.
pub(crate) const FAR: f64 = 64.0;

/// A stretch of solid met by a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hit {
    /// Distance to its near surface, cells; 0 when the ray starts in it.
    pub(crate) near: f64,
    /// Distance to its far surface, cells.
    pub(crate) far: f64,
    /// Whose surface it is.
    pub(crate) body: BodyId,
}

/// Puts the first solid of a row in the place of `first` if it is nearer.
#[inline]
fn nearer(first: &mut Option<Hit>, body: BodyId, row: &Row, up: bool, reach: f64) {
    let limit = first.map_or(reach, |hit| hit.near);
    if let Some((near, far)) = row.ray(up, limit)
        && first.is_none_or(|hit| near < hit.near)
    {
        *first = Some(Hit { near, far, body });
    }
}

/// All rigid bodies of a scene at one moment, in cell units of the domain.
#[derive(Clone, Debug)]
pub(crate) struct Solids {
    blocks: Vec<Block>,
    /// Of scenes with periodic sides.
    periods: Option<Periods>,
    /// Sides of the domain.
    pub(crate) domain: Domain,
}

impl Solids {
    /// The bodies of a scene, undisplaced, in a domain with low corner `min_m` and cells of
    /// `cell_m`. Beyond periodic sides they have images without end.
    pub(crate) fn new(
        bodies: Vec<RigidBody>,
        domain: Domain,
        min_m: [f64; 3],
        cell_m: f64,
    ) -> Self {
        let periods = [0, 1, 2].map(|a| match a < domain.axes && domain.periodic(a) {
            true => domain.cells[a] as f64,
            false => 0.0,
        });
        let mut blocks = Vec::new();
        for (id, body) in bodies.into_iter().enumerate() {
            for block in body.blocks {
                let origin = std::array::from_fn(|a| (block.origin()[a] - min_m[a]) / cell_m);
                let mut block = Block {
                    body: id as BodyId,
                    rest: origin,
                    origin,
                    edge: std::array::from_fn(|a| block.voxel()[a] / cell_m),
                    rows: Arc::new(Rows::new(block, domain.axes)),
                };
                for (axis, &period) in periods.iter().enumerate().filter(|(_, p)| **p > 0.0) {
                    block.clip(axis, period);
                }
                blocks.push(block);
            }
        }
        Self {
            blocks,
            periods: Periods::new(periods),
            domain,
        }
    }

    /// Whether there are no bodies.
    pub(crate) fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    /// The same bodies displaced from their first place by `displacement[body]` cells.
    pub(crate) fn displaced(&self, displacement: &[[f64; 3]]) -> Self {
        let mut moved = self.clone();
        for block in &mut moved.blocks {
            let by = displacement[usize::from(block.body)];
            block.origin = std::array::from_fn(|a| block.rest[a] + by[a]);
        }
        moved
    }

    /// The body whose voxel holds `point`; low faces belong to a voxel, high faces do not.
    /// Bodies only: domain sides are not looked at.
    #[inline]
    pub(crate) fn at(&self, point: [f64; 3]) -> Option<BodyId> {
        for_each!(block in &self.periods, &self.blocks, point, point => {
            if block.contains(point) {
                return Some(block.body);
            }
        });
        None
    }

    /// Ends of the line along `axis` through `from` that reaches `reach` cells.
    fn line(from: [f64; 3], axis: usize, reach: f64) -> [[f64; 3]; 2] {
        [-reach, reach].map(|by| {
            let mut end = from;
            end[axis] += by;
            end
        })
    }

    /// First solid along `axis` from `from`, upwards or downwards, no farther than `reach`
    /// cells. A symmetry plane of the domain is a hit with body [`SIDE`].
    pub(crate) fn ray(&self, from: [f64; 3], axis: usize, up: bool, reach: f64) -> Option<Hit> {
        let mut first = self.side(from, axis, up, reach);
        let [low, high] = Self::line(from, axis, reach);
        for_each!(block in &self.periods, &self.blocks, low, high => {
            if let Some(row) = block.row(from, axis) {
                nearer(&mut first, block.body, &row, up, reach);
            }
        });
        first
    }

    /// The first solids along `axis` from `from` downwards and upwards, as of [`Solids::ray`].
    pub(crate) fn rays(&self, from: [f64; 3], axis: usize, reach: f64) -> [Option<Hit>; 2] {
        // Walls are mostly found before a ray has gone through all images that it may reach.
        const NEAR: f64 = 8.0;
        if self.periods.is_some() {
            let near = self.both_ways(from, axis, reach.min(NEAR));
            if near.iter().all(Option::is_some) {
                return near;
            }
        }
        self.both_ways(from, axis, reach)
    }

    fn both_ways(&self, from: [f64; 3], axis: usize, reach: f64) -> [Option<Hit>; 2] {
        let mut first = [false, true].map(|up| self.side(from, axis, up, reach));
        let [low, high] = Self::line(from, axis, reach);
        for_each!(block in &self.periods, &self.blocks, low, high => {
            if let Some(row) = block.row(from, axis) {
                nearer(&mut first[0], block.body, &row, false, reach);
                nearer(&mut first[1], block.body, &row, true, reach);
            }
        });
        first
    }

    /// The symmetry plane that a ray meets.
    fn side(&self, from: [f64; 3], axis: usize, up: bool, reach: f64) -> Option<Hit> {
        if self.domain.boundary[axis] != Boundary::Symmetry {
            return None;
        }
        let to_side = if up {
            self.domain.cells[axis] as f64 - from[axis]
        } else {
            from[axis]
        };
        (to_side <= reach).then_some(Hit {
            near: to_side.max(0.0),
            far: f64::INFINITY,
            body: SIDE,
        })
    }

    /// Calls `found(body, volume)` for every block that overlaps the box `low..high`, in the
    /// order of the blocks. An axis with `low == high` counts as a plane cut there: the
    /// volume is then an area.
    pub(crate) fn overlaps(
        &self,
        low: [f64; 3],
        high: [f64; 3],
        mut found: impl FnMut(BodyId, f64),
    ) {
        for_each!(block in &self.periods, &self.blocks, low, high => {
            let volume = block.overlap(low, high);
            if volume > 0.0 {
                found(block.body, volume);
            }
        });
    }

    /// Subtracts the solid part from `open`, the open fractions of one row of sub-cells that
    /// covers the intervals `y` and `z`; its first sub-cell begins at `x0` and is `dx` wide.
    pub(crate) fn carve_row(&self, y: [f64; 2], z: [f64; 2], x0: f64, dx: f64, open: &mut [f32]) {
        let area = (y[1] - y[0]) * (z[1] - z[0]);
        let end = x0 + open.len() as f64 * dx;
        for_each!(block in &self.periods, &self.blocks, [x0, y[0], z[0]], [end, y[1], z[1]] => {
            block.carve(y, z, x0, dx, 1.0 / area, open);
        });
        for o in open {
            // Rounding of a sum of overlaps must not leave a sub-cell that is almost solid.
            *o = if *o < 1e-5 { 0.0 } else { *o };
        }
    }
}
