//! The solver against dense factorisation.

use nalgebra::{DMatrix, DVector};
use saddle_point::Csr;

use crate::pseudo_wood::{Case, Problem};
use crate::{SMALL, distance, solve};

fn dense(matrix: &Csr<f64>) -> DMatrix<f64> {
    let mut full = DMatrix::zeros(matrix.n_rows(), matrix.n_columns());
    for row in 0..matrix.n_rows() {
        let (columns, values) = matrix.row(row);
        for (&column, &value) in columns.iter().zip(values) {
            full[(row, column as usize)] = value;
        }
    }
    full
}

#[test]
fn agrees_with_dense_factorisation() {
    for (contrast, bulk_modulus) in [(1.0, 1e9), (210.0, 1e9), (1.0, 1e7)] {
        let problem = Problem::new(&Case {
            contrast,
            bulk_modulus,
            ..SMALL
        })
        .unwrap();
        let (n, m) = (problem.b.len(), problem.c.len());
        let (a, g) = (dense(&problem.a), dense(&problem.g));
        assert!((&a - a.transpose()).amax() < 1e-12, "A is not symmetric");
        let mut full = DMatrix::zeros(n + m, n + m);
        full.view_mut((0, 0), (n, n)).copy_from(&a);
        full.view_mut((0, n), (n, m)).copy_from(&-g.transpose());
        full.view_mut((n, 0), (m, n)).copy_from(&-&g);
        for cell in 0..m {
            full[(n + cell, n + cell)] = -problem.c[cell];
        }
        let sources = problem.volume_source.iter().map(|g| -g);
        let rhs = DVector::from_iterator(n + m, problem.b.iter().copied().chain(sources));
        let matrix = full.clone();
        let exact = full.lu().solve(&rhs).unwrap();
        let (u, p, report) = solve(&problem, 1e-9).unwrap();
        let errors = [
            distance(&u, exact.rows(0, n).as_slice()),
            distance(&p, exact.rows(n, m).as_slice()),
        ];
        let iterations = report.iterations();
        println!(
            "{n} faces, {m} cells: {iterations} iterations, errors {:.1e} {:.1e}",
            errors[0], errors[1]
        );
        assert!(errors[0] < 1e-7 && errors[1] < 1e-7);
        let found = DVector::from_iterator(n + m, u.iter().chain(&p).copied());
        let left = (&rhs - &matrix * found).norm() / rhs.norm();
        let told = report.residual();
        assert!((told / left - 1.0).abs() < 1e-2, "{told:e}, not {left:e}");
    }
}

#[test]
fn eigenvalue_bound_is_safe_and_tight() {
    for (contrast, viscosity) in [(1.0, 1.3), (210.0, 1.3), (1.0, 1e-3)] {
        let problem = Problem::new(&Case {
            contrast,
            viscosity,
            ..SMALL
        })
        .unwrap();
        let a = dense(&problem.a);
        let scale = a.diagonal().map(|d| 1.0 / d.sqrt());
        let scaled = DMatrix::from_fn(a.nrows(), a.ncols(), |i, j| a[(i, j)] * scale[i] * scale[j]);
        let largest = scaled.symmetric_eigenvalues().max();
        let (_, _, report) = solve(&problem, 1e-3).unwrap();
        let bound = report.eigenvalue_bound;
        println!("largest eigenvalue {largest:.4}, bound {bound:.4}");
        assert!((largest..1.25 * largest).contains(&bound));
    }
}
