//! What the shear around the edges of the lattice takes of geometry and liquid: found once an edge
//! for the four faces whose rows it enters.

use super::Operator;
use super::dofs::NONE;
use super::sparse::Sparse;
use super::terms::Velocity;
use super::walls::{Beside, REACH};
use crate::geometry::{Across, OPEN, half};

/// An edge in the plane of two axes i and j.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Edge {
    /// Liquid and open volume of the sub-cells around it.
    pub(super) volume: [f64; 2],
    /// Part of the columns across which the two velocities along i, and those along j, see each
    /// other, times the factor of re-entrant edges along these; 0 where there are no two.
    pub(super) sight: [f32; 2],
    /// Distances between the places of these velocities, cells.
    pub(super) distance: [f64; 2],
    /// Whether one of the velocities is a body's.
    pub(super) walled: bool,
}

/// The edges around the faces that are unknowns, in each plane, counted by the axis along the edges,
/// and by the cell at whose low corner they are.
pub(super) struct Edges([Sparse<Edge>; 3]);

impl Edges {
    pub(super) fn new(operator: &Operator) -> Self {
        let window = &operator.lattice.window;
        let plain = Edge {
            volume: [window.sub_per_cell() as f64; 2],
            sight: [1.0; 2],
            distance: [1.0; 2],
            walled: false,
        };
        Self([(1, 2), (0, 2), (0, 1)].map(|(i, j)| {
            let len = if j < window.domain.axes {
                window.len()
            } else {
                0
            };
            Sparse::new(len, plain, |at| operator.edge(i, j, at))
        }))
    }

    /// The edge at the low corner of cell `at` in the plane of `i` and `j`, if there is shear.
    #[inline]
    pub(super) fn at(&self, i: usize, j: usize, at: usize) -> Option<Edge> {
        let edge = *self.0[3 - i - j].at(at)?;
        let [along, across] = edge.sight;
        let [di, dj] = edge.distance;
        Some(if i < j {
            edge
        } else {
            Edge {
                sight: [across, along],
                distance: [dj, di],
                ..edge
            }
        })
    }
}

impl Operator<'_> {
    /// The edge at the low corner of cell `at` in the plane of `i` and `j`; `None` where no
    /// unknown, no liquid or a symmetry plane is at it.
    fn edge(&self, i: usize, j: usize, at: usize) -> Option<Edge> {
        let window = &self.lattice.window;
        let (si, sj) = (window.stride(i), window.stride(j));
        let (below, beside) = (at.checked_sub(sj)?, at.checked_sub(si)?);
        let faces = [(i, below), (i, at), (j, beside), (j, at)];
        if faces
            .iter()
            .all(|&(axis, face)| self.dofs.face[axis][face] == NONE)
        {
            return None;
        }
        let velocities = faces.map(|(axis, index)| self.velocity(axis, index));
        if velocities.contains(&Some(Velocity::Still)) {
            return None;
        }
        let cell = window.coordinates(at);
        if cell[i] == 0 || cell[j] == 0 {
            return None;
        }
        let first = window.first_sub(cell) - window.sub_stride(i) - window.sub_stride(j);
        let (wet, open) = (self.volumes).of_block(self.lattice, first, [2, 2, window.parts(2)]);
        if wet <= 0.0 {
            return None;
        }
        let seen = |low: usize, axis: usize, t: usize| match velocities[low..low + 2] {
            [Some(a), Some(b)] => {
                let (sight, distance) = self.sight(axis, t, cell, [a, b]);
                match a.is_body() || b.is_body() {
                    true => (sight, distance),
                    false => (sight * self.beside(axis, t, cell), distance),
                }
            }
            _ => (0.0, 1.0),
        };
        let (along, across) = (seen(0, i, j), seen(2, j, i));
        Some(Edge {
            volume: [wet, open],
            sight: [along.0 as f32, across.0 as f32],
            distance: [along.1, across.1],
            walled: velocities.iter().flatten().any(|v| v.is_body()),
        })
    }

    /// Factor of the exchange between the face along `axis` below `cell` and that of `cell`, neighbours
    /// along `t`, by re-entrant edges along `axis`.
    fn beside(&self, axis: usize, t: usize, cell: [usize; 3]) -> f64 {
        let window = &self.lattice.window;
        if window.domain.axes < 3 {
            return 1.0;
        }
        let other = 3 - axis - t;
        let all = self.lattice.all_parts();
        let upper = window.index(cell);
        let open = |by: usize| {
            let beside = upper + by - window.stride(other);
            [beside, beside - window.stride(t)].iter().all(|&at| {
                let part = |cell: usize, high: bool| {
                    let part = all & half(axis, high);
                    self.lattice.uniform[cell].open & part == part
                };
                part(at, false) && part(at - window.stride(axis), true)
            })
        };
        let inside = 0 < cell[other] && cell[other] + 1 < window.cells[other];
        if !inside || [0, 1, 2].iter().all(|n| open(n * window.stride(other))) {
            return 1.0;
        }
        let mut middle = window.face_centre(axis, cell);
        middle[t] -= 0.5;
        let place = [middle[t.min(other)], middle[t.max(other)]];
        let mut found = Vec::new();
        let factors = [-0.25, 0.25].map(|half| {
            let across = Across {
                axis,
                along: middle[axis] + half,
                low: place.map(|x| x - REACH),
                high: place.map(|x| x + REACH),
            };
            found.clear();
            self.lattice.solids.reentrant(&across, &mut found);
            Beside::new(&found, place).factor
        });
        0.5 * (factors[0] + factors[1])
    }

    /// Part of the columns between the centre of the face along `axis` below `cell` and that
    /// of `cell`, neighbours along `t` with velocities `between`, that no wall crosses, and the
    /// distance between the places of the two velocities, cells.
    fn sight(&self, axis: usize, t: usize, cell: [usize; 3], between: [Velocity; 2]) -> (f64, f64) {
        let window = &self.lattice.window;
        let which = usize::from(self.lattice.tangents(axis)[0] != t);
        let shifts = between.map(|velocity| match velocity {
            Velocity::Face(face) => self.walls.shifts(face as usize).map(|s| &s[which]),
            _ => None,
        });
        let upper = window.index(cell);
        let lower = upper - window.stride(t);
        let all = self.lattice.all_parts();
        let bits =
            |cell: usize, high: bool| (self.lattice.uniform[cell].open, all & half(axis, high));
        let around = [upper, lower].map(|c| [bits(c, false), bits(c - window.stride(axis), true)]);
        if shifts == [None; 2]
            && around
                .as_flattened()
                .iter()
                .all(|&(open, part)| open & part == part)
        {
            return (1.0, 1.0);
        }
        let other = 3 - axis - t;
        let first = window.first_sub(cell) - window.sub_stride(axis) - window.sub_stride(t);
        let count = self.lattice.column_count();
        let mut below = cell;
        below[t] -= 1;
        // A closed face may have its centre exactly on the wall that closes it.
        let [low_open, high_open] = [lower, upper].map(|c| self.lattice.face(axis, c) == OPEN);
        let shift = |side: usize, column: usize| shifts[side].map_or(0.0, |s| f64::from(s[column]));
        let (mut free, mut conductance) = (0.0, 0.0);
        for index in 0..count {
            let mut sub = first + (index & 1) * window.sub_stride(axis);
            if other < window.domain.axes {
                sub += (index >> 1) * window.sub_stride(other);
            }
            let step = window.sub_stride(t);
            let open = |s: usize| self.lattice.open[s];
            // Sub-cells of the column beyond the centres of closed faces.
            let beyond = [
                if low_open { 1.0 } else { open(sub - step) },
                if high_open { 1.0 } else { open(sub + 2 * step) },
            ];
            let clear = match ([open(sub), open(sub + step)], beyond) {
                ([a, b], _) if a == 0.0 || b == 0.0 => false,
                (_, [a, b]) if a == 0.0 || b == 0.0 => false,
                ([1.0, 1.0], [1.0, 1.0]) => true,
                _ => {
                    let up = self.lattice.column(axis, below, t, index).distance[1];
                    let down = self.lattice.column(axis, cell, t, index).distance[0];
                    up.min(down) > 1.0 + 1e-6
                }
            };
            if clear {
                free += 1.0;
                conductance += 1.0 / (1.0 + shift(1, index) - shift(0, index));
            }
        }
        (
            free / count as f64,
            if free > 0.0 { free / conductance } else { 1.0 },
        )
    }
}

#[cfg(test)]
mod tests {
    use physics::VoxelBlock;

    use super::*;
    use crate::geometry::tests::{domain, lattice};
    use crate::liquid::Volumes;
    use crate::system::Scales;

    /// Part of the columns between the centres of two faces along `axis`, neighbours along `t`, that is free
    /// beside a wall a fifth of a cell thick that covers one half of them, the lower or the `upper` along
    /// an axis.
    fn sight(axis: usize, t: usize, halved: usize, upper: bool) -> f64 {
        let (mut low, mut high) = ([0.0; 3], [6.0; 3]);
        (low[t], high[t]) = (2.9, 3.1);
        // The faces lie at 3 along their axis, and from 3 to 4 along the others.
        let middle = if halved == axis { 3.0 } else { 3.5 };
        if upper {
            low[halved] = middle;
        } else {
            high[halved] = middle;
        }
        let wall = VoxelBlock::solid_box(low, high);
        let lattice = lattice(domain([6; 3], 3), vec![vec![wall]]);
        let phi = vec![1.0; lattice.window.sub_len()];
        let volumes = Volumes::new(&lattice, &phi);
        let operator = Operator::new(&lattice, &volumes, Scales::plain());
        let cell = lattice.window.local([3.0; 3]).map(|x| x.round() as usize);
        operator.sight(axis, t, cell, [Velocity::Still; 2]).0
    }

    #[test]
    fn a_wall_hides_the_columns_that_it_crosses_and_no_other() {
        for (axis, t) in [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)] {
            for halved in [axis, 3 - axis - t] {
                assert_eq!(sight(axis, t, halved, false), 0.5, "{axis} {t} {halved}");
                assert_eq!(sight(axis, t, halved, true), 0.5, "{axis} {t} {halved}");
            }
        }
    }
}
