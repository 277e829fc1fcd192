//! The multigrid solver of the pressure operator.

use saddle_point::Poisson;

use crate::pseudo_wood::{Case, Problem};
use crate::{MEDIUM, distance, pockets};

pub fn poisson(problem: &Problem, c: &[f64]) -> Poisson {
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
    assert!(2 * iterations[1] <= 3 * iterations[0] && iterations[1] < 31);
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
