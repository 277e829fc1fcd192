//! The viscous dissipation as a sum of squares, face by face.
//!
//! Every term is 1/2 w (sum_a c_a x_a)^2 over a few velocities x_a: of faces, which are
//! unknowns, or of bodies, which are known. Row i of the velocity block, the forces on the
//! bodies and the dissipated power all follow from the same terms:
//! A_ij = sum w c_i c_j, F_b = sum w c_b (sum c_a x_a), power = sum w (sum c_a x_a)^2.

use super::Operator;
use super::dofs::NONE;
use super::edges::{Edge, Edges};
use crate::geometry::{BodyId, OPEN, SIDE};

/// A velocity in a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Velocity {
    /// Unknown number.
    Face(u32),
    /// Component `axis` of a body's velocity, as 3 body + axis.
    Body(u32),
    /// Known to be zero: the normal velocity at a symmetry plane.
    Still,
}

impl Velocity {
    pub(super) fn of_body(body: BodyId, axis: usize) -> Self {
        Self::Body(3 * u32::from(body) + axis as u32)
    }

    pub(super) fn is_body(self) -> bool {
        matches!(self, Self::Body(_))
    }
}

/// 1/2 weight (sum of coefficient times velocity)^2.
#[derive(Clone, Copy, Debug)]
pub(super) struct Term {
    pub(super) weight: f64,
    parts: [(Velocity, f64); 4],
    count: usize,
}

impl Term {
    pub(super) fn pair(weight: f64, low: Velocity, high: Velocity) -> Self {
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
            body => Some(Velocity::of_body(body, axis)),
        }
    }

    /// Calls `each` with every term that face unknown `face` takes part in; with `BODIES`, only with
    /// those that a body takes part in as well.
    pub(super) fn terms<const BODIES: bool>(
        &self,
        edges: &Edges,
        face: usize,
        mut each: impl FnMut(&Term),
    ) {
        let (axis, index) = self.dofs.faces[face];
        let (axis, index) = (usize::from(axis), index as usize);
        let window = &self.lattice.window;
        self.normal_term::<BODIES>(axis, index - window.stride(axis), &mut each);
        self.normal_term::<BODIES>(axis, index, &mut each);
        for &t in self.lattice.tangents(axis) {
            for at in [index, index + window.stride(t)] {
                if let Some(edge) = edges.at(axis, t, at)
                    && (edge.walled || !BODIES)
                {
                    self.edge_terms(&edge, [axis, t], at, &mut each);
                }
            }
        }
        let links = self.walls.of(face);
        let factor = match links.is_empty() {
            true => 1.0,
            false => self.mean_factor([index, index - window.stride(axis)]),
        };
        for link in links {
            let weight = factor * f64::from(link.viscosity * link.area)
                / (f64::from(link.distance) + self.scales.influence_length);
            let wall = Velocity::of_body(link.body, axis);
            each(&Term::pair(weight, wall, Velocity::Face(face as u32)));
        }
        self.line_terms(face, each);
    }

    /// Stretching of a cell along `axis`: 2 eta (D u)^2 / 2 over its liquid volume.
    fn normal_term<const BODIES: bool>(
        &self,
        axis: usize,
        cell: usize,
        each: &mut impl FnMut(&Term),
    ) {
        let high = cell + self.lattice.window.stride(axis);
        let (low, high) = (self.velocity(axis, cell), self.velocity(axis, high));
        let (Some(low), Some(high)) = (low, high) else {
            return;
        };
        let weight = 2.0 * self.eta(cell) * f64::from(self.volumes.cell[cell]);
        if weight > 0.0 && (low.is_body() || high.is_body() || !BODIES) {
            each(&Term::pair(weight, low, high));
        }
    }

    /// Shear around the edge at the low corner of cell `at` in the plane of axes `i` and `j`:
    /// eta/2 [w (D_j u_i + D_i u_j)^2 + (w_i - w)(D_j u_i)^2 + (w_j - w)(D_i u_j)^2] with w_i
    /// the part of the edge across which the two u_i see each other, w = min(w_i, w_j), each over
    /// the distances between the places of the velocities.
    fn edge_terms(&self, edge: &Edge, [i, j]: [usize; 2], at: usize, each: &mut impl FnMut(&Term)) {
        let window = &self.lattice.window;
        let (si, sj) = (window.stride(i), window.stride(j));
        let faces = [(i, at - sj), (i, at), (j, at - si), (j, at)];
        let velocities = faces.map(|(axis, index)| self.velocity(axis, index));
        let [wet, open] = edge.volume;
        let cells = [at, at - si, at - sj, at - si - sj];
        let law = match self.edge_viscosity[3 - i - j].get(at) {
            Some(&eta) => f64::from(eta),
            None => self.mean_law(cells),
        };
        let eta = law * self.factor_between(cells) * wet / open;
        let seen = |low: usize, which: usize| {
            let (a, b) = (velocities[low]?, velocities[low + 1]?);
            let sight = f64::from(edge.sight[which]);
            (sight > 0.0).then_some((sight, edge.distance[which], a, b))
        };
        let (along, across) = (seen(0, 0), seen(2, 1));
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
}
