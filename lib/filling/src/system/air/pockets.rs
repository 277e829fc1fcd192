//! Which cells of void are one pocket.

use physics::Boundary;

use super::held::Shares;
use crate::geometry::{Lattice, OPEN, Window};
use crate::liquid::{Volumes, neighbours, sub_cells};
use crate::system::dofs::{Dofs, NONE};

/// In [`Pockets::of`]: air that nothing closes off.
pub(crate) const OUTSIDE: u32 = NONE - 1;
/// Void of a cell, cells, below which it holds no air.
const LEAST: f64 = 1e-3;

/// Sides of the domain that air passes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Outside([bool; 3]);

impl Outside {
    /// Open sides; where a clamp closes the bond those normal to y too, where its body leaves room behind.
    pub(crate) fn new(boundary: [Boundary; 3], clamped: bool) -> Self {
        let mut open = boundary.map(|side| side == Boundary::Open);
        open[1] |= clamped;
        Self(open)
    }
}

/// Void of a step, by pockets: cells without a pressure of their own that open faces connect.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pockets {
    /// Of each cell of the window: the number of its pocket, [`OUTSIDE`], or none.
    pub(crate) of: Vec<u32>,
    /// Liquid cells that are not full, and the pocket beside them that their void counts with.
    pub(crate) edge: Vec<(u32, u32)>,
    /// Void of each cell of the window, cells.
    pub(crate) room: Vec<f32>,
    /// Void of each pocket, cells; first come those that have a face with a velocity to liquid.
    pub(crate) volume: Vec<f64>,
    /// How many these are.
    pub(crate) wet: usize,
}

impl Pockets {
    /// The pockets beside the liquid of `volumes`, whose unknowns are `dofs`, in the window of a whole domain.
    pub(crate) fn find(
        lattice: &Lattice,
        volumes: &Volumes,
        dofs: &Dofs,
        outside: Outside,
    ) -> Self {
        let window = &lattice.window;
        let room: Vec<f32> = (0..window.len())
            .map(|cell| {
                let open: f32 = sub_cells(window, cell).map(|sub| lattice.open[sub]).sum();
                let void = open / window.sub_per_cell() as f32 - volumes.cell[cell];
                if f64::from(void) > LEAST { void } else { 0.0 }
            })
            .collect();
        let mut found = Self {
            of: vec![NONE; window.len()],
            room,
            ..Self::default()
        };
        let kinds = found.flood(lattice, dofs, outside);
        found.number(&kinds);
        found.add_partly_filled(lattice, dofs);
        let Self {
            of,
            edge,
            room,
            volume,
            ..
        } = &mut found;
        let edge = edge.iter().map(|&(cell, pocket)| (cell as usize, pocket));
        for (cell, pocket) in of.iter().copied().enumerate().chain(edge) {
            if let Some(volume) = volume.get_mut(pocket as usize) {
                *volume += f64::from(room[cell]);
            }
        }
        found
    }

    /// Counts with what new pockets share with the old one `from` their part of the void in partly filled cells.
    pub(super) fn add_edges(&self, shares: &mut Shares, from: u32) {
        if !shares.keys().any(|share| share.0 == from) {
            return;
        }
        let mut dry = vec![0.0; self.volume.len()];
        for (&pocket, &room) in self.of.iter().zip(&self.room) {
            if let Some(dry) = dry.get_mut(pocket as usize) {
                *dry += f64::from(room);
            }
        }
        for (&(_, new), room) in shares.iter_mut().filter(|share| share.0.0 == from) {
            if let (Some(whole), Some(dry)) = (self.volume.get(new as usize), dry.get(new as usize))
            {
                *room *= whole / dry;
            }
        }
    }

    /// Numbers connected void in the order of its first cells; what each is.
    fn flood(&mut self, lattice: &Lattice, dofs: &Dofs, outside: Outside) -> Vec<Kind> {
        let window = &lattice.window;
        let home = |cell: usize| window.index(window.home(window.coordinates(cell)));
        let mut kinds = Vec::new();
        for first in 0..window.len() {
            let void = |of: &[u32], cell: usize| {
                of[cell] == NONE
                    && self.room[cell] > 0.0
                    && dofs.cell[cell] == NONE
                    && window.in_domain(window.coordinates(cell))
            };
            if !void(&self.of, first) {
                continue;
            }
            let mut kind = Kind::default();
            self.of[first] = kinds.len() as u32;
            let mut front = vec![first];
            while let Some(cell) = front.pop() {
                kind.outside |= reaches(window, cell, outside);
                for axis in 0..window.domain.axes {
                    let stride = window.stride(axis);
                    for (face, next) in [(cell, cell - stride), (cell + stride, cell + stride)] {
                        let next = home(next);
                        kind.wet |= dofs.face[axis][face] != NONE && dofs.cell[next] != NONE;
                        if lattice.face(axis, face) == OPEN && void(&self.of, next) {
                            self.of[next] = kinds.len() as u32;
                            front.push(next);
                        }
                    }
                }
            }
            kinds.push(kind);
        }
        kinds
    }

    /// Numbers pockets beside liquid first, then the others.
    fn number(&mut self, kinds: &[Kind]) {
        let mut numbers = vec![OUTSIDE; kinds.len()];
        let mut next = 0;
        for wet in [true, false] {
            for (number, kind) in numbers.iter_mut().zip(kinds) {
                if !kind.outside && kind.wet == wet {
                    *number = next;
                    next += 1;
                }
            }
            if wet {
                self.wet = next as usize;
            }
        }
        for of in &mut self.of {
            if let Some(&number) = numbers.get(*of as usize) {
                *of = number;
            }
        }
        self.volume = vec![0.0; next as usize];
    }

    /// Liquid cells with void join what is beside them through an open face, or else at an edge or corner.
    fn add_partly_filled(&mut self, lattice: &Lattice, dofs: &Dofs) {
        let window = &lattice.window;
        let of = |cell: usize| self.of[window.index(window.home(window.coordinates(cell)))];
        self.edge = (dofs.cells.iter())
            .filter(|&&cell| self.room[cell as usize] > 0.0)
            .filter_map(|&cell| {
                let at = cell as usize;
                let beside = (0..window.domain.axes).flat_map(|axis| {
                    let stride = window.stride(axis);
                    let sides = [(at, at - stride), (at + stride, at + stride)];
                    sides.map(|(face, next)| (lattice.face(axis, face) == OPEN).then(|| of(next)))
                });
                let near = neighbours(window, at).flatten().map(of);
                let known = |pocket: &u32| *pocket != NONE;
                let found =
                    (beside.flatten().filter(known).min()).or_else(|| near.filter(known).min())?;
                Some((cell, found))
            })
            .collect();
    }
}

/// What connected void is.
#[derive(Clone, Copy, Debug, Default)]
struct Kind {
    /// It reaches a side that air passes.
    outside: bool,
    /// It has a face with a velocity to liquid.
    wet: bool,
}

/// Whether a cell lies at a side that air passes.
fn reaches(window: &Window, cell: usize, Outside(open): Outside) -> bool {
    let at = window.coordinates(cell);
    (0..window.domain.axes).filter(|&a| open[a]).any(|a| {
        let i = window.low[a] + at[a] as i64;
        i == 0 || i + 1 == window.domain.cells[a] as i64
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Domain, Solids};

    /// Liquid from x = 3 to 5 and three quarters of the cells beyond, of 8 x 4: void on both sides.
    fn beside_liquid(side: Boundary, clamped: bool) -> (Vec<f64>, usize) {
        let domain = Domain {
            cells: [8, 4, 1],
            boundary: [side, Boundary::Symmetry, Boundary::Symmetry],
            axes: 2,
        };
        let window = Window::around(domain, [0; 3], [8, 4, 1]);
        let lattice = Lattice::new(Solids::new(vec![], domain, [0.0; 3], 1.0), window);
        let mut phi = vec![0.0; window.sub_len()];
        for cell in 0..window.len() {
            let filled = match window.coordinates(cell)[0] as i64 + window.low[0] {
                3 | 4 => 1.0,
                5 => 0.75,
                _ => 0.0,
            };
            if window.in_domain(window.coordinates(cell)) {
                sub_cells(&window, cell).for_each(|sub| phi[sub] = filled);
            }
        }
        let volumes = Volumes::new(&lattice, &phi);
        let dofs = Dofs::new(&lattice, &volumes);
        let outside = Outside::new(domain.boundary, clamped);
        let found = Pockets::find(&lattice, &volumes, &dofs, outside);
        (found.volume, found.wet)
    }

    #[test]
    fn void_is_a_pocket_where_no_side_is_outside() {
        assert_eq!(
            beside_liquid(Boundary::Symmetry, false),
            (vec![12.0, 9.0], 2)
        );
        assert_eq!(beside_liquid(Boundary::Periodic, false), (vec![21.0], 1));
        assert_eq!(beside_liquid(Boundary::Open, false), (vec![], 0));
        assert_eq!(beside_liquid(Boundary::Symmetry, true), (vec![], 0));
    }
}
