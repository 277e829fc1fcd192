//! Velocity within pores, interpolated from face velocities (docs/methods.md section 3.15).

use rayon::prelude::*;

use super::FlowField;
use crate::geometry::{Lattice, others};

/// Velocity profiles of a flow within pores. A component is linear along its own axis from face to face. Across it is a parabola
/// whose mean over the face is the velocity of the face and whose slopes at its two sides are the shear rates there.
pub(crate) struct Profile<'a> {
    lattice: &'a Lattice,
    flow: FlowField<'a>,
    /// Slopes of the velocity of each face at its low and its high side along its two tangential axes, the lower first, 1/s.
    slopes: Vec<[[f64; 2]; 2]>,
}

/// Velocities of the voxel columns at a side of a pore, the lower tangential axis fastest; `None` where the liquid ends.
type Columns = [Option<f64>; 4];

impl<'a> Profile<'a> {
    pub(crate) fn new(lattice: &'a Lattice, flow: FlowField<'a>) -> Self {
        let faces = (0..flow.mesh.faces.len()).into_par_iter();
        Self {
            lattice,
            slopes: faces.map(|face| flow.slopes(face)).collect(),
            flow,
        }
    }

    /// Velocities at the centres of the voxels of a pore, in their order, cells/s.
    pub(crate) fn of_pore(&self, pore: usize) -> impl Iterator<Item = [f64; 3]> {
        let sides: [[Columns; 2]; 3] = std::array::from_fn(|axis| {
            [false, true].map(|up| match self.lattice.flat && axis == 2 {
                true => [None; 4],
                false => self.columns(pore, axis, up),
            })
        });
        let at = move |voxel: [usize; 3]| {
            std::array::from_fn(|axis| {
                let [(first, low), (last, high)] = [false, true].map(|up| {
                    self.column_end(pore, voxel, &sides[axis][usize::from(up)], axis, up)
                });
                let part = (voxel[axis] as f64 + 0.5 - first) / (last - first);
                let between = |a: f64, b: f64| a + part * (b - a);
                let own = match (low, high) {
                    (Some(low), Some(high)) => between(low, high),
                    (one, other) => one.or(other).unwrap_or(0.0),
                };
                let [low, high] =
                    [false, true].map(|up| self.flow.grid_velocity(self.lattice, pore, axis, up));
                own + between(low, high)
            })
        };
        self.flow.mesh.voxels(pore).map(at)
    }

    /// Velocities relative to the grid of the voxel columns at one side of a pore: 0 at walls. Over the open height h of a face
    /// this is u + a y + c (y^2 - h^2/12), with the slopes a - c h and a + c h at its sides.
    fn columns(&self, pore: usize, axis: usize, up: bool) -> Columns {
        let (mesh, across) = (self.flow.mesh, others(axis));
        let k = mesh.k;
        let mut side: Columns = [Some(0.0); 4];
        for face in mesh.faces_at(pore, axis, up) {
            let open = mesh.faces[face].open;
            let places = (0..k * k).filter(|place| open >> place & 1 == 1);
            let at = |place: usize| [place % k, place / k];
            let ends = [0, 1].map(|i| {
                let along = places.clone().map(|place| at(place)[i]);
                along.fold([k, 0], |[first, last], at| {
                    [first.min(at), last.max(at + 1)]
                })
            });
            for place in places {
                let departure = |i: usize| {
                    let edge = mesh.edge(pore, across[i]) / k as f64;
                    let [[first, last], [low, high]] =
                        [ends[i].map(|end| end as f64), self.slopes[face][i]];
                    let (height, y) = (
                        edge * (last - first),
                        edge * (at(place)[i] as f64 + 0.5 - 0.5 * (first + last)),
                    );
                    let curvature = 0.5 * (high - low) / height;
                    0.5 * (low + high) * y + curvature * (y * y - height * height / 12.0)
                };
                side[place] = (self.flow.moves(face))
                    .then(|| self.flow.velocity[face] + departure(0) + departure(1));
            }
        }
        side
    }

    /// End of a voxel's column along an axis: its position, voxels from the low side of the cell, and the velocity relative
    /// to the grid there, 0 at a wall within the cell, else that of the `side` of the pore.
    fn column_end(
        &self,
        pore: usize,
        voxel: [usize; 3],
        side: &Columns,
        axis: usize,
        up: bool,
    ) -> (f64, Option<f64>) {
        let mesh = self.flow.mesh;
        let mut last = voxel;
        let end = if up { mesh.k - 1 } else { 0 };
        while last[axis] != end {
            let mut next = last;
            next[axis] = if up { last[axis] + 1 } else { last[axis] - 1 };
            if !mesh.has_voxel(pore, next) {
                return ((last[axis] + usize::from(up)) as f64, Some(0.0));
            }
            last = next;
        }
        let [s, t] = others(axis);
        let own = side[last[s] + mesh.k * last[t]];
        ((last[axis] + usize::from(up)) as f64, own)
    }
}

impl FlowField<'_> {
    /// Mean velocity of a pore: along each axis the mean of its two sides, by area, cells/s.
    pub(crate) fn mean(&self, lattice: &Lattice, pore: usize) -> [f64; 3] {
        let mesh = self.mesh;
        std::array::from_fn(|axis| {
            let side = |up: bool| {
                let faces = mesh.faces_at(pore, axis, up);
                let (flux, area) = faces.fold((0.0, 0.0), |(flux, area), face| {
                    let own = mesh.area(face);
                    (flux + own * self.velocity[face], area + own)
                });
                let own = if area > 0.0 { flux / area } else { 0.0 };
                self.grid_velocity(lattice, pore, axis, up) + own
            };
            0.5 * (side(false) + side(true))
        })
    }

    /// Velocity of the grid along an axis at one side of a pore's cell, cells/s.
    fn grid_velocity(&self, lattice: &Lattice, pore: usize, axis: usize, up: bool) -> f64 {
        if axis != 1 {
            return 0.0;
        }
        let row = self.mesh.row_of(pore);
        let share = self.mesh.rows().closing_share(row + usize::from(up));
        lattice.grid_speed(share) * self.speed
    }

    /// Whether the velocity of a face was an unknown of the step: those of others are exactly zero.
    fn moves(&self, face: usize) -> bool {
        self.velocity[face] != 0.0
    }

    /// Slopes of the velocity of a face at its low and its high side along its two tangential axes. Where a side has no next face
    /// this is the wall shear rate, and zero where the liquid ends.
    fn slopes(&self, face: usize) -> [[f64; 2]; 2] {
        if !self.moves(face) {
            return [[0.0; 2]; 2];
        }
        let (mesh, f) = (self.mesh, self.mesh.faces[face]);
        let at_walls = self.wall_shear_rate(face);
        // Number of open voxel columns of the face, transverse to each of the two axes.
        let columns = [
            (f.open | f.open >> 1) & 0b0101,
            (f.open | f.open >> 2) & 0b0011,
        ]
        .map(|open| f64::from(open.count_ones()));
        let across = others(usize::from(f.axis));
        std::array::from_fn(|i| {
            let side = |up: bool| {
                let edges = self.edges.of(face).iter();
                let (mut rate, mut walls) = (0.0, columns[i]);
                for edge in edges.filter(|edge| edge.is_at(across[i], up)) {
                    walls -= edge.columns();
                    if self.moves(edge.next as usize) {
                        rate += edge.columns() * edge.slope(mesh, face, self.velocity);
                    }
                }
                let inside = mesh.next_cell(mesh.cell(f.low as usize), across[i], up);
                let rate = match (inside, up) {
                    (None, _) => rate,
                    (_, true) => rate + walls * at_walls,
                    (_, false) => rate - walls * at_walls,
                };
                rate / columns[i]
            };
            [side(false), side(true)]
        })
    }

    /// Mean shear rate at the walls of a face, 1/s, positive if the walls accelerate it.
    fn wall_shear_rate(&self, face: usize) -> f64 {
        let coupling = self.couplings.of(face);
        if coupling.area == 0.0 {
            return 0.0;
        }
        let drag = |half: usize| {
            let [own, closing] = coupling.sliding[half];
            own + closing * self.speed - coupling.friction[half] * self.velocity[face]
        };
        (drag(0) + drag(1)) / coupling.area
    }
}
