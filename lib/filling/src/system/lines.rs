//! Contact lines that recede at another angle than they advance: between both they hold, as dry friction does.

use super::Operator;
use super::terms::{Term, Velocity};

/// Way of a held line in a step in which half of what it can hold pulls at it, cells.
const CREEP: f64 = 1e-3;
/// Relative change of the resistance of a line below which it is that of its speed.
const SETTLED: f64 = 0.05;
/// Way in a step from which on a line has turned around, cells.
const TURNED: f64 = 0.01;

/// The lines of a step, by their faces.
///
/// Half the difference of both adhesion tensions times the length of a line, F, is the most that it holds. It resists by
/// F v/(|v'| + v_0): v its velocity against the wall, v' that before the step, and v_0 that of [`CREEP`].
#[derive(Clone, Debug, Default)]
pub(super) struct Lines(Vec<Line>);

/// A line at a face and a wall.
#[derive(Clone, Copy, Debug)]
struct Line {
    face: u32,
    wall: Velocity,
    /// Velocity of the wall, m/s.
    moves: f64,
    /// Force over velocity.
    friction: f64,
    /// The most that it holds.
    holds: f64,
}

impl Lines {
    /// Adds a line at a face, not below those before, and at a wall that moves so; it holds up to `holds` and had a
    /// `speed` against the wall, in steps in which a cell is crossed at `pace`, m/s.
    pub(super) fn add(
        &mut self,
        face: u32,
        (wall, moves): (Velocity, f64),
        holds: f64,
        speed: f64,
        pace: f64,
    ) {
        self.0.push(Line {
            face,
            wall,
            moves,
            friction: holds / (speed.abs() + CREEP * pace),
            holds,
        });
    }

    /// What lines resist with at a face.
    pub(super) fn friction(&self, face: usize) -> f64 {
        self.at(face).map(|line| line.friction).sum()
    }

    /// Calls `each` with the term of every line at a face.
    pub(super) fn terms(&self, face: usize, mut each: impl FnMut(&Term)) {
        for line in self.at(face) {
            each(&Term::pair(
                line.friction,
                line.wall,
                Velocity::Face(line.face),
            ));
        }
    }

    fn at(&self, face: usize) -> impl Iterator<Item = &Line> {
        let from = (self.0).partition_point(|line| (line.face as usize) < face);
        (self.0[from..].iter()).take_while(move |line| line.face as usize == face)
    }

    /// Makes lines resist by the velocities `u` of the faces, m/s; whether that changes any.
    fn slow_down(&mut self, u: &[f64], pace: f64) -> bool {
        let mut found = false;
        for line in &mut self.0 {
            let speed = (u[line.face as usize] - line.moves).abs();
            let friction = line.holds / (speed + CREEP * pace);
            found |= (friction - line.friction).abs() > SETTLED * friction;
            line.friction = friction;
        }
        found
    }

    /// Holds the lines that turned around from velocities `before` to `u` of the faces, m/s; whether there are any.
    fn hold_turned(&mut self, before: &[f64], u: &[f64], pace: f64) -> bool {
        let mut found = false;
        for line in &mut self.0 {
            let [before, now] = [before, u].map(|u| u[line.face as usize] - line.moves);
            let held = line.holds / (CREEP * pace);
            if before * now < 0.0 && now.abs() > TURNED * pace && line.friction < 0.5 * held {
                (line.friction, found) = (held, true);
            }
        }
        found
    }
}

impl Operator<'_> {
    /// Makes contact lines resist by the velocities `u`, m/s, of a first solve: there are none before. Whether that
    /// changes any.
    pub(crate) fn slow_down(&mut self, u: &[f64]) -> bool {
        (self.pull.lines).slow_down(u, self.scales.cell_per_step)
    }

    /// Holds the contact lines that turned around from velocities `before` to `u`, m/s: in between they come to rest, and
    /// without this the friction of their speed lets them go to and fro for ever. Whether there are any.
    pub(crate) fn hold_turned(&mut self, before: &[f64], u: &[f64]) -> bool {
        (self.pull.lines).hold_turned(before, u, self.scales.cell_per_step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_that_turns_around_is_held() {
        let mut lines = Lines::default();
        for (face, speed) in [(3, 0.5), (5, 0.5), (5, -1e-4)] {
            lines.add(face, (Velocity::Body(1), 0.1), 2.0, speed, 1.0);
        }
        let friction = |lines: &Lines| [3, 4, 5].map(|face| lines.friction(face));
        let free = [2.0 / 0.501, 0.0, 2.0 / 0.501 + 2.0 / 0.0011];
        assert_eq!(friction(&lines), free);
        // Against the wall: 0.5 before, then still forward, or back by less than counts, or by more.
        let turned = |lines: &mut Lines, u: f64| {
            lines.hold_turned(&[0.6; 6], &[0.3, 0.3, 0.3, 0.3, 0.3, u], 1.0)
        };
        assert!(!turned(&mut lines, 0.11) && !turned(&mut lines, 0.095));
        assert_eq!(friction(&lines), free);
        assert!(turned(&mut lines, 0.05));
        assert_eq!(lines.friction(3), free[0]);
        assert!((lines.friction(5) - (2.0 / 1e-3 + 2.0 / 0.0011)).abs() < 1e-9);
        assert!(!turned(&mut lines, 0.05), "held already");
    }
}
