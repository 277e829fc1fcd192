//! What holds a meniscus in an uneven passage: dry friction, by as much as its pressure varies there.

use super::lines::Friction;

/// Way in a step at which a pin holds by half of all it can, cells.
const CAUGHT: f64 = 0.01;

/// The pins of a step, by their faces.
///
/// Where the passage is wider ahead than behind, the jump falls from one to the other, and a meniscus rests there under any
/// pressure between; in voxels it falls at once. F, half of the fall, is the most that holds it. The friction is F v/(|v'| + v_0), v its velocity
/// against the wall, v' that of the step before, v_0 that of [`CAUGHT`]: what goes to and fro around its place is held ever more.
#[derive(Clone, Debug, Default)]
pub(super) struct Pins(Vec<Friction>);

impl Pins {
    /// Adds a pin, at a face that is not below those before, that `holds` at most so much of a meniscus that had a `speed` against
    /// its wall, in steps in which a cell is crossed at `pace`, m/s.
    pub(super) fn push(&mut self, face: u32, wall: u32, holds: f64, speed: f64, pace: f64) {
        self.0.push(Friction {
            face: face as usize,
            wall: wall as usize,
            friction: holds / (speed.abs() + CAUGHT * pace),
        });
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = Friction> {
        self.0.iter().copied()
    }

    /// What holds at a face.
    pub(super) fn at(&self, face: usize) -> impl Iterator<Item = Friction> {
        let from = self.0.partition_point(|pin| pin.face < face);
        (self.0[from..].iter().copied()).take_while(move |pin| pin.face == face)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In steps of a cell at 1 m/s, of two faces.
    #[test]
    fn what_goes_slower_is_held_more() {
        let mut pins = Pins::default();
        for (face, speed) in [(3, -0.19), (3, 0.0), (5, 0.09)] {
            pins.push(face, 1, 2.0, speed, 1.0);
        }
        let at = |face: usize| pins.at(face).map(|pin| pin.friction).collect::<Vec<f64>>();
        assert_eq!(
            (at(3), at(4), at(5)),
            (vec![10.0, 200.0], vec![], vec![20.0])
        );
        assert_eq!(pins.iter().count(), 3);
    }
}
