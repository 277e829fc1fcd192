//! Voxels as lit solids: their surface where the trilinear interpolation between voxel centres is
//! one half, so that one voxel alone is still there and a full one ends at its faces.

use particle_file::limits;
use voxels::{ADHESIVE, LabelVolume, VOID, WOOD};

/// What a ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hit {
    /// Distance from the ray's start, voxels.
    pub(crate) distance: f64,
    /// [`ADHESIVE`] or [`WOOD`].
    pub(crate) label: u8,
    /// Unit vector out of the solid.
    pub(crate) normal: [f64; 3],
    /// Share of solid about the place: one half on a plane, more in a corner.
    pub(crate) filled: f64,
}

/// Labels of voxels with a layer of void around them. A place (in voxels from the low corner of
/// that layer's centres) lies in the cell of the eight centres around it.
pub(crate) struct Solids {
    /// Voxels along x, y, z with the layer.
    dims: [usize; 3],
    labels: Vec<u8>,
    /// Of each cell, by its low corner: bits of the labels that some but not all corners have.
    surface: Vec<u8>,
}

/// Radius of the neighbourhood that normals are taken from, and the voxels it reaches over.
const RADIUS: f64 = 2.5;
const REACH: isize = 3;
/// Places along a ray's way through a cell at which the surface is looked for.
const SAMPLES: usize = 4;

fn bit(label: u8) -> u8 {
    match label {
        ADHESIVE => 1,
        WOOD => 2,
        _ => 0,
    }
}

impl Solids {
    /// Memory that the voxels of `dims` take while they are made: a byte for label, bits and surface each.
    pub(crate) fn bytes(dims: [usize; 3]) -> u64 {
        3 * limits::volume(dims.map(|n| n as u64 + 2))
    }

    /// The adhesive of `labels`, and of its wood the voxels that are shown.
    pub(crate) fn new(labels: &LabelVolume, shown: impl Fn([usize; 3]) -> bool) -> Self {
        let dims = labels.dims.map(|n| n + 2);
        let mut solids = Self {
            dims,
            labels: vec![VOID; dims.iter().product()],
            surface: Vec::new(),
        };
        let [nx, ny, _] = labels.dims;
        let mut z = 0;
        let page = labels.pages(|page| {
            for (i, &label) in page.iter().enumerate() {
                let voxel = [i % nx, i / nx % ny, z];
                if label == ADHESIVE || label == WOOD && shown(voxel) {
                    let at = solids.index(voxel.map(|i| i + 1));
                    solids.labels[at] = label;
                }
            }
            z += 1;
            Ok(())
        });
        // Only writing fails, and nothing is written.
        debug_assert!(page.is_ok());
        solids.mark();
        solids
    }

    fn mark(&mut self) {
        let offsets = self.corners();
        let bits: Vec<u8> = self.labels.iter().map(|label| bit(*label)).collect();
        self.surface = vec![0; bits.len()];
        for at in 0..bits.len() - offsets[7] {
            let all = offsets.iter().fold((0, 3), |(any, all), offset| {
                let bit = bits[at + offset];
                (any | bit, all & bit)
            });
            self.surface[at] = all.0 & !all.1;
        }
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.dims[1] + y) * self.dims[0] + x
    }

    /// Offsets of the corners of a cell from its lowest.
    fn corners(&self) -> [usize; 8] {
        std::array::from_fn(|c| self.index([c & 1, c >> 1 & 1, c >> 2]))
    }

    /// Where a ray from `start` along the unit vector `way` (no component exactly zero) first
    /// meets a solid.
    pub(crate) fn meet(&self, start: [f64; 3], way: [f64; 3]) -> Option<Hit> {
        let last = self.dims.map(|n| n as f64 - 1.0);
        // Distances at which the ray enters and leaves the box of all cells.
        let [mut near, mut far] = [0.0_f64, f64::INFINITY];
        for a in 0..3 {
            let ends = [-start[a] / way[a], (last[a] - start[a]) / way[a]];
            near = near.max(ends[0].min(ends[1]));
            far = far.min(ends[0].max(ends[1]));
        }
        let mut at = near;
        let place = |at: f64, a: usize| start[a] + at * way[a];
        let mut cell: [usize; 3] =
            std::array::from_fn(|a| (place(at, a).max(0.0) as usize).min(self.dims[a] - 2));
        let corners = self.corners();
        while at < far {
            // The next face of the cell that the ray crosses.
            let faces: [f64; 3] = std::array::from_fn(|a| {
                let face = cell[a] as f64 + if way[a] > 0.0 { 1.0 } else { 0.0 };
                (face - start[a]) / way[a]
            });
            let nearest = (0..3).min_by(|&a, &b| faces[a].total_cmp(&faces[b]));
            let axis = nearest.unwrap_or(0);
            let low = self.index(cell);
            if self.surface[low] != 0 {
                let ends = [at, faces[axis].max(at)];
                if let Some((distance, label)) = self.cross(low, cell, &corners, start, way, ends) {
                    let hit: [f64; 3] = std::array::from_fn(|a| place(distance, a));
                    let (normal, filled) = self.shape(hit, label, way);
                    return Some(Hit {
                        distance,
                        label,
                        normal,
                        filled,
                    });
                }
            }
            at = faces[axis].max(at);
            match way[axis] > 0.0 {
                true if cell[axis] + 2 < self.dims[axis] => cell[axis] += 1,
                false if cell[axis] > 0 => cell[axis] -= 1,
                _ => return None,
            }
        }
        None
    }

    /// Where within a cell the ray first crosses the surface of a label.
    fn cross(
        &self,
        low: usize,
        cell: [usize; 3],
        corners: &[usize; 8],
        start: [f64; 3],
        way: [f64; 3],
        [from, to]: [f64; 2],
    ) -> Option<(f64, u8)> {
        let mut first: Option<(f64, u8)> = None;
        for label in [ADHESIVE, WOOD] {
            if self.surface[low] & bit(label) == 0 {
                continue;
            }
            let inside = |at: f64| {
                let part: [f64; 3] =
                    std::array::from_fn(|a| start[a] + at * way[a] - cell[a] as f64);
                let along = |c: usize, a: usize| match c >> a & 1 {
                    1 => part[a],
                    _ => 1.0 - part[a],
                };
                let weight = |c: usize| (0..3).map(|a| along(c, a)).product::<f64>();
                let own = |c: &usize| self.labels[low + corners[*c]] == label;
                (0..8).filter(own).map(weight).sum::<f64>() - 0.5
            };
            let mut before = (from, inside(from));
            for i in 1..=SAMPLES {
                let at = from + (to - from) * i as f64 / SAMPLES as f64;
                let now = (at, inside(at));
                if before.1 >= 0.0 || now.1 >= 0.0 {
                    let share = match before.1 < 0.0 {
                        true => -before.1 / (now.1 - before.1),
                        false => 0.0,
                    };
                    let distance = before.0 + share * (now.0 - before.0);
                    if first.is_none_or(|(other, _)| distance < other) {
                        first = Some((distance, label));
                    }
                    break;
                }
                before = now;
            }
        }
        first
    }

    /// Normal of the surface of `label` at a place, and how much of its surroundings is solid.
    fn shape(&self, hit: [f64; 3], label: u8, way: [f64; 3]) -> ([f64; 3], f64) {
        let middle = hit.map(|x| x.round() as isize);
        let (mut moment, mut all, mut solid) = ([0.0; 3], 0.0, 0.0);
        let edge = 2 * REACH + 1;
        for i in 0..edge * edge * edge {
            let away = [i % edge, i / edge % edge, i / edge / edge].map(|i| i - REACH);
            let voxel: [isize; 3] = std::array::from_fn(|a| middle[a] + away[a]);
            let away: [f64; 3] = std::array::from_fn(|a| voxel[a] as f64 - hit[a]);
            let square: f64 = away.iter().map(|x| x * x).sum();
            if square >= RADIUS * RADIUS {
                continue;
            }
            let weight = (1.0 - square / (RADIUS * RADIUS)).powi(2);
            let found = self.label(voxel);
            all += weight;
            if found != VOID {
                solid += weight;
            }
            if found == label {
                (0..3).for_each(|a| moment[a] -= weight * away[a]);
            }
        }
        let length = moment.iter().map(|x| x * x).sum::<f64>().sqrt();
        let normal = match length > 1e-6 {
            true => moment.map(|x| x / length),
            // A voxel alone in the middle: it faces the viewer.
            false => way.map(|x| -x),
        };
        (normal, solid / all)
    }

    fn label(&self, voxel: [isize; 3]) -> u8 {
        let inside = (0..3).all(|a| (0..self.dims[a] as isize).contains(&voxel[a]));
        match inside {
            true => self.labels[self.index(voxel.map(|i| i as usize))],
            false => VOID,
        }
    }
}
