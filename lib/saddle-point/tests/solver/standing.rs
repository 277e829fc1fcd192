//! Liquid that stands under pressure, or nearly.

use saddle_point::{Csr, Load, SaddleSolver, SaddleSystem, VelocityBlock};

use crate::{options, pockets};

/// A wall drives liquid slowly along a row of cells into a void with gas, which pushes back a million times as
/// hard as that takes, and which the liquid's pressure from before balances.
#[test]
fn a_slow_flow_against_gas_is_solved_to_the_tolerance() {
    let (moved, pressure, faces) = (1e-3, 1e3, 40);
    let (row, friction) = pockets(0, faces);
    let g = Csr::assemble(faces + 1, faces, |cell, entries| match cell == faces {
        true => entries.add(faces - 1, -1.0),
        false => {
            let (columns, values) = row.row(cell);
            for (&column, &value) in columns.iter().zip(values) {
                entries.add(column as usize, value);
            }
        }
    })
    .unwrap();
    let a = VelocityBlock::assemble(faces, |row, entries| entries.add(row, 2.0)).unwrap();
    let (mut source, mut c) = (vec![0.0; faces + 1], vec![0.0; faces + 1]);
    (source[0], c[faces]) = (moved, 1e3);
    let mut push = vec![0.0; faces];
    push[faces - 1] = -pressure;
    let system = SaddleSystem {
        a: &a,
        g: &g,
        pockets: 1,
        c: &c,
        friction: &friction,
        two_eta: &[2.0; 41],
        b: &push,
        standing: &push,
        clinging: &[],
        slow: 0.0,
        volume_source: &source,
        carried: &[0.0; 41],
    };
    let (mut u, mut p) = (vec![0.0; faces], vec![pressure; faces + 1]);
    p[faces] = 0.0;
    (SaddleSolver::new(options(1e-3)).solve(&system, &mut u, &mut p)).unwrap();
    let error = (u.iter()).fold(0.0, |most: f64, u| most.max((u / moved - 1.0).abs()));
    println!("velocities off by {error:.1e} of the wall's");
    assert!(error < 2e-3);
}

/// Menisci pull at both ends of a row of cells, at one of them a ten-thousandth more; the guess rests under their mean, or
/// flows a thousand times too fast. A body on some of it, under no force, is drawn along or not.
#[test]
fn a_slight_difference_of_pulls_is_solved_from_any_guess() {
    let (cells, pull, more) = (60, 10.0, 1e-3);
    let g = Csr::assemble(cells, cells + 1, |cell, entries| {
        entries.add(cell, -1.0);
        entries.add(cell + 1, 1.0);
    })
    .unwrap();
    let faces = cells + 1;
    let a = VelocityBlock::assemble(faces, |row, entries| entries.add(row, 2.0)).unwrap();
    let mut b = vec![0.0; faces];
    (b[0], b[cells]) = (-pull, pull + more);
    let exact = more / (2.0 * faces as f64);
    let system = SaddleSystem {
        a: &a,
        g: &g,
        pockets: 0,
        c: &vec![0.0; cells],
        friction: &vec![2.0; faces],
        two_eta: &vec![2.0; cells],
        b: &b,
        standing: &b,
        clinging: &[],
        slow: 1e-3 * exact,
        volume_source: &vec![0.0; cells],
        carried: &vec![0.0; cells],
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
        let start = (vec![guess; faces], vec![-pull; cells]);
        let (mut u, mut p) = start.clone();
        let report = (SaddleSolver::new(options(1e-3)).solve(&system, &mut u, &mut p)).unwrap();
        let error = u[30] / exact - 1.0;
        let (mut u, mut p) = start;
        let mut speed = 20.0 * guess;
        (SaddleSolver::new(options(1e-3)))
            .solve_loaded(&system, &load, &mut u, &mut p, &mut speed)
            .unwrap();
        let loaded = [u[30] / drawn - 1.0, speed / (20.0 * drawn) - 1.0];
        println!(
            "guess of {:+.0} times the flow: off by {error:+.1e} after {} iterations; with a body {loaded:?}",
            guess / exact,
            report.iterations()
        );
        assert!(error.abs() < 5e-3);
        assert!(loaded.iter().all(|error| error.abs() < 5e-3));
    }
}

/// A wall under a force on a row of cells that is closed: all of them come to the pressure of the force, whether
/// what the liquid gives way by is lost in double precision or in single precision.
#[test]
fn sealed_liquid_comes_to_the_pressure_of_its_load() {
    let cells = 200;
    let (g, _) = pockets(cells, 0);
    let a = VelocityBlock::assemble(cells, |row, entries| entries.add(row, 2.0)).unwrap();
    let nothing = vec![0.0; cells];
    let mut source = nothing.clone();
    source[0] = 1.0;
    let load = Load {
        momentum: nothing.clone(),
        source,
        resistance: 0.0,
        force: 3.0,
        scale: 3.0,
    };
    for c in [1e-17, 1e-13, 1e-9] {
        let system = SaddleSystem {
            a: &a,
            g: &g,
            pockets: 0,
            c: &vec![c; cells],
            friction: &vec![2.0; cells],
            two_eta: &vec![2.0; cells],
            b: &nothing,
            standing: &[],
            clinging: &[],
            slow: 0.0,
            volume_source: &nothing,
            carried: &vec![c; cells],
        };
        // Without the load the volume that a wall at rest takes up is all that compresses it.
        let taken = SaddleSystem {
            volume_source: &vec![c; cells],
            ..system
        };
        let (mut u, mut p) = (nothing.clone(), vec![1.0; cells]);
        (SaddleSolver::new(options(1e-3)).solve(&taken, &mut u, &mut p)).unwrap();
        assert!((p[0] / 2.0 - 1.0).abs() < 2e-3, "{}", p[0]);

        let (mut u, mut p, mut speed) = (nothing.clone(), vec![1.0; cells], c);
        let report = SaddleSolver::new(options(1e-3))
            .solve_loaded(&system, &load, &mut u, &mut p, &mut speed)
            .unwrap();
        // From 1 to 3 in each.
        let volume = 2.0 * c * cells as f64;
        println!(
            "C {c:.0e}: speed off by {:+.1e}, pressure at the end {:.6}; {} iterations",
            speed / volume - 1.0,
            p[cells - 1],
            report.iterations()
        );
        assert!((p[cells - 1] / 3.0 - 1.0).abs() < 2e-3);
        // The smaller volume is rounding of the pressures, and moves nothing.
        assert!((speed - volume).abs() < 2e-3 * volume.max(1e-11));
    }
}

/// Beside liquid under a load stands sealed liquid that the load's body does not touch, or carries along, and that
/// loses volume: its pressure falls by that over its compressibility, and the load is borne by the other.
#[test]
fn sealed_liquid_beside_a_load_keeps_its_own_pressure() {
    let cells = 100;
    let (g, friction) = pockets(cells, cells);
    let all = 2 * cells;
    let a = VelocityBlock::assemble(all, |row, entries| entries.add(row, 2.0)).unwrap();
    let nothing = vec![0.0; all];
    for carried in [[0.0; 3], [0.1, 0.2, -0.3]] {
        let mut displaced = nothing.clone();
        displaced[..3].copy_from_slice(&carried);
        displaced[cells] = 1.0;
        let load = Load {
            momentum: nothing.clone(),
            source: displaced,
            resistance: 0.0,
            force: 3.0,
            scale: 3.0,
        };
        for (c, lost) in [(1e-9, 1e-6), (1e-9, 1e-4), (1e-12, 1e-9)] {
            let mut source = nothing.clone();
            source[..cells].fill(-lost);
            let system = SaddleSystem {
                a: &a,
                g: &g,
                pockets: 0,
                c: &vec![c; all],
                friction: &friction.iter().map(|d| 2.0 * d).collect::<Vec<_>>(),
                two_eta: &vec![2.0; all],
                b: &nothing,
                standing: &[],
                clinging: &[],
                slow: 0.0,
                volume_source: &source,
                carried: &nothing,
            };
            let (mut u, mut p, mut speed) = (nothing.clone(), nothing.clone(), 0.01);
            let report = SaddleSolver::new(options(1e-3))
                .solve_loaded(&system, &load, &mut u, &mut p, &mut speed)
                .unwrap();
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

/// Much liquid that one narrow opening relieves is not sealed.
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
    })
    .unwrap();
    let hole = 2 * (n - 1);
    let friction: Vec<f64> = (0..faces)
        .map(|f| if f == hole { 24.0 } else { 0.06 })
        .collect();
    let a = VelocityBlock::assemble(faces, |row, entries| entries.add(row, friction[row])).unwrap();
    let mut source = vec![0.0; n * n];
    source[n * n - 1] = 3.0;
    let system = SaddleSystem {
        a: &a,
        g: &g,
        pockets: 0,
        c: &vec![1e-12; n * n],
        friction: &friction,
        two_eta: &vec![0.06; n * n],
        b: &vec![0.0; faces],
        standing: &[],
        clinging: &[],
        slow: 0.0,
        volume_source: &source,
        carried: &vec![0.0; n * n],
    };
    let (mut u, mut p) = (vec![0.0; faces], vec![0.0; n * n]);
    let report = (SaddleSolver::new(options(1e-3)).solve(&system, &mut u, &mut p)).unwrap();
    println!(
        "{:.4} of 3 out, {} iterations",
        u[hole],
        report.iterations()
    );
    assert!((u[hole] / 3.0 - 1.0).abs() < 0.01);
}
