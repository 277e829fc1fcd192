//! Which faces are open.

use physics::Boundary;

use super::{Lattice, PROBE, half};
use crate::geometry::{BodyId, OPEN, SIDE};

impl Lattice {
    /// Whether the low face along `axis` of a cell carries a velocity of its own.
    ///
    /// The face is probed at the points around its centre (4, in plane strain 2), on both
    /// sides of its plane. It is open when one is free; where others are not, because the centre
    /// lies on a wall, only between cells each of which is one room. A wall that lies strictly
    /// inside the neighbouring cell nearer to this face than to the opposite one closes it at any
    /// point (leak stopper: such a wall lies on no face of its own).
    pub(super) fn face_state(&self, axis: usize, cell: [usize; 3]) -> BodyId {
        if self.on_side(axis, cell) {
            return SIDE;
        }
        match self.both_uniform(axis, cell) {
            Some(true) => return OPEN,
            Some(false) => {
                let mut centre = self.window.face_centre(axis, cell);
                centre[axis] += PROBE;
                if let Some(body) = self.solids.at(centre) {
                    return body;
                }
            }
            None => {}
        }
        let centre = self.window.face_centre(axis, cell);
        let tangents = self.tangents(axis);
        let (mut closing, mut free) = (OPEN, false);
        for corner in 0..1_usize << tangents.len() {
            if self.corner_open(axis, cell, corner) {
                free = true;
                continue;
            }
            let mut point = centre;
            for (bit, &t) in tangents.iter().enumerate() {
                point[t] = centre[t] + [-PROBE, PROBE][corner >> bit & 1];
            }
            match self.solid_at_plane(axis, point) {
                Some(body) => closing = body,
                None => match self.wall_behind(axis, point) {
                    Some(body) => return body,
                    None => free = true,
                },
            }
        }
        let below = |mut cell: [usize; 3]| {
            cell[axis] = cell[axis].checked_sub(1)?;
            Some(cell)
        };
        let one_room = |cell| self.is_one_room(cell);
        if free && (closing == OPEN || one_room(cell) && below(cell).is_none_or(one_room)) {
            OPEN
        } else {
            closing
        }
    }

    /// Whether the face lies on or beyond a symmetry plane.
    fn on_side(&self, axis: usize, cell: [usize; 3]) -> bool {
        let domain = &self.window.domain;
        (0..domain.axes).any(|a| {
            let i = self.window.low[a] + cell[a] as i64;
            let n = domain.cells[a] as i64;
            let inside = if a == axis {
                0 < i && i < n
            } else {
                0 <= i && i < n
            };
            domain.boundary[a] == Boundary::Symmetry && !inside
        })
    }

    /// `Some(true)` when both cells at the face are open throughout, `Some(false)` when both
    /// are solid throughout.
    fn both_uniform(&self, axis: usize, cell: [usize; 3]) -> Option<bool> {
        if cell[axis] == 0 {
            return None;
        }
        let index = self.window.index(cell);
        let both = [index, index - self.window.stride(axis)].map(|i| self.uniform[i]);
        let all = self.all_parts();
        if both.iter().all(|cell| cell.open == all) {
            Some(true)
        } else {
            (both.iter().all(|cell| cell.solid == all)).then_some(false)
        }
    }

    /// Whether nothing solid is in a quadrant of the two cells at a face, so that no probe in a corner of
    /// its centre meets a wall.
    fn corner_open(&self, axis: usize, cell: [usize; 3], corner: usize) -> bool {
        if cell[axis] == 0 {
            return false;
        }
        let quadrant = (self.tangents(axis).iter().enumerate())
            .map(|(bit, &t)| half(t, corner >> bit & 1 == 1))
            .fold(self.all_parts(), |all, half| all & half);
        let index = self.window.index(cell);
        [index, index - self.window.stride(axis)]
            .iter()
            .all(|&i| self.uniform[i].open & quadrant == quadrant)
    }

    /// The body just above or below a point of a face plane.
    fn solid_at_plane(&self, axis: usize, point: [f64; 3]) -> Option<BodyId> {
        [PROBE, -PROBE].into_iter().find_map(|side| {
            let mut probe = point;
            probe[axis] += side;
            self.solids.at(probe)
        })
    }

    /// The body of a wall that lies strictly inside a cell at a face plane and nearer to this
    /// face than to the opposite one, where it crosses the normal of the plane at `point`.
    fn wall_behind(&self, axis: usize, point: [f64; 3]) -> Option<BodyId> {
        for up in [true, false] {
            let Some(hit) = self.solids.ray(point, axis, up, 1.0) else {
                continue;
            };
            let middle = 0.5 * (hit.near + hit.far);
            // A wall half way between two faces closes the lower one.
            let nearer = if up {
                middle <= 0.5 + PROBE
            } else {
                middle < 0.5 - PROBE
            };
            if hit.body != SIDE && hit.far < 1.0 - PROBE && nearer {
                return Some(hit.body);
            }
        }
        None
    }
}
