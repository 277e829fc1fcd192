//! Contact lines that recede at another angle than they advance: between both they hold, as dry friction does.

use super::Operator;
use super::terms::{Term, Velocity};

/// Way in a step of a held line at which all that it can hold pulls, cells: beyond, it goes.
const CREEP: f64 = 1e-3;
/// Way in a step from which on a line counts as one that went, cells.
const WENT: f64 = 0.01;
/// Part of all that lines can hold by which they may pull otherwise than at the velocities found.
const DECIDED: f64 = 0.01;

/// The lines of a step, by their faces.
///
/// Half the difference of both adhesion tensions times the length of a line, F, is the most that it holds. A line that
/// goes resists by F; one that is held by F v/v_0, v its velocity against the wall and v_0 that of [`CREEP`].
#[derive(Clone, Debug, Default)]
pub(super) struct Lines(Vec<Line>);

/// A line at a face and a wall.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) face: u32,
    /// Component of the wall's velocity, as 3 body + axis.
    pub(super) wall: u32,
    /// The most that it holds.
    holds: f64,
    state: State,
}

#[derive(Clone, Copy, Debug)]
enum State {
    Held,
    /// Goes along the axis, 1, or against it, -1.
    Goes(f64),
}

impl Line {
    /// A line that had a `speed` against its wall, in steps in which a cell is crossed at `pace`, m/s.
    pub(super) fn new(face: u32, wall: u32, holds: f64, speed: f64, pace: f64) -> Self {
        Self {
            face,
            wall,
            holds,
            state: match speed.abs() > WENT * pace {
                true => State::Goes(speed.signum()),
                false => State::Held,
            },
        }
    }

    /// Force on the liquid of one that goes.
    pub(super) fn force(&self) -> f64 {
        match self.state {
            State::Goes(sign) => -sign * self.holds,
            State::Held => 0.0,
        }
    }

    /// What one that is held resists with, force over velocity.
    fn friction(&self, pace: f64) -> f64 {
        match self.state {
            State::Goes(_) => 0.0,
            State::Held => self.holds / (CREEP * pace),
        }
    }

    fn resistance(&self, pace: f64) -> Friction {
        Friction {
            face: self.face as usize,
            wall: self.wall as usize,
            friction: self.friction(pace),
        }
    }

    /// By how much it pulls otherwise than one does that has a `speed` against its wall.
    fn error(&self, speed: f64, pace: f64) -> f64 {
        match self.state {
            State::Goes(sign) if sign * speed < 0.0 => self.holds,
            State::Goes(_) => 0.0,
            State::Held => (self.friction(pace) * speed.abs() - self.holds).max(0.0),
        }
    }

    /// Makes it what it is at a `speed` against its wall.
    fn settle(&mut self, speed: f64, pace: f64) {
        if self.error(speed, pace) > 0.0 {
            self.state = match self.state {
                State::Goes(_) => State::Held,
                State::Held => State::Goes(speed.signum()),
            };
        }
    }
}

impl Lines {
    /// Adds a line, at a face that is not below those before.
    pub(super) fn push(&mut self, line: Line) {
        self.0.push(line);
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Line> {
        self.0.iter()
    }

    fn at(&self, face: usize) -> impl Iterator<Item = &Line> {
        let from = (self.0).partition_point(|line| (line.face as usize) < face);
        (self.0[from..].iter()).take_while(move |line| line.face as usize == face)
    }

    /// By how much lines pull otherwise than they do at the velocities `u` of the faces and `bodies`, m/s, over all that they
    /// can hold; and makes them go or hold as they do there.
    fn settle(&mut self, u: &[f64], bodies: &[[f64; 3]], pace: f64) -> f64 {
        let (mut error, mut all) = (0.0, 0.0);
        for line in &mut self.0 {
            let wall = line.wall as usize;
            let speed = u[line.face as usize] - bodies[wall / 3][wall % 3];
            error += line.error(speed, pace);
            all += line.holds;
            line.settle(speed, pace);
        }
        if all > 0.0 { error / all } else { 0.0 }
    }
}

/// What a held line, or a pin, resists with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Friction {
    pub(super) face: usize,
    /// Component of the wall's velocity, as 3 body + axis.
    pub(super) wall: usize,
    /// Force over velocity.
    pub(super) friction: f64,
}

impl Operator<'_> {
    /// What all held lines and pins resist with.
    pub(super) fn held_lines(&self) -> Vec<Friction> {
        let pace = self.scales.cell_per_step;
        let held = self.pull.lines.iter().map(|line| line.resistance(pace));
        let held = held.filter(|line| line.friction > 0.0);
        held.chain(self.pull.pins.iter()).collect()
    }

    /// Makes contact lines go or hold as they do at velocities `u` of the faces and `bodies`, m/s; whether they did.
    pub(crate) fn settle_lines(&mut self, u: &[f64], bodies: &[[f64; 3]]) -> bool {
        let pace = self.scales.cell_per_step;
        self.pull.lines.settle(u, bodies, pace) < DECIDED
    }

    /// What held lines and pins resist with at a face.
    pub(super) fn line_friction(&self, face: usize) -> f64 {
        self.held_at(face).map(|held| held.friction).sum()
    }

    /// Calls `each` with the term of every held line and pin at a face.
    pub(super) fn line_terms(&self, face: usize, mut each: impl FnMut(&Term)) {
        for held in self.held_at(face) {
            let wall = Velocity::Body(held.wall as u32);
            let liquid = Velocity::Face(face as u32);
            each(&Term::pair(held.friction, wall, liquid));
        }
    }

    fn held_at(&self, face: usize) -> impl Iterator<Item = Friction> {
        let pace = self.scales.cell_per_step;
        let lines = self
            .pull
            .lines
            .at(face)
            .map(move |line| line.resistance(pace));
        lines.chain(self.pull.pins.at(face))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At walls that move at 0.1 m/s, in steps of a cell at 1 m/s.
    #[test]
    fn lines_hold_until_they_are_pulled_harder() {
        let line = |speed: f64| Line::new(0, 1, 2.0, speed, 1.0);
        let mut lines = Lines(vec![line(0.5), line(-0.5), line(0.009)]);
        let mut at = |u: f64| {
            let changed = lines.settle(&[u], &[[0.0, 0.1, 0.0]], 1.0);
            let forces: Vec<f64> = lines.iter().map(Line::force).collect();
            let frictions: Vec<f64> = lines.iter().map(|line| line.friction(1.0)).collect();
            ((3.0 * changed).round() / 3.0, forces, frictions)
        };
        // All that it holds at a thousandth of a cell.
        let held = 2.0 / 1e-3;
        assert_eq!(
            at(0.1009),
            (1.0 / 3.0, vec![-2.0, 0.0, 0.0], vec![0.0, held, held])
        );
        // Both that were held pull by twice what they hold.
        let go = vec![-2.0; 3];
        assert_eq!(at(0.102), (2.0 / 3.0, go.clone(), vec![0.0; 3]));
        assert_eq!(at(0.0), (1.0, vec![0.0; 3], vec![held; 3]));
    }
}
