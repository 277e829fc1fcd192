//! Voids of wood that are connected to a given layer.

use std::collections::VecDeque;

use particle_file::{BitGrid, BitsRef};
use units::Axis;

const WORD: usize = u64::BITS as usize;

/// The voids that are connected, through faces of voxels, to those of `layer` across `normal`; along axes that are `periodic`
/// also through the sides.
///
/// Liquid passes between the adherends through the bond plane only, so each adherend is treated alone, from its layer at
/// the bond: the last one of the lower, the first one of the upper.
///
/// # Panics
/// If there is no such layer.
pub fn open_voids(wood: BitsRef, normal: Axis, layer: usize, periodic: [bool; 3]) -> BitGrid {
    let dims = wood.dims();
    let [nx, ny, nz] = dims;
    assert!(layer < dims[normal.index()], "a layer outside the wood");
    let mut flood = Flood {
        wood,
        periodic,
        found: BitGrid::new(dims),
        waiting: VecDeque::new(),
        is_waiting: BitGrid::new([ny, nz, 1]),
    };
    let every = vec![u64::MAX; nx.div_ceil(WORD)];
    let mut one = vec![0; nx.div_ceil(WORD)];
    let whole = |n: usize| 0..n;
    match normal {
        Axis::X => {
            one[layer / WORD] = 1 << (layer % WORD);
            whole(nz).for_each(|z| whole(ny).for_each(|y| flood.add([y, z], &one)));
        }
        Axis::Y => whole(nz).for_each(|z| flood.add([layer, z], &every)),
        Axis::Z => whole(ny).for_each(|y| flood.add([y, layer], &every)),
    }
    flood.spread();
    flood.found
}

/// A flood fill by rows along x, which takes less memory than a front of single voxels.
struct Flood<'a> {
    wood: BitsRef<'a>,
    periodic: [bool; 3],
    found: BitGrid,
    /// Rows (y, z) with new voids, whose neighbours are still to be visited.
    waiting: VecDeque<[usize; 2]>,
    /// Whether a row is in `waiting`.
    is_waiting: BitGrid,
}

impl Flood<'_> {
    /// Adds the voids of row (y, z) that are set in `from`.
    fn add(&mut self, [y, z]: [usize; 2], from: &[u64]) {
        let found = self.found.row_mut(y, z);
        let mut more = 0;
        for (i, found) in found.iter_mut().enumerate() {
            let new = from[i] & void_word(self.wood, [y, z], i) & !*found;
            *found |= new;
            more |= new;
        }
        if more != 0 && !self.is_waiting.get(y, z, 0) {
            self.is_waiting.set(y, z, 0, true);
            self.waiting.push_back([y, z]);
        }
    }

    fn spread(&mut self) {
        let [nx, ny, nz] = self.wood.dims();
        let beside = |i: usize, n: usize, periodic: bool| {
            let below = (i > 0 || periodic).then(|| (i + n - 1) % n);
            let above = (i + 1 < n || periodic).then(|| (i + 1) % n);
            below.into_iter().chain(above)
        };
        while let Some([y, z]) = self.waiting.pop_front() {
            self.is_waiting.set(y, z, 0, false);
            self.fill_row([y, z]);
            let ends = [0, nx - 1];
            let found = ends.map(|x| self.found.get(x, y, z));
            let open = ends.iter().all(|&x| !self.wood.get(x, y, z));
            if self.periodic[0] && open && found[0] != found[1] {
                ends.iter().for_each(|&x| self.found.set(x, y, z, true));
                self.fill_row([y, z]);
            }
            let row = self.found.row(y, z).to_vec();
            beside(y, ny, self.periodic[1]).for_each(|y| self.add([y, z], &row));
            beside(z, nz, self.periodic[2]).for_each(|z| self.add([y, z], &row));
        }
    }

    /// Fills the voids of row (y, z) that are connected, within the row, to a void already found.
    fn fill_row(&mut self, at: [usize; 2]) {
        let wood = self.wood;
        let row = self.found.row_mut(at[0], at[1]);
        let mut carry = 0;
        for (i, found) in row.iter_mut().enumerate() {
            let void = void_word(wood, at, i);
            *found = extend_up(*found | carry & void, void);
            carry = *found >> (WORD - 1);
        }
        carry = 0;
        for (i, found) in row.iter_mut().enumerate().rev() {
            let void = void_word(wood, at, i);
            let turned = (*found | carry & void).reverse_bits();
            *found = extend_up(turned, void.reverse_bits()).reverse_bits();
            carry = *found << (WORD - 1);
        }
    }
}

/// The voids in word `i` of row (y, z); bits beyond the end of the row are zero.
fn void_word(wood: BitsRef, [y, z]: [usize; 2], i: usize) -> u64 {
    let inside = match wood.dims()[0] - i * WORD {
        left if left < WORD => (1 << left) - 1,
        _ => u64::MAX,
    };
    !wood.row(y, z)[i] & inside
}

/// Extends each bit of `from` upwards over adjacent bits of `void`, in steps of 1, 2, 4 ... bits.
fn extend_up(from: u64, void: u64) -> u64 {
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

    /// The same fill, voxel by voxel.
    fn by_voxels(wood: &BitGrid, axis: usize, layer: usize, periodic: [bool; 3]) -> BitGrid {
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
                if periodic[a] {
                    beside[0][a] = beside[0][a].min(dims[a] - 1);
                    beside[1][a] %= dims[a];
                }
                front.extend(beside.into_iter().filter(|at| at[a] < dims[a]));
            }
        }
        open
    }

    /// Rows that end within, at and just beyond the end of a word, and voids that wind through several rows.
    #[test]
    fn whole_rows_find_what_single_voxels_do() {
        for nx in [1, 63, 64, 65, 130] {
            let dims = [nx, 7, 5];
            let wood = BitGrid::from_fn(dims, |x, y, z| {
                (x * 7919 + y * 104_729 + z * 1_299_709) % 97 % 5 < 2
            });
            for (axis, normal) in Axis::ALL.into_iter().enumerate() {
                let mut across = [true; 3];
                across[axis] = false;
                for (layer, periodic) in [(0, [false; 3]), (dims[axis] - 1, across)] {
                    let expected = by_voxels(&wood, axis, layer, periodic);
                    let found = open_voids(wood.view(), normal, layer, periodic);
                    assert_eq!(found, expected, "{nx} {normal} {layer}");
                    assert!(nx == 1 || expected.count() > 0);
                }
            }
        }
    }
}
