//! One block of voxels at its place: what of it points, boxes, rows and rays meet.

use std::sync::Arc;

use physics::VoxelBlock;

use super::BodyId;

/// Points this close (cells) to a surface count as on it.
pub(super) const TOUCH: f64 = 1e-7;

/// A block of voxels at its place, in cell units.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    pub(super) body: BodyId,
    pub(super) block: Arc<VoxelBlock>,
    /// Low corner without displacement.
    pub(super) rest: [f64; 3],
    /// Low corner now.
    pub(super) origin: [f64; 3],
    /// Edges of a voxel.
    pub(super) edge: [f64; 3],
}

impl Placed {
    /// Cuts a block of one voxel along `axis` to `0..period`, where its images must not
    /// overlap it.
    pub(super) fn clip(&mut self, axis: usize, period: f64) {
        if self.block.dims()[axis] == 1 {
            let low = self.rest[axis].clamp(0.0, period);
            let high = (self.rest[axis] + self.edge[axis]).clamp(0.0, period);
            self.rest[axis] = low;
            self.edge[axis] = (high - low).max(TOUCH);
            self.origin = self.rest;
        }
    }

    #[inline]
    fn index(&self, axis: usize, x: f64) -> Option<usize> {
        let s = (x - self.origin[axis]) / self.edge[axis];
        (s >= 0.0 && s < self.block.dims()[axis] as f64).then_some(s as usize)
    }

    #[inline]
    pub(super) fn contains(&self, point: [f64; 3]) -> bool {
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

    pub(super) fn overlap(&self, low: [f64; 3], high: [f64; 3]) -> f64 {
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

    pub(super) fn carve(
        &self,
        y: [f64; 2],
        z: [f64; 2],
        x0: f64,
        dx: f64,
        scale: f64,
        open: &mut [f32],
    ) {
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
    #[inline]
    pub(super) fn ray(
        &self,
        from: [f64; 3],
        axis: usize,
        up: bool,
        reach: f64,
    ) -> Option<(f64, f64)> {
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
