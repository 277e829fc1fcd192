//! Closing of holes in the liquid: sampling noise of the particles must not look like bubbles.

use rayon::prelude::*;

use super::hidden::behind_walls;
use super::{Fractions, films, sub_cells, sub_cells_of};
use crate::geometry::{Lattice, Window};

/// Air pockets of at most this many cells, enclosed by liquid, are noise.
const LARGEST_HOLE: usize = 4;

/// Fills small enclosed air pockets, films under liquid and the inside of the liquid: a cell without
/// an air cell among its 3^d neighbours, those behind walls left out, is full. `bodies` are the bodies' velocities.
pub(super) fn close(fractions: &mut Fractions, lattice: &Lattice, bodies: &[[f64; 3]]) {
    let (window, open) = (&lattice.window, &lattice.open);
    let nx = window.cells[0];
    let rows = &fractions.rows;
    let cell = &fractions.cell;
    let mut kinds = vec![Kind::Solid; window.len()];
    kinds.par_chunks_mut(nx).enumerate().for_each(|(row, out)| {
        for ((i, kind), mut subs) in
            out.iter_mut()
                .enumerate()
                .zip(sub_cells_of(window, row, 0..nx))
        {
            *kind = if subs.all(|s| open[s] <= 1e-6) {
                Kind::Solid
            } else if rows[row].contains(&i) && cell[row * nx + i] >= 0.5 {
                Kind::Liquid
            } else {
                Kind::Air
            };
        }
    });
    let near = |c: usize| rows[c / nx].contains(&(c % nx));
    let mut holes: Vec<u32> = (0..kinds.len())
        .into_par_iter()
        .filter(|&c| near(c) && is_hole(&kinds, window, open, c))
        .map(|c| c as u32)
        .collect();
    holes.extend(films::find(&kinds, lattice, bodies, near));
    for &hole in &holes {
        kinds[hole as usize] = Kind::Liquid;
    }
    let full: Vec<bool> = (0..kinds.len())
        .into_par_iter()
        .map(|c| kinds[c] == Kind::Liquid && beside_no_air(&kinds, lattice, c))
        .collect();
    for hole in holes {
        fill(fractions, window, hole as usize);
    }
    let Fractions { liquid, cell, .. } = fractions;
    let (sx, sy) = (window.sub_cells()[0], window.sub_cells()[1]);
    liquid.par_chunks_mut(sx).enumerate().for_each(|(r, out)| {
        let base = (r / sy / window.parts(2) * window.cells[1] + r % sy / 2) * nx;
        for (phi, &full) in out.chunks_exact_mut(2).zip(&full[base..]) {
            if full {
                phi.fill(1.0);
            }
        }
    });
    cell.par_iter_mut().zip(&full).for_each(|(phi, &full)| {
        if full {
            *phi = 1.0;
        }
    });
}

/// Whether no neighbour of a cell is air, but for those that it does not meet.
fn beside_no_air(kinds: &[Kind], lattice: &Lattice, cell: usize) -> bool {
    let (mut air, mut apart) = (0, 0);
    for neighbour in neighbours(&lattice.window, cell) {
        match neighbour {
            Some(neighbour) => air += usize::from(kinds[neighbour] == Kind::Air),
            None => return false,
        }
    }
    if air > 0 {
        behind_walls(lattice, cell, |neighbour, _| {
            apart += usize::from(kinds[neighbour] == Kind::Air);
        });
    }
    air == apart
}

/// What a cell holds.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Solid,
    Liquid,
    Air,
}

fn fill(fractions: &mut Fractions, window: &Window, cell: usize) {
    for sub in sub_cells(window, cell) {
        fractions.liquid[sub] = 1.0;
    }
    fractions.cell[cell] = 1.0;
}

/// All 3^d neighbours; `None` for those outside the window.
pub(crate) fn neighbours(
    window: &Window,
    cell: usize,
) -> impl Iterator<Item = Option<usize>> + use<> {
    let at = window.coordinates(cell);
    let inner = window.inner(at);
    let (row, layer) = (window.stride(1) as isize, window.stride(2) as isize);
    let planes = if window.parts(2) == 2 { -1..=1 } else { 0..=0 };
    planes.flat_map(move |c: isize| {
        (-1..=1).flat_map(move |b: isize| {
            (-1..=1).map(move |a: isize| {
                inner.then(|| (cell as isize + c * layer + b * row + a) as usize)
            })
        })
    })
}

/// Whether an air cell belongs to a pocket of at most [`LARGEST_HOLE`] cells all of whose open
/// neighbours are liquid and whose surface is liquid for at least one half: small pores ahead
/// of the liquid have more wall than liquid around them.
fn is_hole(kinds: &[Kind], window: &Window, open: &[f32], cell: usize) -> bool {
    if kinds[cell] != Kind::Air {
        return false;
    }
    let mut pocket = vec![cell];
    let (mut wet, mut dry) = (0, 0);
    let mut next = 0;
    while next < pocket.len() {
        let from = pocket[next];
        next += 1;
        if !window.inner(window.coordinates(from)) {
            return false;
        }
        for axis in 0..window.domain.axes {
            for up in [false, true] {
                let stride = window.stride(axis);
                let to = if up { from + stride } else { from - stride };
                if !joined(window, open, from, to, axis, up) {
                    dry += 1;
                    continue;
                }
                match kinds[to] {
                    Kind::Solid => dry += 1,
                    Kind::Liquid => wet += 1,
                    Kind::Air if pocket.contains(&to) => {}
                    Kind::Air if pocket.len() == LARGEST_HOLE => return false,
                    Kind::Air => pocket.push(to),
                }
            }
        }
    }
    wet >= dry
}

/// Whether open sub-cells of two neighbouring cells touch across their common face.
fn joined(window: &Window, open: &[f32], from: usize, to: usize, axis: usize, up: bool) -> bool {
    let (low, high) = if up { (from, to) } else { (to, from) };
    let low = window.first_sub(window.coordinates(low)) + window.sub_stride(axis);
    let high = window.first_sub(window.coordinates(high));
    let others = [(axis + 1) % 3, (axis + 2) % 3];
    (0..window.parts(others[0])).any(|a| {
        (0..window.parts(others[1])).any(|b| {
            let shift = a * window.sub_stride(others[0]) + b * window.sub_stride(others[1]);
            open[low + shift] > 0.0 && open[high + shift] > 0.0
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::tests::{domain, lattice};

    /// Two neighbours of which one sub-cell each is open: they meet where these touch.
    #[test]
    fn cells_are_joined_where_open_sub_cells_touch() {
        for axes in [2, 3] {
            let lattice = lattice(domain([4, 4, if axes == 3 { 4 } else { 1 }], axes), vec![]);
            let window = &lattice.window;
            let cell = [2, 2, if axes == 3 { 2 } else { 0 }];
            let from = window.index(cell);
            let parts = |cell: [usize; 3]| -> Vec<([usize; 3], usize)> {
                let first = window.first_sub(cell);
                let place = |bit: usize| [bit & 1, bit >> 1 & 1, bit >> 2];
                let sub = |at: [usize; 3]| {
                    first + (0..3).map(|a| at[a] * window.sub_stride(a)).sum::<usize>()
                };
                (0..window.sub_per_cell())
                    .map(|bit| (place(bit), sub(place(bit))))
                    .collect()
            };
            for (axis, up) in (0..axes).flat_map(|axis| [(axis, false), (axis, true)]) {
                let mut next = cell;
                next[axis] = if up { 3 } else { 1 };
                for (own, own_sub) in parts(cell) {
                    for (others, other_sub) in parts(next) {
                        let mut open = vec![0.0; window.sub_len()];
                        (open[own_sub], open[other_sub]) = (1.0, 1.0);
                        let beside = (0..3).all(|a| a == axis || own[a] == others[a]);
                        let facing = own[axis] == usize::from(up) && others[axis] != own[axis];
                        let found = joined(window, &open, from, window.index(next), axis, up);
                        assert_eq!(found, beside && facing, "{axis} {up} {own:?} {others:?}");
                    }
                }
            }
        }
    }
}
