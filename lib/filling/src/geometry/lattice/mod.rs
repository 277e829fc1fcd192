//! Geometry of a step: open fractions of the half-cell lattice, open and closed faces, the
//! walls that a face velocity sees along its tangential directions, and the areas it carries.
//!
//! Lengths are in cells. What is cheap to hold for every cell of the window (fractions, which
//! sub-cells are open or solid throughout, face states) is stored; what only faces near walls need
//! is answered by rays in the voxels of the bodies, each a scan of a few words of bits.

mod aperture;
mod column;
mod faces;
mod passage;
mod rooms;
mod uniform;

use physics::Boundary;
use rayon::prelude::*;

use crate::geometry::{BodyId, OPEN, Solids, Window};

pub(crate) use aperture::Aperture;
pub(crate) use column::Column;
pub(crate) use passage::{Chord, Passage};
pub(crate) use uniform::half;
use uniform::{Uniform, uniform};

/// Distance from a point at which its neighbourhood is probed: a wall exactly on the centre
/// of a face must be seen from both of its sides.
const PROBE: f64 = 1e-4;

/// Geometry of the bodies at one moment in one window.
#[derive(Clone, Debug)]
pub(crate) struct Lattice {
    /// Cells and their indices.
    pub(crate) window: Window,
    /// The bodies where they are at this moment.
    pub(crate) solids: Solids,
    /// Open volume fraction of each sub-cell; 0 beyond symmetry planes.
    pub(crate) open: Vec<f32>,
    /// Which sub-cells of each cell are open or solid throughout.
    pub(crate) uniform: Vec<Uniform>,
    /// State of the low face of each cell along x, y, z: [`OPEN`], or who closes it: a body
    /// or [`crate::geometry::SIDE`]. Empty along z in plane strain.
    pub(crate) faces: [Vec<BodyId>; 3],
}

impl Lattice {
    /// The geometry of `solids` in `window`.
    pub(crate) fn new(solids: Solids, window: Window) -> Self {
        let mut lattice = Self {
            window,
            solids,
            open: Vec::new(),
            uniform: Vec::new(),
            faces: [const { Vec::new() }; 3],
        };
        lattice.fill_open();
        lattice.uniform = uniform(&window, &lattice.open);
        let [nx, ny, _] = window.cells;
        for axis in 0..window.domain.axes {
            let mut faces = vec![OPEN; window.len()];
            faces.par_chunks_mut(nx).enumerate().for_each(|(r, row)| {
                for (i, face) in row.iter_mut().enumerate() {
                    *face = lattice.face_state(axis, [i, r % ny, r / ny]);
                }
            });
            lattice.faces[axis] = faces;
        }
        lattice
    }

    fn fill_open(&mut self) {
        let window = self.window;
        let [nx, ny, _] = window.sub_cells();
        let mut open = vec![1.0; window.sub_len()];
        let width: [f64; 3] = std::array::from_fn(|a| 1.0 / window.parts(a) as f64);
        // Ends of the sub-cell `s` along an axis.
        let span = |axis: usize, s: usize| {
            let low = window.low[axis] as f64 + s as f64 * width[axis];
            [low, low + width[axis]]
        };
        let outside = |axis: usize, [a, b]: [f64; 2]| {
            window.domain.boundary[axis] == Boundary::Symmetry
                && axis < window.domain.axes
                && (a < 0.0 || b > window.domain.cells[axis] as f64)
        };
        open.par_chunks_mut(nx).enumerate().for_each(|(r, row)| {
            let (y, z) = (span(1, r % ny), span(2, r / ny));
            if outside(1, y) || outside(2, z) {
                row.fill(0.0);
                return;
            }
            row.fill(1.0);
            self.solids
                .carve_row(y, z, window.low[0] as f64, width[0], row);
            for (s, o) in row.iter_mut().enumerate() {
                if outside(0, span(0, s)) {
                    *o = 0.0;
                }
            }
        });
        self.open = open;
    }

    /// Bits of all sub-cells of a cell.
    #[inline]
    pub(crate) fn all_parts(&self) -> u8 {
        u8::MAX >> (8 - self.window.sub_per_cell())
    }

    /// State of the low face along `axis` of a cell, see [`Lattice::faces`].
    #[inline]
    pub(crate) fn face(&self, axis: usize, index: usize) -> BodyId {
        self.faces[axis][index]
    }

    /// The tangential directions of a face: one in plane strain, else two.
    #[inline]
    pub(crate) fn tangents(&self, axis: usize) -> &'static [usize] {
        match (self.window.domain.axes, axis) {
            (2, 0) => &[1],
            (2, _) => &[0],
            (_, 0) => &[1, 2],
            (_, 1) => &[0, 2],
            _ => &[0, 1],
        }
    }
}
