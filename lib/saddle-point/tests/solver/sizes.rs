//! Iterations over sizes and materials; the same result with any number of threads.

use crate::pseudo_wood::{Case, Problem};
use crate::{MEDIUM, solve};

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
    assert!(2 * found[1][1] <= 3 * found[0][1] && found[1][1] <= 15);
}

#[test]
#[ignore = "a minute; 0.5 M cells"]
fn iterations_do_not_grow_up_to_full_size() {
    let found = [iterations([64, 56, 64], 12), iterations([128, 56, 128], 19)];
    println!("cells and iterations to 1e-4: {found:?}");
    assert!(found.iter().all(|[_, iterations]| *iterations <= 15));
}

#[test]
fn materials_and_walls() {
    let cases: [(_, fn(&mut Case), _); 9] = [
        ("PF", |_| (), 24),
        ("viscosity 1e-3", |c| c.viscosity = 1e-3, 20),
        ("viscosity 1e3", |c| c.viscosity = 1e3, 12),
        ("contrast 210", |c| c.contrast = 210.0, 27),
        ("bulk modulus 1e7", |c| c.bulk_modulus = 1e7, 15),
        ("bulk modulus 1e10", |c| c.bulk_modulus = 1e10, 25),
        ("incompressible", |c| c.bulk_modulus = f64::INFINITY, 25),
        ("frictionless", |c| c.friction = false, 29),
        (
            "thick, contrast",
            |c| (c.contrast, c.viscosity) = (210.0, 1e2),
            14,
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
