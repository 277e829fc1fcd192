//! Swept collision of points with moving bodies: nothing passes a wall, however thin.

use std::ops::Deref;

use super::Solids;
use super::block::for_each;
use super::placed::{Placed, TOUCH, floor};
use super::rows::Rows;

/// Distance (cells) at which a deflected point stays off a wall.
const CLEARANCE: f64 = 0.02;
/// Walls that one path can be deflected by; a corner of three takes three.
const DEFLECTIONS: usize = 8;
/// Distances (cells) searched around a point that closing walls have pinched.
const SEARCH: [f64; 6] = [0.05, 0.15, 0.3, 0.6, 1.0, 1.5];

/// Where a path ends that walls may have deflected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Deflected {
    /// End of the path, outside all solids unless `pinched`.
    pub(crate) point: [f64; 3],
    /// How deep (cells) the undeflected end lay behind the wall that stopped it most; 0 when
    /// nothing was met.
    pub(crate) depth: f64,
    /// Whether no place free of solids was found nearby.
    pub(crate) pinched: bool,
}

/// Where a straight path first enters a solid.
struct Entry {
    /// Part of the path before it.
    time: f64,
    axis: usize,
    /// Place along `axis` of the surface at the end of the step.
    surface: f64,
    /// Whether the path goes up along `axis`, relative to the wall.
    up: bool,
}

impl Solids {
    /// Takes a point from `from` to `to` while the bodies move from where they are here to
    /// where they are in `after`, sliding along the walls that are in the way.
    ///
    /// In the frame of each block the path is a straight line, followed voxel by voxel. When it
    /// enters a solid, the end is put back to just outside the surface that it entered through
    /// and the new straight line is tried, so the path taken is free of solids.
    pub(crate) fn deflect(&self, after: &Solids, from: [f64; 3], to: [f64; 3]) -> Deflected {
        let mut end = Deflected {
            point: to,
            depth: 0.0,
            pinched: false,
        };
        for _ in 0..DEFLECTIONS {
            let Some(entry) = self.first_entry(after, from, end.point) else {
                if after.at(end.point).is_some() {
                    break;
                }
                return end;
            };
            let place = &mut end.point[entry.axis];
            end.depth = end.depth.max((*place - entry.surface).abs());
            *place = entry.surface + if entry.up { -CLEARANCE } else { CLEARANCE };
        }
        match after.nearby(end.point) {
            Some(point) => end.point = point,
            None => end.pinched = true,
        }
        end
    }

    fn first_entry(&self, after: &Solids, from: [f64; 3], to: [f64; 3]) -> Option<Entry> {
        let mut first: Option<Entry> = None;
        for (before, after) in self.blocks.iter().zip(&after.blocks) {
            // Where the end is for the block as it was.
            let end: [f64; 3] =
                std::array::from_fn(|a| to[a] - (after.origin[a] - before.origin[a]));
            for_each!(image in &self.periods, std::slice::from_ref(before), from, end => {
                let shift = |a: usize| image.origin[a] - before.origin[a];
                let after = std::array::from_fn(|a| after.origin[a] + shift(a));
                if let Some(entry) = image.entry(after, from, to)
                    && first.as_ref().is_none_or(|f| entry.time < f.time)
                {
                    first = Some(entry);
                }
            });
        }
        first
    }

    /// A place free of solids close to `point`: nearest distances first, along the axes before
    /// the diagonals.
    fn nearby(&self, point: [f64; 3]) -> Option<[f64; 3]> {
        let axes = self.domain.axes;
        let inside = |x: [f64; 3]| {
            (0..axes).all(|a| {
                self.domain.periodic(a) || x[a] > 0.0 && x[a] < self.domain.cells[a] as f64
            })
        };
        // Base 3 digits of `way` are the steps along the axes: none, down, up.
        let digit = |way: usize, axis: usize| way / 3_usize.pow(axis as u32) % 3;
        let mut ways: Vec<usize> = (1..3_usize.pow(axes as u32)).collect();
        ways.sort_by_key(|&way| (0..axes).filter(|&a| digit(way, a) != 0).count());
        for distance in SEARCH {
            for &way in &ways {
                let candidate = std::array::from_fn(|a| {
                    point[a] + [0.0, -distance, distance][if a < axes { digit(way, a) } else { 0 }]
                });
                if inside(candidate) && self.at(candidate).is_none() {
                    return Some(candidate);
                }
            }
        }
        None
    }
}

impl<R: Deref<Target = Rows>> Placed<R> {
    /// First entry of the path into a solid voxel of the block, whose low corner goes to `after`; a voxel that
    /// the path starts in does not count.
    fn entry(&self, after: [f64; 3], from: [f64; 3], to: [f64; 3]) -> Option<Entry> {
        // Most paths lie below one of the blocks, which takes no division to tell.
        if (0..3).any(|i| from[i] < self.origin[i] && to[i] < after[i]) {
            return None;
        }
        let a: [f64; 3] = std::array::from_fn(|i| (from[i] - self.origin[i]) / self.edge[i]);
        let b: [f64; 3] = std::array::from_fn(|i| (to[i] - after[i]) / self.edge[i]);
        let dims = self.rows.block.dims().map(|n| n as f64);
        if (0..3).any(|i| a[i].max(b[i]) < 0.0 || a[i].min(b[i]) > dims[i]) {
            return None;
        }
        let mut voxel = a.map(floor);
        let within = |i: usize| (TOUCH..1.0 - TOUCH).contains(&(b[i] - voxel[i] as f64));
        if (0..3).all(within) {
            return None;
        }
        let way: [f64; 3] = std::array::from_fn(|i| b[i] - a[i]);
        let step = way.map(|w| if w > 0.0 { 1_i64 } else { -1 });
        // Part of the path at which it leaves the current voxel along each axis.
        let mut leave: [f64; 3] = std::array::from_fn(|i| {
            if way[i] == 0.0 {
                return f64::INFINITY;
            }
            let border = if way[i] > 0.0 { voxel[i] + 1 } else { voxel[i] };
            (border as f64 - a[i]) / way[i]
        });
        loop {
            let axis = if leave[0] <= leave[1] && leave[0] <= leave[2] {
                0
            } else if leave[1] <= leave[2] {
                1
            } else {
                2
            };
            let time = leave[axis];
            if time > 1.0 {
                return None;
            }
            voxel[axis] += step[axis];
            leave[axis] += (step[axis] as f64) / way[axis];
            let [i, j, k] = voxel;
            if i >= 0
                && j >= 0
                && k >= 0
                && self.rows.block.solid(i as usize, j as usize, k as usize)
            {
                let up = step[axis] > 0;
                let border = if up { voxel[axis] } else { voxel[axis] + 1 };
                return Some(Entry {
                    time,
                    axis,
                    surface: after[axis] + border as f64 * self.edge[axis],
                    up,
                });
            }
        }
    }
}
