//! Friction of walls on face velocities, and the free paths that go with it.

use rayon::prelude::*;

use super::dofs::Dofs;
use crate::lattice::{Column, Lattice};
use crate::solids::BodyId;
use crate::wall::{effective_distance, shift_of_mean};

/// Faces per task; part of no result.
const CHUNK: usize = 1 << 12;
/// Free path, over the lesser of the two across a lumen, below which walls in both directions
/// count no more where one control volume reaches to its middle: what a square duct of two
/// control volumes wants (mean velocity 0.0351 G a^2/eta, mean wall slope G a/(4 eta)).
const SQUARE: f64 = 0.85;
/// No entry in [`Walls::shifts`].
const CENTRED: u32 = u32::MAX;

/// Which free path enters the wall law in 3D.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathRule {
    /// H_n, across the lumen along the wall's normal: for walls made of voxels of half a cell,
    /// whose steps already add friction.
    Normal,
    /// (H_n^-2 + H_t^-2)^(-1/2) with H_t along the other tangential direction: exact to 1 %
    /// for ducts with plane walls.
    Combined,
}

/// A part of a body's surface that a face velocity slides along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallLink {
    /// Whose surface.
    pub body: BodyId,
    /// Wetted area, cells^2.
    pub area: f32,
    /// d_eff of [`effective_distance`], cells.
    pub distance: f32,
    /// Viscosity there over eta_0.
    pub viscosity: f32,
}

/// The walls at all face unknowns.
#[derive(Clone, Debug, Default)]
pub struct Walls {
    start: Vec<u32>,
    links: Vec<WallLink>,
    /// Sum over the tangential directions of H^-2, cells^-2, per face unknown.
    pub inverse_paths: Vec<f32>,
    /// Where the shifts of a face unknown are in `shifts`, or [`CENTRED`].
    place: Vec<u32>,
    shifts: Vec<Shifts>,
}

/// Places of a velocity from its face's centre, along each tangential direction (cells), in the
/// columns of the control volume: it is the mean over the part that walls bound.
type Shifts = [[f32; 4]; 2];

/// What a task finds.
#[derive(Default)]
struct Part {
    counts: Vec<u32>,
    links: Vec<WallLink>,
    paths: Vec<f32>,
    shifts: Vec<Option<Shifts>>,
}

impl Walls {
    /// Marches the rays from all face unknowns. `friction` false leaves the links out.
    pub fn new(
        lattice: &Lattice,
        phi: &[f32],
        dofs: &Dofs,
        rule: PathRule,
        friction: bool,
    ) -> Self {
        let parts: Vec<Part> = (dofs.faces.par_chunks(CHUNK))
            .map(|faces| {
                let mut part = Part::default();
                for &(axis, index) in faces {
                    let before = part.links.len();
                    let cell = lattice.window.coordinates(index as usize);
                    let view = View::new(lattice, axis.into(), cell);
                    part.paths.push(view.inverse_paths(lattice) as f32);
                    part.shifts.push(view.shifts());
                    if friction {
                        view.push_links(lattice, phi, rule, &mut part.links);
                    }
                    part.counts.push((part.links.len() - before) as u32);
                }
                part
            })
            .collect();
        let mut walls = Self {
            start: vec![0],
            ..Self::default()
        };
        let mut end = 0;
        for part in parts {
            for count in part.counts {
                end += count;
                walls.start.push(end);
            }
            for shifts in part.shifts {
                let place = shifts.map_or(CENTRED, |_| walls.shifts.len() as u32);
                walls.place.push(place);
                walls.shifts.extend(shifts);
            }
            walls.links.extend(part.links);
            walls.inverse_paths.extend(part.paths);
        }
        walls
    }

    /// Place of a face unknown's velocity from the face's centre along its tangential direction
    /// number `which` in a column of its control volume, cells.
    #[inline]
    pub(super) fn shift(&self, face: usize, which: usize, column: usize) -> f64 {
        match self.place[face] {
            CENTRED => 0.0,
            place => self.shifts[place as usize][which][column].into(),
        }
    }

    /// Sets the viscosity of every link by `viscosity(face, link)`.
    pub(super) fn set_viscosity(&mut self, viscosity: impl Fn(usize, &WallLink) -> f32) {
        for face in 0..self.start.len() - 1 {
            for link in &mut self.links[self.start[face] as usize..self.start[face + 1] as usize] {
                link.viscosity = viscosity(face, link);
            }
        }
    }

    /// The walls at a face unknown.
    pub fn of(&self, face: usize) -> &[WallLink] {
        &self.links[self.start[face] as usize..self.start[face + 1] as usize]
    }
}

/// What a face sees along its tangential directions.
struct View {
    axis: usize,
    cell: [usize; 3],
    /// Columns per tangential direction; one that stands for all where no wall is near.
    columns: [[Column; 4]; 2],
    near: [bool; 2],
}

impl View {
    fn new(lattice: &Lattice, axis: usize, cell: [usize; 3]) -> Self {
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

    /// Mean free path along a tangential direction.
    fn path(&self, t: usize) -> f64 {
        let open = self.columns[t].iter().filter(|c| !c.blocked());
        let (sum, count) = open.fold((0.0, 0), |(s, n), c| (s + c.free_path(), n + 1));
        if count == 0 {
            1.0
        } else {
            sum / f64::from(count)
        }
    }

    fn inverse_paths(&self, lattice: &Lattice) -> f64 {
        (0..lattice.tangents(self.axis).len())
            .map(|t| self.path(t).max(0.5).powi(-2))
            .sum()
    }

    /// Places of the velocity; `None` where it is at the centre in all columns.
    fn shifts(&self) -> Option<Shifts> {
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

    fn push_links(
        &self,
        lattice: &Lattice,
        phi: &[f32],
        rule: PathRule,
        links: &mut Vec<WallLink>,
    ) {
        let mut links = Collector {
            first: links.len(),
            links,
        };
        let tangents = lattice.tangents(self.axis);
        let count = lattice.column_count();
        for (t, &tangent) in tangents.iter().enumerate().filter(|(t, _)| self.near[*t]) {
            let across = match rule {
                PathRule::Combined if tangents.len() == 2 => Some(self.path(1 - t)),
                _ => None,
            };
            for index in 0..count {
                let column = self.columns[t][index];
                if !column.blocked() {
                    let area = self.wetted(lattice, phi, self.cell, tangent, index) / count as f64;
                    for side in (0..2).filter(|&s| column.touches(s)) {
                        links.add(column, side, area, across);
                    }
                }
            }
            if tangents.len() == 2 {
                self.push_sliver_links(lattice, phi, t, across, &mut links);
            }
        }
    }

    /// The walls along tangential direction `t` of slivers that lie, along the other one, in
    /// adjacent closed faces and are merged into this face.
    fn push_sliver_links(
        &self,
        lattice: &Lattice,
        phi: &[f32],
        t: usize,
        across: Option<f64>,
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
                        let wet = self.wetted(lattice, phi, closed, tangent, index);
                        links.add(column, side, 0.25 * share * wet, across);
                    }
                }
            }
        }
    }

    /// Liquid fraction of the part of a column that lies at the face of `cell`.
    fn wetted(
        &self,
        lattice: &Lattice,
        phi: &[f32],
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
        0.5 * f64::from(phi[sub] + phi[sub + w.sub_stride(tangent)])
    }
}

/// Gathers the links of one face; equal ones join.
struct Collector<'a> {
    links: &'a mut Vec<WallLink>,
    first: usize,
}

impl Collector<'_> {
    /// The wall of `column` at `side`, in a lumen of free path `across` along the other
    /// tangential direction if that is to count.
    fn add(&mut self, column: Column, side: usize, area: f64, across: Option<f64>) {
        let along = column.free_path();
        let (d, opposite) = (column.distance[side], column.distance[1 - side]);
        let path = across.map_or(along, |a| {
            let least = SQUARE * along.min(a).min(2.0 * (d + 0.5));
            (along.powi(-2) + a.powi(-2)).powf(-0.5).max(least)
        });
        let link = WallLink {
            body: column.body[side],
            area: area as f32,
            distance: effective_distance(d, opposite, path.max(d)) as f32,
            viscosity: 1.0,
        };
        let equal = |l: &&mut WallLink| l.body == link.body && l.distance == link.distance;
        match self.links[self.first..].iter_mut().find(equal) {
            Some(known) => known.area += link.area,
            None => self.links.push(link),
        }
    }
}
