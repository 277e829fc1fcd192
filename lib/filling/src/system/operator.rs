//! Geometry, liquid and unknowns of a step together.

use super::air::Pockets;
use super::dofs::Dofs;
use super::walls::Walls;
use super::{Pull, Scales};
use crate::geometry::Lattice;
use crate::liquid::Volumes;

/// Geometry, liquid and unknowns of a step, from which its system is assembled.
pub(crate) struct Operator<'a> {
    /// Geometry.
    pub(crate) lattice: &'a Lattice,
    /// Liquid volumes.
    pub(crate) volumes: &'a Volumes<'a>,
    /// Viscosity of each cell over eta_0; empty when it is eta_0 everywhere.
    pub(super) viscosity: Vec<f32>,
    /// The same around the edges in each plane, by a law of their own rates; empty where it is the mean of
    /// the cells there.
    pub(super) edge_viscosity: [Vec<f32>; 3],
    /// What else multiplies the viscosity of each cell, at any shear rate; empty where nothing does.
    pub(super) factor: &'a [f32],
    /// Unknowns.
    pub(crate) dofs: Dofs,
    /// Walls at the face unknowns.
    pub(crate) walls: Walls,
    /// Pockets of air, where they have pressures of their own.
    pub(crate) pockets: Option<&'a Pockets>,
    /// What menisci pull, where they do.
    pub(crate) pull: Pull,
    pub(super) scales: Scales,
}

impl<'a> Operator<'a> {
    /// The operator for the liquid of `volumes` in `lattice`.
    // Not inlined: make leave-out counts what it takes by its name.
    #[inline(never)]
    pub(crate) fn new(lattice: &'a Lattice, volumes: &'a Volumes<'a>, scales: Scales) -> Self {
        let dofs = Dofs::new(lattice, volumes);
        let friction = scales.influence_length.is_finite();
        let walls = Walls::new(lattice, volumes, &dofs, scales.width, friction);
        Self {
            lattice,
            volumes,
            viscosity: Vec::new(),
            edge_viscosity: Default::default(),
            factor: &[],
            dofs,
            walls,
            pockets: None,
            pull: Pull::default(),
            scales,
        }
    }

    #[inline]
    pub(super) fn eta(&self, cell: usize) -> f64 {
        let law = self.viscosity.get(cell).map_or(1.0, |&eta| f64::from(eta));
        law * self.factor(cell)
    }

    /// What multiplies the viscosity by the law of the shear rate in a cell.
    #[inline]
    pub(super) fn factor(&self, cell: usize) -> f64 {
        (self.factor.get(cell)).map_or(1.0, |&factor| f64::from(factor))
    }

    /// The same around a place, by the liquid in the cells that meet there.
    #[inline]
    pub(super) fn mean_factor<const N: usize>(&self, cells: [usize; N]) -> f64 {
        match self.factor.is_empty() {
            true => 1.0,
            false => self.mean(cells, |cell| self.factor(cell)),
        }
    }

    /// The same between cells that liquid shears against each other, the mean of its inverse: a film that has dried in the corner of
    /// a cell does not make the others as thick.
    pub(super) fn factor_between<const N: usize>(&self, cells: [usize; N]) -> f64 {
        match self.factor.is_empty() {
            true => 1.0,
            false => 1.0 / self.mean(cells, |cell| 1.0 / self.factor(cell)),
        }
    }

    /// Puts a factor on the viscosity of each cell.
    pub(crate) fn thicken(&mut self, factor: &'a [f32]) {
        self.factor = factor;
    }

    /// Viscosity by the law of the shear rate around a place, by the liquid in the cells that meet there.
    pub(super) fn mean_law<const N: usize>(&self, cells: [usize; N]) -> f64 {
        match self.viscosity.is_empty() {
            true => 1.0,
            false => self.mean(cells, |cell| f64::from(self.viscosity[cell])),
        }
    }

    fn mean<const N: usize>(&self, cells: [usize; N], value: impl Fn(usize) -> f64) -> f64 {
        let (mut sum, mut volume) = (0.0, 0.0);
        for cell in cells {
            let v = f64::from(self.volumes.cell[cell]);
            sum += v * value(cell);
            volume += v;
        }
        if volume > 0.0 { sum / volume } else { 1.0 }
    }
}
