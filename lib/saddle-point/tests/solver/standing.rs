//! Liquid at rest, or nearly, under pressure.

use saddle_point::{Csr, Load, SaddleReport, SaddleSolver, SaddleSystem};

use crate::pseudo_wood::{Problem, add_row};
use crate::{options, pockets};

/// Velocities, pressures and speed of a system under a load from the guess `p`, and the report.
fn loaded(
    system: &SaddleSystem,
    load: &Load,
    mut u: Vec<f64>,
    mut p: Vec<f64>,
    mut speed: f64,
) -> (Vec<f64>, Vec<f64>, f64, SaddleReport) {
    let solver = SaddleSolver::new(options(1e-3));
    let report = solver.solve_loaded(system, load, &mut u, &mut p, &mut speed);
    (u, p, speed, report.unwrap())
}

/// A wall drives liquid slowly along a row of cells against gas. The pressure of the gas is a million times that of the flow
/// and is balanced by the liquid's pressure from the step before.
#[test]
fn a_slow_flow_against_gas_is_solved_to_the_tolerance() {
    let (moved, pressure, faces) = (1e-3, 1e3, 40);
    let row = pockets(0, faces, 0.0).g;
    let g = Csr::assemble(faces + 1, faces, |cell, entries| match cell == faces {
        true => entries.add(faces - 1, -1.0),
        false => add_row(row.row(cell), entries),
    });
    let mut problem = Problem::still(g.unwrap(), |_| 2.0, 0.0);
    (problem.volume_source[0], problem.c[faces]) = (moved, 1e3);
    problem.b[faces - 1] = -pressure;
    let system = SaddleSystem {
        pockets: 1,
        standing: &problem.b,
        ..problem.system()
    };
    let (mut u, mut p) = problem.rest();
    p[..faces].fill(pressure);
    (SaddleSolver::new(options(1e-3)).solve(&system, &mut u, &mut p)).unwrap();
    let error = (u.iter()).fold(0.0, |most: f64, u| most.max((u / moved - 1.0).abs()));
    println!("velocities off by {error:.1e} of the wall's");
    assert!(error < 2e-3);
}

/// Menisci pull at both ends of a row of cells, at one a ten-thousandth more. The guess is at rest under their mean, or flows
/// a thousand times too fast. A body without force on part of the row is drawn along, or there is none.
#[test]
fn a_slight_difference_of_pulls_is_solved_from_any_guess() {
    let (cells, pull, more) = (60, 10.0, 1e-3);
    let faces = cells + 1;
    let g = Csr::assemble(cells, faces, |cell, entries| {
        entries.add(cell, -1.0);
        entries.add(cell + 1, 1.0);
    });
    let mut problem = Problem::still(g.unwrap(), |_| 2.0, 0.0);
    (problem.b[0], problem.b[cells]) = (-pull, pull + more);
    let exact = more / (2.0 * faces as f64);
    let system = SaddleSystem {
        standing: &problem.b,
        slow: 1e-3 * exact,
        ..problem.system()
    };
    let mut load = Load {
        momentum: vec![0.0; faces],
        source: vec![0.0; cells],
        resistance: 0.1,
        force: 0.0,
        scale: 1e-3,
    };
    load.momentum[20..40].fill(0.1);
    // Rows of the body: 0.1 V = 2 u; of the liquid: 2 faces u - 2 V = more.
    let drawn = more / (2.0 * faces as f64 - 40.0);
    for guess in [0.0, exact, -1000.0 * exact] {
        let (u, p) = (vec![guess; faces], vec![-pull; cells]);
        let (mut flow, mut pressure) = (u.clone(), p.clone());
        let solver = SaddleSolver::new(options(1e-3));
        let report = solver.solve(&system, &mut flow, &mut pressure).unwrap();
        let (u, _, speed, _) = loaded(&system, &load, u, p, 20.0 * guess);
        let errors = [flow[30] / exact, u[30] / drawn, speed / (20.0 * drawn)].map(|x| x - 1.0);
        println!(
            "guess of {:+.0} times the flow: off by {:+.1e}, with a body {:?}; {} iterations",
            guess / exact,
            errors[0],
            &errors[1..],
            report.iterations()
        );
        assert!(errors.iter().all(|error| error.abs() < 5e-3));
    }
}

/// A wall under a force on a closed row of cells: all cells come to the pressure of the force, whether the compression is lost
/// in single or even in double precision.
#[test]
fn sealed_liquid_comes_to_the_pressure_of_its_load() {
    let cells = 200;
    for c in [1e-17, 1e-13, 1e-9] {
        let mut problem = pockets(cells, 0, c);
        problem.carried.fill(c);
        let (rest, _) = problem.rest();
        // Without the load only the volume displaced by a wall at rest compresses it.
        let taken = SaddleSystem {
            volume_source: &problem.c,
            ..problem.system()
        };
        let (mut u, mut p) = (rest.clone(), vec![1.0; cells]);
        (SaddleSolver::new(options(1e-3)).solve(&taken, &mut u, &mut p)).unwrap();
        assert!((p[0] / 2.0 - 1.0).abs() < 2e-3, "{}", p[0]);

        let mut load = Load {
            momentum: rest.clone(),
            source: rest.clone(),
            resistance: 0.0,
            force: 3.0,
            scale: 3.0,
        };
        load.source[0] = 1.0;
        let (_, p, speed, report) = loaded(&problem.system(), &load, rest, vec![1.0; cells], c);
        // From 1 to 3 in each.
        let volume = 2.0 * c * cells as f64;
        println!(
            "C {c:.0e}: speed off by {:+.1e}, pressure at the end {:.6}; {} iterations",
            speed / volume - 1.0,
            p[cells - 1],
            report.iterations()
        );
        assert!((p[cells - 1] / 3.0 - 1.0).abs() < 2e-3);
        // The smaller volume is within the rounding of the pressures.
        assert!((speed - volume).abs() < 2e-3 * volume.max(1e-11));
    }
}

/// Liquid under a load, beside sealed liquid that loses volume and that the body does not touch, or carries along. The
/// pressure of the sealed liquid falls by lost volume over compressibility; the other liquid bears the load.
#[test]
fn sealed_liquid_beside_a_load_keeps_its_own_pressure() {
    let cells = 100;
    for carried in [[0.0; 3], [0.1, 0.2, -0.3]] {
        for (c, lost) in [(1e-9, 1e-6), (1e-9, 1e-4), (1e-12, 1e-9)] {
            let mut problem = pockets(cells, cells, c);
            problem.volume_source[..cells].fill(-lost);
            let (u, p) = problem.rest();
            let mut load = Load {
                momentum: u.clone(),
                source: p.clone(),
                resistance: 0.0,
                force: 3.0,
                scale: 3.0,
            };
            load.source[..3].copy_from_slice(&carried);
            load.source[cells] = 1.0;
            let (_, p, _, report) = loaded(&problem.system(), &load, u, p, 0.01);
            let mean = p[..cells].iter().sum::<f64>() / cells as f64;
            let borne: f64 = load.source.iter().zip(&p).map(|(s, p)| s * p).sum();
            println!(
                "C {c:.0e}, {lost:.0e} lost: mean {mean:.2} of {:.2}, {borne:.4} of 3 borne; {} iterations",
                -lost / c,
                report.iterations()
            );
            assert!((mean * c / -lost - 1.0).abs() < 0.01);
            assert!((borne / 3.0 - 1.0).abs() < 0.01);
        }
    }
}

/// A large volume of liquid with one narrow opening is not sealed.
#[test]
fn an_opening_relieves_much_liquid() {
    let (n, closed) = (300, usize::MAX);
    let faces = 2 * n * n;
    // Faces behind each cell along both axes; the last ones of a row are walls but one.
    let number = |i: usize, j: usize, axis: usize| match [i, j][axis] + 1 == n {
        true if axis == 1 || j != 0 => closed,
        _ => 2 * (j * n + i) + axis,
    };
    let g = Csr::assemble(n * n, faces, |cell, entries| {
        let (i, j) = (cell % n, cell / n);
        for axis in 0..2 {
            let behind = number(i, j, axis);
            if behind != closed {
                entries.add(behind, 1.0);
            }
            if [i, j][axis] > 0 {
                entries.add(number(i - (1 - axis), j - axis, axis), -1.0);
            }
        }
    });
    let hole = 2 * (n - 1);
    let friction = |face: usize| if face == hole { 24.0 } else { 0.06 };
    let mut problem = Problem::still(g.unwrap(), friction, 1e-12);
    problem.volume_source[n * n - 1] = 3.0;
    // The friction of the preconditioner only estimates the resistance of the opening.
    for estimate in [0.1, 1.0, 10.0] {
        problem.friction[hole] = estimate * friction(hole);
        let (mut u, mut p) = problem.rest();
        let solver = SaddleSolver::new(options(1e-3));
        let report = solver.solve(&problem.system(), &mut u, &mut p).unwrap();
        let iterations = report.iterations();
        println!(
            "{estimate}: {:.4} of 3 out, {iterations} iterations",
            u[hole]
        );
        assert!((u[hole] / 3.0 - 1.0).abs() < 0.01);

        // A wall in the place of the source, under the pressure found there.
        let (rest, resting) = problem.rest();
        let mut load = Load {
            momentum: rest.clone(),
            source: resting.clone(),
            resistance: 0.0,
            force: p[n * n - 1],
            scale: p[n * n - 1],
        };
        load.source[n * n - 1] = 1.0;
        let still = SaddleSystem {
            volume_source: &resting,
            ..problem.system()
        };
        let (_, _, speed, report) = loaded(&still, &load, rest, resting.clone(), 0.01);
        let iterations = report.iterations();
        println!("{estimate}: speed {speed:.4} of 3, {iterations} iterations");
        assert!((speed / 3.0 - 1.0).abs() < 0.01);
    }
}
