//! Systems that are solved already or cannot be solved.

use saddle_point::{Cause, Csr, SaddleOptions, SaddleSolver, SolveError, VelocityBlock};

use crate::pseudo_wood::Problem;
use crate::{SMALL, options, pockets, solve};

#[test]
fn the_solution_is_its_own_guess() {
    let problem = Problem::new(&SMALL).unwrap();
    let (mut u, mut p, _) = solve(&problem, 1e-6).unwrap();
    let kept = u.clone();
    let solver = SaddleSolver::new(options(2e-6));
    let report = solver.solve(&problem.system(), &mut u, &mut p).unwrap();
    assert_eq!(report.iterations(), 0);
    assert_eq!(u, kept);
}

/// The error of a changed problem after three iterations, and its cause.
fn failure(change: fn(&mut Problem)) -> (SolveError, Cause) {
    let mut problem = Problem::new(&SMALL).unwrap();
    change(&mut problem);
    let (mut u, mut p) = problem.rest();
    let few = SaddleOptions {
        max_iterations: 3,
        ..options(1e-8)
    };
    match SaddleSolver::new(few).solve(&problem.system(), &mut u, &mut p) {
        Err(SolveError::Unsolved { error, cause }) => (*error, cause),
        other => panic!("{other:?}"),
    }
}

#[test]
fn failures_are_reported() {
    let mut problem = Problem::new(&SMALL).unwrap();
    let (mut u, mut p) = problem.rest();
    let (few, _) = failure(|_| ());
    assert!(
        matches!(few, SolveError::NotConverged { iterations: 3, residual, .. } if (1e-8..0.5).contains(&residual)),
        "{few}"
    );
    let solver = SaddleSolver::new(options(1e-3));
    let mut error = |u: &mut Vec<f64>, problem: &Problem| {
        let solved = solver.solve(&problem.system(), u, &mut p);
        solved.unwrap_err()
    };
    problem.b[7] = f64::NAN;
    assert_eq!(error(&mut u, &problem), SolveError::NotFinite { row: 7 });

    let negative = VelocityBlock::assemble(problem.b.len(), |row, entries| {
        entries.add(row, if row == 11 { -1.0 } else { 1.0 });
    });
    let error = negative.err().unwrap();
    assert!(error.to_string().contains("row 11"), "{error}");
}

#[test]
fn a_sealed_incompressible_pocket_fails_and_a_compressible_one_does_not() {
    let run = |c: f64| {
        let mut problem = pockets(20, 20, c);
        problem.volume_source.fill(0.1);
        let (mut u, mut p) = problem.rest();
        let result = SaddleSolver::new(options(1e-6)).solve(&problem.system(), &mut u, &mut p);
        assert!(u.iter().chain(&p).all(|v| v.is_finite()));
        result.map(|_| p)
    };
    let p = run(1e-4).unwrap();
    let mean = p[..20].iter().sum::<f64>() / 20.0;
    println!("pressure of the sealed pocket {mean:.1}, source over compressibility 1000");
    assert!((mean / 1000.0 - 1.0).abs() < 1e-3);
    let error = run(0.0).unwrap_err();
    println!("{error}");
    let SolveError::Unsolved { error, cause } = error else {
        panic!("{error:?}");
    };
    assert!(matches!(*error, SolveError::NotConverged { residual, .. } if residual > 0.1));
    assert_eq!(cause, Cause::Unbalanced { cells: 20 });
}

/// A row of cells under pressure from the step before, with slowly moving walls: the carried volume is five hundred times
/// the displaced one.
#[test]
fn a_slow_flow_under_pressure_is_solved_to_the_tolerance() {
    let (c, pressure, moved) = (1e-3_f64, 1e2, 1e-3);
    let mut problem = pockets(40, 0, c);
    (problem.volume_source[0], problem.volume_source[39]) = (moved, -moved);
    problem.carried.fill(c * pressure);
    let (mut u, mut p) = problem.rest();
    p.fill(pressure);
    (SaddleSolver::new(options(1e-3)).solve(&problem.system(), &mut u, &mut p)).unwrap();
    // u_(i+1) - 2 u_i + u_(i-1) = 2 c u_i, and u = moved at both walls.
    let decay = (1.0 + c).acosh();
    let exact = |face: usize| moved * (decay * (face as f64 - 19.0)).cosh() / (20.0 * decay).cosh();
    let error = (0..39).fold(0.0, |most: f64, face| {
        most.max((u[face] - exact(face)).abs())
    });
    println!("velocities off by {:.1e} of the wall's", error / moved);
    assert!(error < 2e-3 * moved);
}

#[test]
fn what_makes_a_system_unsolvable_is_named() {
    let (beyond, _) = failure(|problem| problem.b.fill(1e200));
    assert!(
        matches!(beyond, SolveError::Overflow { iteration: 1, .. }),
        "{beyond}"
    );
    let (_, stiff) = failure(|problem| problem.c.fill(1e20));
    assert!(matches!(stiff, Cause::Stiff { .. }), "{stiff}");
    let (_, fast) = failure(|problem| problem.friction.fill(1e20));
    assert!(matches!(fast, Cause::Inertial { .. }), "{fast}");
    assert_eq!(failure(|_| ()).1, Cause::Unknown);
}

/// Indices have 32 bits, and the largest one is reserved.
#[test]
fn a_matrix_too_wide_for_its_indices_is_refused() {
    let wide = |columns: usize| Csr::<f64>::assemble(1, columns, |_, entries| entries.add(7, 1.0));
    assert_eq!(wide(u32::MAX as usize - 1).unwrap().row(0).0, [7]);
    let said = wide(u32::MAX as usize).err().unwrap().to_string();
    assert!(said.contains("exceeds the 32-bit index range"), "{said}");
}
