//! The walls that one face velocity sees.

use super::effective_distance::{effective_distance, shift_of_mean};
use super::reentrant::{Beside, Edges, PROFILE};
use super::{Shifts, WallLink, WidthRule};
use crate::geometry::{Across, Column, Lattice};
use crate::liquid::Volumes;

/// Least combined width over the lesser of the two across a lumen, where one control volume
/// reaches from the wall to the middle: the value that is exact for a square duct of two control
/// volumes (mean velocity 0.0351 G a^2/eta, mean wall slope G a/(4 eta)).
const SQUARE: f64 = 0.85;

/// What a face sees along its tangential directions.
pub(super) struct View {
    axis: usize,
    cell: [usize; 3],
    /// Columns per tangential direction; one that stands for all where no wall is near.
    columns: [[Column; 4]; 2],
    near: [bool; 2],
}

impl View {
    pub(super) fn new(lattice: &Lattice, axis: usize, cell: [usize; 3]) -> Self {
        let mut near = [false; 2];
        let mut columns = [[Column::FREE; 4]; 2];
        for (t, &tangent) in lattice.tangents(axis).iter().enumerate() {
            near[t] = !lattice.clear(axis, cell, tangent);
            columns[t] = if near[t] {
                lattice.columns(axis, cell, tangent)
            } else {
                [lattice.column(axis, cell, tangent, 0); 4]
            };
        }
        Self {
            axis,
            cell,
            columns,
            near,
        }
    }

    /// Mean width of the lumen along a tangential direction.
    fn width(&self, t: usize) -> f64 {
        let open = self.columns[t].iter().filter(|c| !c.blocked());
        let (sum, count) = open.fold((0.0, 0), |(s, n), c| (s + c.width(), n + 1));
        if count == 0 {
            1.0
        } else {
            sum / f64::from(count)
        }
    }

    pub(super) fn inverse_widths(&self, lattice: &Lattice) -> f64 {
        (0..lattice.tangents(self.axis).len())
            .map(|t| self.width(t).max(0.5).powi(-2))
            .sum()
    }

    /// Places of the velocity; `None` where it is at the centre in all columns.
    pub(super) fn shifts(&self) -> Option<Shifts> {
        let mut shifts = Shifts::default();
        for (t, shifts) in shifts.iter_mut().enumerate().filter(|(t, _)| self.near[*t]) {
            for (column, shift) in self.columns[t].iter().zip(shifts) {
                let part = |side| {
                    if column.touches(side) {
                        shift_of_mean(column.distance[side])
                    } else {
                        0.0
                    }
                };
                if !column.blocked() {
                    *shift = (part(0) - part(1)) as f32;
                }
            }
        }
        (shifts.as_flattened().iter().any(|s| s.abs() > 1e-6)).then_some(shifts)
    }

    pub(super) fn push_links(
        &self,
        lattice: &Lattice,
        volumes: &Volumes,
        rule: WidthRule,
        links: &mut Vec<WallLink>,
    ) {
        let mut links = Collector {
            first: links.len(),
            links,
        };
        let tangents = lattice.tangents(self.axis);
        let count = lattice.column_count();
        let edges = self.edges(lattice);
        for (t, &tangent) in tangents.iter().enumerate().filter(|(t, _)| self.near[*t]) {
            let across = match rule {
                WidthRule::Combined if tangents.len() == 2 => Some(self.width(1 - t)),
                _ => None,
            };
            for index in 0..count {
                let column = self.columns[t][index];
                if !column.blocked() {
                    let area =
                        self.wetted(lattice, volumes, self.cell, tangent, index) / count as f64;
                    for side in (0..2).filter(|&s| column.touches(s)) {
                        let beside = edges.beside(t, index, 0.0, &column, side);
                        links.add(column, side, area, across, beside);
                    }
                }
            }
            if tangents.len() == 2 {
                self.push_sliver_links(lattice, volumes, t, across, &edges, &mut links);
            }
        }
    }

    /// The walls along tangential direction `t` of slivers that lie, along the other one, in
    /// adjacent closed faces and are merged into this face.
    fn push_sliver_links(
        &self,
        lattice: &Lattice,
        volumes: &Volumes,
        t: usize,
        across: Option<f64>,
        edges: &Edges,
        links: &mut Collector,
    ) {
        let tangents = lattice.tangents(self.axis);
        let (tangent, other) = (tangents[t], tangents[1 - t]);
        for up in [false, true] {
            let Some(closed) = lattice.closed_neighbour(self.axis, self.cell, other, up) else {
                continue;
            };
            for side in 0..2 {
                let near_half = usize::from(!up);
                let quadrant = side << t | near_half << (1 - t);
                let share = lattice.sliver_share(self.axis, closed, quadrant, other, !up);
                if share == 0.0 {
                    continue;
                }
                for normal in 0..2 {
                    let index = normal | near_half << 1;
                    let column = lattice.column(self.axis, closed, tangent, index);
                    if column.touches(side) && !column.blocked() {
                        let wet = self.wetted(lattice, volumes, closed, tangent, index);
                        let off = if up { 1.0 } else { -1.0 };
                        let beside = edges.beside(t, index, off, &column, side);
                        links.add(column, side, 0.25 * share * wet, across, beside);
                    }
                }
            }
        }
    }

    /// The re-entrant edges along the face's axis that reach its walls.
    fn edges(&self, lattice: &Lattice) -> Edges {
        let centre = lattice.window.face_centre(self.axis, self.cell);
        let mut edges = Edges {
            centre: [0.0; 2],
            halves: Default::default(),
        };
        let &[s, t] = lattice.tangents(self.axis) else {
            return edges;
        };
        edges.centre = [centre[s], centre[t]];
        let Some([low, high]) = self.walls(lattice) else {
            return edges;
        };
        for (half, found) in edges.halves.iter_mut().enumerate() {
            let across = Across {
                axis: self.axis,
                along: centre[self.axis] + half as f64 / 2.0 - 0.25,
                low: [0, 1].map(|n| edges.centre[n] + low[n] - PROFILE),
                high: [0, 1].map(|n| edges.centre[n] + high[n] + PROFILE),
            };
            lattice.solids.reentrant(&across, found);
        }
        edges
    }

    /// Ends, from the face's centre, of the rectangle that holds all places where its columns meet walls;
    /// `None` where none does.
    fn walls(&self, lattice: &Lattice) -> Option<[[f64; 2]; 2]> {
        let tangents = lattice.tangents(self.axis);
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let mut add = |n: usize, from: f64, to: f64| {
            low[n] = low[n].min(from);
            high[n] = high[n].max(to);
        };
        for t in (0..2).filter(|&t| self.near[t]) {
            for column in self.columns[t].iter().filter(|column| !column.blocked()) {
                for side in (0..2).filter(|&side| column.touches(side)) {
                    let at = [-1.0, 1.0][side] * column.distance[side];
                    add(t, at, at);
                    add(1 - t, -0.25, 0.25);
                }
            }
            for up in [false, true] {
                let other = tangents[1 - t];
                if (lattice.closed_neighbour(self.axis, self.cell, other, up)).is_some() {
                    let off = if up { 1.0 } else { -1.0 };
                    add(t, -1.0, 1.0);
                    add(1 - t, off - 0.25, off + 0.25);
                }
            }
        }
        (low[0] <= high[0] && low[1] <= high[1]).then_some([low, high])
    }

    /// Liquid fraction of the part of a column that lies at the face of `cell`, less what does not touch walls.
    fn wetted(
        &self,
        lattice: &Lattice,
        volumes: &Volumes,
        cell: [usize; 3],
        tangent: usize,
        index: usize,
    ) -> f64 {
        let w = &lattice.window;
        let other = 3 - self.axis - tangent;
        let mut sub = w.first_sub(cell) - w.sub_stride(self.axis);
        sub += (index & 1) * w.sub_stride(self.axis);
        if other < w.domain.axes {
            sub += (index >> 1) * w.sub_stride(other);
        }
        let phi = 0.5 * (volumes.phi[sub] + volumes.phi[sub + w.sub_stride(tangent)]);
        let below = (1 - (index & 1)) * w.stride(self.axis);
        f64::from(phi * volumes.touching(w.index(cell) - below))
    }
}

/// Gathers the links of one face; equal ones join.
struct Collector<'a> {
    links: &'a mut Vec<WallLink>,
    first: usize,
}

impl Collector<'_> {
    /// The wall of `column` at `side`, in a lumen of width `across` along the other
    /// tangential direction if that is to count, which it does no more `beside` edges.
    fn add(&mut self, column: Column, side: usize, area: f64, across: Option<f64>, beside: Beside) {
        let along = column.width();
        let (d, opposite) = (column.distance[side], column.distance[1 - side]);
        let width = across.map_or(along, |a| {
            let least = SQUARE * along.min(a).min(2.0 * (d + 0.5));
            (along.powi(-2) + a.powi(-2)).powf(-0.5).max(least)
        });
        let slit = 1.0 - beside.near;
        let width = (slit * width.powi(-2) + beside.near * along.powi(-2)).powf(-0.5);
        let link = WallLink {
            body: column.body[side],
            area: (area * beside.factor) as f32,
            distance: effective_distance(d, opposite, width.max(d), slit) as f32,
            viscosity: 1.0,
        };
        let equal = |l: &&mut WallLink| l.body == link.body && l.distance == link.distance;
        match self.links[self.first..].iter_mut().find(equal) {
            Some(known) => known.area += link.area,
            None => self.links.push(link),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::tests::{domain, lattice};

    /// Sub-cells that tell their place: 100 x + 10 y + z.
    #[test]
    fn a_column_is_as_wet_as_the_sub_cells_on_its_side_of_the_face() {
        let lattice = lattice(domain([4; 3], 3), vec![]);
        let window = &lattice.window;
        let [nx, ny, nz] = window.sub_cells();
        let place = |sub: usize| [sub % nx, sub / nx % ny, sub / (nx * ny)];
        let weight = [100.0, 10.0, 1.0];
        let value = |at: [f64; 3]| (0..3).map(|a| weight[a] * at[a]).sum::<f64>();
        let phi: Vec<f32> = (0..nx * ny * nz)
            .map(|sub| value(place(sub).map(|x| x as f64)) as f32)
            .collect();
        let volumes = Volumes::new(&lattice, &phi);
        let cell = [2; 3];
        for (axis, tangent) in [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)] {
            let view = View::new(&lattice, axis, cell);
            for index in 0..4 {
                // Sub-cells 4 and 5 are those of the cell, 3 the last one below the face.
                let mut at = [4.0; 3];
                at[axis] = if index & 1 == 1 { 4.0 } else { 3.0 };
                at[tangent] = 4.5;
                at[3 - axis - tangent] = if index & 2 == 2 { 5.0 } else { 4.0 };
                let found = view.wetted(&lattice, &volumes, cell, tangent, index);
                assert!((found - value(at)).abs() < 1e-9, "{axis} {tangent} {index}");
            }
        }
    }
}
