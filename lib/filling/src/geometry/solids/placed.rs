//! One block of voxels at its place: what of it points, boxes, rows and rays meet.

use std::ops::Deref;

use super::BodyId;
use super::rows::{self, Rows};

/// Points this close (cells) to a surface count as on it.
pub(super) const TOUCH: f64 = 1e-7;

/// A block of voxels at its place, or, with borrowed `rows`, an image of it beyond periodic sides; in cell units.
#[derive(Clone, Debug)]
pub(super) struct Placed<R> {
    pub(super) body: BodyId,
    pub(super) rows: R,
    /// Low corner without displacement.
    pub(super) rest: [f64; 3],
    /// Low corner now.
    pub(super) origin: [f64; 3],
    /// Edges of a voxel.
    pub(super) edge: [f64; 3],
}

impl<R: Deref<Target = Rows>> Placed<R> {
    /// Whether it is that block or image.
    pub(super) fn is(&self, other: &Placed<impl Deref<Target = Rows>>) -> bool {
        std::ptr::eq(&*self.rows, &*other.rows) && self.origin == other.origin
    }

    #[inline]
    pub(super) fn index(&self, axis: usize, x: f64) -> Option<usize> {
        let s = (x - self.origin[axis]) / self.edge[axis];
        (s >= 0.0 && s < self.rows.block.dims()[axis] as f64).then_some(s as usize)
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
        self.rows.block.solid(i, j, k)
    }

    /// Range of voxels along `axis` that overlap `low..high`, or hold `low` when it is a point.
    #[inline]
    fn range(&self, axis: usize, low: f64, high: f64) -> std::ops::Range<usize> {
        let n = self.rows.block.dims()[axis] as f64;
        let voxels = |x: f64| (x - self.origin[axis]) / self.edge[axis];
        if high == low {
            return match voxels(low) {
                a if a >= 0.0 && a < n => a as usize..a as usize + 1,
                _ => 0..0,
            };
        }
        voxels(low).clamp(0.0, n) as usize..ceil(voxels(high).clamp(0.0, n))
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
                    if self.rows.block.solid(i, j, k) {
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
                let width = self.rows.block.dims()[0] as f64 * self.edge[0];
                let end = (self.origin[0] + width - x0) / dx;
                let end = end.ceil().clamp(0.0, open.len() as f64) as usize;
                for (s, o) in open.iter_mut().enumerate().take(end).skip(first) {
                    let (a, b) = (x0 + s as f64 * dx, x0 + (s + 1) as f64 * dx);
                    for i in self.range(0, a, b) {
                        if self.rows.block.solid(i, j, k) {
                            *o -= (self.length(0, i, a, b) / dx * area) as f32;
                        }
                    }
                }
            }
        }
    }

    /// The row of voxels along `axis` that the line through `from` runs in.
    #[inline]
    pub(super) fn row(&self, from: [f64; 3], axis: usize) -> Option<Row<'_>> {
        let mut voxel = [0_usize; 3];
        for t in (0..3).filter(|&t| t != axis) {
            voxel[t] = self.index(t, from[t])?;
        }
        Some(Row {
            bits: self.rows.along(axis, voxel),
            len: self.rows.block.dims()[axis],
            edge: self.edge[axis],
            along: from[axis] - self.origin[axis],
        })
    }
}

/// The least integer that is not below `x`, which is not negative.
#[inline]
fn ceil(x: f64) -> usize {
    let whole = x as usize;
    whole + usize::from((whole as f64) < x)
}

/// The integer at or below `x`, by two conversions instead of a call.
#[inline]
pub(super) fn floor(x: f64) -> i64 {
    let towards_zero = x as i64;
    towards_zero - i64::from(x < towards_zero as f64)
}

/// A row of voxels, and a point of the line through it from which rays start.
pub(super) struct Row<'a> {
    bits: &'a [u64],
    len: usize,
    edge: f64,
    /// Place of the point from the low end of the row.
    along: f64,
}

impl Row<'_> {
    /// Near and far distance of the first run of solid voxels upwards or downwards, no farther than
    /// `reach`; the run ends with the first voxel beyond it.
    #[inline]
    pub(super) fn ray(&self, up: bool, reach: f64) -> Option<(f64, f64)> {
        let &Self {
            along,
            edge,
            len,
            bits,
        } = self;
        // Distances to the faces between the voxels, counted from 0 to `len`, by which the ray
        // enters them.
        if up {
            let enter = |face: usize| face as f64 * edge - along;
            let start = ((along + TOUCH).max(0.0) / edge) as usize;
            let beyond = len.min(((along + reach) / edge).max(0.0) as usize + 2);
            let first = rows::next(bits, start, beyond, true);
            if first >= beyond || enter(first) > reach {
                return None;
            }
            let mut end = rows::next(bits, first + 1, beyond, false);
            while end > first + 1 && enter(end - 1) > reach {
                end -= 1;
            }
            Some((enter(first).max(0.0), enter(end)))
        } else {
            let enter = |face: usize| along - face as f64 * edge;
            if along < TOUCH {
                return None;
            }
            let start = len.min(((along - TOUCH) / edge) as usize + 1);
            let beyond = (((along - reach) / edge).max(0.0) as usize).saturating_sub(1);
            let first = rows::previous(bits, start, beyond, true);
            if first <= beyond || enter(first) > reach {
                return None;
            }
            let mut end = rows::previous(bits, first - 1, beyond, false);
            while end < first - 1 && enter(end + 1) > reach {
                end += 1;
            }
            Some((enter(first).max(0.0), enter(end)))
        }
    }
}

#[cfg(test)]
mod tests {
    use physics::VoxelBlock;

    use super::*;

    /// A ray by its definition: voxel after voxel.
    fn walked(placed: &Placed<&Rows>, from: [f64; 3], axis: usize, up: bool) -> Option<(f64, f64)> {
        let (edge, n) = (placed.edge[axis], placed.rows.block.dims()[axis] as i64);
        let along = from[axis] - placed.origin[axis];
        let solid = |v: i64| {
            let mut middle = from;
            middle[axis] = placed.origin[axis] + (v as f64 + 0.5) * edge;
            placed.contains(middle)
        };
        let first = if up { along + TOUCH } else { along - TOUCH } / edge;
        let (mut v, step) = (first.floor() as i64, if up { 1 } else { -1 });
        let distance = |v: i64| {
            let surface = if up { v as f64 } else { (v + 1) as f64 };
            (surface * edge - along) * step as f64
        };
        while (-200..n + 200).contains(&v) && !solid(v) {
            v += step;
        }
        let near = distance(v);
        if !(0..n).contains(&v) || near > REACH {
            return None;
        }
        v += step;
        while solid(v) && distance(v) <= REACH {
            v += step;
        }
        Some((near.max(0.0), distance(v)))
    }

    const REACH: f64 = 7.3;

    #[test]
    fn rays_by_words_are_rays_by_voxels() {
        let solid = |i, j, k| (i * i + 3 * j * k + j + 5 * k) % 11 < 4 || j > 60 && i > 40;
        let edge = [0.5, 0.25, 1.25];
        let block = VoxelBlock::from_fn([0.0; 3], edge, [70, 131, 9], solid);
        let origin = [-0.37, 1.21, 0.4];
        let placed = Placed {
            body: 0,
            rows: &Rows::new(block, 3),
            rest: origin,
            origin,
            edge,
        };
        let mut hits = 0;
        for n in 0..6000_u32 {
            let part = |of: f64| f64::from(n) * of % 1.0;
            let mut from = [part(0.317) * 35.0, part(0.731) * 33.0, part(0.093) * 11.0];
            if n % 3 == 0 {
                // On a face between voxels.
                from = std::array::from_fn(|a| origin[a] + (from[a] / edge[a]).round() * edge[a]);
            }
            for axis in 0..3 {
                for up in [false, true] {
                    let found = placed.row(from, axis).and_then(|row| row.ray(up, REACH));
                    assert_eq!(
                        found,
                        walked(&placed, from, axis, up),
                        "{from:?} {axis} {up}"
                    );
                    hits += usize::from(found.is_some());
                }
            }
        }
        assert!(hits > 10_000, "{hits}");
    }
}
