//! The surface of the bodies in pieces, with the area that it has where voxels step along an inclined wall.

use std::ops::Deref;

use rayon::prelude::*;

use super::block::for_each;
use super::placed::Placed;
use super::rows::Rows;
use super::{BodyId, Solids};
use crate::geometry::Window;
use physics::Boundary;

/// Longest edge of a piece, and the distance of the places probed around one, cells.
const EDGE: f64 = 0.5;
/// How far places around a piece tell where its wall faces, cells; by 1 - (r/RADIUS)^2.
const RADIUS: f64 = 1.3;
/// Least cosine between a face of a voxel and the wall that it stands for: that in the corner of a cube.
const LEAST: f64 = 0.577;
/// Cells off a wall at which liquid beside it is looked for.
const BESIDE: f64 = 0.02;
/// Cells off a wall at which the liquid is found that a wall takes from; less beside thin voxels.
const HOME: f64 = 0.45;

/// A piece of a face of a voxel.
#[derive(Clone, Copy, Debug)]
struct Piece {
    /// Its middle before any displacement, cells.
    centre: [f32; 3],
    /// The axis that it is normal to.
    axis: u8,
    /// Whether the body is below it.
    up: bool,
    /// Cells off it at which the liquid is found that it takes from.
    reach: f32,
    /// Area of the wall that it stands for, cells^2.
    area: f32,
}

/// The surface of some bodies.
#[derive(Clone, Debug, Default)]
pub(crate) struct Surface(Vec<(BodyId, Vec<Piece>)>);

impl Surface {
    /// The surface of those of the bodies, undisplaced, that are `wanted`.
    ///
    /// An inclined wall made of voxels is a staircase, 4/pi times as long around a circle. Of each face
    /// counts its area times the cosine between its normal and that of the wall: the way from the
    /// face to the middle of what is open around it.
    pub(crate) fn new(solids: &Solids, wanted: impl Fn(BodyId) -> bool) -> Self {
        let mut parts = Vec::new();
        let end = solids.domain.cells.map(|n| n as f64);
        for_each!(block in &solids.periods, &solids.blocks, [0.0; 3], end => {
            if wanted(block.body) {
                let pieces = (0..block.rows.block.dims()[2])
                    .into_par_iter()
                    .flat_map_iter(|layer| solids.pieces(block, layer))
                    .collect();
                parts.push((block.body, pieces));
            }
        });
        Self(parts)
    }

    /// Number of pieces.
    pub(crate) fn len(&self) -> usize {
        self.0.iter().map(|(_, pieces)| pieces.len()).sum()
    }

    /// What is wet of it in `window` between bodies now at `solids`, with the liquid fractions `phi` and open
    /// fractions `open` of its sub-cells.
    pub(crate) fn wetted(
        &self,
        solids: &Solids,
        window: &Window,
        open: &[f32],
        phi: &[f32],
    ) -> Vec<Wetted> {
        let (mut all, mut first) = (Vec::new(), 0);
        for (body, pieces) in &self.0 {
            let shift = solids.shift(*body);
            all.par_extend(pieces.par_iter().enumerate().filter_map(|(p, piece)| {
                let at = |off: f64| piece.off(&shift, off, window);
                let beside = at(BESIDE);
                let sub = sub_cell(window, beside)?;
                let wet = phi[sub];
                let free = |x| solids.at(x).is_none();
                if wet == 0.0 || !(open[sub] == 1.0 || free(beside)) {
                    return None;
                }
                let reach = f64::from(piece.reach);
                let inside = |x: &[f64; 3]| sub_cell(window, *x).is_some() && free(*x);
                let home = [reach, 0.5 * reach].map(at).into_iter().find(inside);
                let home = home.unwrap_or(beside);
                Some(Wetted {
                    piece: (first + p) as u32,
                    cell: window.index(window.local(home).map(|s| s as usize)) as u32,
                    area: wet * piece.area,
                    part: wet,
                })
            }));
            first += pieces.len();
        }
        all
    }
}

/// A piece that is wet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wetted {
    /// Its number among all of its surface.
    pub(crate) piece: u32,
    /// The cell of the window that it takes from.
    pub(crate) cell: u32,
    /// Its wet area, cells^2, and the part of it that this is.
    pub(crate) area: f32,
    pub(crate) part: f32,
}

impl Piece {
    /// The place so many cells off it, of a body displaced by `shift`, in the domain where that repeats.
    fn off(&self, shift: &[f64; 3], off: f64, window: &Window) -> [f64; 3] {
        let mut at = std::array::from_fn(|a| f64::from(self.centre[a]) + shift[a]);
        at[usize::from(self.axis)] += if self.up { off } else { -off };
        for (a, x) in at.iter_mut().enumerate() {
            if window.domain.periodic(a) {
                *x = x.rem_euclid(window.domain.cells[a] as f64);
            }
        }
        at
    }
}

/// The sub-cell of `window` at a place that is in the domain.
fn sub_cell(window: &Window, at: [f64; 3]) -> Option<usize> {
    let local = window.local(at);
    let inside = (0..3).all(|a| {
        let n = window.domain.cells[a] as f64;
        (0.0..n).contains(&at[a]) && local[a] >= 0.0 && local[a] < window.cells[a] as f64
    });
    let part = |a: usize| (local[a] * window.parts(a) as f64) as usize * window.sub_stride(a);
    inside.then(|| (0..3).map(part).sum())
}

impl Solids {
    /// How far a body is from its first place, cells.
    fn shift(&self, body: BodyId) -> [f64; 3] {
        let block = self.blocks.iter().find(|block| block.body == body);
        block.map_or([0.0; 3], |b| {
            std::array::from_fn(|a| b.origin[a] - b.rest[a])
        })
    }

    /// The pieces of the surface of layer `k` of a block.
    fn pieces(&self, block: &Placed<impl Deref<Target = Rows>>, k: usize) -> Vec<Piece> {
        let voxels = &block.rows.block;
        let axes = self.domain.axes;
        let mut pieces = Vec::new();
        let low = |a: usize, i: usize| block.origin[a] + i as f64 * block.edge[a];
        if axes == 2 && !(low(2, k) <= 0.5 && low(2, k + 1) > 0.5) {
            return pieces;
        }
        for j in 0..voxels.dims()[1] {
            for i in (0..voxels.dims()[0]).filter(|&i| voxels.solid(i, j, k)) {
                let at = [i, j, k];
                for (axis, up) in (0..axes).flat_map(|a| [(a, false), (a, true)]) {
                    let mut next = at;
                    next[axis] = next[axis].wrapping_add_signed(if up { 1 } else { -1 });
                    if !voxels.solid(next[0], next[1], next[2]) {
                        let mut corners = [[0.0; 2]; 3];
                        for (a, ends) in corners.iter_mut().enumerate() {
                            *ends = [low(a, at[a]), low(a, at[a] + 1)];
                        }
                        corners[axis] = [corners[axis][usize::from(up)]; 2];
                        self.face(corners, axis, up, block.edge[axis], &mut pieces);
                    }
                }
            }
        }
        pieces
    }

    /// The pieces of one face of a voxel between `corners`; `edge` is the voxel's along its normal.
    fn face(
        &self,
        mut corners: [[f64; 2]; 3],
        axis: usize,
        up: bool,
        edge: f64,
        pieces: &mut Vec<Piece>,
    ) {
        let domain = &self.domain;
        // A face on a periodic side is one with its image there.
        let inside = (0.0..domain.cells[axis] as f64).contains(&corners[axis][0]);
        if domain.periodic(axis) && !inside {
            return;
        }
        for a in (0..3).filter(|&a| a != axis) {
            let n = domain.cells[a] as f64;
            // What lies beyond the sides stays there: bodies move along y, or over periodic sides.
            if a != 1 || domain.periodic(a) || a >= domain.axes {
                corners[a] = corners[a].map(|x| x.clamp(0.0, n));
            }
        }
        let length = |a: usize| corners[a][1] - corners[a][0];
        let parts = |a: usize| match a == axis || a >= domain.axes {
            true => 1,
            false => (length(a) / EDGE - 1e-9).ceil().max(0.0) as usize,
        };
        let n = [0, 1, 2].map(parts);
        let area: f64 = (0..3).filter(|&a| a != axis).map(length).product();
        let area = area / n.iter().product::<usize>().max(1) as f64;
        for piece in 0..n.iter().product() {
            let place = [piece % n[0], piece / n[0] % n[1], piece / (n[0] * n[1])];
            let centre: [f64; 3] = std::array::from_fn(|a| {
                corners[a][0] + length(a) * (place[a] as f64 + 0.5) / n[a] as f64
            });
            pieces.push(Piece {
                centre: centre.map(|x| x as f32),
                axis: axis as u8,
                up,
                reach: HOME.min(0.9 * edge) as f32,
                area: (area * self.cosine(centre, axis, up)) as f32,
            });
        }
    }

    /// Cosine between the normal of a piece of surface and the way from it to the middle of the open
    /// places around it.
    fn cosine(&self, centre: [f64; 3], axis: usize, up: bool) -> f64 {
        let mut way = [0.0; 3];
        let most = (RADIUS / EDGE) as i32;
        let span = |a: usize| match (a == axis, a < self.domain.axes) {
            (true, _) => -most - 1..most + 1,
            (false, true) => -most..most + 1,
            (false, false) => 0..1,
        };
        for z in span(2) {
            for y in span(1) {
                for x in span(0) {
                    let step = [x, y, z];
                    let by: [f64; 3] = std::array::from_fn(|a| {
                        EDGE * (f64::from(step[a]) + if a == axis { 0.5 } else { 0.0 })
                    });
                    let square: f64 = by.iter().map(|x| x * x).sum();
                    let weight = 1.0 - square / (RADIUS * RADIUS);
                    let at = std::array::from_fn(|a| self.mirrored(a, centre[a] + by[a]));
                    if weight > 0.0 && self.at(at).is_none() {
                        way = std::array::from_fn(|a| way[a] + weight * by[a]);
                    }
                }
            }
        }
        let size = way.iter().map(|w| w * w).sum::<f64>().sqrt();
        let along = if up { way[axis] } else { -way[axis] };
        match size > 0.0 {
            true => (along / size).max(LEAST),
            false => 1.0,
        }
    }

    /// A coordinate, seen in the mirror where it lies beyond a symmetry plane.
    fn mirrored(&self, axis: usize, x: f64) -> f64 {
        let n = self.domain.cells[axis] as f64;
        match self.domain.boundary[axis] == Boundary::Symmetry && axis < self.domain.axes {
            true if x < 0.0 => -x,
            true if x > n => 2.0 * n - x,
            _ => x,
        }
    }
}

#[cfg(test)]
mod tests;
