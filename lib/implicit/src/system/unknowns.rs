//! Which pores have a pressure and which faces a velocity.

use crate::geometry::Mesh;

/// Volume fraction from which on a pore is full and has a pressure of its own, which fills what it lacks within the step.
pub(crate) const FULL: f64 = 0.9;
/// Mean liquid volume of two pores, cells, above which the face between them has a velocity without a full pore beside it.
const WET: f64 = 0.005;
/// No unknown.
const ABSENT: u32 = u32::MAX;

/// Numbers of the unknowns of a step.
pub(crate) struct Unknowns {
    /// Faces with a velocity.
    pub(crate) faces: Vec<u32>,
    /// Pores with a pressure.
    pub(crate) pores: Vec<u32>,
    face_number: Vec<u32>,
    pore_number: Vec<u32>,
}

impl Unknowns {
    /// Those of pores filled to `fractions`.
    pub(crate) fn new(mesh: &Mesh, fractions: &[f64]) -> Self {
        let full = |pore: u32| fractions[pore as usize] >= FULL;
        let mut unknowns = Self {
            faces: Vec::new(),
            pores: Vec::new(),
            face_number: vec![ABSENT; mesh.faces.len()],
            pore_number: vec![ABSENT; mesh.pores.len()],
        };
        for (index, face) in mesh.faces.iter().enumerate() {
            let ends = [face.low, face.high];
            let liquid = |pore: u32| fractions[pore as usize] * mesh.volume(pore as usize);
            let wet = || ends.iter().map(|&pore| 0.5 * liquid(pore)).sum::<f64>() > WET;
            if !(ends.iter().any(|&pore| full(pore)) || wet()) {
                continue;
            }
            unknowns.face_number[index] = unknowns.faces.len() as u32;
            unknowns.faces.push(index as u32);
            for pore in ends.into_iter().filter(|&pore| full(pore)) {
                unknowns.pore_number[pore as usize] = 0;
            }
        }
        for (pore, number) in unknowns.pore_number.iter_mut().enumerate() {
            if *number != ABSENT {
                *number = unknowns.pores.len() as u32;
                unknowns.pores.push(pore as u32);
            }
        }
        unknowns
    }

    /// Number of the velocity of a face.
    pub(crate) fn face(&self, face: usize) -> Option<usize> {
        number(&self.face_number, face)
    }

    /// Number of the pressure of a pore.
    pub(crate) fn pore(&self, pore: usize) -> Option<usize> {
        number(&self.pore_number, pore)
    }
}

fn number(numbers: &[u32], index: usize) -> Option<usize> {
    (numbers[index] != ABSENT).then_some(numbers[index] as usize)
}
