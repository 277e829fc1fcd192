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
}

impl Unknowns {
    /// Those of pores filled to `fractions`.
    pub(crate) fn new(mesh: &Mesh, fractions: &[f64]) -> Self {
        let full = |pore: u32| fractions[pore as usize] >= FULL;
        let mut unknowns = Self {
            faces: Vec::new(),
            pores: Vec::new(),
            face_number: vec![ABSENT; mesh.faces.len()],
        };
        let mut bounded = vec![false; mesh.pores.len()];
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
                bounded[pore as usize] = true;
            }
        }
        let pores = (0..mesh.pores.len() as u32).filter(|&pore| bounded[pore as usize]);
        unknowns.pores.extend(pores);
        unknowns
    }

    /// Number of the velocity of a face.
    pub(crate) fn face(&self, face: usize) -> Option<usize> {
        let number = self.face_number[face];
        (number != ABSENT).then_some(number as usize)
    }
}
