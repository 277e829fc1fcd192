//! Grids of one bit a voxel.

use rayon::prelude::*;

pub(crate) const WORD: usize = u64::BITS as usize;

/// A box of voxels, one bit each, x fastest. Every row (fixed y and z) starts at a new word,
/// so that a row is a slice; the bits behind the last voxel of a row are zero. Places outside panic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bits<W> {
    dims: [usize; 3],
    words: W,
}

/// A box with words of its own.
pub type BitGrid = Bits<Vec<u64>>;

/// A borrowed [`BitGrid`], e.g. straight from a mapped file.
pub type BitsRef<'a> = Bits<&'a [u64]>;

/// Words of all rows, or `None` when that number overflows.
pub(crate) fn word_count(dims: [usize; 3]) -> Option<usize> {
    dims[0]
        .div_ceil(WORD)
        .checked_mul(dims[1])?
        .checked_mul(dims[2])
}

fn last_word_mask(nx: usize) -> u64 {
    match nx % WORD {
        0 => u64::MAX,
        used => (1 << used) - 1,
    }
}

impl BitGrid {
    /// An empty grid of `dims` = [nx, ny, nz] voxels.
    ///
    /// # Panics
    /// When the grid is larger than the address space.
    pub fn new(dims: [usize; 3]) -> Self {
        let words = word_count(dims).expect("a grid larger than the address space");
        Self {
            dims,
            words: vec![0; words],
        }
    }

    /// Builds the rows in parallel: `fill(y, z, row)` gets each row zeroed. Bits behind the
    /// last voxel are cleared afterwards.
    pub fn from_rows(dims: [usize; 3], fill: impl Fn(usize, usize, &mut [u64]) + Sync) -> Self {
        let mut grid = Self::new(dims);
        let words_per_row = dims[0].div_ceil(WORD).max(1);
        let mask = last_word_mask(dims[0]);
        let rows = grid.words.par_chunks_exact_mut(words_per_row);
        rows.with_min_len(64).enumerate().for_each(|(r, row)| {
            fill(r % dims[1], r / dims[1], row);
            row[words_per_row - 1] &= mask;
        });
        grid
    }

    /// Builds a grid from a predicate on voxel indices, rows in parallel.
    pub fn from_fn(dims: [usize; 3], set: impl Fn(usize, usize, usize) -> bool + Sync) -> Self {
        Self::from_rows(dims, |y, z, row| {
            for (w, word) in row.iter_mut().enumerate() {
                let end = WORD.min(dims[0] - w * WORD);
                *word = (0..end).fold(0, |bits, b| bits | u64::from(set(w * WORD + b, y, z)) << b);
            }
        })
    }

    /// Sets or clears voxel (x, y, z).
    pub fn set(&mut self, x: usize, y: usize, z: usize, value: bool) {
        assert!(x < self.dims[0], "voxel outside the grid");
        let word = &mut self.row_mut(y, z)[x / WORD];
        *word = *word & !(1 << (x % WORD)) | u64::from(value) << (x % WORD);
    }

    /// The words of row (y, z) for writing; bits behind the last voxel must stay zero.
    pub fn row_mut(&mut self, y: usize, z: usize) -> &mut [u64] {
        let range = row_range(self.dims, y, z);
        &mut self.words[range]
    }
}

impl<W: AsRef<[u64]>> Bits<W> {
    /// A box from its words; `None` when their number is not `ceil(nx / 64) * ny * nz` or a bit
    /// behind the end of a row is set.
    pub fn from_words(dims: [usize; 3], words: W) -> Option<Self> {
        let outside = !last_word_mask(dims[0]);
        let all = words.as_ref();
        let mut rows = all.chunks_exact(dims[0].div_ceil(WORD).max(1));
        let sound = word_count(dims)? == all.len()
            && rows.all(|row| row.last().is_some_and(|last| last & outside == 0));
        sound.then_some(Self { dims, words })
    }

    /// A borrowed view.
    pub fn view(&self) -> BitsRef<'_> {
        Bits {
            dims: self.dims,
            words: self.words(),
        }
    }

    /// Number of voxels along x, y, z.
    pub fn dims(&self) -> [usize; 3] {
        self.dims
    }

    /// Whether voxel (x, y, z) is set.
    #[inline]
    pub fn get(&self, x: usize, y: usize, z: usize) -> bool {
        assert!(x < self.dims[0], "voxel outside the grid");
        self.row(y, z)[x / WORD] >> (x % WORD) & 1 == 1
    }

    /// Number of set voxels.
    pub fn count(&self) -> u64 {
        popcount(self.words())
    }

    /// The words of row (y, z), x fastest.
    pub fn row(&self, y: usize, z: usize) -> &[u64] {
        &self.words()[row_range(self.dims, y, z)]
    }

    /// All words, rows (y, z) with y fastest.
    pub fn words(&self) -> &[u64] {
        self.words.as_ref()
    }
}

impl<'a> BitsRef<'a> {
    /// The x of the set voxels of row (y, z), ascending.
    pub fn set_in_row(&self, y: usize, z: usize) -> impl Iterator<Item = usize> + use<'a> {
        let row = &self.words[row_range(self.dims, y, z)];
        row.iter().enumerate().flat_map(|(w, &word)| {
            std::iter::successors(Some(word), |&rest| Some(rest & rest.wrapping_sub(1)))
                .take_while(|&rest| rest != 0)
                .map(move |rest| w * WORD + rest.trailing_zeros() as usize)
        })
    }

    /// Calls `visit` with the index of every set voxel, in storage order.
    pub fn for_each(&self, mut visit: impl FnMut([usize; 3])) {
        for z in 0..self.dims[2] {
            for y in 0..self.dims[1] {
                self.set_in_row(y, z).for_each(|x| visit([x, y, z]));
            }
        }
    }

    /// Number of set voxels in each layer across `axis` (0 = x, 1 = y, 2 = z).
    ///
    /// # Panics
    /// When `axis` is above 2.
    pub fn counts_along(&self, axis: usize) -> Vec<u64> {
        let mut counts = vec![0; self.dims[axis]];
        for z in 0..self.dims[2] {
            for y in 0..self.dims[1] {
                match axis {
                    0 => self.set_in_row(y, z).for_each(|x| counts[x] += 1),
                    1 => counts[y] += popcount(self.row(y, z)),
                    _ => counts[z] += popcount(self.row(y, z)),
                }
            }
        }
        counts
    }
}

impl<'a> From<&'a BitGrid> for BitsRef<'a> {
    fn from(grid: &'a BitGrid) -> Self {
        grid.view()
    }
}

fn popcount(words: &[u64]) -> u64 {
    words.iter().map(|w| u64::from(w.count_ones())).sum()
}

fn row_range(dims: [usize; 3], y: usize, z: usize) -> std::ops::Range<usize> {
    assert!(y < dims[1] && z < dims[2], "row outside the grid");
    let words_per_row = dims[0].div_ceil(WORD);
    let start = (z * dims[1] + y) * words_per_row;
    start..start + words_per_row
}
