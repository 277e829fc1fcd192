//! A test system for the solver, with its arrays.

use saddle_point::{Csr, RowEntries, SaddleSystem, SolveError, VelocityBlock};

use super::{Case, Stokes};

/// An assembled problem.
pub struct Problem {
    pub a: Csr<f64>,
    /// The same, for the solver.
    pub block: VelocityBlock,
    pub g: Csr<f64>,
    pub c: Vec<f64>,
    pub friction: Vec<f64>,
    pub b: Vec<f64>,
    pub volume_source: Vec<f64>,
    pub carried: Vec<f64>,
}

impl Problem {
    pub fn new(case: &Case) -> Result<Self, SolveError> {
        Stokes::new(case).assemble()
    }

    /// A problem at rest with fluxes `g`, only friction of `stiffness` at the faces, and compressibility `c` of the cells.
    pub fn still(g: Csr<f64>, stiffness: impl Fn(usize) -> f64 + Sync, c: f64) -> Self {
        let (faces, cells) = (g.n_columns(), g.n_rows());
        let fill = |row: usize, entries: &mut RowEntries| entries.add(row, stiffness(row));
        Self {
            a: Csr::assemble(faces, faces, fill).unwrap(),
            block: VelocityBlock::assemble(faces, fill).unwrap(),
            g,
            c: vec![c; cells],
            friction: (0..faces).map(&stiffness).collect(),
            b: vec![0.0; faces],
            volume_source: vec![0.0; cells],
            carried: vec![0.0; cells],
        }
    }

    pub fn system(&self) -> SaddleSystem<'_> {
        SaddleSystem {
            a: &self.block,
            g: &self.g,
            pockets: 0,
            standing: &[],
            clinging: &[],
            slow: 0.0,
            c: &self.c,
            friction: &self.friction,
            b: &self.b,
            volume_source: &self.volume_source,
            carried: &self.carried,
        }
    }

    /// Velocities and pressures at rest.
    pub fn rest(&self) -> (Vec<f64>, Vec<f64>) {
        (vec![0.0; self.b.len()], vec![0.0; self.c.len()])
    }
}
