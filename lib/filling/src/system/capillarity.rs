//! The pull of the menisci at the front: sigma cos(theta) times perimeter over area of the local passage.

use rayon::prelude::*;
use saddle_point::Csr;

use super::{CHUNK, NONE, Operator};
use crate::geometry::{BodyId, Chord, OPEN, Passage, SIDE};

/// Part of a face over which the liquid fraction may change without being a front, cells^2.
const NO_FRONT: f64 = 1e-6;

/// How far inside a wall liquid is looked for, cells.
const INSIDE: f64 = 0.5;

/// Forces of the menisci, in units of eta_0 h.
#[derive(Clone, Debug, Default)]
pub(super) struct Pull {
    /// On each face unknown; empty where the surface pulls nowhere.
    pub(super) momentum: Vec<f64>,
    /// On the bodies whose walls they meet, as much and opposite.
    pub(super) bodies: Vec<[f64; 3]>,
}

impl Operator<'_> {
    /// The pull on the liquid of fluxes `g`, for so many bodies.
    ///
    /// A meniscus that spans a passage makes the pressure of the liquid behind it lower than that of the air by the
    /// jump P = sigma cos(theta) perimeter/area. The force of it on face unknown f is P_f (G^T 1)_f: what
    /// a pressure of -P in all of the liquid would leave unbalanced there. Inside the liquid that is
    /// nothing; along a passage it adds up to P times the cross-section wherever in its cells the front
    /// is, and liquid under P alone is at rest to rounding.
    pub(super) fn pull(&self, g: &Csr<f64>, bodies: usize) -> Pull {
        if self.scales.adhesion == 0.0 {
            return Pull::default();
        }
        let mut front = vec![0.0; self.dofs.faces.len()];
        // Pockets of air have rows behind those of the liquid.
        for cell in 0..self.dofs.cells.len() {
            let (faces, areas) = g.row(cell);
            for (&face, area) in faces.iter().zip(areas) {
                front[face as usize] += area;
            }
        }
        let forces: Vec<_> = (front.par_iter().enumerate().with_min_len(CHUNK))
            .map(|(face, &area)| self.meniscus(face, area))
            .collect();
        let mut reactions = vec![[0.0; 3]; bodies];
        for ((_, walls), &(axis, _)) in forces.iter().zip(&self.dofs.faces) {
            for &(body, force) in walls.iter().filter(|wall| wall.0 < OPEN) {
                reactions[usize::from(body)][usize::from(axis)] -= force;
            }
        }
        Pull {
            momentum: forces.into_iter().map(|(force, _)| force).collect(),
            bodies: reactions,
        }
    }

    /// The pull on a face unknown across which so much `front` looks along its axis, and what of it goes
    /// to whom.
    fn meniscus(&self, face: usize, front: f64) -> (f64, [(BodyId, f64); 6]) {
        let mut walls = [(OPEN, 0.0); 6];
        let (axis, index) = self.dofs.faces[face];
        let (axis, index) = (usize::from(axis), index as usize);
        let window = &self.lattice.window;
        let cell = window.coordinates(index);
        let below = window.coordinates(index - window.stride(axis));
        // An open side of the domain is no front.
        let inside = window.in_domain(cell) && window.in_domain(below);
        if front.abs() < NO_FRONT || !inside {
            return (0.0, walls);
        }
        let Some(passage) = self.lattice.passage(axis, cell, front > 0.0) else {
            return (0.0, walls);
        };
        let wet_end = usize::from(front < 0.0);
        let mut total = 0.0;
        for (t, chord) in passage.across(window.domain.axes) {
            if !self.spans(&passage, t, chord) {
                continue;
            }
            let force = 2.0 * self.scales.adhesion * front / chord.length;
            total += force;
            for (end, body) in chord.ends.into_iter().enumerate() {
                // A surface along the wall pulls at that under the liquid; a symmetry plane takes
                // nothing, as the contact line beyond it is that of the mirror image.
                let share = match (t == axis, chord.ends.contains(&SIDE)) {
                    (true, false) => f64::from(u8::from(end == wet_end)),
                    (false, false) => 0.5,
                    (_, true) => 1.0,
                };
                walls[2 * t + end] = (body, share * force);
            }
        }
        (total, walls)
    }

    /// Whether liquid spans a passage along the chord in direction `t`, not farther from it than the
    /// chord is long: nearer to the wall or the middle than that a meniscus reaches. Liquid that only lies
    /// on a wall has none.
    fn spans(&self, passage: &Passage, t: usize, chord: Chord) -> bool {
        let ends = [-1.0, 1.0].map(|side| side * (0.5 * chord.length - INSIDE).max(0.0));
        let ends = [(ends[0], chord.ends[0]), (ends[1], chord.ends[1])];
        let wet_at = |place: [f64; 3]| {
            [(0.0, OPEN), ends[0], ends[1]]
                .into_iter()
                .all(|(off, end)| {
                    let mut at = place;
                    at[t] += off;
                    end == SIDE || self.is_wet(at)
                })
        };
        let axes = self.lattice.window.domain.axes;
        (0..=chord.length.ceil() as usize).any(|way| {
            (0..axes).filter(|&a| a != t).any(|a| {
                [-1.0, 1.0].into_iter().any(|side| {
                    let mut place = passage.middle;
                    place[a] += side * way as f64;
                    wet_at(place)
                })
            })
        })
    }

    /// Whether a place is in a cell of the window with a pressure of its own.
    fn is_wet(&self, at: [f64; 3]) -> bool {
        let window = &self.lattice.window;
        let local = window.local(at);
        let inside = (0..3).all(|a| local[a] >= 0.0 && local[a] < window.cells[a] as f64);
        inside && self.dofs.cell[window.index(window.home(local.map(|x| x as usize)))] != NONE
    }
}
