//! Wall friction: the viscous coupling of every face to its walls (docs/methods.md section 3.5).

use std::num::NonZeroU32;
use std::sync::Arc;

use rayon::prelude::*;

use crate::geometry::{Chords, Lattice, MIRROR, Mesh, OPEN, VoxelAddress, others};
use crate::liquid::FaceMap;

use super::coupling::WallCoupling;

/// Lower bound on the width of a channel, cells: a fifth of the gap at which a bond counts as closed.
const MIN_WIDTH: f64 = 0.01;
/// Lower bound on d_w over the open height, which keeps friction finite.
const MIN_DISTANCE: f64 = 0.1;
/// Lower bound on the effective width H over the least of H_t, H_a and 2 h1, for walls on both axes: that of a square duct two
/// cells wide.
const MIN_DUCT: f64 = 0.85;

/// The wall couplings of all faces of a mesh at a height of the gap.
#[derive(Clone, Default)]
pub(crate) struct WallCouplings {
    /// One a face; a placeholder where it depends on the height of the gap.
    fixed: Arc<Vec<WallCoupling<f32>>>,
    /// Faces whose coupling depends on the height of the gap, and their couplings at one height.
    gap_faces: Arc<Vec<u32>>,
    of_gap: Vec<WallCoupling<f32>>,
}

impl WallCouplings {
    /// Whether none have been computed yet.
    pub(crate) fn is_empty(&self) -> bool {
        self.fixed.is_empty()
    }

    /// The coupling of a face.
    pub(crate) fn of(&self, face: usize) -> WallCoupling {
        let fixed = &self.fixed[face];
        let coupling = match fixed.of_gap {
            Some(number) => self.of_gap.get(number.get() as usize - 1).unwrap_or(fixed),
            None => fixed,
        };
        coupling.with(f64::from)
    }

    /// The couplings of a mesh that do not depend on the height of its gap; faces that are unchanged by `face_map` keep their
    /// `old` ones.
    pub(crate) fn new(channels: &Channels, face_map: &FaceMap, old: &Self) -> Self {
        let mesh = channels.mesh;
        let clear = mesh.wall_free_cells();
        let moving = channels.lattice.moving.is_some();
        let coupling = |face: usize| {
            let old = face_map.unchanged(face).map(|face| old.fixed[face]);
            if let Some(old) = old.filter(|coupling| coupling.of_gap.is_none()) {
                return old;
            }
            let clear = mesh.is_wall_free(face, &clear);
            match mesh.is_inner(face) {
                false => WallCoupling::default(),
                true if moving && channels.depends_on_gap(face) => WallCoupling {
                    of_gap: Some(NonZeroU32::MIN),
                    walled: !clear,
                    ..WallCoupling::default()
                },
                true => channels.coupling(face, clear),
            }
        };
        let mut fixed: Vec<WallCoupling<f32>> = (0..mesh.faces.len())
            .into_par_iter()
            .map(coupling)
            .collect();
        let mut gap_faces = Vec::new();
        for (face, coupling) in fixed.iter_mut().enumerate() {
            if coupling.of_gap.is_some() {
                gap_faces.push(face as u32);
                coupling.of_gap = NonZeroU32::new(gap_faces.len() as u32);
            }
        }
        Self {
            fixed: Arc::new(fixed),
            gap_faces: Arc::new(gap_faces),
            of_gap: Vec::new(),
        }
    }

    /// These couplings at the height of the gap of the `channels`, of faces with liquid.
    pub(crate) fn at_height(&self, channels: &Channels, fractions: &[f64]) -> Self {
        let coupling = |&face: &u32| {
            let face = face as usize;
            let mut pores = channels.mesh.faces[face].pores().into_iter();
            let fixed = self.fixed[face];
            match pores.any(|pore| fractions[pore] > 0.0) {
                true => channels.coupling(face, !fixed.walled),
                false => fixed,
            }
        };
        Self {
            of_gap: self.gap_faces.par_iter().map(coupling).collect(),
            ..self.clone()
        }
    }
}

/// The inputs of wall couplings.
pub(crate) struct Channels<'a> {
    pub(crate) lattice: &'a Lattice,
    pub(crate) chords: &'a Chords,
    pub(crate) mesh: &'a Mesh,
    /// Influence length of Eq. 3, cells; infinite without friction.
    pub(crate) influence_length: f64,
}

impl Channels<'_> {
    /// Whether the coupling of a face depends on the height of the gap.
    fn depends_on_gap(&self, face: usize) -> bool {
        let mesh = self.mesh;
        let through = |pore: usize| {
            let indices = mesh.cell_indices(mesh.cell(pore));
            let voxels = mesh.voxels(pore);
            voxels
                .filter_map(|voxel| mesh.lattice_address(self.lattice, indices, voxel))
                .any(|address| self.chords.through_gap(self.lattice, address))
        };
        mesh.touches_gap(face) || mesh.faces[face].pores().into_iter().any(through)
    }

    /// Computes the coupling of a face; `clear` says that it has no walls.
    fn coupling(&self, face: usize, clear: bool) -> WallCoupling<f32> {
        let mut coupling = WallCoupling::<f64>::default();
        let f = self.mesh.faces[face];
        let cell_indices = f
            .pores()
            .map(|pore| self.mesh.cell_indices(self.mesh.cell(pore)));
        let axis = usize::from(f.axis);
        if self.influence_length.is_infinite() {
            return coupling.with(|value| value as f32);
        }
        for t in others(axis) {
            if self.lattice.flat && t == 2 {
                continue;
            }
            for r in 0..self.mesh.k {
                self.column((face, clear), cell_indices, (t, r), &mut coupling);
            }
        }
        coupling.with(|value| value as f32)
    }

    /// Adds the walls at both ends of voxel column `r` along `t` of a face. `cell_indices` are those of its two cells.
    fn column(
        &self,
        (face, clear): (usize, bool),
        cell_indices: [[usize; 3]; 2],
        (t, r): (usize, usize),
        coupling: &mut WallCoupling,
    ) {
        let (mesh, k) = (self.mesh, self.mesh.k);
        let f = mesh.faces[face];
        let axis = usize::from(f.axis);
        let pores = f.pores();
        let cells = pores.map(|pore| mesh.cell(pore));
        let across = 3 - axis - t;
        let voxel = |half: usize, i: usize| {
            let mut at = [0; 3];
            (at[axis], at[t], at[across]) = (if half == 0 { k - 1 } else { 0 }, i, r);
            at
        };
        let mut open = (0..k).filter(|&i| mesh.is_open(face, voxel(0, i)));
        let Some(first) = open.next() else {
            return;
        };
        let last = open.next_back().unwrap_or(first);
        let height = (last + 1 - first) as f64 / k as f64;
        let is_wall = |code: u8| code != OPEN && code != MIRROR;
        let corner = [(first, false), (last, true)];
        let both = [0, 1].map(|half| {
            corner.map(|(i, up)| match clear {
                true => OPEN,
                false => mesh
                    .next_voxel(cells[half], voxel(half, i), t, up)
                    .map_or(MIRROR, |(cell, at)| mesh.code(cell, at)),
            })
        });
        let walled = both.as_flattened().iter().any(|&code| is_wall(code));
        coupling.walled |= walled;
        for (half, cell) in cells.into_iter().enumerate() {
            let edges = [1.0, mesh.height(pores[half]), 1.0];
            let ends = both[half];
            let address =
                mesh.lattice_address(self.lattice, cell_indices[half], voxel(half, first));
            let width = |a: usize| self.width(address, a) / edges[t];
            let part = 0.5 * edges[axis] * edges[across] / k as f64;
            let along = width(t);
            coupling.inverse_width_squared += part / (along * along * edges[t] * edges[t]);
            if !walled {
                continue;
            }
            // With two voxels a cell, columns account for walls on the other axis by themselves.
            let widths = [along, if k == 1 { width(across) } else { along }];
            // Past the corner of a wall, liquid shears against the face that the wall closes.
            for (code, (_, up)) in both[1 - half].into_iter().zip(corner) {
                let open = ends[usize::from(up)] == OPEN;
                if let Some(next) = mesh
                    .next_cell(cell, t, up)
                    .filter(|_| open && is_wall(code))
                {
                    let apart = 0.5 * (height * edges[t] + mesh.cell_edge(next, t));
                    coupling.add(half, part / apart, self.wall_velocity(code, face, axis));
                }
            }
            if !ends.iter().any(|&code| is_wall(code)) {
                continue;
            }
            let between = ends.iter().all(|&code| is_wall(code));
            for (code, (i, up)) in ends.into_iter().zip(corner).filter(|end| is_wall(end.0)) {
                let at = (cell, voxel(half, i));
                let step_proximity = mesh.step_proximity(at, [t, across], up);
                let distance = edges[t] * self.distance(height, widths, between, step_proximity);
                let lowest = if axis == 1 {
                    1.0
                } else {
                    mesh.lowest_row(f.low as usize)
                };
                // Beside a step within the cell the friction already allows for its re-entrant edge.
                let factor = match step_proximity < 1.0 {
                    true => 1.0,
                    false => (lowest * mesh.ln_reentrant_factor(at, [t, across], up)).exp(),
                };
                let friction = factor * part / (distance + self.influence_length);
                coupling.add(half, friction, self.wall_velocity(code, face, axis));
                coupling.area += part;
                let shared = if between { 0.5 } else { 1.0 };
                coupling.height += part * shared * height * edges[t];
                coupling.body = code;
            }
        }
    }

    /// Channel width along an axis at a voxel, cells; above zero, so that a gap that closes has finite friction.
    fn width(&self, address: Option<VoxelAddress>, axis: usize) -> f64 {
        let k = self.mesh.k as f64;
        let gap = self.mesh.rows().height * k;
        let length = |address: VoxelAddress| self.chords.length(self.lattice, address, axis, gap);
        (address.map_or(f64::INFINITY, length) / k).max(MIN_WIDTH)
    }

    /// Effective distance d_w of a column from its walls, which makes the flux of plane Poiseuille flow exact for every open
    /// height `h1` of the column in a channel of width H. Lengths are over the edge of the cell along the column; the channel
    /// widths are those `along` the column, H_t, and `across` it, H_a.
    ///
    /// Derivation. The velocity is the mean over a column of height h1 at the wall. Between plates the profile is u = g (x -
    /// x^2/H) with the slope g at the wall; its mean there is g (h1/2 - h1^2/(3 H)). Differences of means over equal heights
    /// are exact, but that between the column at the wall and the next is short by e = g (h1^2 - 1)/(3 H). Spreading this
    /// defect over the half channel,
    ///
    /// d = h1/2 - h1^2/(3 H) + (1 - 2 h1/H) (h1^2 - 1)/(3 H).
    ///
    /// A column between two walls has the mean g H/6, so that d = H/6. Beside steps flow is not that between plates, and the
    /// defect is reduced by the factor 1 - `step_proximity`.
    fn distance(
        &self,
        h1: f64,
        [along, across]: [f64; 2],
        between: bool,
        step_proximity: f64,
    ) -> f64 {
        if between {
            return along / 6.0;
        }
        let width = match self.mesh.k {
            1 => {
                let least = along.min(across).min(2.0 * h1.max(0.5));
                let duct = (along.powi(-2) + (1.0 - step_proximity) * across.powi(-2)).powf(-0.5);
                duct.max(MIN_DUCT * least)
            }
            _ => along,
        };
        let defect = (1.0 - 2.0 * h1 / width) * (h1 * h1 - 1.0) / (3.0 * width);
        let distance = 0.5 * h1 - h1 * h1 / (3.0 * width) + (1.0 - step_proximity) * defect;
        distance.max(MIN_DISTANCE * h1)
    }

    /// Velocity of a wall along an axis relative to the grid at a face: by sliding, cells/s, and per closing speed.
    fn wall_velocity(&self, code: u8, face: usize, axis: usize) -> [f64; 2] {
        let body = usize::from(code - 1);
        let own = self.lattice.slide[body][axis];
        if axis != 1 {
            return [own, 0.0];
        }
        [
            0.0,
            self.lattice.body_speed(body) - self.mesh.grid_velocity(self.lattice, face),
        ]
    }
}
