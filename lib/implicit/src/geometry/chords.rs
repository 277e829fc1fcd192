//! Chord lengths: the run of open voxels along x, y or z through a voxel, which is the channel width H of docs/methods.md
//! section 3.5.

use physics::Boundary;

use super::Lattice;
use super::lattice::OPEN;

/// Cap on chord lengths, voxels, which also stands for infinity: walls farther apart do not affect each other's friction.
pub(super) const LONGEST_CHORD: u16 = 1000;

/// A run of open voxels along y that starts at the gap, in the part below or above: its length, and whether it reaches the side
/// of the domain.
#[derive(Clone, Copy, Default)]
struct Column {
    voxels: u32,
    reaches_side: bool,
}

/// Chord lengths of all voxels. Those that involve the gap are tabulated; others are counted on request.
pub(crate) struct Chords {
    /// Chord lengths along x and along z in the gap.
    gap: [Vec<u16>; 2],
    /// Runs of open voxels that continue the gap below and above.
    columns: [Vec<Column>; 2],
}

/// Address of a voxel: part of the lattice, layer counted from the gap, index in the layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum VoxelAddress {
    Below(usize, usize),
    Gap(usize),
    Above(usize, usize),
}

impl Chords {
    pub(crate) fn new(lattice: &Lattice) -> Self {
        let [nx, nz] = lattice.layer_size();
        let in_gap = |axis: usize| {
            let mut lengths: Vec<u16> = vec![0; nx * nz];
            let stride = [1, nx][axis];
            for at in (0..nx * nz).filter(|&at| lattice.gap[at] == OPEN) {
                let i = [at % nx, at / nx][axis];
                lengths[at] = match i > 0 && lattice.gap[at - stride] == OPEN {
                    true => lengths[at - stride],
                    false => chord_in_layer(&lattice.gap, at, axis, lattice),
                };
            }
            lengths
        };
        let columns = |layers: &[Vec<u8>]| {
            let column = |at: usize| {
                let voxels = layers.iter().take_while(|layer| layer[at] == OPEN).count();
                Column {
                    voxels: voxels as u32,
                    reaches_side: voxels == layers.len(),
                }
            };
            (0..nx * nz).map(column).collect()
        };
        Self {
            gap: [0, 1].map(in_gap),
            columns: [columns(&lattice.below), columns(&lattice.above)],
        }
    }

    /// Chord length along an axis through an open voxel, voxels; the gap is `gap` voxels high.
    pub(crate) fn length(
        &self,
        lattice: &Lattice,
        address: VoxelAddress,
        axis: usize,
        gap: f64,
    ) -> f64 {
        let (part, layer, at) = match address {
            VoxelAddress::Gap(at) if axis == 1 => return self.length_through_gap(lattice, at, gap),
            VoxelAddress::Gap(at) => return f64::from(self.gap[axis / 2][at]),
            VoxelAddress::Below(layer, at) => (&lattice.below, layer, at),
            VoxelAddress::Above(layer, at) => (&lattice.above, layer, at),
        };
        if axis != 1 {
            return f64::from(chord_in_layer(&part[layer], at, axis / 2, lattice));
        }
        let (n, open) = (part.len(), |i: usize| part[i][at] == OPEN);
        if lattice.moving.is_none() {
            return f64::from(chord_length(n, lattice.boundary[1], open, layer));
        }
        let [from, to] = open_run(n, &open, layer);
        match from {
            0 => self.length_through_gap(lattice, at, gap),
            _ => bounded_length(lattice, (to - from) as f64, usize::from(to == n)),
        }
    }

    /// Whether the chord along y through a voxel goes through the gap.
    pub(crate) fn through_gap(&self, lattice: &Lattice, address: VoxelAddress) -> bool {
        let (column, layer) = match address {
            VoxelAddress::Gap(_) => return true,
            _ if lattice.moving.is_none() => return false,
            VoxelAddress::Below(layer, at) => (&self.columns[0][at], layer),
            VoxelAddress::Above(layer, at) => (&self.columns[1][at], layer),
        };
        layer < column.voxels as usize
    }

    /// Chord length along y through the gap at index `at` of the layers.
    fn length_through_gap(&self, lattice: &Lattice, at: usize, gap: f64) -> f64 {
        let [low, high] = [0, 1].map(|part| self.columns[part][at]);
        let voxels = f64::from(low.voxels) + gap + f64::from(high.voxels);
        bounded_length(
            lattice,
            voxels,
            usize::from(low.reaches_side) + usize::from(high.reaches_side),
        )
    }
}

/// Chord length of a run along y that has `at_sides` ends at sides of the domain: doubled by a mirror, else unbounded.
fn bounded_length(lattice: &Lattice, voxels: f64, at_sides: usize) -> f64 {
    match (at_sides, lattice.boundary[1]) {
        (0, _) => voxels,
        (1, Boundary::Symmetry) => 2.0 * voxels,
        _ => f64::from(LONGEST_CHORD),
    }
    .min(f64::from(LONGEST_CHORD))
}

/// Chord length along x (axis 0) or z (axis 1) through an open voxel of a layer.
fn chord_in_layer(layer: &[u8], at: usize, axis: usize, lattice: &Lattice) -> u16 {
    let size = lattice.layer_size();
    let (stride, i) = ([1, size[0]][axis], [at % size[0], at / size[0]][axis]);
    let start = at - i * stride;
    let open = |i: usize| layer[start + i * stride] == OPEN;
    chord_length(size[axis], lattice.boundary[2 * axis], open, i)
}

/// The run of open voxels around index `i` of a line of `n`, as start and end.
fn open_run(n: usize, open: &impl Fn(usize) -> bool, i: usize) -> [usize; 2] {
    let from = (0..i).rev().find(|&i| !open(i)).map_or(0, |wall| wall + 1);
    let to = (i..n).find(|&i| !open(i)).unwrap_or(n);
    [from, to]
}

/// Chord length through voxel `i` of a line of `n`: doubled at a mirror, joined across periodic sides.
fn chord_length(n: usize, boundary: Boundary, open: impl Fn(usize) -> bool, i: usize) -> u16 {
    let [from, to] = open_run(n, &open, i);
    let (first, last, length) = (from == 0, to == n, to - from);
    let length = match boundary {
        _ if !first && !last => length,
        Boundary::Symmetry if first != last => 2 * length,
        Boundary::Periodic if first && !last => length + (n - open_run(n, &open, n)[0]),
        Boundary::Periodic if last && !first => length + open_run(n, &open, 0)[1],
        _ => usize::from(LONGEST_CHORD),
    };
    length.min(usize::from(LONGEST_CHORD)) as u16
}
