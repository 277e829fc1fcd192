//! The pull of the menisci at the front: sigma cos(theta) times perimeter over area of the local passage.

use rayon::prelude::*;

use super::couplings::fluxes;
use super::fluxes::Areas;
use super::lines::{Line, Lines};
use super::pins::Pins;
use super::{CHUNK, NONE, Operator, Scales};
use crate::geometry::{BodyId, Chord, OPEN, Passage, SIDE};

/// Part of a face over which the liquid fraction may change without being a front, cells^2.
const NO_FRONT: f64 = 1e-6;

/// How far inside a wall liquid is looked for, cells.
const INSIDE: f64 = 0.5;

/// Forces of the menisci, in units of eta_0 h.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pull {
    /// On each face unknown; empty where the surface pulls nowhere.
    momentum: Vec<f64>,
    /// On the bodies whose walls they meet, as much and opposite.
    bodies: Vec<[f64; 3]>,
    /// Contact lines that resist; none where they recede as they advance.
    pub(super) lines: Lines,
    /// What holds menisci in uneven passages.
    pub(super) pins: Pins,
}

impl Pull {
    /// With what contact lines that go resist by: on each face unknown, and on the bodies.
    pub(super) fn forces(&self) -> (Vec<f64>, Vec<[f64; 3]>) {
        let (mut momentum, mut bodies) = (self.momentum.clone(), self.bodies.clone());
        for line in self.lines.iter() {
            let (force, wall) = (line.force(), line.wall as usize);
            momentum[line.face as usize] += force;
            bodies[wall / 3][wall % 3] -= force;
        }
        (momentum, bodies)
    }
}

/// The part of a meniscus at a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    pub(super) face: u32,
    /// Area by which it looks along the face's axis, cells^2.
    pub(super) front: f64,
    /// Perimeter over area of the passage, cells^-1.
    pub(super) narrowness: f64,
    /// Half of what that varies by around it, where an equilibrium lies between.
    pub(super) uneven: f64,
    /// Bodies that bear it, and their shares.
    pub(super) walls: [(BodyId, f64); 6],
}

impl Operator<'_> {
    /// The pull on the liquid, whose faces move at `u` and the bodies at `bodies`, m/s.
    ///
    /// A meniscus that spans a passage makes the pressure of the liquid behind it lower than that of the air by the
    /// jump P = sigma cos(theta) perimeter/area. The force of it on face unknown f is P (G^T 1)_f: what
    /// a pressure of -P in all of the liquid would leave unbalanced there. Inside the liquid that is
    /// nothing; along a passage it adds up to P times the cross-section wherever in its cells the front
    /// is, and liquid under P alone is at rest to rounding.
    ///
    /// Where contact lines recede at another angle than they advance, P is that of the mean of both cosines, and
    /// [`Lines`] resist by half their difference. [`Pins`] hold menisci where P varies.
    pub(crate) fn pull(&self, u: &[f64], bodies: &[[f64; 3]]) -> Pull {
        let Scales {
            adhesion, holding, ..
        } = self.scales;
        if adhesion == 0.0 && holding == 0.0 {
            return Pull::default();
        }
        let mut front = vec![0.0; self.dofs.faces.len()];
        let flux = fluxes(self, &Areas::new(self));
        // Pockets of air have rows behind those of the liquid.
        for cell in 0..self.dofs.cells.len() {
            for &(column, area) in flux.of(cell) {
                if let Some(front) = front.get_mut(column as usize) {
                    *front += area;
                }
            }
        }
        let mut patches: Vec<Patch> = (front.par_iter().enumerate().with_min_len(CHUNK))
            .filter_map(|(face, &area)| self.patch(face, area))
            .collect();
        self.level(&mut patches);
        let mut pull = Pull {
            momentum: vec![0.0; front.len()],
            bodies: vec![[0.0; 3]; bodies.len()],
            ..Pull::default()
        };
        for patch in patches {
            let force = adhesion * patch.narrowness * patch.front;
            pull.momentum[patch.face as usize] = force;
            let axis = usize::from(self.dofs.faces[patch.face as usize].0);
            for (body, share) in patch.walls.into_iter().filter(|wall| wall.0 < OPEN) {
                pull.bodies[usize::from(body)][axis] -= share * force;
                let (wall, pace) = (3 * u32::from(body) + axis as u32, self.scales.cell_per_step);
                let speed = u[patch.face as usize] - bodies[usize::from(body)][axis];
                let [line, pin] = [holding * patch.narrowness, adhesion.abs() * patch.uneven]
                    .map(|most| share * most * patch.front.abs());
                if line > 0.0 {
                    (pull.lines).push(Line::new(patch.face, wall, line, speed, pace));
                }
                if pin > 0.0 {
                    pull.pins.push(patch.face, wall, pin, speed, pace);
                }
            }
        }
        pull
    }

    /// The meniscus at a face unknown across which so much `front` looks along its axis.
    fn patch(&self, face: usize, front: f64) -> Option<Patch> {
        let (axis, index) = self.dofs.faces[face];
        let (axis, index) = (usize::from(axis), index as usize);
        let window = &self.lattice.window;
        let cell = window.coordinates(index);
        let below = window.coordinates(index - window.stride(axis));
        // An open side of the domain is no front.
        let inside = window.in_domain(cell) && window.in_domain(below);
        if front.abs() < NO_FRONT || !inside {
            return None;
        }
        let up = front > 0.0;
        let passage = self.lattice.passage(axis, cell, up)?;
        let mut patch = Patch {
            face: face as u32,
            front,
            narrowness: 0.0,
            uneven: 0.0,
            walls: [(OPEN, 0.0); 6],
        };
        let wet_end = usize::from(!up);
        for (t, chord) in self.spanned(&passage, 0) {
            let narrowness = 2.0 / chord.length;
            patch.narrowness += narrowness;
            for (end, body) in chord.ends.into_iter().enumerate() {
                // A surface along the wall pulls at that under the liquid; a symmetry plane takes
                // nothing, as the contact line beyond it is that of the mirror image.
                let share = match (t == axis, chord.ends.contains(&SIDE)) {
                    (true, false) => f64::from(u8::from(end == wet_end)),
                    (false, false) => 0.5,
                    (_, true) => 1.0,
                };
                patch.walls[2 * t + end] = (body, share * narrowness);
            }
        }
        if patch.narrowness == 0.0 {
            return None;
        }
        for wall in &mut patch.walls {
            wall.1 /= patch.narrowness;
        }
        let here = patch.narrowness;
        let beside = |at: usize| {
            let mut cell = cell;
            cell[axis] = at;
            let passage = self.lattice.passage(axis, cell, up);
            let known = passage.filter(|_| window.in_domain(cell));
            known.map_or(here, |passage| {
                (self.spanned(&passage, 1))
                    .map(|(_, chord)| 2.0 / chord.length)
                    .sum()
            })
        };
        let (low, high) = (beside(cell[axis] - 1), beside(cell[axis] + 1));
        // A liquid that does not wet is pressed back by narrower places, not drawn on.
        let [from, to] = match up == (self.scales.adhesion > 0.0) {
            true => [low, high],
            false => [high, low],
        };
        patch.uneven = 0.5 * (here.max(from) - here.min(to)).max(0.0);
        Some(patch)
    }

    /// The chords across a passage, so many cells `off` the front, that liquid spans.
    fn spanned(&self, passage: &Passage, off: usize) -> impl Iterator<Item = (usize, Chord)> {
        let across = passage.across(self.lattice.window.domain.axes);
        across.filter(move |&(t, chord)| self.spans(passage, off, t, chord))
    }

    /// Whether liquid spans a passage along the chord in direction `t`, not farther from it than the
    /// chord is long and `off`: nearer to the wall or the middle than that a meniscus reaches. Liquid that only lies
    /// on a wall has none.
    fn spans(&self, passage: &Passage, off: usize, t: usize, chord: Chord) -> bool {
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
        (0..=chord.length.ceil() as usize + off).any(|way| {
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
