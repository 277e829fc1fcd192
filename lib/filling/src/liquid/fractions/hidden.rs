//! What of the surroundings of a cell lies behind walls, from where its liquid neither comes nor could go.

use crate::geometry::{Lattice, OPEN};

/// Cells around one, itself included, along each axis.
const AROUND: usize = 3;
/// Most of them.
const ALL: usize = AROUND.pow(3);

/// Calls `see(neighbour, place)` for every neighbour of a cell, diagonal ones too, that is not solid throughout and to which no
/// way leads through open faces among them; `place` is 0, 1 or 2 along each axis, 1 in the middle. None where the window ends.
pub(super) fn behind_walls(lattice: &Lattice, cell: usize, mut see: impl FnMut(usize, [usize; 3])) {
    let window = &lattice.window;
    if !window.inner(window.coordinates(cell)) {
        return;
    }
    let (axes, all) = (window.domain.axes, lattice.all_parts());
    let steps: [usize; 3] = std::array::from_fn(|a| AROUND.pow(a as u32));
    let count = AROUND.pow(axes as u32);
    let place = |number: usize, axis: usize| number / steps[axis] % AROUND;
    let lowest = cell - (0..axes).map(|a| window.stride(a)).sum::<usize>();
    let mut index = [0; ALL];
    for (number, index) in index[..count].iter_mut().enumerate() {
        let up = |axis| place(number, axis) * window.stride(axis);
        *index = lowest + (0..axes).map(up).sum::<usize>();
    }
    let index = &index[..count];
    if index.iter().all(|&cell| lattice.uniform[cell].open == all) {
        return;
    }
    let mut reached = [false; ALL];
    let (mut ways, mut found, mut next) = ([count / 2; ALL], 1, 0);
    reached[count / 2] = true;
    while next < found {
        let from = ways[next];
        next += 1;
        for (axis, &step) in steps.iter().enumerate().take(axes) {
            let at = place(from, axis);
            let below = (at > 0).then(|| (from - step, from));
            let above = (at + 1 < AROUND).then(|| (from + step, from + step));
            for (to, upper) in [below, above].into_iter().flatten() {
                if !reached[to] && lattice.face(axis, index[upper]) == OPEN {
                    (reached[to], ways[found]) = (true, to);
                    found += 1;
                }
            }
        }
    }
    for (number, &neighbour) in index.iter().enumerate() {
        if !reached[number] && lattice.uniform[neighbour].solid != all {
            let middle = |a| if a < axes { place(number, a) } else { 1 };
            see(neighbour, std::array::from_fn(middle));
        }
    }
}
