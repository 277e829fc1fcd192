//! What pressures balance, and liquid that goes along with walls, but for little: no measure of the solver's tolerance.

use super::Operator;
use super::couplings::Couplings;
use super::lines::Friction;

impl Operator<'_> {
    /// Adds weight to the forces that stand, which stay empty without any; returns what it adds up to.
    pub(super) fn add_weight(&self, volume: &[f64], standing: &mut Vec<f64>) -> f64 {
        let gravity = self.scales.gravity;
        if gravity == [0.0; 3] {
            return 0.0;
        }
        standing.resize(volume.len(), 0.0);
        let mut all = 0.0;
        for (face, &(axis, _)) in self.dofs.faces.iter().enumerate() {
            let weight = volume[face] * gravity[usize::from(axis)];
            standing[face] += weight;
            all += weight.abs();
        }
        all
    }

    /// Part of what walls drag each face by that only makes thick liquid go along; empty where none is thick.
    pub(super) fn clinging(&self) -> Vec<f64> {
        if self.factor.is_empty() && self.viscosity.is_empty() {
            return Vec::new();
        }
        let part = |(face, &(axis, index)): (usize, &(u8, u32))| {
            let (index, stride) = (index as usize, self.lattice.window.stride(axis.into()));
            let cells = [index, index - stride];
            let links = self.walls.of(face).iter().map(|link| link.viscosity.into());
            let thick = self.mean_factor(cells) * links.fold(self.mean_law(cells), f64::max);
            1.0 - 1.0 / thick.max(1.0)
        };
        self.dofs.faces.iter().enumerate().map(part).collect()
    }

    /// Friction of what goes along with walls on each face: of lines that hold, and of liquid that clings to walls; empty without any.
    pub(super) fn holding(
        &self,
        clinging: &[f64],
        held: &[Friction],
        couplings: &Couplings,
        bodies: usize,
    ) -> Vec<f64> {
        let faces = &self.dofs.faces;
        if clinging.is_empty() && held.is_empty() {
            return Vec::new();
        }
        let mut holding = vec![0.0; faces.len()];
        for line in held {
            holding[line.face] += line.friction;
        }
        let along: [Vec<[f64; 3]>; 3] = std::array::from_fn(|axis| {
            let unit = std::array::from_fn(|a| f64::from(u8::from(a == axis)));
            vec![unit; bodies]
        });
        for (face, part) in clinging.iter().enumerate() {
            holding[face] += part * couplings.dragged(face, &along[usize::from(faces[face].0)]);
        }
        holding
    }
}
