//! The least-squares problem of GMRES.

/// The small least-squares problem `min |beta e_1 - H y|`, kept triangular by Givens rotations.
pub(crate) struct LeastSquares {
    /// Columns of the triangular factor.
    columns: Vec<Vec<f64>>,
    rotations: Vec<(f64, f64)>,
    rhs: Vec<f64>,
}

impl LeastSquares {
    /// The problem for a residual of norm `beta`, without columns.
    pub(crate) fn new(beta: f64) -> Self {
        Self {
            columns: Vec::new(),
            rotations: Vec::new(),
            rhs: vec![beta],
        }
    }

    /// Appends column `(h_0..h_k, below)` of the Hessenberg matrix.
    pub(crate) fn push(&mut self, mut column: Vec<f64>, below: f64) {
        for (i, &(cosine, sine)) in self.rotations.iter().enumerate() {
            let (upper, lower) = (column[i], column[i + 1]);
            column[i] = cosine * upper + sine * lower;
            column[i + 1] = cosine * lower - sine * upper;
        }
        let k = self.rotations.len();
        let length = column[k].hypot(below);
        let (cosine, sine) = if length > 0.0 {
            (column[k] / length, below / length)
        } else {
            (1.0, 0.0)
        };
        column[k] = length;
        let last = self.rhs[k];
        self.rhs[k] = cosine * last;
        self.rhs.push(-sine * last);
        self.rotations.push((cosine, sine));
        self.columns.push(column);
    }

    /// Norm of the residual.
    pub(crate) fn residual(&self) -> f64 {
        self.rhs.last().map_or(0.0, |r| r.abs())
    }

    /// Coefficients of the minimiser; zero for a direction without effect.
    pub(crate) fn solve(&self) -> Vec<f64> {
        let n = self.columns.len();
        let mut y = self.rhs[..n].to_vec();
        for i in (0..n).rev() {
            let pivot = self.columns[i][i];
            y[i] = if pivot > 0.0 { y[i] / pivot } else { 0.0 };
            for j in 0..i {
                y[j] -= self.columns[i][j] * y[i];
            }
        }
        y
    }
}
