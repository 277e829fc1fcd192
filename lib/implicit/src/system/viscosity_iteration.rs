//! Fixed-point iteration on the viscosity field of a liquid whose viscosity depends on the shear rate, with Anderson
//! acceleration (docs/methods.md section 3.8).

use std::collections::VecDeque;

use physics::Viscosity;

use super::viscosity::{Rates, Viscosities};

/// Bound on the iterations over all that depends on the solution; those that converge take fewer.
pub(crate) const MAX_PASSES: usize = 30;

/// Number of earlier passes that the acceleration combines with the latest one.
const DEPTH: usize = 5;
/// Residual at which the iteration ends: root mean square of the change of ln(viscosity), weighted by dissipation. It is the
/// relative error of the stresses that a flow was solved with.
const CONVERGED: f64 = 1e-3;
/// Bounds of ln(rate), 1/s: pores at rest have a finite logarithm.
const LN_RATES: [f64; 2] = [-70.0, 70.0];
/// Part of the squares added to the diagonal of the least-squares problem, which rounding to f32 makes uncertain.
const RIDGE: f64 = 1e-8;

/// The iteration on the viscosity field of a step.
pub(crate) struct ViscosityIteration {
    /// Factor on the liquid's law.
    pub(crate) factor: f64,
    /// Influence length, cells.
    pub(crate) slip: f64,
    /// The viscosities for the next solve.
    pub(crate) used: Viscosities,
    /// The latest passes, the last one first.
    passes: VecDeque<Pass>,
}

/// A solve.
struct Pass {
    /// ln(rate) of pores, edges and walls.
    ln_rates: Vec<f32>,
    /// ln of the law's viscosity at the rates of each pore and wall over that used.
    residuals: Vec<f32>,
    /// Root mean square of the residuals, weighted by dissipation.
    residual: f64,
}

impl ViscosityIteration {
    /// Starts with the viscosities `used`.
    pub(crate) fn new(factor: f64, slip: f64, used: Viscosities) -> Self {
        Self {
            factor,
            slip,
            used,
            passes: VecDeque::new(),
        }
    }

    /// Updates the viscosities by the `rates` and the dissipation (`power`) of pores and walls of the flow that was solved with
    /// them. Returns whether the iteration has converged.
    pub(crate) fn update(&mut self, law: &Viscosity, mut rates: Rates, power: &[f64]) -> bool {
        let by_law = Viscosities::of(&rates, law, self.factor, self.slip);
        let walls = by_law.walls.iter().zip(&self.used.walls);
        let pores = by_law.pores.iter().zip(&self.used.pores);
        let pairs = pores.chain(walls.map(|(by_law, used)| (&by_law[0], &used[0])));
        let residuals: Vec<f32> = pairs
            .map(|(by_law, used)| (by_law / used).ln() as f32)
            .collect();
        let all: f64 = power.iter().sum();
        let residual = (product(&residuals, &residuals, power) / all.max(f64::MIN_POSITIVE)).sqrt();
        if (self.passes.front()).is_some_and(|before| residual > before.residual) {
            // They do not tell how rates respond to viscosities here.
            self.passes.clear();
        }
        let bounded = |rate: &mut f64| rate.ln().clamp(LN_RATES[0], LN_RATES[1]) as f32;
        self.passes.push_front(Pass {
            ln_rates: rates.values_mut().map(bounded).collect(),
            residuals,
            residual,
        });
        self.passes.truncate(DEPTH + 1);
        let weights = self.weights(power);
        for (index, rate) in rates.values_mut().enumerate().filter(|of| *of.1 > 0.0) {
            let terms = weights.iter().zip(&self.passes);
            let ln_rate: f64 = terms
                .map(|(weight, pass)| weight * f64::from(pass.ln_rates[index]))
                .sum();
            *rate = ln_rate.clamp(LN_RATES[0], LN_RATES[1]).exp();
        }
        self.used = Viscosities::of(&rates, law, self.factor, self.slip);
        residual < CONVERGED
    }

    /// Weights of the passes, which add up to 1: those whose combined residual is least (Anderson 1965).
    fn weights(&self, power: &[f64]) -> Vec<f64> {
        let difference = |(new, old): (&Pass, &Pass)| -> Vec<f32> {
            let both = new.residuals.iter().zip(&old.residuals);
            both.map(|(new, old)| new - old).collect()
        };
        let older = self.passes.iter().skip(1);
        let changes: Vec<Vec<f32>> = self.passes.iter().zip(older).map(difference).collect();
        let row = |change: &Vec<f32>| -> Vec<f64> {
            let others = changes.iter().chain([&self.passes[0].residuals]);
            others.map(|other| product(change, other, power)).collect()
        };
        let parts = least_squares(changes.iter().map(row).collect());
        let mut weights = vec![0.0; self.passes.len()];
        weights[0] = 1.0;
        for (index, part) in parts.into_iter().enumerate() {
            weights[index] -= part;
            weights[index + 1] += part;
        }
        weights
    }
}

/// Scalar product with the weights `power`.
fn product(one: &[f32], other: &[f32], power: &[f64]) -> f64 {
    let terms = one.iter().zip(other).zip(power).filter(|of| *of.1 > 0.0);
    terms
        .map(|((one, other), power)| power * f64::from(*one) * f64::from(*other))
        .sum()
}

/// The solution of normal equations, each a row of the matrix and the right-hand side, by Gauss-Jordan elimination.
fn least_squares(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for (k, row) in rows.iter_mut().enumerate() {
        row[k] = (1.0 + RIDGE) * row[k] + f64::MIN_POSITIVE;
    }
    for k in 0..n {
        let pivot = rows[k].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|of| of.0 != k) {
            let factor = row[k] / pivot[k];
            (row.iter_mut().zip(&pivot)).for_each(|(value, pivot)| *value -= factor * pivot);
        }
    }
    (rows.iter().enumerate())
        .map(|(k, row)| row[n] / row[k])
        .collect()
}

#[cfg(test)]
mod tests {
    use physics::Law;

    use super::*;

    /// Stress K rate^0.04. Of three places the first two have given stresses and the last a given rate; a viscosity fixed
    /// by the flow before leaves 0.96 of an error in the first two and nothing in the last.
    #[test]
    fn given_stresses_of_a_nearly_flat_law_take_few_passes() {
        let (k, n, rates) = (2.0, 0.04, [1e-6, 1e9]);
        let law = Viscosity::Law(Law::Power { k, n, rates });
        let exact = [3.0, 50.0, 7.0_f64];
        let stress = exact.map(|rate| k * rate.powf(n));
        let used = Viscosities {
            pores: vec![0.2, 0.5, 9.0],
            ..Viscosities::default()
        };
        let mut iteration = ViscosityIteration::new(1.0, 0.0, used);
        for pass in 1.. {
            let eta = &iteration.used.pores;
            let pores = vec![stress[0] / eta[0], stress[1] / eta[1], exact[2]];
            let power: Vec<f64> = (0..3).map(|i| eta[i] * pores[i] * pores[i]).collect();
            let rates = Rates {
                pores: pores.clone(),
                ..Rates::default()
            };
            if iteration.update(&law, rates, &power) {
                // The stress is exact to the residual, the rate to 25 times that.
                let off = |i: usize| (pores[i] / exact[i]).ln().abs();
                assert!((0..3).all(|i| off(i) < 25.0 * CONVERGED), "{pores:?}");
                assert!(pass <= 4, "{pass} passes");
                return;
            }
        }
    }
}
