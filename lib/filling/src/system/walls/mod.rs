//! Friction of walls on face velocities, and the widths of the lumens that go with it.

mod effective_distance;
mod reentrant;
mod thinning;
mod view;

use rayon::prelude::*;

use super::dofs::Dofs;
use crate::geometry::{BodyId, Lattice};
use crate::liquid::Volumes;
pub(super) use reentrant::{Beside, REACH};
pub(crate) use thinning::thinning_distance;
use view::View;

/// Faces per task; part of no result.
const CHUNK: usize = 1 << 12;
/// No entry in [`Walls::shifts`].
const CENTRED: u32 = u32::MAX;

/// Which width H of the lumen enters the wall law in 3D.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WidthRule {
    /// H_n, across the lumen along the wall's normal: for walls made of voxels of half a cell,
    /// whose steps already add friction.
    Normal,
    /// (H_n^-2 + H_t^-2)^(-1/2) with H_t along the other tangential direction: exact to 1 %
    /// for ducts with plane walls.
    Combined,
}

/// A part of a body's surface that a face velocity slides along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WallLink {
    /// Whose surface.
    pub(crate) body: BodyId,
    /// Wetted area, cells^2, times the factor of edges near it.
    pub(crate) area: f32,
    /// d_eff of [`effective_distance`], cells.
    pub(crate) distance: f32,
    /// Viscosity there over eta_0.
    pub(crate) viscosity: f32,
}

/// The walls at all face unknowns.
#[derive(Clone, Debug, Default)]
pub(crate) struct Walls {
    start: Vec<u32>,
    links: Vec<WallLink>,
    /// Sum over the tangential directions of H^-2, cells^-2, per face unknown.
    pub(crate) inverse_widths: Vec<f32>,
    /// Where the shifts of a face unknown are in `shifts`, or [`CENTRED`].
    place: Vec<u32>,
    shifts: Vec<Shifts>,
}

/// Places of a velocity from its face's centre, along each tangential direction (cells), in the
/// columns of the control volume: it is the mean over the part that walls bound.
pub(super) type Shifts = [[f32; 4]; 2];

/// What a task finds.
#[derive(Default)]
struct Part {
    counts: Vec<u32>,
    links: Vec<WallLink>,
    inverse_widths: Vec<f32>,
    shifts: Vec<Option<Shifts>>,
}

impl Walls {
    /// Marches the rays from all face unknowns. `friction` false leaves the links out.
    pub(crate) fn new(
        lattice: &Lattice,
        volumes: &Volumes,
        dofs: &Dofs,
        rule: WidthRule,
        friction: bool,
    ) -> Self {
        let parts: Vec<Part> = (dofs.faces.par_chunks(CHUNK))
            .map(|faces| {
                let mut part = Part::default();
                for &(axis, index) in faces {
                    let before = part.links.len();
                    let cell = lattice.window.coordinates(index as usize);
                    let view = View::new(lattice, axis.into(), cell);
                    part.inverse_widths
                        .push(view.inverse_widths(lattice) as f32);
                    part.shifts.push(view.shifts());
                    if friction {
                        view.push_links(lattice, volumes, rule, &mut part.links);
                    }
                    part.counts.push((part.links.len() - before) as u32);
                }
                part
            })
            .collect();
        // All of it stays while the step is solved, so nothing is allocated beyond it.
        let links = parts.iter().map(|part| part.links.len()).sum();
        let shifts = parts.iter().flat_map(|part| &part.shifts);
        let mut walls = Self {
            start: vec![0],
            links: Vec::with_capacity(links),
            shifts: Vec::with_capacity(shifts.flatten().count()),
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
            walls.inverse_widths.extend(part.inverse_widths);
        }
        walls
    }

    /// Places of a face unknown's velocity from the face's centre; `None` where it is there in all
    /// columns.
    #[inline]
    pub(super) fn shifts(&self, face: usize) -> Option<&Shifts> {
        match self.place[face] {
            CENTRED => None,
            place => Some(&self.shifts[place as usize]),
        }
    }

    /// Width (cells) of the lumen at a face unknown, by all tangential directions.
    pub(super) fn width(&self, face: usize) -> f64 {
        1.0 / f64::from(self.inverse_widths[face]).sqrt()
    }

    /// Sets the viscosity of every link by `viscosity(face, link)`.
    pub(super) fn set_viscosity(&mut self, mut viscosity: impl FnMut(usize, &WallLink) -> f32) {
        for face in 0..self.start.len() - 1 {
            for link in &mut self.links[self.start[face] as usize..self.start[face + 1] as usize] {
                link.viscosity = viscosity(face, link);
            }
        }
    }

    /// The walls at a face unknown.
    pub(crate) fn of(&self, face: usize) -> &[WallLink] {
        &self.links[self.start[face] as usize..self.start[face + 1] as usize]
    }
}
