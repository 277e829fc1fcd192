//! Which faces and cells are unknowns of a step, and their numbering.

use rayon::prelude::*;

use crate::lattice::Lattice;
use crate::solids::OPEN;

/// No unknown.
pub const NONE: u32 = u32::MAX;
/// Liquid volume of a face's control volume, in cells, above which it is an unknown.
const WET_FACE: f64 = 0.05;
/// Liquid fraction of a cell's open volume from which its pressure is an unknown.
pub const WET_CELL: f64 = 0.5;

/// Numbering of the unknowns along rows of cells, one velocity component after the other, so
/// that neighbours in space are near in memory and consecutive rows of the velocity block couple
/// to equal distances, which the solver packs.
#[derive(Clone, Debug, Default)]
pub struct Dofs {
    /// Number of the low face of each cell along x, y, z, or [`NONE`]. Images of a face
    /// beyond a periodic side have its number.
    pub face: [Vec<u32>; 3],
    /// Number of the pressure of each cell, or [`NONE`].
    pub cell: Vec<u32>,
    /// Axis and cell index of each face unknown.
    pub faces: Vec<(u8, u32)>,
    /// Cell index of each pressure unknown.
    pub cells: Vec<u32>,
}

/// Liquid in the cells and control volumes of a window.
#[derive(Clone, Debug)]
pub struct Liquid<'a> {
    /// Liquid fraction of the open part of each sub-cell, 0 to 1.
    pub phi: &'a [f32],
    /// Liquid volume of each cell, in cells.
    pub volume: Vec<f32>,
    /// Liquid fraction of the open part of each cell.
    pub fraction: Vec<f32>,
}

impl<'a> Liquid<'a> {
    /// Cell volumes and fractions from the sub-cells'.
    pub fn new(lattice: &Lattice, phi: &'a [f32]) -> Self {
        let window = &lattice.window;
        let (mut volume, mut fraction) = (vec![0.0; window.len()], vec![0.0; window.len()]);
        let row = window.cells[0];
        (volume.par_chunks_mut(row).zip(fraction.par_chunks_mut(row)))
            .enumerate()
            .for_each(|(r, (volume, fraction))| {
                let (j, k) = (r % window.cells[1], r / window.cells[1]);
                for i in 0..row {
                    let first = window.first_sub([i, j, k]);
                    let parts = [2, 2, window.parts(2)];
                    let (wet, open) = fill(lattice, phi, first, parts);
                    volume[i] = (wet / window.sub_per_cell() as f64) as f32;
                    fraction[i] = if open > 1e-6 {
                        (wet / open) as f32
                    } else {
                        0.0
                    };
                }
            });
        Self {
            phi,
            volume,
            fraction,
        }
    }
}

/// Sums of phi o and of o over a block of sub-cells.
pub(super) fn fill(lattice: &Lattice, phi: &[f32], first: usize, parts: [usize; 3]) -> (f64, f64) {
    let (mut wet, mut open) = (0.0, 0.0);
    for z in 0..parts[2] {
        for y in 0..parts[1] {
            let row = first + y * lattice.window.sub_stride(1) + z * lattice.window.sub_stride(2);
            let range = row..row + parts[0];
            for (&o, &phi) in lattice.open[range.clone()].iter().zip(&phi[range]) {
                open += f64::from(o);
                wet += f64::from(o) * f64::from(phi);
            }
        }
    }
    (wet, open)
}

/// Liquid volume and open volume, in cells, of the control volume of a face: half of each of
/// the two cells at it.
pub(super) fn face_fill(
    lattice: &Lattice,
    phi: &[f32],
    axis: usize,
    cell: [usize; 3],
) -> (f64, f64) {
    let window = &lattice.window;
    let first = window.first_sub(cell) - window.sub_stride(axis);
    let (wet, open) = fill(lattice, phi, first, [2, 2, window.parts(2)]);
    let whole = window.sub_per_cell() as f64;
    (wet / whole, open / whole)
}

impl Dofs {
    /// Numbers the unknowns of `liquid`.
    pub fn new(lattice: &Lattice, liquid: &Liquid) -> Self {
        let window = &lattice.window;
        let wet = |index: usize| {
            f64::from(liquid.fraction[index]) >= WET_CELL && liquid.volume[index] > 1e-6
        };
        let mine = |cell: [usize; 3]| window.inner(cell) && window.home(cell) == cell;
        let active = |axis: usize, cell: [usize; 3]| {
            let index = window.index(cell);
            let below = index - window.stride(axis);
            lattice.face(axis, index) == OPEN
                && (window.in_domain(cell) || window.in_domain(window.coordinates(below)))
                && (wet(index)
                    || wet(below)
                    || face_fill(lattice, liquid.phi, axis, cell).0 > WET_FACE)
        };
        let axes = window.domain.axes;
        // One bit per axis for an active low face, one for a wet cell; rows are independent.
        let mut flags = vec![0_u8; window.len()];
        flags
            .par_chunks_mut(window.cells[0])
            .enumerate()
            .for_each(|(r, row)| {
                let (j, k) = (r % window.cells[1], r / window.cells[1]);
                for (i, flag) in row.iter_mut().enumerate() {
                    let cell = [i, j, k];
                    if mine(cell) && !lonely(lattice, liquid, cell) {
                        for axis in (0..axes).filter(|&a| active(a, cell)) {
                            *flag |= 1 << axis;
                        }
                        if window.in_domain(cell) && wet(window.index(cell)) {
                            *flag |= 8;
                        }
                    }
                }
            });
        let mut dofs = Self {
            face: std::array::from_fn(|a| {
                if a < axes {
                    vec![NONE; flags.len()]
                } else {
                    vec![]
                }
            }),
            cell: vec![NONE; flags.len()],
            ..Self::default()
        };
        for (r, row) in flags.chunks(window.cells[0]).enumerate() {
            for axis in 0..axes {
                for i in (0..row.len()).filter(|&i| row[i] >> axis & 1 == 1) {
                    let index = r * window.cells[0] + i;
                    dofs.face[axis][index] = dofs.faces.len() as u32;
                    dofs.faces.push((axis as u8, index as u32));
                }
            }
        }
        dofs.mirror_faces(lattice);
        for (index, _) in flags.iter().enumerate().filter(|f| *f.1 & 8 != 0) {
            let owns = (0..axes).any(|a| {
                let face = &dofs.face[a];
                face[index] != NONE || face[index + window.stride(a)] != NONE
            });
            if owns {
                dofs.cell[index] = dofs.cells.len() as u32;
                dofs.cells.push(index as u32);
            }
        }
        dofs
    }

    /// Gives images beyond periodic sides the number of their face.
    fn mirror_faces(&mut self, lattice: &Lattice) {
        let window = &lattice.window;
        if !(0..window.domain.axes).any(|a| window.domain.periodic(a)) {
            return;
        }
        for index in 0..window.len() {
            let cell = window.coordinates(index);
            let home = window.home(cell);
            if home != cell {
                for face in &mut self.face[..window.domain.axes] {
                    face[index] = face[window.index(home)];
                }
            }
        }
    }
}

/// Whether no liquid is in or next to a cell, so that it can hold no unknown.
fn lonely(lattice: &Lattice, liquid: &Liquid, cell: [usize; 3]) -> bool {
    let window = &lattice.window;
    let index = window.index(cell);
    liquid.volume[index] == 0.0
        && (0..window.domain.axes).all(|a| liquid.volume[index - window.stride(a)] == 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solids::Solids;
    use crate::window::{Domain, Window};
    use physics::Boundary;

    /// Liquid up to x = 3 and a cell beyond it that is filled in part.
    #[test]
    fn half_a_cell_has_a_pressure_and_a_twentieth_of_a_face_a_velocity() {
        let domain = Domain {
            cells: [8, 4, 1],
            boundary: [Boundary::Symmetry; 3],
            axes: 2,
        };
        let window = Window::around(domain, [0; 3], [8, 4, 1]);
        let lattice = Lattice::new(Solids::new(vec![], domain, [0.0; 3], 1.0), window);
        let at = |x: f64| window.local([x, 1.5, 0.5]).map(|x| x as usize);
        let unknowns = |filled: f32| {
            let mut phi = vec![0.0; window.sub_len()];
            for index in 0..window.len() {
                let x = window.coordinates(index)[0];
                let first = window.first_sub(window.coordinates(index));
                for sub in [0, 1].map(|y| first + y * window.sub_stride(1)) {
                    let filled = [1.0, filled, 0.0]
                        [usize::from(x >= at(3.5)[0]) + usize::from(x > at(3.5)[0])];
                    phi[sub..sub + 2].fill(filled);
                }
            }
            let dofs = Dofs::new(&lattice, &Liquid::new(&lattice, &phi));
            let cell = dofs.cell[window.index(at(3.5))];
            let beyond = dofs.face[0][window.index(at(4.5))];
            (cell != NONE, beyond != NONE)
        };
        assert_eq!(unknowns(0.51), (true, true));
        assert_eq!(unknowns(0.49), (false, true));
        assert_eq!(unknowns(0.11), (false, true));
        assert_eq!(unknowns(0.09), (false, false));
    }
}
