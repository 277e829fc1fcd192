//! Pore throats: perimeter over area of the cross-section that a meniscus spans, N of docs/methods.md section 3.12.

use super::chords::{Chords, LONGEST_CHORD, VoxelAddress};
use super::lattice::{Lattice, OPEN};
use super::mesh::{Mesh, others};
use super::rows::RowKind;

/// Largest ratio of the chord lengths of neighbouring voxels within one throat. In a disc the ratio is smaller; where a lumen
/// opens into the bond line it is larger.
const MAX_WIDENING: f64 = 3.0;

/// Perimeter over area of the throat at a pore, 1/cells: the sum of 2/d over its two smallest widths d that liquid spans, so
/// 4/d in a tube and 2/d in a slit. It is 0 for walls that are too far apart and for a film on one wall. `wet` says which
/// pores are full.
pub(crate) fn perimeter_over_area(
    lattice: &Lattice,
    chords: &Chords,
    mesh: &Mesh,
    pore: usize,
    wet: &impl Fn(usize) -> bool,
) -> f64 {
    let view = ThroatView {
        lattice,
        chords,
        mesh,
        gap: mesh.rows().height * mesh.k as f64,
    };
    let count = f64::from(mesh.pores[pore].voxels.count_ones());
    let each = mesh
        .voxels(pore)
        .map(|voxel| view.at_voxel(mesh.cell(pore), voxel, wet));
    mesh.k as f64 * each.sum::<f64>() / count
}

/// Voxels and chord lengths at the current height of the gap, in voxels.
struct ThroatView<'a> {
    lattice: &'a Lattice,
    chords: &'a Chords,
    mesh: &'a Mesh,
    gap: f64,
}

/// A voxel: its cell and its position in the cell.
type Voxel = (usize, [usize; 3]);

impl ThroatView<'_> {
    /// Perimeter over area at one voxel, 1/voxels. In plane strain the throat has no walls along z. A width counts as one
    /// voxel at least: images resolve no less, and the capillary pressure of a closing gap would grow without limit.
    fn at_voxel(&self, cell: usize, voxel: [usize; 3], wet: &impl Fn(usize) -> bool) -> f64 {
        let indices = self.mesh.cell_indices(cell);
        let Some(address) = self.mesh.lattice_address(self.lattice, indices, voxel) else {
            return 0.0;
        };
        let axes = if self.lattice.flat { 2 } else { 3 };
        let far = LONGEST_CHORD;
        let lengths = [0, 1, 2].map(|axis| match axis < axes {
            true => self.chords.length(self.lattice, address, axis, self.gap),
            false => far,
        });
        let mut widths: Vec<(f64, usize)> = (0..axes)
            .map(|axis| match self.lattice.flat {
                true => (lengths[axis], axis),
                false => (self.throat_width(address, axis, &lengths), axis),
            })
            .filter(|width| width.0 < far)
            .collect();
        widths.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        (widths.iter())
            .filter(|&&(width, axis)| self.is_spanned((cell, voxel), axis, axes, width, wet))
            .take(axes - 1)
            .map(|width| 2.0 / width.0.max(1.0))
            .sum()
    }

    /// Whether liquid spans the chord along an axis through a voxel: both ends and the middle are wet, here or at a parallel
    /// chord that is no farther off along another axis than the chord is long. No meniscus is deeper than that.
    fn is_spanned(
        &self,
        voxel: Voxel,
        axis: usize,
        axes: usize,
        length: f64,
        wet: &impl Fn(usize) -> bool,
    ) -> bool {
        let step = |(cell, voxel): Voxel, axis: usize, up: bool| {
            let (cell, voxel) = self.mesh.next_voxel(cell, voxel, axis, up)?;
            self.mesh.pore_at(cell, voxel).map(|_| (cell, voxel))
        };
        let line = |up: bool| {
            let most = length as usize;
            let beyond = std::iter::successors(step(voxel, axis, up), |&at| step(at, axis, up));
            beyond.take(most).collect::<Vec<Voxel>>()
        };
        let (below, above) = (line(false), line(true));
        let chord: Vec<Voxel> = (below.into_iter().rev())
            .chain([voxel])
            .chain(above)
            .collect();
        let last = chord.len() - 1;
        let voxels = [0, last / 2, last.div_ceil(2), last].map(|at| chord[at]);
        let is_wet = |&(cell, voxel): &Voxel| self.mesh.pore_at(cell, voxel).is_some_and(wet);
        (0..axes).filter(|&a| a != axis).any(|a| {
            [false, true].into_iter().any(|up| {
                let parallel =
                    std::iter::successors(Some(voxels), |at| match at.map(|at| step(at, a, up)) {
                        [Some(a), Some(b), Some(c), Some(d)] => Some([a, b, c, d]),
                        _ => None,
                    });
                (parallel.take(length as usize + 1)).any(|at| at.iter().all(is_wet))
            })
        })
    }

    /// Width of the throat along an axis: the longest parallel chord whose half length is at least its distance from the
    /// voxel. In a round section that is the diameter. Chords displaced along the throat's own axis, the longest chord, do
    /// not count.
    fn throat_width(&self, address: VoxelAddress, axis: usize, lengths: &[f64; 3]) -> f64 {
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        let mut widest = lengths[axis];
        for beside in others(axis).into_iter().filter(|&b| lengths[b] < longest) {
            for up in [false, true] {
                let (mut at, mut previous) = (address, lengths[axis]);
                let mut offset = 0.5 * self.thickness(at, beside);
                while let Some(next) = self.next_address(at, beside, up) {
                    let length = self.chords.length(self.lattice, next, axis, self.gap);
                    if length > MAX_WIDENING * previous {
                        break;
                    }
                    if offset <= 0.5 * length {
                        widest = widest.max(length);
                    }
                    offset += self.thickness(next, beside);
                    (at, previous) = (next, length);
                }
            }
        }
        widest
    }

    /// Thickness of an addressed voxel along an axis, voxels: at each x and z the gap is one address.
    fn thickness(&self, address: VoxelAddress, axis: usize) -> f64 {
        match (address.part, axis) {
            (RowKind::Gap, 1) => self.gap,
            _ => 1.0,
        }
    }

    /// The next open address along an axis.
    fn next_address(&self, address: VoxelAddress, axis: usize, up: bool) -> Option<VoxelAddress> {
        let [nx, nz] = self.lattice.layer_size();
        let shifted = |at: usize| {
            let (i, n, stride) = match axis {
                0 => (at % nx, nx, 1),
                _ => (at / nx, nz, nx),
            };
            let periodic = self.lattice.boundary[axis] == physics::Boundary::Periodic;
            match (up, i) {
                (true, i) if i + 1 < n => Some(at + stride),
                (false, i) if i > 0 => Some(at - stride),
                (true, _) if periodic => Some(at - (n - 1) * stride),
                (false, _) if periodic => Some(at + (n - 1) * stride),
                _ => None,
            }
        };
        let VoxelAddress { part, layer, at } = address;
        let away = up == (part == RowKind::Above);
        let (part, layer, at) = match part {
            _ if axis != 1 => (part, layer, shifted(at)?),
            RowKind::Gap if up => (RowKind::Above, 0, at),
            RowKind::Gap => (RowKind::Below, 0, at),
            _ if away => (part, layer + 1, at),
            _ if layer > 0 => (part, layer - 1, at),
            _ if self.lattice.moving.is_some() => (RowKind::Gap, 0, at),
            _ => return None,
        };
        let code = self.lattice.layers[part as usize].get(layer)?[at];
        (code == OPEN).then_some(VoxelAddress { part, layer, at })
    }
}
