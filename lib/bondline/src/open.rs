//! The voids of wood that are open to a layer of it.

use std::collections::VecDeque;

use particle_file::{BitGrid, BitsRef};
use units::Axis;

const WORD: usize = u64::BITS as usize;

/// The voids that paths through faces between voxels connect to those of `layer` across `normal`.
///
/// Liquid gets from one adherend to the other through the bond plane only, so each can be looked at
/// alone, from its layer there: the last of the lower, the first of the upper.
///
/// # Panics
/// When there is no such layer.
pub fn open_voids(wood: BitsRef, normal: Axis, layer: usize) -> BitGrid {
    let dims = wood.dims();
    let [nx, ny, nz] = dims;
    assert!(layer < dims[normal.index()], "a layer outside the wood");
    let mut flood = Flood {
        wood,
        found: BitGrid::new(dims),
        waiting: VecDeque::new(),
        waits: BitGrid::new([ny, nz, 1]),
    };
    let every = vec![u64::MAX; nx.div_ceil(WORD)];
    let mut one = vec![0; nx.div_ceil(WORD)];
    let whole = |n: usize| 0..n;
    match normal {
        Axis::X => {
            one[layer / WORD] = 1 << (layer % WORD);
            whole(nz).for_each(|z| whole(ny).for_each(|y| flood.enter([y, z], &one)));
        }
        Axis::Y => whole(nz).for_each(|z| flood.enter([layer, z], &every)),
        Axis::Z => whole(ny).for_each(|y| flood.enter([y, layer], &every)),
    }
    flood.spread();
    flood.found
}

/// Voids found so far, row by row along x: a front of single voxels took 24 bytes of each.
struct Flood<'a> {
    wood: BitsRef<'a>,
    found: BitGrid,
    /// Rows (y, z) in which voids were found whose neighbours are to be looked at.
    waiting: VecDeque<[usize; 2]>,
    /// Which those are.
    waits: BitGrid,
}

impl Flood<'_> {
    /// Adds to row (y, z) those of its voids that are in `from`.
    fn enter(&mut self, [y, z]: [usize; 2], from: &[u64]) {
        let found = self.found.row_mut(y, z);
        let mut more = 0;
        for (i, found) in found.iter_mut().enumerate() {
            let new = from[i] & void(self.wood, [y, z], i) & !*found;
            *found |= new;
            more |= new;
        }
        if more != 0 && !self.waits.get(y, z, 0) {
            self.waits.set(y, z, 0, true);
            self.waiting.push_back([y, z]);
        }
    }

    fn spread(&mut self) {
        let [_, ny, nz] = self.wood.dims();
        while let Some([y, z]) = self.waiting.pop_front() {
            self.waits.set(y, z, 0, false);
            self.fill([y, z]);
            let row = self.found.row(y, z).to_vec();
            let beside = [
                (y > 0, [y.wrapping_sub(1), z]),
                (y + 1 < ny, [y + 1, z]),
                (z > 0, [y, z.wrapping_sub(1)]),
                (z + 1 < nz, [y, z + 1]),
            ];
            for (_, at) in beside.into_iter().filter(|(inside, _)| *inside) {
                self.enter(at, &row);
            }
        }
    }

    /// Fills the voids of row (y, z) that are connected within it to one found.
    fn fill(&mut self, at: [usize; 2]) {
        let wood = self.wood;
        let row = self.found.row_mut(at[0], at[1]);
        let mut carry = 0;
        for (i, found) in row.iter_mut().enumerate() {
            let void = void(wood, at, i);
            *found = upwards(*found | carry & void, void);
            carry = *found >> (WORD - 1);
        }
        carry = 0;
        for (i, found) in row.iter_mut().enumerate().rev() {
            let void = void(wood, at, i);
            let turned = (*found | carry & void).reverse_bits();
            *found = upwards(turned, void.reverse_bits()).reverse_bits();
            carry = *found << (WORD - 1);
        }
    }
}

/// The voids of word `i` of row (y, z); there are none behind its end.
fn void(wood: BitsRef, [y, z]: [usize; 2], i: usize) -> u64 {
    let inside = match wood.dims()[0] - i * WORD {
        left if left < WORD => (1 << left) - 1,
        _ => u64::MAX,
    };
    !wood.row(y, z)[i] & inside
}

/// `from`, and the bits of `void` above each of it without a gap, in steps of 1, 2, 4 ... bits.
fn upwards(from: u64, void: u64) -> u64 {
    let (mut filled, mut open) = (from, void);
    for step in (0..WORD.ilog2()).map(|power| 1 << power) {
        filled |= open & filled << step;
        open &= open << step;
    }
    filled
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Voxel by voxel, as the rows do it a word at a time.
    fn by_voxels(wood: &BitGrid, axis: usize, layer: usize) -> BitGrid {
        let dims = wood.dims();
        let mut open = BitGrid::new(dims);
        let mut front = Vec::new();
        let all = BitGrid::from_fn(dims, |x, y, z| [x, y, z][axis] == layer);
        all.view().for_each(|index| front.push(index));
        while let Some([x, y, z]) = front.pop() {
            if wood.get(x, y, z) || open.get(x, y, z) {
                continue;
            }
            open.set(x, y, z, true);
            for a in 0..3 {
                let mut beside = [[x, y, z]; 2];
                (beside[0][a], beside[1][a]) = (beside[0][a].wrapping_sub(1), beside[1][a] + 1);
                front.extend(beside.into_iter().filter(|at| at[a] < dims[a]));
            }
        }
        open
    }

    /// Rows that end within, at and behind the end of a word, and voids that wind through several.
    #[test]
    fn whole_rows_find_what_single_voxels_do() {
        for nx in [1, 63, 64, 65, 130] {
            let dims = [nx, 7, 5];
            let wood = BitGrid::from_fn(dims, |x, y, z| {
                (x * 7919 + y * 104_729 + z * 1_299_709) % 97 % 5 < 2
            });
            for (axis, normal) in Axis::ALL.into_iter().enumerate() {
                for layer in [0, dims[axis] - 1] {
                    let expected = by_voxels(&wood, axis, layer);
                    let found = open_voids(wood.view(), normal, layer);
                    assert_eq!(found, expected, "{nx} {normal} {layer}");
                    assert!(nx == 1 || expected.count() > 0);
                }
            }
        }
    }
}
