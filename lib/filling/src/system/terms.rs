//! The viscous dissipation as a sum of squares, face by face.
//!
//! Every term is 1/2 w (sum_a c_a x_a)^2 over a few velocities x_a: of faces, which are
//! unknowns, or of bodies, which are known. Row i of the velocity block, the forces on the
//! bodies and the dissipated power all follow from the same terms:
//! A_ij = sum w c_i c_j, F_b = sum w c_b (sum c_a x_a), power = sum w (sum c_a x_a)^2.

use super::Operator;
use super::dofs::NONE;
use crate::geometry::{OPEN, SIDE};

/// A velocity in a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Velocity {
    /// Unknown number.
    Face(u32),
    /// Component `axis` of a body's velocity, as 3 body + axis.
    Body(usize),
    /// Known to be zero: the normal velocity at a symmetry plane.
    Still,
}

/// 1/2 weight (sum of coefficient times velocity)^2.
#[derive(Clone, Copy, Debug)]
pub(super) struct Term {
    pub(super) weight: f64,
    parts: [(Velocity, f64); 4],
    count: usize,
}

impl Term {
    fn pair(weight: f64, low: Velocity, high: Velocity) -> Self {
        Self {
            weight,
            parts: [(low, -1.0), (high, 1.0), (low, 0.0), (high, 0.0)],
            count: 2,
        }
    }

    pub(super) fn parts(&self) -> &[(Velocity, f64)] {
        &self.parts[..self.count]
    }

    /// Coefficient of a face unknown.
    pub(super) fn coefficient(&self, face: usize) -> f64 {
        let own = |part: &&(Velocity, f64)| part.0 == Velocity::Face(face as u32);
        self.parts().iter().filter(own).map(|part| part.1).sum()
    }

    /// The unknown that counts this term in sums over all terms: its lowest one.
    pub(super) fn owner(&self) -> Option<u32> {
        let faces = self.parts().iter().filter_map(|part| match part.0 {
            Velocity::Face(face) => Some(face),
            _ => None,
        });
        faces.min()
    }
}

impl Operator<'_> {
    /// The velocity at the low face along `axis` of a cell; `None` for a face in air.
    #[inline]
    pub(super) fn velocity(&self, axis: usize, index: usize) -> Option<Velocity> {
        let face = self.dofs.face[axis][index];
        if face != NONE {
            return Some(Velocity::Face(face));
        }
        match self.lattice.face(axis, index) {
            OPEN => None,
            SIDE => Some(Velocity::Still),
            body => Some(Velocity::Body(3 * usize::from(body) + axis)),
        }
    }

    /// Calls `each` with every term that face unknown `face` takes part in.
    pub(super) fn terms(&self, face: usize, mut each: impl FnMut(&Term)) {
        let (axis, index) = self.dofs.faces[face];
        let (axis, index) = (usize::from(axis), index as usize);
        let window = &self.lattice.window;
        self.normal_term(axis, index - window.stride(axis), &mut each);
        self.normal_term(axis, index, &mut each);
        for &t in self.lattice.tangents(axis) {
            self.edge_terms(axis, t, index, &mut each);
            self.edge_terms(axis, t, index + window.stride(t), &mut each);
        }
        for link in self.walls.of(face) {
            let weight = f64::from(link.viscosity * link.area)
                / (f64::from(link.distance) + self.scales.influence_length);
            let wall = Velocity::Body(3 * usize::from(link.body) + axis);
            each(&Term::pair(weight, wall, Velocity::Face(face as u32)));
        }
    }

    /// Stretching of a cell along `axis`: 2 eta (D u)^2 / 2 over its liquid volume.
    fn normal_term(&self, axis: usize, cell: usize, each: &mut impl FnMut(&Term)) {
        let weight = 2.0 * self.eta(cell) * f64::from(self.volumes.cell[cell]);
        if weight <= 0.0 {
            return;
        }
        let high = cell + self.lattice.window.stride(axis);
        if let (Some(low), Some(high)) = (self.velocity(axis, cell), self.velocity(axis, high)) {
            each(&Term::pair(weight, low, high));
        }
    }

    /// Shear around the edge at the low corner of cell `at` in the plane of axes `i` and `j`:
    /// eta/2 [w (D_j u_i + D_i u_j)^2 + (w_i - w)(D_j u_i)^2 + (w_j - w)(D_i u_j)^2] with w_i
    /// the part of the edge across which the two u_i see each other, w = min(w_i, w_j), each over
    /// the distances between the places of the velocities.
    fn edge_terms(&self, i: usize, j: usize, at: usize, each: &mut impl FnMut(&Term)) {
        let window = &self.lattice.window;
        let (si, sj) = (window.stride(i), window.stride(j));
        let faces = [(i, at - sj), (i, at), (j, at - si), (j, at)];
        let velocities = faces.map(|(axis, index)| self.velocity(axis, index));
        if velocities.contains(&Some(Velocity::Still)) {
            return;
        }
        let cell = window.coordinates(at);
        let first = window.first_sub(cell) - window.sub_stride(i) - window.sub_stride(j);
        let (wet, open) = (self.volumes).of_block(self.lattice, first, [2, 2, window.parts(2)]);
        if wet <= 0.0 {
            return;
        }
        let eta = self.mean_viscosity([at, at - si, at - sj, at - si - sj]) * wet / open;
        let seen = |low: usize, axis: usize, t: usize| {
            let (a, b) = (velocities[low]?, velocities[low + 1]?);
            let (sight, distance) = self.sight(axis, t, cell, [a, b]);
            (sight > 0.0).then_some((sight, distance, a, b))
        };
        let (along, across) = (seen(0, i, j), seen(2, j, i));
        let mut both = 0.0;
        if let (Some((sight, di, a, b)), Some((other, dj, c, d))) = (along, across) {
            both = sight.min(other);
            each(&Term {
                weight: eta * both * di * dj,
                parts: [(a, -1.0 / di), (b, 1.0 / di), (c, -1.0 / dj), (d, 1.0 / dj)],
                count: 4,
            });
        }
        for (sight, distance, low, high) in [along, across].into_iter().flatten() {
            if sight > both {
                each(&Term::pair(eta * (sight - both) / distance, low, high));
            }
        }
    }

    /// Part of the columns between the centre of the face along `axis` below `cell` and that
    /// of `cell`, neighbours along `t` with velocities `between`, that no wall crosses, and the
    /// distance between the places of the two velocities, cells.
    fn sight(&self, axis: usize, t: usize, cell: [usize; 3], between: [Velocity; 2]) -> (f64, f64) {
        let window = &self.lattice.window;
        let other = 3 - axis - t;
        let first = window.first_sub(cell) - window.sub_stride(axis) - window.sub_stride(t);
        let count = self.lattice.column_count();
        let mut below = cell;
        below[t] -= 1;
        // A closed face may have its centre exactly on the wall that closes it.
        let [low_open, high_open] =
            [below, cell].map(|c| self.lattice.face(axis, window.index(c)) == OPEN);
        let which = usize::from(self.lattice.tangents(axis)[0] != t);
        let shift = |velocity: Velocity, column: usize| match velocity {
            Velocity::Face(face) => self.walls.shift(face as usize, which, column),
            _ => 0.0,
        };
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
                conductance += 1.0 / (1.0 + shift(between[1], index) - shift(between[0], index));
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
    use crate::system::{Scales, WidthRule};

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
        let scales = Scales {
            inertia: 1.0,
            compressibility: 0.0,
            gravity: [0.0; 3],
            influence_length: 0.0,
            width: WidthRule::Normal,
        };
        let operator = Operator::new(&lattice, &volumes, scales);
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
