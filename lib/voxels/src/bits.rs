/// A set of voxels: one bit per voxel, x fastest; each row (fixed y and z) starts at a
/// 64-bit word, the unused high bits of a row's last word are zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BitVolume {
    dims: [usize; 3],
    words_per_row: usize,
    words: Vec<u64>,
}

impl BitVolume {
    /// The empty set in a volume of `[nx, ny, nz]` voxels; none if it has more voxels than
    /// can be counted.
    pub fn empty(dims: [usize; 3]) -> Option<Self> {
        dims[0].checked_mul(dims[1])?.checked_mul(dims[2])?;
        let words_per_row = dims[0].div_ceil(64);
        let words = words_per_row.checked_mul(dims[1])?.checked_mul(dims[2])?;
        words.checked_mul(8)?;
        Some(Self {
            dims,
            words_per_row,
            words: vec![0; words],
        })
    }

    /// Numbers of voxels along x, y, z.
    pub fn dims(&self) -> [usize; 3] {
        self.dims
    }

    /// Words of a row.
    pub fn words_per_row(&self) -> usize {
        self.words_per_row
    }

    /// The words: row (y, z) is at `(z * ny + y) * words_per_row`, voxel x of it is bit
    /// `x % 64` of its word `x / 64`.
    pub fn words(&self) -> &[u64] {
        &self.words
    }

    /// The words, for a consumer that keeps them.
    pub fn into_words(self) -> Vec<u64> {
        self.words
    }

    pub(crate) fn words_mut(&mut self) -> &mut [u64] {
        &mut self.words
    }

    /// Whether voxel (x, y, z) is in the set; outside the volume none is.
    pub fn contains(&self, x: usize, y: usize, z: usize) -> bool {
        let [nx, ny, nz] = self.dims;
        x < nx
            && y < ny
            && z < nz
            && self.words[(z * ny + y) * self.words_per_row + x / 64] >> (x % 64) & 1 == 1
    }

    /// Number of voxels in the set.
    pub fn count(&self) -> u64 {
        self.words.iter().map(|w| u64::from(w.count_ones())).sum()
    }
}
