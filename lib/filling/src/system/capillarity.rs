//! The pull of the menisci at the front: sigma cos(theta) times perimeter over area of the local passage.

use rayon::prelude::*;

use super::couplings::fluxes;
use super::fluxes::Areas;
use super::lines::{Line, Lines};
use super::{CHUNK, NONE, Operator, Scales};
use crate::geometry::{BodyId, Chord, OPEN, Passage, SIDE};

/// Part of a face over which the liquid fraction may change without being a front, cells^2.
const NO_FRONT: f64 = 1e-6;

/// How many times narrower a passage may be than one whose meniscus is the same.
const ALIKE: f64 = 2.0;
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
struct Patch {
    face: u32,
    /// Area by which it looks along the face's axis, cells^2.
    front: f64,
    /// Perimeter over area of the passage, cells^-1.
    narrowness: f64,
    /// Bodies that bear it, and their shares.
    walls: [(BodyId, f64); 6],
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
    /// [`Lines`] resist by half their difference.
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
            lines: Lines::default(),
        };
        for patch in patches {
            let force = adhesion * patch.narrowness * patch.front;
            pull.momentum[patch.face as usize] = force;
            let axis = usize::from(self.dofs.faces[patch.face as usize].0);
            for (body, share) in patch.walls.into_iter().filter(|wall| wall.0 < OPEN) {
                pull.bodies[usize::from(body)][axis] -= share * force;
                if holding > 0.0 && share > 0.0 {
                    let holds = share * holding * patch.narrowness * patch.front.abs();
                    let speed = u[patch.face as usize] - bodies[usize::from(body)][axis];
                    let (wall, pace) =
                        (3 * u32::from(body) + axis as u32, self.scales.cell_per_step);
                    pull.lines
                        .push(Line::new(patch.face, wall, holds, speed, pace));
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
        let passage = self.lattice.passage(axis, cell, front > 0.0)?;
        let mut patch = Patch {
            face: face as u32,
            front,
            narrowness: 0.0,
            walls: [(OPEN, 0.0); 6],
        };
        let wet_end = usize::from(front < 0.0);
        for (t, chord) in passage.across(window.domain.axes) {
            if !self.spans(&passage, t, chord) {
                continue;
            }
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
        for wall in &mut patch.walls {
            wall.1 /= patch.narrowness;
        }
        (patch.narrowness > 0.0).then_some(patch)
    }

    /// Gives all parts of one meniscus their mean: it has one pressure, and differences between its parts would
    /// stir the liquid for ever. Parts belong together that meet in a cell or in neighbouring cells of air
    /// and whose passages are not twice as narrow as each other.
    fn level(&self, patches: &mut [Patch]) {
        let window = &self.lattice.window;
        let home = |cell: usize| window.index(window.home(window.coordinates(cell))) as u32;
        let mut at: Vec<(u32, u32)> = (patches.iter().zip(0..))
            .flat_map(|(patch, number)| {
                let (axis, index) = self.dofs.faces[patch.face as usize];
                let index = index as usize;
                [index, index - window.stride(usize::from(axis))].map(|cell| (home(cell), number))
            })
            .collect();
        at.sort_unstable();
        let of = |cell: u32| {
            let from = at.partition_point(|entry| entry.0 < cell);
            at[from..].iter().take_while(move |entry| entry.0 == cell)
        };
        let mut parts = Parts((0..patches.len() as u32).collect());
        for &(cell, one) in &at {
            let index = cell as usize;
            let beside = (0..window.domain.axes).filter_map(|axis| {
                let next = index + window.stride(axis);
                let air = [index, next].iter().all(|&c| self.dofs.cell[c] == NONE);
                (air && self.lattice.face(axis, next) == OPEN).then(|| home(next))
            });
            for near in std::iter::once(cell).chain(beside) {
                for &(_, other) in of(near) {
                    let [a, b] = [one, other].map(|n| patches[n as usize].narrowness);
                    if a < ALIKE * b && b < ALIKE * a {
                        parts.join(one, other);
                    }
                }
            }
        }
        let mut sums = vec![[0.0; 2]; patches.len()];
        for (patch, number) in patches.iter().zip(0..) {
            let sum = &mut sums[parts.first(number) as usize];
            sum[0] += patch.front.abs();
            sum[1] += patch.front.abs() * patch.narrowness;
        }
        for (patch, number) in patches.iter_mut().zip(0..) {
            let [area, sum] = sums[parts.first(number) as usize];
            patch.narrowness = sum / area;
        }
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

/// Which of several things belong together: each refers to one of lower number, or to itself.
struct Parts(Vec<u32>);

impl Parts {
    /// The lowest number of those that belong together with `one`.
    fn first(&mut self, mut one: u32) -> u32 {
        while self.0[one as usize] != one {
            let next = self.0[one as usize];
            self.0[one as usize] = self.0[next as usize];
            one = next;
        }
        one
    }

    fn join(&mut self, one: u32, other: u32) {
        let (a, b) = (self.first(one), self.first(other));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::tests::{domain, lattice};
    use crate::liquid::Volumes;

    /// Two faces of one cell: they have the mean of both by area if neither passage is twice as narrow.
    #[test]
    fn parts_of_a_meniscus_have_one_pressure_if_their_passages_are_alike() {
        let lattice = lattice(domain([4, 4, 1], 2), vec![]);
        let phi = vec![1.0; lattice.window.sub_len()];
        let volumes = Volumes::new(&lattice, &phi);
        let operator = Operator::new(&lattice, &volumes, Scales::plain());
        let cell =
            (lattice.window).index(lattice.window.local([2.5, 2.5, 0.5]).map(|x| x as usize));
        let levelled = |other: f64| {
            let patch = |axis: usize, front: f64, narrowness: f64| Patch {
                face: operator.dofs.face[axis][cell],
                front,
                narrowness,
                walls: [(OPEN, 0.0); 6],
            };
            let mut patches = [patch(0, 3.0, 1.0), patch(1, -1.0, other)];
            operator.level(&mut patches);
            patches.map(|patch| patch.narrowness)
        };
        assert_eq!(levelled(1.96), [1.24; 2]);
        assert_eq!(levelled(2.04), [1.0, 2.04]);
    }
}
