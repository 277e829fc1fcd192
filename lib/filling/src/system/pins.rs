//! What holds a meniscus in an uneven passage: dry friction, by as much as its pressure varies there.

use super::lines::Friction;

/// Way in a step at which a pin holds by half of all it can, cells.
const CAUGHT: f64 = 0.01;

/// The pins of a step, by their faces.
///
/// Where the passage is wider ahead than behind, the jump falls from one to the other, and a meniscus rests there under any
/// pressure between; in voxels it falls at once. F, half of the fall, is the most that holds it. The friction is F v/(|v'| + v_0), v its velocity
/// against the wall, v' that of the solve before, of [`CAUGHT`] v_0: what goes to and fro around its place is held ever more.
#[derive(Clone, Debug, Default)]
pub(super) struct Pins(Vec<Pin>);

/// A pin at a face and a wall.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pin {
    face: u32,
    /// Component of the wall's velocity, as 3 body + axis.
    wall: u32,
    /// Force over velocity.
    friction: f64,
}

impl Pin {
    /// A pin that `holds` at most so much, of a meniscus that had a `speed` against its wall, in steps in which a cell is crossed at `pace`, m/s.
    pub(super) fn new(face: u32, wall: u32, holds: f64, speed: f64, pace: f64) -> Self {
        Self {
            face,
            wall,
            friction: holds / (speed.abs() + CAUGHT * pace),
        }
    }
}

impl From<&Pin> for Friction {
    fn from(pin: &Pin) -> Self {
        Self {
            face: pin.face as usize,
            wall: pin.wall as usize,
            friction: pin.friction,
        }
    }
}

impl Pins {
    /// Adds a pin, at a face that is not below those before.
    pub(super) fn push(&mut self, pin: Pin) {
        self.0.push(pin);
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = Friction> {
        self.0.iter().map(Friction::from)
    }

    /// What holds at a face.
    pub(super) fn at(&self, face: usize) -> impl Iterator<Item = Friction> {
        let from = (self.0).partition_point(|pin| (pin.face as usize) < face);
        let here = (self.0[from..].iter()).take_while(move |pin| pin.face as usize == face);
        here.map(Friction::from)
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
            pins.push(Pin::new(face, 1, 2.0, speed, 1.0));
        }
        let at = |face: usize| pins.at(face).map(|pin| pin.friction).collect::<Vec<f64>>();
        assert_eq!(
            (at(3), at(4), at(5)),
            (vec![10.0, 200.0], vec![], vec![20.0])
        );
        assert_eq!(pins.iter().count(), 3);
    }
}
