//! A body of unknown speed under a known force against the same body at a known speed.

use saddle_point::{Load, SaddleSolver, SaddleSystem, SolveError, VelocityBlock};

use crate::options;
use crate::pseudo_wood::{Case, Problem, add_row};

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Couples the closing block to the faces that it drags, with a friction of `times` the face's own resistance. Returns the
/// momentum of the drag at unit speed.
fn bind(problem: &mut Problem, times: f64) -> Vec<f64> {
    let bound: Vec<f64> = (problem.b.iter().zip(problem.a.diagonal()))
        .map(|(b, own)| if *b == 0.0 { 0.0 } else { times * own })
        .collect();
    let block = VelocityBlock::assemble(bound.len(), |row, entries| {
        add_row(problem.a.row(row), entries);
        entries.add(row, bound[row]);
    });
    problem.block = block.unwrap();
    for (face, bound) in bound.iter().enumerate() {
        problem.b[face] -= bound;
        problem.friction[face] += bound;
    }
    bound.iter().map(|bound| -bound).collect()
}

/// The closing block alone drives the problem, so its right-hand side is that of unit speed. Under load there are also
/// forces on the liquid at the block.
#[test]
fn the_speed_that_a_force_drives() {
    // With such strong coupling the mutual drag of liquid and block cancels to a ten-thousandth.
    for times in [0.0, 1e4] {
        drives(times);
    }
}

#[allow(clippy::print_stdout, reason = "prints for developers")]
fn drives(times: f64) {
    let mut problem = Problem::new(&Case {
        cells: [24, 40, 24],
        ..Case::default()
    })
    .unwrap();
    let dragged = problem.b.clone();
    let bound = bind(&mut problem, times);
    let solver = SaddleSolver::new(options(1e-7));
    let (mut u, mut p) = problem.rest();
    let moving = SaddleSystem {
        standing: &bound,
        clinging: &bound,
        ..problem.system()
    };
    let known = solver.solve(&moving, &mut u, &mut p).unwrap();
    // Any value that keeps the whole resistance positive, as that of the walls does.
    let resistance = 2.0 * dot(&dragged, &u) - bound.iter().sum::<f64>();
    let force_on = |u: &[f64], p: &[f64]| dot(&problem.volume_source, p) - dot(&problem.b, u);
    let force_per_speed = force_on(&u, &p) + resistance;
    assert!(force_per_speed > 0.0);

    let pushed: Vec<f64> = dragged.iter().map(|b| 0.2 * b).collect();
    let (mut v, mut q) = problem.rest();
    let resting = SaddleSystem {
        b: &pushed,
        volume_source: &problem.carried,
        ..problem.system()
    };
    let mut w = v.clone();
    solver.solve(&resting, &mut w, &mut q).unwrap();

    let wanted = 0.37;
    let load = Load {
        momentum: problem.b.clone(),
        source: problem.volume_source.clone(),
        resistance,
        force: wanted * force_per_speed + force_on(&w, &q),
        scale: wanted * force_per_speed,
    };
    let mut speed = 1.0;
    q.fill(0.0);
    let report = solver
        .solve_loaded(&resting, &load, &mut v, &mut q, &mut speed)
        .unwrap();
    let largest = u.iter().fold(0.0, |m: f64, u| m.max(u.abs()));
    let error = (u.iter().zip(&w).zip(&v))
        .map(|((u, w), v)| (v - wanted * u - w).abs())
        .fold(0.0, f64::max);
    println!(
        "speed {speed:.8}, {wanted} wanted, velocities off by {:.1e}; {} iterations, {} at known speed",
        error / largest,
        report.iterations(),
        known.iterations()
    );
    assert!((speed / wanted - 1.0).abs() < 1e-5);
    assert!(error < 1e-4 * largest);
    // The preconditioner eliminates the speed, which costs no iterations except by rounding, at strong coupling up to a fifth.
    assert!(report.iterations() <= known.iterations() + known.iterations() / 4 + 2);

    let pulling = Load {
        force: -1.0,
        scale: -1.0,
        ..load
    };
    let refused = solver.solve_loaded(&resting, &pulling, &mut v, &mut q, &mut speed);
    assert!(matches!(refused, Err(SolveError::Matrix(_))));
}
