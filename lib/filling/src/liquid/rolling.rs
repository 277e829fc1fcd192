//! What full cells lack behind a front, where liquid rolls over the walls.
//!
//! Cells there count as full before particles have filled them, because the wedge of air between the tip of a front and its
//! contact lines is thinner than cells can tell.

use rayon::prelude::*;

use super::Fractions;
use crate::geometry::{Lattice, OPEN};

/// Density of a full cell from which it lacks nothing: the rest is the density projection's, and noise of the particles.
const ENOUGH: f32 = 0.8;
/// Density up to which liquid does not touch the walls of a full cell: that of one that is half wedge, half liquid.
const APART: f32 = 0.5;

/// Faces between a cell that lacks liquid and the air at most: farther away is no front, and closed-in liquid has no room to take
/// up from.
const REACH: usize = 4;

/// Fills [`Fractions::lack`].
pub(super) fn behind_fronts(fractions: &mut Fractions, lattice: &Lattice) {
    let (window, all) = (&lattice.window, lattice.all_parts());
    let Fractions {
        cell: fraction,
        density,
        lack,
        ..
    } = fractions;
    let air = |cell: usize| fraction[cell] < 0.5 && lattice.uniform[cell].solid != all;
    let beyond = |cell: usize, next: &mut Vec<usize>| {
        let axes = match window.inner(window.coordinates(cell)) {
            true => window.domain.axes,
            false => 0,
        };
        for axis in 0..axes {
            let stride = window.stride(axis);
            for (face, to) in [(cell, cell - stride), (cell + stride, cell + stride)] {
                if lattice.face(axis, face) == OPEN {
                    next.push(window.index(window.home(window.coordinates(to))));
                }
            }
        }
    };
    let near_air = |cell: usize| nearest_air(cell, beyond, air).is_some();
    let lacking: Vec<(usize, f32)> = (density.par_iter().enumerate())
        .map(|(cell, &density)| (cell, lacks(density)))
        .filter(|&(cell, lack)| lack > 0.0 && fraction[cell] == 1.0 && near_air(cell))
        .collect();
    lack.clear();
    for (cell, part) in lacking {
        lack.resize(density.len(), 0.0);
        lack[cell] = part;
    }
}

/// What a cell of such a density lacks.
pub(super) fn lacks(density: f32) -> f32 {
    (ENOUGH - density).max(0.0)
}

/// The first of the cells of `air` that are the fewest faces away from `cell`, if it is within [`REACH`]; `beyond` adds the cells
/// next to one.
pub(crate) fn nearest_air(
    cell: usize,
    mut beyond: impl FnMut(usize, &mut Vec<usize>),
    air: impl Fn(usize) -> bool,
) -> Option<usize> {
    let (mut known, mut ring, mut next) = (vec![cell], vec![cell], Vec::new());
    for _ in 0..REACH {
        for from in ring.drain(..) {
            beyond(from, &mut next);
        }
        if let Some(&air) = next.iter().find(|&&to| air(to)) {
            return Some(air);
        }
        for to in next.drain(..) {
            if !known.contains(&to) {
                known.push(to);
                ring.push(to);
            }
        }
    }
    None
}

/// Part of the walls wet by a cell's liquid that it touches, of what its density lacks.
pub(crate) fn touching(lack: f32) -> f32 {
    1.0 - (lack / (ENOUGH - APART)).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::tests::{domain, lattice};

    /// What the cells of a channel of 12 x 1 cells lack that liquid of density 0.65 fills from 3 to `wet`, with a wall across at 5.
    fn lack(wet: usize) -> Vec<usize> {
        let wall = physics::VoxelBlock::solid_box([5.0, -9.0, 0.0], [6.0, 9.0, 1.0]);
        let lattice = lattice(domain([12, 1, 1], 2), vec![vec![wall]]);
        let window = &lattice.window;
        let x = |cell: usize| window.coordinates(cell)[0] as i64 + window.low[0];
        let full = |cell: usize| (3..wet as i64).contains(&x(cell)) && x(cell) != 5;
        let of = |full_is: f32| -> Vec<f32> {
            let value = |cell| if full(cell) { full_is } else { 0.0 };
            (0..window.len()).map(value).collect()
        };
        let mut fractions = Fractions::default();
        (fractions.cell, fractions.density) = (of(1.0), of(0.65));
        behind_fronts(&mut fractions, &lattice);
        let lacking =
            (0..window.len()).filter(|&cell| fractions.lack.get(cell).is_some_and(|&l| l > 0.0));
        let mut found: Vec<usize> = lacking.map(|cell| x(cell) as usize).collect();
        found.dedup();
        assert!(
            fractions
                .lack
                .iter()
                .all(|&l| l == 0.0 || (l - 0.15).abs() < 1e-6)
        );
        found
    }

    #[test]
    fn cells_lack_liquid_within_four_faces_of_air_and_not_through_walls() {
        assert_eq!(lack(11), [3, 4, 7, 8, 9, 10]);
        assert_eq!(lack(12), [3, 4]);
    }

    #[test]
    fn liquid_that_lacks_touches_less_of_its_walls() {
        let touching = |density| touching(lacks(density));
        assert_eq!(touching(0.81), 1.0);
        assert!((touching(0.65) - 0.5).abs() < 1e-6);
        assert_eq!((touching(0.5), touching(0.2)), (0.0, 0.0));
    }
}
