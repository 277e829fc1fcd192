//! The linear solver on synthetic wood: against dense factorisation, over sizes, materials and
//! threads, and what it does when a system cannot be solved.

mod pseudo_wood;

use filling::solve::{
    Csr, Poisson, SaddleOptions, SaddleReport, SaddleSolver, SaddleSystem, SolveError,
};
use nalgebra::{DMatrix, DVector};
use pseudo_wood::{Case, Problem};

const SMALL: Case = Case {
    cells: [10, 14, 5],
    gap: 4,
    depth: 3,
    viscosity: 1.3,
    contrast: 1.0,
    bulk_modulus: 1e9,
    friction: true,
    sliver: 1.0,
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
    let (mut u, mut p) = (vec![0.0; problem.b.len()], vec![0.0; problem.c.len()]);
    let report = SaddleSolver::new(options(tolerance)).solve(&problem.system(), &mut u, &mut p)?;
    Ok((u, p, report))
}

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

/// `|x - y| / |y|`.
fn distance(x: &[f64], y: &[f64]) -> f64 {
    let square = |f: &dyn Fn(usize) -> f64| (0..x.len()).map(|i| f(i).powi(2)).sum::<f64>();
    (square(&|i| x[i] - y[i]) / square(&|i| y[i])).sqrt()
}

#[test]
fn agrees_with_dense_factorisation() {
    for case in [
        SMALL,
        Case {
            contrast: 210.0,
            ..SMALL
        },
        Case {
            sliver: 0.02,
            bulk_modulus: 1e7,
            ..SMALL
        },
    ] {
        let problem = Problem::new(&case).unwrap();
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
        let rhs = DVector::from_iterator(
            n + m,
            problem
                .b
                .iter()
                .copied()
                .chain(problem.volume_source.iter().map(|g| -g)),
        );
        let exact = full.lu().solve(&rhs).unwrap();
        let (u, p, report) = solve(&problem, 1e-9).unwrap();
        let errors = [
            distance(&u, exact.rows(0, n).as_slice()),
            distance(&p, exact.rows(n, m).as_slice()),
        ];
        println!(
            "{n} faces, {m} cells: {} iterations, errors {:.1e} {:.1e}",
            report.iterations(),
            errors[0],
            errors[1]
        );
        assert!(errors[0] < 1e-7 && errors[1] < 1e-7);
    }
}

#[test]
fn eigenvalue_bound_is_safe_and_tight() {
    for (contrast, sliver, viscosity) in [(1.0, 1.0, 1.3), (210.0, 1.0, 1.3), (1.0, 0.02, 1e-3)] {
        let problem = Problem::new(&Case {
            contrast,
            sliver,
            viscosity,
            ..SMALL
        })
        .unwrap();
        let a = dense(&problem.a);
        let scale = a.diagonal().map(|d| 1.0 / d.sqrt());
        let scaled = DMatrix::from_fn(a.nrows(), a.ncols(), |i, j| a[(i, j)] * scale[i] * scale[j]);
        let largest = scaled.symmetric_eigenvalues().max();
        let (_, _, report) = solve(&problem, 1e-3).unwrap();
        println!(
            "largest eigenvalue {largest:.4}, bound {:.4}",
            report.eigenvalue_bound
        );
        assert!(report.eigenvalue_bound >= largest);
        assert!(report.eigenvalue_bound < 1.25 * largest);
    }
}

#[test]
fn iterations_do_not_grow_with_the_domain() {
    let iterations = [[24, 40, 16], [32, 48, 48]].map(|cells| {
        let problem = Problem::new(&Case { cells, ..MEDIUM }).unwrap();
        let (_, p, report) = solve(&problem, 1e-4).unwrap();
        println!(
            "{} cells: {} iterations to 1e-4",
            p.len(),
            report.iterations()
        );
        assert!(report.residual() <= 1e-4);
        report.iterations()
    });
    assert!(2 * iterations[1] <= 3 * iterations[0] && iterations[1] <= 24);
}

#[test]
#[ignore = "a minute; 0.5 M cells"]
fn iterations_do_not_grow_up_to_full_size() {
    for (cells, gap) in [([64, 56, 64], 12), ([128, 56, 128], 19)] {
        let problem = Problem::new(&Case {
            cells,
            gap,
            ..MEDIUM
        })
        .unwrap();
        let (_, p, report) = solve(&problem, 1e-4).unwrap();
        println!(
            "{} cells: {} iterations to 1e-4",
            p.len(),
            report.iterations()
        );
        assert!(report.iterations() <= 26);
    }
}

#[test]
fn materials_walls_and_slivers() {
    let cases = [
        ("PF", MEDIUM, 30),
        (
            "viscosity 1e-3",
            Case {
                viscosity: 1e-3,
                ..MEDIUM
            },
            24,
        ),
        (
            "viscosity 1e3",
            Case {
                viscosity: 1e3,
                ..MEDIUM
            },
            24,
        ),
        (
            "contrast 210",
            Case {
                contrast: 210.0,
                ..MEDIUM
            },
            36,
        ),
        (
            "bulk modulus 1e7",
            Case {
                bulk_modulus: 1e7,
                ..MEDIUM
            },
            24,
        ),
        (
            "bulk modulus 1e10",
            Case {
                bulk_modulus: 1e10,
                ..MEDIUM
            },
            36,
        ),
        (
            "incompressible",
            Case {
                bulk_modulus: f64::INFINITY,
                ..MEDIUM
            },
            36,
        ),
        (
            "frictionless",
            Case {
                friction: false,
                ..MEDIUM
            },
            40,
        ),
        (
            "slivers 0.02",
            Case {
                sliver: 0.02,
                ..MEDIUM
            },
            40,
        ),
        (
            "slivers, contrast",
            Case {
                sliver: 0.02,
                contrast: 210.0,
                viscosity: 1e2,
                ..MEDIUM
            },
            75,
        ),
    ];
    for (name, case, most) in cases {
        let (_, _, report) = solve(&Problem::new(&case).unwrap(), 1e-6).unwrap();
        println!("{name}: {} iterations to 1e-6", report.iterations());
        assert!(
            report.iterations() <= most,
            "{name}: {} > {most}",
            report.iterations()
        );
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
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let (u, p, report) = solve(&problem, 1e-4).unwrap();
            let poisson = poisson(&problem, &problem.c);
            let mut psi = Vec::new();
            poisson
                .solve(&problem.volume_source, &mut psi, 1e-6, 100)
                .unwrap();
            (u, p, psi, report.history)
        })
    };
    let one = with(1);
    assert!(one.0.len() > 3 * (1 << 14), "too small to be split");
    for threads in [2, 3] {
        assert!(one == with(threads), "{threads} threads differ");
    }
}

#[test]
fn the_solution_is_its_own_guess() {
    let problem = Problem::new(&SMALL).unwrap();
    let (mut u, mut p, _) = solve(&problem, 1e-6).unwrap();
    let kept = u.clone();
    let mut solver = SaddleSolver::new(options(2e-6));
    let report = solver.solve(&problem.system(), &mut u, &mut p).unwrap();
    assert_eq!(report.iterations(), 0);
    assert_eq!(u, kept);
}

#[test]
fn failures_are_reported() {
    let problem = Problem::new(&SMALL).unwrap();
    let (mut u, mut p) = (vec![0.0; problem.b.len()], vec![0.0; problem.c.len()]);
    let few = SaddleOptions {
        max_iterations: 3,
        ..options(1e-8)
    };
    match SaddleSolver::new(few).solve(&problem.system(), &mut u, &mut p) {
        Err(SolveError::NotConverged {
            iterations: 3,
            residual,
            ..
        }) => {
            println!("residual after 3 iterations {residual:.2e}");
            assert!((1e-8..0.5).contains(&residual));
        }
        other => panic!("{other:?}"),
    }
    let mut solver = SaddleSolver::new(options(1e-3));
    let mut b = problem.b.clone();
    b[7] = f64::NAN;
    let system = SaddleSystem {
        b: &b,
        ..problem.system()
    };
    let error = solver.solve(&system, &mut u, &mut p).unwrap_err();
    assert_eq!(error, SolveError::NotFinite { row: 7 });

    let negative = Csr::assemble(problem.b.len(), problem.b.len(), |row, entries| {
        entries.add(row, if row == 11 { -1.0 } else { 1.0 });
    });
    let system = SaddleSystem {
        a: &negative.unwrap(),
        ..problem.system()
    };
    let error = solver.solve(&system, &mut u, &mut p).unwrap_err();
    assert!(error.to_string().contains("row 11"), "{error}");

    let error = solver
        .solve(&problem.system(), &mut u[1..], &mut p)
        .unwrap_err();
    assert!(matches!(
        error,
        SolveError::Length {
            what: "velocities",
            ..
        }
    ));
}

fn poisson(problem: &Problem, c: &[f64]) -> Poisson {
    let weight: Vec<f64> = problem.friction.iter().map(|d| 1.0 / d).collect();
    Poisson::new(&problem.g, &problem.g.transpose(), &weight, c).unwrap()
}

/// `L psi` from the factors of `L`.
fn poisson_times(problem: &Problem, c: &[f64], psi: &[f64]) -> Vec<f64> {
    let mut flow = vec![0.0; problem.b.len()];
    problem.g.transpose().multiply(psi, &mut flow);
    for (flow, friction) in flow.iter_mut().zip(&problem.friction) {
        *flow /= friction;
    }
    let mut out = vec![0.0; c.len()];
    problem.g.multiply(&flow, &mut out);
    out.iter()
        .zip(psi)
        .zip(c)
        .map(|((out, psi), c)| out + c * psi)
        .collect()
}

#[test]
fn poisson_converges_at_a_rate_independent_of_size() {
    let iterations = [[24, 40, 16], [32, 48, 48]].map(|cells| {
        let problem = Problem::new(&Case { cells, ..MEDIUM }).unwrap();
        let no_c = vec![0.0; problem.c.len()];
        let rhs: Vec<f64> = (0..no_c.len())
            .map(|i| (i as f64 * 0.7).sin() + 0.3)
            .collect();
        let mut psi = Vec::new();
        let iterations = poisson(&problem, &no_c)
            .solve(&rhs, &mut psi, 1e-8, 100)
            .unwrap();
        let error = distance(&poisson_times(&problem, &no_c, &psi), &rhs);
        println!(
            "{} cells: {iterations} cycles to 1e-8, residual {error:.1e}",
            rhs.len()
        );
        assert!(error < 2e-8);
        iterations
    });
    assert!(2 * iterations[1] <= 3 * iterations[0] && iterations[1] < 40);
}

/// Two rows of cells, the first closed, the second open at its end.
fn pockets(closed: usize, open: usize) -> (Csr<f64>, Vec<f64>) {
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
    (g.unwrap(), vec![1.0; cells])
}

#[test]
fn closed_pockets_take_only_the_solvable_part() {
    let (closed, open) = (700, 900);
    let (g, weight) = pockets(closed, open);
    let poisson = Poisson::new(&g, &g.transpose(), &weight, &vec![0.0; closed + open]).unwrap();
    let rhs: Vec<f64> = (0..closed + open).map(|i| 1.0 + (i as f64).cos()).collect();
    let mut psi = Vec::new();
    let iterations = poisson.solve(&rhs, &mut psi, 1e-8, 200).unwrap();
    let mean = psi[..closed].iter().sum::<f64>() / closed as f64;
    let removed = rhs[..closed].iter().sum::<f64>() / closed as f64;
    let mut flow = vec![0.0; closed + open];
    g.transpose().multiply(&psi, &mut flow);
    let mut out = vec![0.0; closed + open];
    g.multiply(&flow, &mut out);
    let wanted: Vec<f64> = (rhs.iter().enumerate())
        .map(|(i, r)| if i < closed { r - removed } else { *r })
        .collect();
    println!("{iterations} cycles, mean of the pocket {mean:.1e}");
    assert!(distance(&out, &wanted) < 1e-7);
    assert!(mean.abs() < 1e-9 * psi[closed..].iter().fold(0.0, |m: f64, v| m.max(v.abs())));
}

#[test]
fn a_sealed_incompressible_pocket_fails_and_a_compressible_one_does_not() {
    let (g, friction) = pockets(20, 20);
    let a = Csr::assemble(40, 40, |row, entries| entries.add(row, 2.0)).unwrap();
    let (b, source) = (vec![0.0; 40], vec![0.1; 40]);
    let run = |c: f64| {
        let (mut u, mut p) = (vec![0.0; 40], vec![0.0; 40]);
        let system = SaddleSystem {
            a: &a,
            g: &g,
            c: &[c; 40],
            friction: &friction,
            two_eta: &[2.0; 40],
            b: &b,
            volume_source: &source,
        };
        let result = SaddleSolver::new(options(1e-6)).solve(&system, &mut u, &mut p);
        assert!(u.iter().chain(&p).all(|v| v.is_finite()));
        result.map(|_| p)
    };
    let p = run(1e-4).unwrap();
    let mean = p[..20].iter().sum::<f64>() / 20.0;
    println!("pressure of the sealed pocket {mean:.1}, source over compressibility 1000");
    assert!((mean / 1000.0 - 1.0).abs() < 1e-3);
    let error = run(0.0).unwrap_err();
    println!("{error}");
    assert!(matches!(error, SolveError::NotConverged { residual, .. } if residual > 0.1));
}
