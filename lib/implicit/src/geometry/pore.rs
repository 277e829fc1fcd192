//! Pores and faces: the control volumes and the faces that carry the staggered velocities.

/// A control volume: a connected set of open voxels of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Pore {
    pub(crate) cell: u32,
    /// Row of the grid.
    pub(crate) row: u32,
    /// Bit mask of its voxels, x fastest.
    pub(crate) voxels: u8,
}

/// The open voxel faces between two pores of neighbouring cells, with one velocity for all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Face {
    pub(crate) low: u32,
    pub(crate) high: u32,
    /// Bit mask of the open voxel faces, the lower of the two tangential axes fastest.
    pub(crate) open: u8,
    pub(crate) axis: u8,
}

impl Face {
    /// The pores on the low and the high side.
    pub(crate) fn pores(&self) -> [usize; 2] {
        [self.low as usize, self.high as usize]
    }
}

/// A neighbour of a pore and the face towards it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neighbour {
    pub(crate) face: usize,
    pub(crate) axis: usize,
    /// Whether the face is on the pore's high side.
    pub(crate) up: bool,
    /// The neighbouring pore.
    pub(crate) pore: usize,
}

impl Neighbour {
    /// Sign of a face velocity that leaves the pore.
    pub(crate) fn sign(self) -> f64 {
        if self.up { 1.0 } else { -1.0 }
    }
}
