//! The saddle-point system and its checks.

use crate::SolveError;
use crate::csr::Csr;
use crate::vector::norm;
use crate::velocity_block::VelocityBlock;

/// The saddle-point system `[A, -G^T; -G, -C] [u; p] = [b; -g]` and the data of its preconditioner.
///
/// All values are scaled alike, momentum rows by `1/eta_0` with lengths in cells and the pressure
/// by `h/eta_0`, so that `A` and `G` have entries of order one.
#[derive(Clone, Copy)]
pub struct SaddleSystem<'a> {
    /// Velocity block, faces x faces: mass, viscosity and wall friction. Symmetric positive
    /// definite.
    pub a: &'a VelocityBlock,
    /// Flux operator, cells x faces.
    pub g: &'a Csr<f64>,
    /// Number of the last rows of `g` that are pockets of gas, not cells: one pressure and any number of faces.
    pub pockets: usize,
    /// Compressibility of every cell, not negative.
    pub c: &'a [f64],
    /// `D_B` of every face, positive: liquid volume times
    /// `rho/dt + 12 eta/h^2 (1/H_1^2 + 1/H_2^2)` with the widths `H` from wall to wall. Walls
    /// that slip count less, frictionless ones not at all: with their widths included the
    /// iterations double.
    pub friction: &'a [f64],
    /// Momentum right-hand side `b`, one per face.
    pub b: &'a [f64],
    /// Standing forces: the part of `b` due to weight, air and menisci, which pressures of the liquid nearly balance; empty if
    /// there are none. The tolerance is not relative to them but to the forces `A u` of the resulting flow.
    pub standing: &'a [f64],
    /// Part of `standing` with which walls only drag thick liquid along, which is no force of the flow either; empty if there
    /// is none.
    pub clinging: &'a [f64],
    /// Least velocity that matters at faces to air: errors of slower flow do not count there, and a millionth of it counts as
    /// rest anywhere.
    pub slow: f64,
    /// Volume displaced by walls, one per cell; `G u + C p = g` is this and `carried`.
    pub volume_source: &'a [f64],
    /// Volume carried over from the step before by compression, `C p` of then, one per cell. Most of it causes no flow, so the
    /// tolerance is not relative to it.
    pub carried: &'a [f64],
}

/// Least scale of the tolerance, as a fraction of the whole right-hand side, for almost no motion. With the whole of it, the
/// pressures on the two sides of a press differ by 2 % as its adhesive sets.
const LEAST_SCALE: f64 = 1e-3;

impl SaddleSystem<'_> {
    /// Number of rows of the flux operator that are cells.
    pub(crate) fn cells(&self) -> usize {
        self.g.n_rows().saturating_sub(self.pockets)
    }

    /// `[b; -g]`.
    pub(crate) fn right_hand_side(&self) -> Vec<f64> {
        let sources =
            (self.volume_source.iter().zip(self.carried)).map(|(moved, kept)| -(moved + kept));
        self.b.iter().copied().chain(sources).collect()
    }

    /// The scale of the tolerance: the norm of what moves the liquid, i.e. of the momenta `b` and the displaced volumes `moved`;
    /// at least the fraction [`LEAST_SCALE`] of the whole right-hand side.
    pub(crate) fn motion_scale(&self, b: &[f64], moved: &[f64]) -> f64 {
        let motion = self.norm_of_volumes(moved).hypot(match self.standing {
            [] => norm(b),
            standing => norm_of_difference(b, standing),
        });
        motion.max(LEAST_SCALE * motion.hypot(norm(self.carried)))
    }

    /// Norm of volumes, one per cell and pocket. The volume of a pocket counts as if shared equally by the faces of its front: as
    /// one value, that of a wide front would outweigh all else.
    fn norm_of_volumes(&self, volumes: &[f64]) -> f64 {
        let (cells, pockets) = volumes.split_at(self.cells());
        let shared =
            |(volume, row): (&f64, usize)| volume.powi(2) / self.g.row(row).0.len().max(1) as f64;
        let shared: f64 = pockets.iter().zip(self.cells()..).map(shared).sum();
        norm(cells).hypot(shared.sqrt())
    }

    /// Norm of the forces of slow flow through the faces to air; the areas of inner faces cancel.
    pub(crate) fn slow_forces(&self) -> f64 {
        let mut forces = vec![0.0; self.a.n_rows()];
        for cell in 0..self.cells() {
            let (faces, areas) = self.g.row(cell);
            for (&face, area) in faces.iter().zip(areas) {
                forces[face as usize] += area;
            }
        }
        for (force, friction) in forces.iter_mut().zip(self.friction) {
            // The friction is capped at that of a cell of liquid with viscosity `eta_0`, else thicker liquid would outweigh the rest.
            *force *= self.slow * friction.min(1.0);
        }
        norm(&forces)
    }

    /// Norm of `b` without the drag of `clinging`.
    pub(crate) fn known_forces(&self) -> f64 {
        match self.clinging {
            [] => norm(self.b),
            clinging => norm_of_difference(self.b, clinging),
        }
    }

    /// Norm of the forces of a flow `u`, without the drag of `clinging`.
    pub(crate) fn forces(&self, u: &[f64]) -> f64 {
        let mut forces = vec![0.0; u.len()];
        self.a.multiply(u, &mut forces);
        for (force, clinging) in forces.iter_mut().zip(self.clinging) {
            *force -= clinging;
        }
        norm(&forces)
    }

    /// Refuses values out of range, those of the guess included.
    ///
    /// # Panics
    /// For arrays of other lengths than the matrices have.
    pub(crate) fn check(&self, u: &[f64], p: &[f64]) -> Result<(), SolveError> {
        let (faces, cells) = (self.a.n_rows(), self.g.n_rows());
        let of_faces = [self.friction, self.b, u].map(<[f64]>::len);
        let of_cells = [self.c, self.volume_source, self.carried, p].map(<[f64]>::len);
        assert_eq!((self.g.n_columns(), of_faces), (faces, [faces; 3]));
        assert_eq!(of_cells, [cells; 4]);
        for forces in [self.standing, self.clinging] {
            assert!(forces.is_empty() || forces.len() == faces);
        }
        for values in [
            self.b,
            self.standing,
            self.clinging,
            self.volume_source,
            self.carried,
            u,
            p,
        ] {
            if let Some(row) = values.iter().position(|v| !v.is_finite()) {
                return Err(SolveError::NotFinite { row });
            }
        }
        let positive = |v: f64| v > 0.0 && v.is_finite();
        if let Some(face) = self.friction.iter().position(|&v| !positive(v)) {
            return Err(SolveError::Matrix(format!(
                "friction {} at face {face}; it must be positive and finite",
                self.friction[face]
            )));
        }
        Ok(())
    }
}

#[cfg(test)]
impl<'a> SaddleSystem<'a> {
    /// A system with `ones`, one per face, as friction and viscosity, and `zeros` elsewhere.
    pub(crate) fn still(
        a: &'a VelocityBlock,
        g: &'a Csr<f64>,
        ones: &'a [f64],
        zeros: &'a [f64],
    ) -> Self {
        let (cells, faces) = (g.n_rows(), a.n_rows());
        Self {
            a,
            g,
            pockets: 0,
            standing: &[],
            clinging: &[],
            slow: 0.0,
            c: &zeros[..cells],
            friction: ones,
            b: &zeros[..faces],
            volume_source: &zeros[..cells],
            carried: &zeros[..cells],
        }
    }
}

/// Norm of a difference.
fn norm_of_difference(a: &[f64], b: &[f64]) -> f64 {
    let square: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
    square.sqrt()
}
