//! The material of every voxel of a specimen, in a quarter of a byte each.

use rayon::prelude::*;

/// What a voxel is, while the adhesive goes in and after.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum State {
    Wood,
    Open,
    /// Open, and next to a voxel that the adhesive has passed: it has its turn.
    Queued,
    Adhesive,
}

/// Label of void voxels.
pub const VOID: u8 = 0;
/// Label of wood voxels.
pub const WOOD: u8 = 128;
/// Label of adhesive voxels.
pub const ADHESIVE: u8 = 255;

impl State {
    fn label(self) -> u8 {
        match self {
            Self::Wood => WOOD,
            Self::Open | Self::Queued => VOID,
            Self::Adhesive => ADHESIVE,
        }
    }
}

/// States of all voxels. A page begins on a byte of its own, so that pages are written side by
/// side; an *index* counts the voxels that this leaves unused, too.
#[derive(Clone, Debug)]
pub(crate) struct Cells {
    size: [usize; 3],
    bytes: Vec<u8>,
}

const PER_BYTE: usize = 4;
const BITS: usize = 2;

impl Cells {
    pub(crate) fn new(size: [usize; 3]) -> Self {
        Self {
            size,
            bytes: vec![0; Self::bytes(size)],
        }
    }

    /// Memory that the states of so many voxels take.
    pub(crate) fn bytes(size: [usize; 3]) -> usize {
        (size[0] * size[1]).div_ceil(PER_BYTE) * size[2]
    }

    /// Indices from one page to the next.
    fn page(&self) -> usize {
        (self.size[0] * self.size[1]).next_multiple_of(PER_BYTE)
    }

    /// The bytes of each page, for [`put`] by its own indices.
    pub(crate) fn pages_mut(&mut self) -> impl IndexedParallelIterator<Item = &mut [u8]> {
        let page = self.page() / PER_BYTE;
        self.bytes.par_chunks_mut(page)
    }

    /// The indices of all voxels, page by page.
    pub(crate) fn indices(&self) -> impl Iterator<Item = usize> + use<> {
        let (page, voxels) = (self.page(), self.size[0] * self.size[1]);
        (0..self.size[2]).flat_map(move |z| z * page..z * page + voxels)
    }

    pub(crate) fn place(&self, index: usize) -> [usize; 3] {
        let (page, nx) = (self.page(), self.size[0]);
        [index % page % nx, index % page / nx, index / page]
    }

    #[cfg(test)]
    pub(crate) fn index(&self, [column, row, page]: [usize; 3]) -> usize {
        page * self.page() + row * self.size[0] + column
    }

    pub(crate) fn get(&self, index: usize) -> State {
        match self.bytes[index / PER_BYTE] >> (BITS * (index % PER_BYTE)) & 3 {
            0 => State::Wood,
            1 => State::Open,
            2 => State::Queued,
            _ => State::Adhesive,
        }
    }

    pub(crate) fn set(&mut self, index: usize, state: State) {
        put(&mut self.bytes, index, state);
    }

    pub(crate) fn labels(&self, page: usize) -> Vec<u8> {
        let first = page * self.page();
        let indices = first..first + self.size[0] * self.size[1];
        indices.map(|index| self.get(index).label()).collect()
    }

    /// The indices of all voxels over the faces of this one.
    pub(crate) fn neighbours(&self, index: usize) -> impl Iterator<Item = usize> + use<> {
        let ([nx, ny, nz], page) = (self.size, self.page());
        let [x, y, z] = self.place(index);
        [
            (x > 0, index.wrapping_sub(1)),
            (x + 1 < nx, index + 1),
            (y > 0, index.wrapping_sub(nx)),
            (y + 1 < ny, index + nx),
            (z > 0, index.wrapping_sub(page)),
            (z + 1 < nz, index + page),
        ]
        .into_iter()
        .filter_map(|(inside, index)| inside.then_some(index))
    }
}

/// Sets the voxel `index` of what `bytes` begins with.
pub(crate) fn put(bytes: &mut [u8], index: usize, state: State) {
    let shift = BITS * (index % PER_BYTE);
    let byte = &mut bytes[index / PER_BYTE];
    *byte = *byte & !(3 << shift) | (state as u8) << shift;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pages of 3 x 5 voxels leave one index unused.
    #[test]
    fn every_voxel_keeps_its_own_state() {
        let size = [3, 5, 2];
        let mut cells = Cells::new(size);
        let states = [State::Wood, State::Open, State::Queued, State::Adhesive];
        let places: Vec<[usize; 3]> = (0..30).map(|i| [i % 3, i / 3 % 5, i / 15]).collect();
        for turn in 0..4 {
            for (i, place) in places.iter().enumerate() {
                let index = cells.index(*place);
                assert_eq!(cells.place(index), *place);
                cells.set(index, states[(i + turn) % 4]);
            }
            for (i, place) in places.iter().enumerate() {
                assert_eq!(cells.get(cells.index(*place)), states[(i + turn) % 4]);
            }
            let labels = [WOOD, VOID, VOID, ADHESIVE];
            let found = (0..2).flat_map(|page| cells.labels(page));
            assert!(found.eq((0..30).map(|i| labels[(i + turn) % 4])), "{turn}");
        }
    }

    #[test]
    fn neighbours_are_those_within_the_box() {
        let cells = Cells::new([3, 5, 2]);
        let around = |place| -> Vec<[usize; 3]> {
            let near = cells.neighbours(cells.index(place));
            near.map(|index| cells.place(index)).collect()
        };
        assert_eq!(around([0, 0, 0]), [[1, 0, 0], [0, 1, 0], [0, 0, 1]]);
        assert_eq!(around([2, 4, 1]), [[1, 4, 1], [2, 3, 1], [2, 4, 0]]);
        assert_eq!(around([1, 2, 0]).len(), 5);
    }
}
