//! How much air the pockets hold, from step to step.

use std::collections::{BTreeMap, BTreeSet};

use super::Pockets;
use super::law::Contents;
use super::pockets::OUTSIDE;
use crate::geometry::Window;
use crate::liquid::neighbours;
use crate::system::dofs::NONE;

/// Least volume of a pocket, cells: what is pressed from there has the pressure at which its law ends.
const LEAST: f64 = 1e-6;

/// Air of the pockets of a step, as pressure times volume; and what liquid has covered.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Held {
    /// Of each cell of the window: the number of its air, [`OUTSIDE`], or none. Empty before the
    /// first step, when all is outside.
    pub(crate) of: Vec<u32>,
    /// Air of each pocket, and behind the pockets of each that vanished under liquid, Pa cells.
    pub(crate) mass: Vec<f64>,
    /// Volume that each has come to by what flowed, cells: the void counted cell by cell jumps by parts of a cell
    /// where liquid creeps.
    pub(crate) volume: Vec<f64>,
    /// Number of the first that vanished.
    pub(crate) vanished: usize,
    /// Air closed off since the start, and air that came free again, Pa cells.
    pub(crate) passed: [f64; 2],
    /// Steps whose air did not come to the pressure of its volume.
    pub(crate) astray: u64,
}

impl Held {
    /// The air as it is in `pockets`, with `outside` (Pa, absolute) where nothing closed it off: it stays
    /// where it was, in the parts of the void shared. A pocket where no air was takes its part of what is
    /// next to it; a pocket under liquid keeps its air until void opens there or beside. With it: the part of each
    /// pocket that was outside.
    pub(crate) fn followed(
        &self,
        pockets: &Pockets,
        window: &Window,
        outside: f64,
    ) -> (Self, Vec<f64>) {
        let mut shares = self.shared(pockets);
        let bare = lacking(shares.keys().map(|pair| pair.1), pockets.volume.len());
        self.add_beside(pockets, window, &mut shares, &bare, |_, new| new);
        let lost = lacking(shares.keys().map(|pair| pair.0), self.mass.len());
        self.add_beside(pockets, window, &mut shares, &lost, |old, _| old);
        pockets.add_edges(&mut shares, OUTSIDE);
        let fresh = (pockets.volume.iter().enumerate()).map(|(new, volume)| {
            shares
                .get(&(OUTSIDE, new as u32))
                .map_or(0.0, |room| room / volume)
        });
        (self.shared_out(&shares, pockets, outside), fresh.collect())
    }

    /// Makes what was outside, the parts `fresh` of pockets, what it was at the start of the step, from which they
    /// grew by `growth` (cells) to the middle.
    pub(crate) fn begin(&mut self, fresh: &[f64], growth: impl Iterator<Item = f64>, outside: f64) {
        for (number, (fresh, growth)) in fresh.iter().zip(growth).enumerate() {
            let volume = &mut self.volume[number];
            let before = (*volume - fresh * growth).max((1.0 - 0.5 * fresh) * *volume);
            let air = outside * (before - *volume);
            *volume = before;
            self.mass[number] += air;
            self.passed[0] += air;
        }
    }

    /// Lets the first pockets grow by `growth` (cells), of which a step had the part `part`.
    pub(crate) fn grow(&mut self, growth: &[f64], part: f64) {
        for (volume, growth) in self.volume.iter_mut().zip(growth) {
            *volume = (*volume * (1.0 + growth / *volume).powf(part)).max(LEAST);
        }
    }

    /// The first pockets of so many.
    pub(crate) fn contents(&self, count: usize) -> Contents<'_> {
        Contents {
            mass: &self.mass[..count],
            volume: &self.volume[..count],
        }
    }

    /// Whether a number of a cell is that of the air outside, or none.
    pub(crate) fn is_no_pocket(number: u32) -> bool {
        [OUTSIDE, NONE].contains(&number)
    }

    /// The number of a cell's air; before the first step all is outside.
    fn at(&self, cell: usize) -> u32 {
        self.of.get(cell).copied().unwrap_or(OUTSIDE)
    }

    /// The void that old and new pockets have in common.
    fn shared(&self, pockets: &Pockets) -> Shares {
        let mut shares = Shares::new();
        for (cell, (&new, &room)) in pockets.of.iter().zip(&pockets.room).enumerate() {
            let old = self.at(cell);
            if new != NONE && old != NONE && [old, new] != [OUTSIDE; 2] {
                *shares.entry((old, new)).or_default() += f64::from(room);
            }
        }
        shares
    }

    /// Adds the void of new pockets beside cells of old ones, where that of both which `which` tells is
    /// `wanted`.
    fn add_beside(
        &self,
        pockets: &Pockets,
        window: &Window,
        shares: &mut Shares,
        wanted: &[bool],
        which: impl Fn(u32, u32) -> u32,
    ) {
        if !wanted.contains(&true) {
            return;
        }
        for (cell, (&new, &room)) in pockets.of.iter().zip(&pockets.room).enumerate() {
            if new == NONE {
                continue;
            }
            let beside: BTreeSet<u32> = (neighbours(window, cell).flatten())
                .map(|near| self.at(window.index(window.home(window.coordinates(near)))))
                .filter(|&old| old != NONE && wanted.get(which(old, new) as usize) == Some(&true))
                .collect();
            for &old in &beside {
                *shares.entry((old, new)).or_default() += f64::from(room) / beside.len() as f64;
            }
        }
    }

    /// Air by shares.
    fn shared_out(&self, shares: &Shares, pockets: &Pockets, outside: f64) -> Self {
        let mut whole = vec![0.0; self.mass.len()];
        for (&(old, _), &room) in shares {
            if let Some(whole) = whole.get_mut(old as usize) {
                *whole += room;
            }
        }
        let count = pockets.volume.len();
        let mut next = Self {
            of: pockets.of.clone(),
            mass: vec![0.0; count],
            volume: vec![0.0; count],
            vanished: count,
            passed: self.passed,
            astray: self.astray,
        };
        for (&(old, new), &room) in shares {
            let (mass, volume) = match self.mass.get(old as usize) {
                Some(mass) => {
                    let part = room / whole[old as usize];
                    (mass * part, self.volume[old as usize] * part)
                }
                None => (outside * room, room),
            };
            if old == OUTSIDE {
                next.passed[0] += mass;
            }
            match next.mass.get_mut(new as usize) {
                Some(sum) => {
                    *sum += mass;
                    next.volume[new as usize] += volume;
                }
                None => next.passed[1] += mass,
            }
        }
        // Air that no liquid presses on has the void that it is in.
        for (number, volume) in next.volume.iter_mut().enumerate() {
            if number >= pockets.wet || *volume < LEAST {
                *volume = pockets.volume[number].max(LEAST);
            }
        }
        let mut covered = vec![NONE; self.mass.len()];
        for (old, &mass) in self.mass.iter().enumerate() {
            if whole[old] == 0.0 && mass > 0.0 {
                covered[old] = next.mass.len() as u32;
                next.mass.push(mass);
                next.volume.push(self.volume[old]);
            }
        }
        for (cell, of) in next.of.iter_mut().enumerate() {
            if *of == NONE
                && let Some(&number) = covered.get(self.at(cell) as usize)
            {
                *of = number;
            }
        }
        next
    }
}

/// Void (cells) by old and new pocket.
pub(super) type Shares = BTreeMap<(u32, u32), f64>;

/// Which of so many numbers are not among these.
fn lacking(numbers: impl Iterator<Item = u32>, count: usize) -> Vec<bool> {
    let mut lacking = vec![true; count];
    for number in numbers {
        if let Some(lacking) = lacking.get_mut(number as usize) {
            *lacking = false;
        }
    }
    lacking
}

#[cfg(test)]
mod tests {
    use physics::Boundary;

    use super::*;
    use crate::geometry::Domain;

    /// A row of ten cells in a domain of its own.
    fn window() -> Window {
        let domain = Domain {
            cells: [10, 1, 1],
            boundary: [Boundary::Symmetry; 3],
            axes: 2,
        };
        Window::around(domain, [0; 3], [10, 1, 1])
    }

    /// Pockets by the number of each of the ten cells, of a whole cell's void each.
    fn pockets(numbers: [u32; 10]) -> Pockets {
        let window = window();
        let mut found = Pockets {
            of: vec![NONE; window.len()],
            room: vec![0.0; window.len()],
            ..Pockets::default()
        };
        let count = numbers.iter().filter(|n| **n < OUTSIDE).max();
        found.volume = vec![0.0; count.map_or(0, |n| *n as usize + 1)];
        for (i, number) in numbers.into_iter().enumerate() {
            let cell = window.index(
                window
                    .local([i as f64, 0.0, 0.0])
                    .map(|x| x.max(0.0) as usize),
            );
            (found.of[cell], found.room[cell]) = (number, 1.0);
            if let Some(volume) = found.volume.get_mut(number as usize) {
                *volume += 1.0;
            }
        }
        found
    }

    const X: u32 = NONE;
    const O: u32 = OUTSIDE;

    #[test]
    fn a_volume_is_pressed_to_next_to_nothing_and_no_less() {
        let mut held = Held {
            volume: vec![2.0, 2.0, 2.0, 1e-6],
            ..Held::default()
        };
        held.grow(&[1.0, -1.999, -2.0, -5e-7], 1.001);
        let pressed = 2.0 * 0.0005_f64.powf(1.001);
        assert!((held.volume[0] - 2.0 * 1.5_f64.powf(1.001)).abs() < 1e-12);
        assert!((held.volume[1] / pressed - 1.0).abs() < 1e-9);
        assert_eq!(held.volume[2..], [1e-6; 2]);
    }

    #[test]
    fn air_stays_with_the_void_it_is_in() {
        let window = window();
        let follow = |held: &Held, numbers| held.followed(&pockets(numbers), &window, 10.0).0;
        let two = follow(&Held::default(), [0, 0, 0, 0, X, 1, 1, X, O, O]);
        assert_eq!(
            (&two.mass[..], two.passed),
            (&[40.0, 20.0][..], [60.0, 0.0])
        );
        // One is compressed, then both are one, which splits in three.
        let less = follow(&two, [0, 0, X, X, X, 1, 1, X, O, O]);
        assert_eq!(less.mass, [40.0, 20.0]);
        let one = follow(&less, [0, 0, 0, 0, 0, 0, 0, X, O, O]);
        assert_eq!((&one.mass[..], one.passed), (&[60.0][..], [60.0, 0.0]));
        let three = follow(&one, [0, X, 1, 1, 1, X, 2, X, O, O]);
        assert_eq!(three.mass, [12.0, 36.0, 12.0]);
        // The first opens, the second keeps its own, the third is under liquid, and comes back beside.
        let open = follow(&three, [O, X, 0, X, X, X, X, X, O, O]);
        assert_eq!((&open.mass[..], open.vanished), (&[36.0, 12.0][..], 1));
        assert_eq!(open.passed, [60.0, 12.0]);
        let back = follow(&open, [O, X, 0, X, X, 1, X, X, O, O]);
        assert_eq!((&back.mass[..], back.vanished), (&[36.0, 12.0][..], 2));
        // Void that opens beside a pocket takes its part of it, far from all none.
        let split = follow(&back, [O, X, 0, 2, X, 1, X, X, X, X]);
        assert_eq!(split.mass, [18.0, 12.0, 18.0]);
        let empty = follow(&split, [O, X, 0, 2, X, 1, X, X, 3, X]);
        assert_eq!(empty.mass, [18.0, 12.0, 18.0, 0.0]);
        // What was outside is closed off at its pressure.
        let closed = follow(&empty, [3, X, 0, 2, X, 1, X, X, X, X]);
        assert_eq!(closed.mass, [18.0, 12.0, 18.0, 10.0]);
    }
}
