//! How narrow the passage is that a face lies in.

use super::{Lattice, PROBE};
use crate::geometry::solids::FAR;
use crate::geometry::{BodyId, SIDE};

/// How far from a face a place on one side of it is looked at, cells: walls at the face itself belong to
/// either side.
const ASIDE: f64 = 0.25;
/// Rounds in which the middle of a passage is found: one leads there in a tube or a slit, the second
/// where walls are uneven.
const ROUNDS: usize = 2;
/// Chords this many times as long as the shortest run along a passage, not across it.
const ALONG: f64 = 4.0;

/// A passage between walls, by the chords through its middle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Passage {
    /// Its middle, cells.
    pub(crate) middle: [f64; 3],
    /// The chords along x, y and z that have walls at both ends.
    pub(crate) chords: [Option<Chord>; 3],
}

impl Passage {
    /// The chords across it: all but the longest where there is one along each axis.
    pub(crate) fn across(&self, axes: usize) -> impl Iterator<Item = (usize, Chord)> {
        let length = |t: usize| self.chords[t].map_or(f64::INFINITY, |chord| chord.length);
        let along = (0..axes).fold(0, |longest, t| {
            if length(t) >= length(longest) {
                t
            } else {
                longest
            }
        });
        let chords = self.chords.into_iter().enumerate();
        chords.filter_map(move |(t, chord)| (t != along).then_some((t, chord?)))
    }
}

/// A chord of a passage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Chord {
    /// Its length H, cells; twice that to a symmetry plane, beyond which the passage goes on as its mirror
    /// image.
    pub(crate) length: f64,
    /// Way from where it was looked for to its middle, cells.
    to_middle: f64,
    /// Bodies at its low and high end, or [`SIDE`] for a symmetry plane.
    pub(crate) ends: [BodyId; 2],
}

impl Lattice {
    /// The passage just above (`up`) or below the low face along `axis` of a cell, where that is open,
    /// else on the other side; `None` where both are solid.
    ///
    /// A chord has walls within [`FAR`] at both ends. Its length is measured through the middle of
    /// the passage, where in a round, elliptic or rectangular one the sum of 2/H over the chords across it is
    /// perimeter over area (an ellipse of axes 1 to 2 within 3 %): nearer to a curved wall chords are
    /// shorter, though the meniscus has one curvature.
    pub(crate) fn passage(&self, axis: usize, cell: [usize; 3], up: bool) -> Option<Passage> {
        let mut at = (self.open_place(axis, cell, up)).or(self.open_place(axis, cell, !up))?;
        let axes = self.window.domain.axes;
        let chords =
            |at: [f64; 3]| [0, 1, 2].map(|t| (t < axes).then(|| self.chord(at, t)).flatten());
        for _ in 0..ROUNDS {
            let mut order: Vec<(usize, f64)> = (chords(at).iter().enumerate())
                .filter_map(|(t, chord)| Some((t, chord.as_ref()?.length)))
                .collect();
            order.sort_by(|a, b| a.1.total_cmp(&b.1));
            order.truncate(axes - 1);
            let shortest = order.first().map_or(0.0, |first| first.1);
            for (t, _) in order
                .into_iter()
                .filter(|(_, length)| *length <= ALONG * shortest)
            {
                at[t] += self.chord(at, t).map_or(0.0, |chord| chord.to_middle);
            }
        }
        Some(Passage {
            middle: at,
            chords: chords(at),
        })
    }

    /// An open place beside a face: at its centre, or at the centre of an open quadrant.
    fn open_place(&self, axis: usize, cell: [usize; 3], up: bool) -> Option<[f64; 3]> {
        let mut centre = self.window.face_centre(axis, cell);
        centre[axis] += if up { ASIDE } else { -ASIDE };
        let tangents = self.tangents(axis);
        let beside = (0..self.column_count()).map(|quadrant| {
            let mut at = centre;
            for (bit, &t) in tangents.iter().enumerate() {
                at[t] += if quadrant >> bit & 1 == 1 {
                    ASIDE
                } else {
                    -ASIDE
                };
            }
            at
        });
        std::iter::once(centre)
            .chain(beside)
            .find(|&at| self.solids.at(at).is_none())
    }

    /// The chord along `t` through a place, if it has an end on both sides and one of them at a body.
    fn chord(&self, at: [f64; 3], t: usize) -> Option<Chord> {
        let [Some(low), Some(high)] = self.solids.rays(at, t, FAR) else {
            return None;
        };
        let (length, to_middle) = match [low, high].map(|hit| hit.body == SIDE) {
            [false, false] => (low.near + high.near, 0.5 * (high.near - low.near)),
            [true, false] => (2.0 * (low.near + high.near), PROBE - low.near),
            [false, true] => (2.0 * (low.near + high.near), high.near - PROBE),
            [true, true] => return None,
        };
        Some(Chord {
            length: length.max(ASIDE),
            to_middle,
            ends: [low.body, high.body],
        })
    }
}
