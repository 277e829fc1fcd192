//! A body of unknown speed under a known force against the same body at a known speed.

mod pseudo_wood;

use pseudo_wood::{Case, Problem};
use saddle_point::{Load, SaddleOptions, SaddleSolver, SaddleSystem, SolveError};

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The problem is driven by the closing block alone, so its right-hand side is that of unit speed.
#[test]
fn the_speed_that_a_force_drives() {
    let problem = Problem::new(&Case {
        cells: [24, 40, 24],
        ..Case::default()
    })
    .unwrap();
    let (faces, cells) = (problem.b.len(), problem.c.len());
    let mut solver = SaddleSolver::new(SaddleOptions {
        tolerance: 1e-7,
        ..SaddleOptions::default()
    });
    let (mut u, mut p) = (vec![0.0; faces], vec![0.0; cells]);
    let known = solver.solve(&problem.system(), &mut u, &mut p).unwrap();
    // Any that keeps the whole resistance positive, as that of the walls themselves does.
    let resistance = 2.0 * dot(&problem.b, &u);
    let force_per_speed = dot(&problem.volume_source, &p) - dot(&problem.b, &u) + resistance;
    assert!(force_per_speed > 0.0);

    let wanted = 0.37;
    let load = Load {
        momentum: problem.b.clone(),
        source: problem.volume_source.clone(),
        resistance,
        force: wanted * force_per_speed,
        scale: wanted * force_per_speed,
    };
    let (still, empty) = (vec![0.0; faces], vec![0.0; cells]);
    let resting = SaddleSystem {
        b: &still,
        volume_source: &empty,
        ..problem.system()
    };
    let (mut v, mut q, mut speed) = (vec![0.0; faces], vec![0.0; cells], 1.0);
    let report = solver
        .solve_loaded(&resting, &load, &mut v, &mut q, &mut speed)
        .unwrap();
    let largest = u.iter().fold(0.0, |m: f64, u| m.max(u.abs()));
    let error = (u.iter().zip(&v)).fold(0.0, |m: f64, (u, v)| m.max((v - wanted * u).abs()));
    println!(
        "speed {speed:.8}, {wanted} wanted, velocities off by {:.1e}; {} iterations, {} at known speed",
        error / largest,
        report.iterations(),
        known.iterations()
    );
    assert!((speed / wanted - 1.0).abs() < 1e-5);
    assert!(error < 1e-4 * largest);
    // The preconditioner eliminates the speed: it costs no iterations.
    assert!(report.iterations() <= known.iterations() + 2);

    let pulling = Load {
        force: -1.0,
        scale: -1.0,
        ..load
    };
    let refused = solver.solve_loaded(&resting, &pulling, &mut v, &mut q, &mut speed);
    assert!(matches!(refused, Err(SolveError::Matrix(_))));
}
