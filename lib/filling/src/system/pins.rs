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
    /// The most that it holds.
    holds: f64,
    /// Force over velocity.
    friction: f64,
}

impl Pin {
    /// A pin of a meniscus that had a `speed` against its wall, in steps in which a cell is crossed at `pace`, m/s.
    pub(super) fn new(face: u32, wall: u32, holds: f64, speed: f64, pace: f64) -> Self {
        Self {
            face,
            wall,
            holds,
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

    /// By how much more than they can pins hold at the velocities `u` of the faces and `bodies`, m/s, over all that they can;
    /// and makes them hold by these.
    pub(super) fn settle(&mut self, u: &[f64], bodies: &[[f64; 3]], pace: f64) -> f64 {
        let (mut beyond, mut all) = (0.0, 0.0);
        for pin in &mut self.0 {
            let wall = pin.wall as usize;
            let speed = u[pin.face as usize] - bodies[wall / 3][wall % 3];
            beyond += (pin.friction * speed.abs() - pin.holds).max(0.0);
            all += pin.holds;
            *pin = Pin::new(pin.face, pin.wall, pin.holds, speed, pace);
        }
        if all > 0.0 { beyond / all } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At a wall that moves at 0.1 m/s, in steps of a cell at 1 m/s: what goes slower is held more, and what goes faster than
    /// it was thought to is held by no more than it can be.
    #[test]
    fn pins_hold_by_the_speed_found() {
        let mut pins = Pins(vec![Pin::new(0, 1, 2.0, 0.19, 1.0)]);
        let mut at = |u: f64| {
            let beyond = pins.settle(&[u], &[[0.0, 0.1, 0.0]], 1.0);
            let friction: f64 = pins.at(0).map(|pin| pin.friction).sum();
            [beyond, friction].map(|x| (1e6 * x).round() / 1e6)
        };
        // A friction of 20: at 0.1 m/s all that it holds.
        assert_eq!(at(0.2), [0.0, 18.181818]);
        assert_eq!(at(0.1), [0.0, 200.0]);
        // 0.03 m/s are held by 6, thrice as much as it can.
        assert_eq!(at(0.13), [2.0, 50.0]);
        assert_eq!(pins.iter().count() + pins.at(1).count(), 1);
    }
}
