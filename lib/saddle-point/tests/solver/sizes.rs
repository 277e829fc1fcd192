//! Iterations over sizes and materials; the same result with any number of threads.

use crate::pseudo_wood::{Case, Problem};
use crate::{MEDIUM, solve};
use saddle_point::Csr;

/// Cells of liquid and iterations to 1e-4.
fn iterations(cells: [usize; 3], gap: usize) -> [usize; 2] {
    let case = Case {
        cells,
        gap,
        ..MEDIUM
    };
    let (_, p, report) = solve(&Problem::new(&case).unwrap(), 1e-4).unwrap();
    assert!(report.residual() <= 1e-4);
    [p.len(), report.iterations()]
}

#[test]
fn iterations_do_not_grow_with_the_domain() {
    let found = [[24, 40, 16], [32, 48, 48]].map(|cells| iterations(cells, MEDIUM.gap));
    println!("cells and iterations to 1e-4: {found:?}");
    assert!(2 * found[1][1] <= 3 * found[0][1] && found[1][1] <= 18);
}

#[test]
#[ignore = "a minute; 0.5 M cells"]
fn iterations_do_not_grow_up_to_full_size() {
    let found = [iterations([64, 56, 64], 12), iterations([128, 56, 128], 19)];
    println!("cells and iterations to 1e-4: {found:?}");
    assert!(found.iter().all(|[_, iterations]| *iterations <= 28));
}

#[test]
fn materials_walls_and_slivers() {
    let cases: [(_, fn(&mut Case), _); 10] = [
        ("PF", |_| (), 26),
        ("viscosity 1e-3", |c| c.viscosity = 1e-3, 20),
        ("viscosity 1e3", |c| c.viscosity = 1e3, 14),
        ("contrast 210", |c| c.contrast = 210.0, 31),
        ("bulk modulus 1e7", |c| c.bulk_modulus = 1e7, 15),
        ("bulk modulus 1e10", |c| c.bulk_modulus = 1e10, 26),
        ("incompressible", |c| c.bulk_modulus = f64::INFINITY, 27),
        ("frictionless", |c| c.friction = false, 28),
        ("slivers 0.02", |c| c.sliver = 0.02, 30),
        (
            "slivers, contrast",
            |c| (c.sliver, c.contrast, c.viscosity) = (0.02, 210.0, 1e2),
            35,
        ),
    ];
    for (name, change, most) in cases {
        let mut case = MEDIUM;
        change(&mut case);
        let (_, _, report) = solve(&Problem::new(&case).unwrap(), 1e-6).unwrap();
        let iterations = report.iterations();
        println!("{name}: {iterations} iterations to 1e-6");
        assert!(iterations <= most, "{name}: {iterations} > {most}");
    }
}

/// The problem with a sliver, a cell of almost no volume, behind every `every`-th face to air, with a flux area of `area`
/// faces. Such cells arise where a wall sweeps over liquid that the steps of another wall cut off on all sides but one.
fn with_swept_slivers(mut problem: Problem, every: usize, area: f64) -> Problem {
    let (cells, faces) = (problem.g.n_rows(), problem.g.n_columns());
    let sides = problem.g.transpose();
    let open: Vec<(usize, f64)> = (0..faces)
        .filter_map(|face| match sides.row(face) {
            (&[_], &[area]) => Some((face, area.signum())),
            _ => None,
        })
        .step_by(every)
        .collect();
    let g = Csr::assemble(cells + open.len(), faces, |cell, entries| {
        if let Some(&(face, sign)) = cell.checked_sub(cells).and_then(|new| open.get(new)) {
            entries.add(face, -sign * area);
            return;
        }
        let (faces, values) = problem.g.row(cell);
        for (&face, &value) in faces.iter().zip(values) {
            let wide = open.iter().any(|&(open, _)| open == face as usize);
            entries.add(face as usize, if wide { area * value } else { value });
        }
    });
    problem.g = g.unwrap();
    for &(face, _) in &open {
        problem.c.push(1e-5);
        problem.two_eta.push(2.0);
        problem.carried.push(0.0);
        problem.volume_source.push(0.5 * area * (face % 3) as f64);
    }
    problem
}

/// Slivers respond to a pressure more than a full cell. With the full viscous part of the Schur complement there, the
/// iteration stagnates, at full size up to 200 iterations.
#[test]
fn slivers_swept_by_walls_cost_few_iterations() {
    for (every, area) in [(7, 1.0), (7, 2.75), (3, 2.75), (7, 0.1)] {
        let problem = with_swept_slivers(Problem::new(&MEDIUM).unwrap(), every, area);
        let (_, p, report) = solve(&problem, 1e-3).unwrap();
        let iterations = report.iterations();
        println!("{} cells, area {area}: {iterations} iterations", p.len());
        assert!(iterations <= 25);
    }
}

#[test]
fn identical_for_any_number_of_threads() {
    let problem = Problem::new(&Case {
        contrast: 10.0,
        ..MEDIUM
    })
    .unwrap();
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap().install(|| {
            let (u, p, report) = solve(&problem, 1e-4).unwrap();
            (u, p, report.history)
        })
    };
    let one = with(1);
    assert!(one.0.len() > 3 * (1 << 14), "too small to be split");
    for threads in [2, 3] {
        assert!(one == with(threads), "{threads} threads differ");
    }
}
