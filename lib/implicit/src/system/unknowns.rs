//! The unknowns of a step: pressures of full pores, velocities of faces with liquid (docs/methods.md section 3.3).

use std::num::NonZeroU32;

use crate::geometry::Mesh;
use crate::liquid::TRACE;

/// Volume fraction from which on a pore counts as full: it has an unknown pressure, and fills up within the step. With 0.8
/// the force of a piston in a slit of three cells scatters by 4.0 % instead of 1.6 %; with 0.98 the pressure added by a
/// front's shape in a duct of six cells is off by that of 0.035 widths of flow instead of 0.017.
pub(crate) const FULL: f64 = 0.9;

/// Numbering of the unknowns of a step. Velocities are numbered along rows of cells, one component after the other:
/// neighbours are close in memory, and consecutive rows of the velocity block have the same column offsets, which the solver
/// packs.
pub(crate) struct Unknowns {
    /// Faces with an unknown velocity.
    pub(crate) faces: Vec<u32>,
    /// Pores with an unknown pressure.
    pub(crate) pores: Vec<u32>,
    /// Number of the velocity of each face plus one, so that the option takes four bytes.
    face_number: Vec<Option<NonZeroU32>>,
    /// Whether each pore has an unknown pressure.
    has_pressure: Vec<bool>,
}

impl Unknowns {
    /// Numbers the unknowns of pores filled to `fractions`; `torn` ones have no unknown pressure.
    pub(crate) fn new(mesh: &Mesh, fractions: &[f64], torn: &[bool]) -> Self {
        let full = |pore: usize| fractions[pore] >= FULL && !torn[pore];
        let mut unknowns = Self {
            faces: Vec::new(),
            pores: Vec::new(),
            face_number: vec![None; mesh.faces.len()],
            has_pressure: vec![false; mesh.pores.len()],
        };
        for face in by_rows(mesh) {
            let pores = mesh.faces[face].pores();
            let liquid = |pore: usize| fractions[pore] * mesh.volume(pore);
            let wet = || pores.iter().map(|&pore| 0.5 * liquid(pore)).sum::<f64>() > TRACE;
            if !(mesh.is_inner(face) && (pores.iter().any(|&pore| full(pore)) || wet())) {
                continue;
            }
            unknowns.faces.push(face as u32);
            unknowns.face_number[face] = NonZeroU32::new(unknowns.faces.len() as u32);
            for pore in pores.into_iter().filter(|&pore| full(pore)) {
                unknowns.has_pressure[pore] = true;
            }
        }
        unknowns.faces.shrink_to_fit();
        let pores = 0..mesh.pores.len() as u32;
        unknowns.pores = (pores.filter(|&pore| unknowns.has_pressure[pore as usize])).collect();
        unknowns
    }

    /// Whether the pressure of a pore is an unknown.
    pub(crate) fn has_pressure(&self, pore: usize) -> bool {
        self.has_pressure[pore]
    }

    /// Number of the velocity of a face; `None` if it is no unknown.
    pub(crate) fn face(&self, face: usize) -> Option<usize> {
        self.face_number[face].map(|number| number.get() as usize - 1)
    }
}

/// The faces of a mesh along rows of cells, one axis after the other.
fn by_rows(mesh: &Mesh) -> impl Iterator<Item = usize> {
    let cells: usize = mesh.size.iter().product();
    let row = mesh.size[0];
    (0..cells).step_by(row).flat_map(move |first| {
        (0..3).flat_map(move |axis| {
            (first..first + row).flat_map(move |cell| mesh.faces_of(cell, axis))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Region;

    /// In a column of six cells of which the first four are active, the cells up to the third have active neighbours only.
    #[test]
    fn liquid_at_the_end_of_the_active_cells_does_not_move() {
        let mesh = Mesh::column_of([0, 6], 0, 0, |size| {
            let mut region = Region::new(size, false);
            (0..4).for_each(|cell| region.add(cell));
            region
        });
        assert_eq!(
            [[0, 1, 2], [1, 2, 3]].map(|pores| mesh.is_cut(&pores)),
            [false, true]
        );
        let cut_rows = Mesh::column_from([0, 6], 0, 2);
        assert_eq!(
            [[0], [3]].map(|pores| cut_rows.is_cut(&pores)),
            [true, false]
        );
        let moving = Unknowns::new(&mesh, &[1.0; 4], &[false; 4]).faces;
        assert_eq!(moving, [0, 1, 2]);
    }
}
