//! Fixed-point iteration on the viscosity field of a liquid whose viscosity depends on the shear rate, accelerated by the
//! response of the rates to the last change of the viscosity (docs/methods.md section 3.8).

use physics::Liquid;
use rayon::prelude::*;

use super::viscosity::{Rates, Viscosities, WallShear};

/// Bound on the iterations over all that depends on the solution; those that converge take fewer.
pub(crate) const MAX_PASSES: usize = 30;

/// Largest |ln| of the factor by which a rate is extrapolated, and the tolerance to which it is solved.
const MAX_EXPONENT: f64 = 30.0;
const EXPONENT_TOLERANCE: f64 = 0.05 * CONVERGED;
/// Mean change of ln(viscosity), weighted by dissipation, at which the iteration ends. A smaller one says nothing of the
/// response.
const CONVERGED: f64 = 2e-3;

/// The iteration on the viscosity field of a step.
pub(crate) struct ViscosityIteration {
    /// Factor on the liquid's law.
    pub(crate) factor: f64,
    /// Influence length, cells.
    pub(crate) slip: f64,
    /// The viscosities for the next solve.
    pub(crate) used: Viscosities,
    previous: Option<Evaluation>,
    /// d ln(rate)/d ln(viscosity), estimated.
    response: f64,
}

impl ViscosityIteration {
    /// Starts with the viscosities `used`.
    pub(crate) fn new(factor: f64, slip: f64, used: Viscosities) -> Self {
        Self {
            factor,
            slip,
            used,
            previous: None,
            response: 0.0,
        }
    }

    /// Updates the viscosities by the `rates` and the dissipation (`power`) of each pore of the flow that was solved with
    /// them. Returns whether the iteration has converged.
    pub(crate) fn update(&mut self, liquid: &Liquid, rates: Rates, power: Vec<f64>) -> bool {
        let by_law = Viscosities::of(&rates, liquid, self.factor, self.slip);
        let used = std::mem::take(&mut self.used);
        let latest = Evaluation { used, rates, power };
        let converged = latest.change(&by_law) < CONVERGED;
        self.used = match &self.previous {
            Some(before) => {
                self.response = latest.response(before, self.response);
                latest.extrapolated(liquid, self.factor, self.slip, self.response)
            }
            None => by_law,
        };
        self.previous = Some(latest);
        converged
    }
}

/// The viscosities used in a solve, and the rates of the resulting flow.
struct Evaluation {
    used: Viscosities,
    rates: Rates,
    /// Dissipation of each pore.
    power: Vec<f64>,
}

impl Evaluation {
    /// Mean change of ln(viscosity) from those used to those of the `law` at the rates, weighted by dissipation.
    fn change(&self, law: &Viscosities) -> f64 {
        let mut sums = [0.0; 2];
        for (pore, &power) in self.power.iter().enumerate().filter(|at| *at.1 > 0.0) {
            sums[0] += power * (law.pores[pore] / self.used.pores[pore]).ln().abs();
            sums[1] += power;
        }
        match sums[1] > 0.0 {
            true => sums[0] / sums[1],
            false => 0.0,
        }
    }

    /// Response d ln(rate)/d ln(viscosity) from the solve `before` to this one, weighted by dissipation: -1 where the stress
    /// is given, 0 where the speed is. Parts of a flow differ, and one solve shows those that it changed most, so the result
    /// is the mean of the new estimate and the `previous` one.
    fn response(&self, before: &Self, previous: f64) -> f64 {
        let (mut covariance, mut variance, mut weight) = (0.0, 0.0, 0.0);
        for (pore, &power) in self.power.iter().enumerate().filter(|at| *at.1 > 0.0) {
            let [old, new] = [before, self].map(|of| [of.used.pores[pore], of.rates.pores[pore]]);
            if old[1] > 0.0 {
                let [eta, rate] = [0, 1].map(|i| (new[i] / old[i]).ln());
                covariance += power * eta * rate;
                variance += power * eta * eta;
                weight += power;
            }
        }
        match variance > CONVERGED * CONVERGED * weight {
            true => 0.5 * (previous + (covariance / variance).clamp(-1.0, 0.0)),
            false => previous,
        }
    }

    /// Extrapolated viscosities: those of the law of `liquid`, times `factor`, at rates that change with the power
    /// `response` of the viscosity. Exact in a channel under a given pressure drop, where plain fixed-point iteration (a
    /// response of 0) converges slowly, and hardly at all for a yielding liquid.
    fn extrapolated(&self, liquid: &Liquid, factor: f64, slip: f64, response: f64) -> Viscosities {
        let law = &liquid.viscosity;
        let of = |rate: f64, used: f64| {
            let at = |rate: f64| (factor * law.at(rate)).ln();
            match rate > 0.0 {
                true => self_consistent(at, used.ln(), rate, response).exp(),
                false => factor * law.at(rate),
            }
        };
        let each = |rates: &[f64], used: &[f64]| -> Vec<f64> {
            let each = rates.par_iter().zip(used);
            each.map(|(&rate, &used)| of(rate, used)).collect()
        };
        let walls = self.rates.walls.par_iter().zip(&self.used.walls);
        let wall = |(wall, used): (&WallShear, &[f64; 2])| {
            let share = wall.thinning_factor(law, slip);
            [share * of(share * wall.rate, used[0] / share); 2]
        };
        Viscosities {
            pores: each(&self.rates.pores, &self.used.pores),
            edges: each(&self.rates.edges, &self.used.edges),
            walls: walls.map(wall).collect(),
        }
    }
}

/// Solves x = ln eta(rate exp(response (x - used))) for x, ln(viscosity), by the Illinois variant of false position in the
/// exponent. The stress must not fall with the rate.
fn self_consistent(ln_eta: impl Fn(f64) -> f64, used: f64, rate: f64, response: f64) -> f64 {
    let at = |exponent: f64| ln_eta(rate * exponent.exp());
    let excess = |exponent: f64| exponent - response * (at(exponent) - used);
    let (mut low, mut at_low) = (0.0, excess(0.0));
    if at_low.abs() <= EXPONENT_TOLERANCE {
        return at(-at_low);
    }
    // The excess grows with the exponent: the root lies on the side it points away from.
    let mut high = -at_low;
    let mut at_high = excess(high);
    while at_high * at_low > 0.0 && high.abs() < MAX_EXPONENT {
        (low, at_low) = (high, at_high);
        high *= 2.0;
        at_high = excess(high);
    }
    if at_high * at_low > 0.0 {
        return at(high);
    }
    while (high - low).abs() > EXPONENT_TOLERANCE {
        let next = (low * at_high - high * at_low) / (at_high - at_low);
        let found = excess(next);
        if found.abs() <= EXPONENT_TOLERANCE * EXPONENT_TOLERANCE {
            return at(next);
        }
        if found * at_high < 0.0 {
            (low, at_low) = (high, at_high);
        } else {
            at_low *= 0.5;
        }
        (high, at_high) = (next, found);
    }
    at(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// eta = rate^-0.7: under a given stress eta rate = 2, from a viscosity of 1 and so a rate of 2.
    #[test]
    fn a_given_stress_has_its_viscosity_at_once() {
        let ln_eta = |rate: f64| -0.7 * rate.ln();
        let eta = self_consistent(ln_eta, 0.0, 2.0, -1.0).exp();
        // rate^0.3 = 2
        let rate = 2_f64.powf(1.0 / 0.3);
        assert!((eta / rate.powf(-0.7) - 1.0).abs() < 1e-3, "{eta}");
        let of_the_rate = self_consistent(ln_eta, 0.0, 2.0, 0.0).exp();
        assert!((of_the_rate / 2_f64.powf(-0.7) - 1.0).abs() < 1e-12);
    }

    /// A law whose stress is nearly constant: the solution, a rate of e^999, lies beyond the largest exponent.
    #[test]
    fn no_rate_is_sought_beyond_thirteen_decades() {
        let ln_eta = |rate: f64| -0.999 * rate.ln();
        let found = self_consistent(ln_eta, 0.0, std::f64::consts::E, -1.0);
        assert!(
            (found + 0.999 * (1.0 + 0.999 * 32.0)).abs() < 1e-9,
            "{found}"
        );
    }
}
