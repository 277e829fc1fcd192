//! A body of unknown speed under a known force against the same body at a known speed.

#![allow(clippy::print_stdout, reason = "prints for developers")]

mod pseudo_wood;

use pseudo_wood::{Case, Problem};
use saddle_point::{Load, SaddleOptions, SaddleSolver, SaddleSystem, SolveError, VelocityBlock};

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Friction of so many times a face's own resistance between the closing block and the faces that it drags; the momentum that
/// it drags by at unit speed.
fn bind(problem: &mut Problem, times: f64) -> Vec<f64> {
    let diagonal = problem.a.diagonal();
    let bound: Vec<f64> = (problem.b.iter().zip(&diagonal))
        .map(|(b, own)| if *b == 0.0 { 0.0 } else { times * own })
        .collect();
    let block = VelocityBlock::assemble(bound.len(), |row, entries| {
        let (columns, values) = problem.a.row(row);
        for (&column, &value) in columns.iter().zip(values) {
            entries.add(column as usize, value);
        }
        entries.add(row, bound[row]);
    });
    problem.block = block.unwrap();
    for (face, bound) in bound.iter().enumerate() {
        problem.b[face] -= bound;
        problem.friction[face] += bound;
    }
    bound.iter().map(|bound| -bound).collect()
}

/// The problem is driven by the closing block alone, so its right-hand side is that of unit speed. Under load there are
/// forces on the liquid at the block, too.
#[test]
fn the_speed_that_a_force_drives() {
    // Bound by so much, what drags liquid and block by each other cancels but for a ten-thousandth.
    for times in [0.0, 1e4] {
        drives(times);
    }
}

fn drives(times: f64) {
    let mut problem = Problem::new(&Case {
        cells: [24, 40, 24],
        ..Case::default()
    })
    .unwrap();
    let dragged = problem.b.clone();
    let bound = bind(&mut problem, times);
    let (faces, cells) = (problem.b.len(), problem.c.len());
    let mut solver = SaddleSolver::new(SaddleOptions {
        tolerance: 1e-7,
        ..SaddleOptions::default()
    });
    let (mut u, mut p) = (vec![0.0; faces], vec![0.0; cells]);
    let moving = SaddleSystem {
        standing: &bound,
        clinging: &bound,
        ..problem.system()
    };
    let known = solver.solve(&moving, &mut u, &mut p).unwrap();
    // Any that keeps the whole resistance positive, as that of the walls themselves does.
    let resistance = 2.0 * dot(&dragged, &u) - bound.iter().sum::<f64>();
    let force_on = |u: &[f64], p: &[f64]| dot(&problem.volume_source, p) - dot(&problem.b, u);
    let force_per_speed = force_on(&u, &p) + resistance;
    assert!(force_per_speed > 0.0);

    let (pushed, empty) = (
        dragged.iter().map(|b| 0.2 * b).collect::<Vec<_>>(),
        vec![0.0; cells],
    );
    let resting = SaddleSystem {
        b: &pushed,
        volume_source: &empty,
        ..problem.system()
    };
    let (mut w, mut q) = (vec![0.0; faces], vec![0.0; cells]);
    solver.solve(&resting, &mut w, &mut q).unwrap();

    let wanted = 0.37;
    let load = Load {
        momentum: problem.b.clone(),
        source: problem.volume_source.clone(),
        resistance,
        force: wanted * force_per_speed + force_on(&w, &q),
        scale: wanted * force_per_speed,
    };
    let (mut v, mut speed) = (vec![0.0; faces], 1.0);
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
    // The preconditioner eliminates the speed: it costs no iterations, but for rounding, which moves so much by an eighth.
    assert!(report.iterations() <= known.iterations() + known.iterations() / 8 + 2);

    let pulling = Load {
        force: -1.0,
        scale: -1.0,
        ..load
    };
    let refused = solver.solve_loaded(&resting, &pulling, &mut v, &mut q, &mut speed);
    assert!(matches!(refused, Err(SolveError::Matrix(_))));
}
