//! Where the rigid bodies are: point, ray and overlap queries by voxel index arithmetic.

mod sweep;

use std::sync::Arc;

use physics::{Boundary, RigidBody, VoxelBlock};

use crate::geometry::Domain;

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
/// Points this close (cells) to a surface count as on it.
const TOUCH: f64 = 1e-7;

/// A block of voxels at its place, in cell units.
#[derive(Clone, Debug)]
struct Placed {
    body: BodyId,
    block: Arc<VoxelBlock>,
    /// Low corner without displacement.
    rest: [f64; 3],
    /// Low corner now.
    origin: [f64; 3],
    /// Edges of a voxel.
    edge: [f64; 3],
}

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

/// All rigid bodies of a scene at one moment, in cell units of the domain.
#[derive(Clone, Debug)]
pub(crate) struct Solids {
    blocks: Vec<Placed>,
    /// Sides of the domain.
    pub(crate) domain: Domain,
}

impl Solids {
    /// The bodies of a scene, undisplaced, in a domain with low corner `min_m` and cells of
    /// `cell_m`. Periodic sides get images of the bodies as far as rays reach.
    pub(crate) fn new(
        bodies: Vec<RigidBody>,
        domain: Domain,
        min_m: [f64; 3],
        cell_m: f64,
    ) -> Self {
        let mut blocks = Vec::new();
        for (id, body) in bodies.into_iter().enumerate() {
            for block in body.blocks {
                let origin = std::array::from_fn(|a| (block.origin()[a] - min_m[a]) / cell_m);
                blocks.push(Placed {
                    body: id as BodyId,
                    rest: origin,
                    origin,
                    edge: std::array::from_fn(|a| block.voxel()[a] / cell_m),
                    block: Arc::new(block),
                });
            }
        }
        for axis in (0..domain.axes).filter(|&a| domain.periodic(a)) {
            let period = domain.cells[axis] as f64;
            let images = (FAR / period).ceil() as i64;
            for block in &mut blocks {
                block.clip(axis, period);
            }
            let originals = blocks.clone();
            for shift in (-images..=images).filter(|&s| s != 0) {
                blocks.extend(originals.iter().cloned().map(|mut image| {
                    image.rest[axis] += shift as f64 * period;
                    image.origin = image.rest;
                    image
                }));
            }
        }
        Self { blocks, domain }
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
        self.blocks
            .iter()
            .find(|block| block.contains(point))
            .map(|block| block.body)
    }

    /// First solid along `axis` from `from`, upwards or downwards, no farther than `reach`
    /// cells. A symmetry plane of the domain is a hit with body [`SIDE`].
    pub(crate) fn ray(&self, from: [f64; 3], axis: usize, up: bool, reach: f64) -> Option<Hit> {
        let mut first: Option<Hit> = None;
        let mut limit = reach;
        if self.domain.boundary[axis] == Boundary::Symmetry {
            let to_side = if up {
                self.domain.cells[axis] as f64 - from[axis]
            } else {
                from[axis]
            };
            if to_side <= limit {
                limit = to_side;
                first = Some(Hit {
                    near: to_side.max(0.0),
                    far: f64::INFINITY,
                    body: SIDE,
                });
            }
        }
        for block in &self.blocks {
            if let Some((near, far)) = block.ray(from, axis, up, limit)
                && first.is_none_or(|hit| near < hit.near)
            {
                limit = near;
                first = Some(Hit {
                    near,
                    far,
                    body: block.body,
                });
            }
        }
        first
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
        for block in &self.blocks {
            let volume = block.overlap(low, high);
            if volume > 0.0 {
                found(block.body, volume);
            }
        }
    }

    /// Subtracts the solid part from `open`, the open fractions of one row of sub-cells that
    /// covers the intervals `y` and `z`; its first sub-cell begins at `x0` and is `dx` wide.
    pub(crate) fn carve_row(&self, y: [f64; 2], z: [f64; 2], x0: f64, dx: f64, open: &mut [f32]) {
        let area = (y[1] - y[0]) * (z[1] - z[0]);
        for block in &self.blocks {
            block.carve(y, z, x0, dx, 1.0 / area, open);
        }
        for o in open {
            // Rounding of a sum of overlaps must not leave a sub-cell that is almost solid.
            *o = if *o < 1e-5 { 0.0 } else { *o };
        }
    }
}

impl Placed {
    /// Cuts a block of one voxel along `axis` to `0..period`, where its images must not
    /// overlap it.
    fn clip(&mut self, axis: usize, period: f64) {
        if self.block.dims()[axis] == 1 {
            let low = self.rest[axis].clamp(0.0, period);
            let high = (self.rest[axis] + self.edge[axis]).clamp(0.0, period);
            self.rest[axis] = low;
            self.edge[axis] = (high - low).max(TOUCH);
            self.origin = self.rest;
        }
    }

    fn index(&self, axis: usize, x: f64) -> Option<usize> {
        let s = (x - self.origin[axis]) / self.edge[axis];
        (s >= 0.0 && s < self.block.dims()[axis] as f64).then_some(s as usize)
    }

    fn contains(&self, point: [f64; 3]) -> bool {
        let Some(i) = self.index(0, point[0]) else {
            return false;
        };
        let Some(j) = self.index(1, point[1]) else {
            return false;
        };
        let Some(k) = self.index(2, point[2]) else {
            return false;
        };
        self.block.solid(i, j, k)
    }

    /// Range of voxels along `axis` that overlap `low..high`, or hold `low` when it is a point.
    fn range(&self, axis: usize, low: f64, high: f64) -> std::ops::Range<usize> {
        let n = self.block.dims()[axis] as f64;
        let a = ((low - self.origin[axis]) / self.edge[axis]).floor();
        if high == low {
            return if a >= 0.0 && a < n {
                a as usize..a as usize + 1
            } else {
                0..0
            };
        }
        let b = ((high - self.origin[axis]) / self.edge[axis]).ceil();
        a.clamp(0.0, n) as usize..b.clamp(0.0, n) as usize
    }

    fn length(&self, axis: usize, voxel: usize, low: f64, high: f64) -> f64 {
        if low == high {
            return 1.0;
        }
        let start = self.origin[axis] + voxel as f64 * self.edge[axis];
        (high.min(start + self.edge[axis]) - low.max(start)).max(0.0)
    }

    fn overlap(&self, low: [f64; 3], high: [f64; 3]) -> f64 {
        let mut volume = 0.0;
        for k in self.range(2, low[2], high[2]) {
            let lz = self.length(2, k, low[2], high[2]);
            for j in self.range(1, low[1], high[1]) {
                let ly = self.length(1, j, low[1], high[1]);
                for i in self.range(0, low[0], high[0]) {
                    if self.block.solid(i, j, k) {
                        volume += self.length(0, i, low[0], high[0]) * ly * lz;
                    }
                }
            }
        }
        volume
    }

    fn carve(&self, y: [f64; 2], z: [f64; 2], x0: f64, dx: f64, scale: f64, open: &mut [f32]) {
        for k in self.range(2, z[0], z[1]) {
            let lz = self.length(2, k, z[0], z[1]);
            for j in self.range(1, y[0], y[1]) {
                let area = self.length(1, j, y[0], y[1]) * lz * scale;
                if area <= TOUCH {
                    continue;
                }
                let first = ((self.origin[0] - x0) / dx).floor().max(0.0) as usize;
                let width = self.block.dims()[0] as f64 * self.edge[0];
                let end = (self.origin[0] + width - x0) / dx;
                let end = end.ceil().clamp(0.0, open.len() as f64) as usize;
                for (s, o) in open.iter_mut().enumerate().take(end).skip(first) {
                    let (a, b) = (x0 + s as f64 * dx, x0 + (s + 1) as f64 * dx);
                    for i in self.range(0, a, b) {
                        if self.block.solid(i, j, k) {
                            *o -= (self.length(0, i, a, b) / dx * area) as f32;
                        }
                    }
                }
            }
        }
    }

    /// Near and far distance of the first run of solid voxels along a ray.
    fn ray(&self, from: [f64; 3], axis: usize, up: bool, reach: f64) -> Option<(f64, f64)> {
        let mut voxel = [0_usize; 3];
        for t in (0..3).filter(|&t| t != axis) {
            voxel[t] = self.index(t, from[t])?;
        }
        let (edge, n) = (self.edge[axis], self.block.dims()[axis] as i64);
        let along = from[axis] - self.origin[axis];
        let step: i64 = if up { 1 } else { -1 };
        let nudged = along + if up { TOUCH } else { -TOUCH };
        let mut v = (nudged / edge).floor() as i64;
        if up && v >= n || !up && v < 0 {
            return None;
        }
        v = v.clamp(0, n - 1);
        // Distance to the surface by which the ray enters voxel v.
        let enter = |v: i64| {
            if up {
                v as f64 * edge - along
            } else {
                along - (v + 1) as f64 * edge
            }
        };
        let solid = |v: i64, mut at: [usize; 3]| {
            at[axis] = v as usize;
            self.block.solid(at[0], at[1], at[2])
        };
        while (0..n).contains(&v) {
            let near = enter(v);
            if near > reach {
                return None;
            }
            if solid(v, voxel) {
                let mut end = v + step;
                while (0..n).contains(&end) && enter(end) <= reach && solid(end, voxel) {
                    end += step;
                }
                return Some((near.max(0.0), enter(end)));
            }
            v += step;
        }
        None
    }
}
