//! Which faces and cells are unknowns of a step, and their numbering.

use rayon::prelude::*;

use crate::geometry::{Lattice, OPEN};
use crate::liquid::Volumes;

/// No unknown.
pub(crate) const NONE: u32 = u32::MAX;
/// Liquid volume of a face's control volume, in cells, above which it is an unknown.
const WET_FACE: f64 = 0.05;
/// Liquid fraction of a cell's open volume from which its pressure is an unknown.
pub(crate) const WET_CELL: f64 = 0.5;

/// Numbering of the unknowns along rows of cells, one velocity component after the other, so
/// that neighbours in space are near in memory and consecutive rows of the velocity block couple
/// to equal distances, which the solver packs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Dofs {
    /// Number of the low face of each cell along x, y, z, or [`NONE`]. Images of a face
    /// beyond a periodic side have its number.
    pub(crate) face: [Vec<u32>; 3],
    /// Number of the pressure of each cell, or [`NONE`].
    pub(crate) cell: Vec<u32>,
    /// Axis and cell index of each face unknown.
    pub(crate) faces: Vec<(u8, u32)>,
    /// Cell index of each pressure unknown.
    pub(crate) cells: Vec<u32>,
}

impl Dofs {
    /// Numbers the unknowns where `volumes` has liquid.
    pub(crate) fn new(lattice: &Lattice, volumes: &Volumes) -> Self {
        let window = &lattice.window;
        let axes = window.domain.axes;
        let flags = flags(lattice, volumes);
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

/// Of each cell one bit per axis for a low face that is an unknown, and 8 for a pressure that may be.
fn flags(lattice: &Lattice, volumes: &Volumes) -> Vec<u8> {
    let window = &lattice.window;
    let wet =
        |index: usize| f64::from(volumes.fraction[index]) >= WET_CELL && volumes.cell[index] > 1e-6;
    let mine = |cell: [usize; 3]| window.inner(cell) && window.home(cell) == cell;
    let active = |axis: usize, cell: [usize; 3]| {
        let index = window.index(cell);
        let below = index - window.stride(axis);
        lattice.face(axis, index) == OPEN
            && (window.in_domain(cell) || window.in_domain(window.coordinates(below)))
            && (wet(index) || wet(below) || volumes.of_face(lattice, axis, cell).0 > WET_FACE)
    };
    let axes = window.domain.axes;
    // Rows are independent.
    let mut flags = vec![0_u8; window.len()];
    flags
        .par_chunks_mut(window.cells[0])
        .enumerate()
        .for_each(|(r, row)| {
            let (j, k) = (r % window.cells[1], r / window.cells[1]);
            for (i, flag) in row.iter_mut().enumerate() {
                let cell = [i, j, k];
                if mine(cell) && !lonely(lattice, volumes, cell) {
                    for axis in (0..axes).filter(|&a| active(a, cell)) {
                        *flag |= 1 << axis;
                    }
                    if window.in_domain(cell) && wet(window.index(cell)) {
                        *flag |= 8;
                    }
                }
            }
        });
    flags
}

/// Whether no liquid is in or next to a cell, so that it can hold no unknown.
fn lonely(lattice: &Lattice, volumes: &Volumes, cell: [usize; 3]) -> bool {
    let window = &lattice.window;
    let index = window.index(cell);
    volumes.cell[index] == 0.0
        && (0..window.domain.axes).all(|a| volumes.cell[index - window.stride(a)] == 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Domain, Solids, Window};
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
            let dofs = Dofs::new(&lattice, &Volumes::new(&lattice, &phi));
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
