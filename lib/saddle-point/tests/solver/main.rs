//! The linear solver on synthetic wood: against dense factorisation, over sizes, materials and threads, and with systems
//! that cannot be solved.

mod dense;
mod failures;
mod loaded;
#[path = "../pseudo_wood/mod.rs"]
mod pseudo_wood;
mod sizes;
mod standing;

use pseudo_wood::{Case, Problem};
use saddle_point::{Csr, SaddleOptions, SaddleReport, SaddleSolver, SolveError};

const SMALL: Case = Case {
    cells: [10, 14, 5],
    gap: 4,
    depth: 3,
    viscosity: 1.3,
    contrast: 1.0,
    bulk_modulus: 1e9,
    friction: true,
};

const MEDIUM: Case = Case {
    cells: [32, 40, 24],
    gap: 12,
    depth: 10,
    ..SMALL
};

fn options(tolerance: f64) -> SaddleOptions {
    SaddleOptions {
        tolerance,
        ..SaddleOptions::default()
    }
}

fn solve(
    problem: &Problem,
    tolerance: f64,
) -> Result<(Vec<f64>, Vec<f64>, SaddleReport), SolveError> {
    let (mut u, mut p) = problem.rest();
    let report = SaddleSolver::new(options(tolerance)).solve(&problem.system(), &mut u, &mut p)?;
    Ok((u, p, report))
}

/// `|x - y| / |y|`.
fn distance(x: &[f64], y: &[f64]) -> f64 {
    let square = |f: &dyn Fn(usize) -> f64| (0..x.len()).map(|i| f(i).powi(2)).sum::<f64>();
    (square(&|i| x[i] - y[i]) / square(&|i| y[i])).sqrt()
}

/// Two rows of cells with compressibility `c` and friction 2 at the faces; the first is closed, the second open at its end.
fn pockets(closed: usize, open: usize, c: f64) -> Problem {
    let cells = closed + open;
    let g = Csr::assemble(cells, cells, |cell, entries| {
        // Face `i` lies behind cell `i`; the closed row has none at its end.
        if cell + 1 != closed {
            entries.add(cell, 1.0);
        }
        if cell != 0 && cell != closed {
            entries.add(cell - 1, -1.0);
        }
    });
    Problem::still(g.unwrap(), |_| 2.0, c)
}
