//! The areas that a face velocity and the bodies at it carry.

use super::{Lattice, PROBE, Uniform};
use crate::geometry::{BodyId, OPEN, SIDE};

/// Area of a face by who moves there. The parts add up to the whole face, so that the volume
/// swept by a moving body is exact whatever its place on the lattice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Aperture {
    /// Area that moves with the face's own velocity, with the slivers merged into it; 0 for a
    /// closed face. May exceed 1.
    pub(crate) open: f64,
    /// Part of it that is merged slivers.
    pub(crate) merged: f64,
    /// Bodies and the areas that move with them; a merged sliver counts negative for the body
    /// behind it. Unused entries are ([`OPEN`], 0).
    pub(crate) bodies: [(BodyId, f64); 4],
}

impl Aperture {
    /// A face that carries all of its area itself.
    pub(crate) const WHOLE: Self = Self {
        open: 1.0,
        merged: 0.0,
        bodies: [(OPEN, 0.0); 4],
    };

    const NONE: Self = Self {
        open: 0.0,
        ..Self::WHOLE
    };

    /// Adds a sliver, which lies in front of `body`.
    fn merge(&mut self, body: BodyId, area: f64) {
        self.open += area;
        self.merged += area;
        self.add(body, -area);
    }

    fn add(&mut self, body: BodyId, area: f64) {
        if body >= OPEN || area == 0.0 {
            return;
        }
        for entry in &mut self.bodies {
            if entry.0 == body || entry.0 == OPEN {
                *entry = (body, entry.1 + area);
                return;
            }
        }
    }
}

impl Lattice {
    /// The areas of the low face along `axis` of a cell that is [`Window::inner`].
    ///
    /// An open face carries its own open area and, of adjacent closed faces, the open
    /// quadrants next to it (sliver merging). A closed face moves with the bodies by covered
    /// area; what is left of it belongs to the body that closes it.
    ///
    /// [`Window::inner`]: crate::geometry::Window::inner
    pub(crate) fn aperture(&self, axis: usize, cell: [usize; 3]) -> Aperture {
        let index = self.window.index(cell);
        let state = self.faces[axis][index];
        if state == SIDE {
            return Aperture::NONE;
        }
        if state == OPEN && self.surroundings_open(axis, cell) {
            return Aperture::WHOLE;
        }
        let mut aperture = Aperture::NONE;
        let covered = self.covered(axis, cell);
        let total: f64 = covered.bodies.iter().map(|b| b.1).sum();
        let shrink = if total > 1.0 { 1.0 / total } else { 1.0 };
        for (body, area) in covered.bodies {
            aperture.add(body, area * shrink);
        }
        let left = (1.0 - total).max(0.0);
        if state != OPEN {
            aperture.add(state, left);
            return aperture;
        }
        aperture.open = left;
        let tangents = self.tangents(axis);
        for &t in tangents {
            for up in [false, true] {
                self.merge(axis, cell, t, up, &mut aperture);
            }
        }
        if tangents.len() == 2 {
            for corner in 0..4 {
                self.merge_corner(axis, cell, corner, &mut aperture);
            }
        }
        aperture
    }

    /// Adds the sliver in the corner between two walls: it lies in the closed face diagonally
    /// across `corner` and borders on no open face.
    fn merge_corner(&self, axis: usize, cell: [usize; 3], corner: usize, sum: &mut Aperture) {
        let tangents = self.tangents(axis);
        let across = (self.shifted(cell, tangents[0], corner & 1 == 1))
            .and_then(|next| self.shifted(next, tangents[1], corner & 2 == 2));
        let Some(closed) = across else { return };
        let body = self.faces[axis][self.window.index(closed)];
        if body == OPEN || body == SIDE {
            return;
        }
        let facing = corner ^ 3;
        let area = self.quadrant_open(axis, closed, facing);
        if area > PROBE && self.receivers(axis, closed, facing, None).0 == 0 {
            sum.merge(body, area);
        }
    }

    /// Adds the slivers of the closed face next to `cell` along `t` to an open face's areas.
    fn merge(&self, axis: usize, cell: [usize; 3], t: usize, up: bool, aperture: &mut Aperture) {
        let Some(closed) = self.closed_neighbour(axis, cell, t, up) else {
            return;
        };
        let body = self.faces[axis][self.window.index(closed)];
        for quadrant in 0..self.column_count() {
            let share = self.sliver_share(axis, closed, quadrant, t, !up);
            if share > 0.0 {
                aperture.merge(body, share * self.quadrant_open(axis, closed, quadrant));
            }
        }
    }

    /// The cell next to `cell` along `t` whose face along `axis` a body closes.
    pub(crate) fn closed_neighbour(
        &self,
        axis: usize,
        cell: [usize; 3],
        t: usize,
        up: bool,
    ) -> Option<[usize; 3]> {
        let next = self.shifted(cell, t, up)?;
        (self.faces[axis][self.window.index(next)] < OPEN).then_some(next)
    }

    /// The share of a closed face's open quadrant that the open face along `t` (above it when
    /// `up`) takes over.
    pub(crate) fn sliver_share(
        &self,
        axis: usize,
        closed: [usize; 3],
        quadrant: usize,
        t: usize,
        up: bool,
    ) -> f64 {
        if self.quadrant_open(axis, closed, quadrant) <= PROBE {
            return 0.0;
        }
        let (found, asking) = self.receivers(axis, closed, quadrant, Some((t, up)));
        f64::from(asking) / f64::from(found.max(1))
    }

    /// Who takes the open quadrant of a closed face: the open faces that it borders on, or, if
    /// there is none, those that its neighbours in the face border on. Their number, and how
    /// many of them are the face along `asking` (a tangential direction, above when `true`).
    fn receivers(
        &self,
        axis: usize,
        closed: [usize; 3],
        quadrant: usize,
        asking: Option<(usize, bool)>,
    ) -> (u32, u32) {
        let tangents = self.tangents(axis);
        // (open faces that quadrant q borders on, whether the asking one is among them)
        let borders = |q: usize| {
            let (mut found, mut mine) = (0, 0);
            for (bit, &tangent) in tangents.iter().enumerate() {
                let outward = q >> bit & 1 == 1;
                let open = self.shifted(closed, tangent, outward).is_some_and(|next| {
                    self.faces[axis][self.window.index(next)] == OPEN
                        && self.quadrant_open(axis, next, q ^ 1 << bit) > PROBE
                });
                if open {
                    found += 1;
                    mine += u32::from(asking == Some((tangent, outward)));
                }
            }
            (found, mine)
        };
        let (mut found, mut mine) = borders(quadrant);
        if found == 0 {
            for sibling in (0..tangents.len()).map(|bit| quadrant ^ 1 << bit) {
                if self.quadrant_open(axis, closed, sibling) > PROBE {
                    let (f, a) = borders(sibling);
                    (found, mine) = (found + f, mine + a);
                }
            }
        }
        (found, mine)
    }

    /// Open area of a quadrant (in plane strain a half) of a face; bit b of `quadrant` tells
    /// its half along the b-th tangential direction.
    pub(crate) fn quadrant_open(&self, axis: usize, cell: [usize; 3], quadrant: usize) -> f64 {
        let whole = 1.0 / self.column_count() as f64;
        let sides = self.quadrant_sides(axis, cell, quadrant);
        if sides.iter().all(|side| side.open == 1) {
            whole
        } else if sides.iter().any(|side| side.solid == 1) {
            0.0
        } else {
            let covered = self.covered_quadrant(axis, cell, quadrant);
            let total: f64 = covered.bodies.iter().map(|b| b.1).sum();
            (whole - total).max(0.0)
        }
    }

    /// The sub-cells below and above a quadrant, as bit 0.
    fn quadrant_sides(&self, axis: usize, cell: [usize; 3], quadrant: usize) -> [Uniform; 2] {
        let mut bit = 0;
        for (n, &t) in self.tangents(axis).iter().enumerate() {
            bit += (quadrant >> n & 1) << t;
        }
        let index = self.window.index(cell);
        [
            (index - self.window.stride(axis), bit + (1 << axis)),
            (index, bit),
        ]
        .map(|(cell, bit)| {
            let Uniform { open, solid } = self.uniform[cell];
            Uniform {
                open: open >> bit & 1,
                solid: solid >> bit & 1,
            }
        })
    }

    /// Area of a quadrant that each body covers.
    fn covered_quadrant(&self, axis: usize, cell: [usize; 3], quadrant: usize) -> Aperture {
        let mut low = self.window.corner(cell);
        let mut high = low.map(|x| x + 1.0);
        for (bit, &t) in self.tangents(axis).iter().enumerate() {
            if quadrant >> bit & 1 == 1 {
                low[t] += 0.5;
            } else {
                high[t] -= 0.5;
            }
        }
        self.covered_box(axis, low, high)
    }

    /// Area of a face that each body covers.
    fn covered(&self, axis: usize, cell: [usize; 3]) -> Aperture {
        let mut covered = Aperture::NONE;
        for quadrant in 0..self.column_count() {
            let sides = self.quadrant_sides(axis, cell, quadrant);
            if sides.iter().any(|side| side.open == 0) {
                for (body, area) in self.covered_quadrant(axis, cell, quadrant).bodies {
                    covered.add(body, area);
                }
            }
        }
        covered
    }

    /// Area of the plane through `low[axis]`, within the box, that each body covers: by the
    /// larger of its cross-sections just below and just above the plane.
    fn covered_box(&self, axis: usize, mut low: [f64; 3], mut high: [f64; 3]) -> Aperture {
        let mut sections = [Aperture::WHOLE; 2];
        let plane = low[axis];
        for (section, side) in sections.iter_mut().zip([-PROBE, PROBE]) {
            low[axis] = plane + side;
            high[axis] = plane + side;
            self.solids
                .overlaps(low, high, |body, area| section.add(body, area));
        }
        let [mut covered, other] = sections;
        for (body, area) in other.bodies {
            let already = covered.bodies.iter().find(|b| b.0 == body);
            let already = already.map_or(0.0, |b| b.1);
            covered.add(body, (area - already).max(0.0));
        }
        covered
    }

    /// Whether the cells on both sides of a face and of its tangential neighbours are open
    /// throughout, so that nothing is covered or merged.
    fn surroundings_open(&self, axis: usize, cell: [usize; 3]) -> bool {
        self.tangents(axis)
            .iter()
            .all(|&t| self.clear(axis, cell, t))
    }

    /// The neighbouring cell along `axis`, above when `up`, if it is in the window.
    pub(super) fn shifted(
        &self,
        mut cell: [usize; 3],
        axis: usize,
        up: bool,
    ) -> Option<[usize; 3]> {
        if up {
            cell[axis] += 1;
            (cell[axis] < self.window.cells[axis]).then_some(cell)
        } else {
            cell[axis] = cell[axis].checked_sub(1)?;
            Some(cell)
        }
    }
}
