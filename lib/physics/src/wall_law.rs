//! Shear stress between liquid and wall.

use crate::{Choice, Rheology};

/// Law of the shear stress between liquid and wall (paper Eq. 3):
/// tau_w = k eta(k dv) dv, with k = 1/(influence length).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WallLaw {
    /// k = 0.
    Frictionless,
    /// 0 < k < infinity.
    PartialSlip {
        /// 1/k, m.
        influence_length_m: f64,
    },
    /// k -> infinity.
    Stick,
}

impl Choice for WallLaw {
    const NAMED: &'static [(&'static str, Self)] = &[
        ("frictionless", Self::Frictionless),
        (
            "partial-slip",
            Self::PartialSlip {
                influence_length_m: 0.0,
            },
        ),
        ("stick", Self::Stick),
    ];
}

impl WallLaw {
    /// Fraction of the sliding velocity that remains after an implicit wall impulse.
    ///
    /// With the sliding speed `slip` (m/s) before the impulse, the stick impulse S = m slip
    /// and the coefficient `a` = k A dt / m (per Pa s) this is the smallest x in (0, 1] with
    /// x (1 + a eta(x k slip)) = 1. Smallest, because a table that is not monotone in stress
    /// (paper Table 1) can have several and the choice must be deterministic. `area_dt_over_mass`
    /// is A dt / m in m2 s/kg.
    #[inline]
    pub fn remaining_slip<R: Rheology>(self, law: &R, slip: f64, area_dt_over_mass: f64) -> f64 {
        match self {
            WallLaw::Frictionless => 1.0,
            WallLaw::Stick => 0.0,
            WallLaw::PartialSlip { influence_length_m } => {
                let k = 1.0 / influence_length_m;
                lowest_root(law, k * slip, k * area_dt_over_mass)
            }
        }
    }

    /// 1/k in m, for laws in series with a resolved layer: 0 for stick, infinite without friction.
    pub fn influence_length(self) -> f64 {
        match self {
            WallLaw::Frictionless => f64::INFINITY,
            WallLaw::PartialSlip { influence_length_m } => influence_length_m,
            WallLaw::Stick => 0.0,
        }
    }
}

/// Smallest x in (0, 1] with x (1 + a eta(x rate)) = 1.
fn lowest_root<R: Rheology>(law: &R, rate: f64, a: f64) -> f64 {
    if R::CONSTANT {
        return 1.0 / (1.0 + a * law.viscosity(rate));
    }
    let excess = |x: f64| x * (1.0 + a * law.viscosity(x * rate)) - 1.0;
    // Below the first and above the last breakpoint the viscosity is constant.
    let constant = |beyond: f64| 1.0 / (1.0 + a * law.viscosity(beyond));
    let breakpoints = law.breakpoints();
    let (Some(&first), Some(&last)) = (breakpoints.first(), breakpoints.last()) else {
        // The root is unique, as the stress grows with the rate.
        let least = 1.0 / (1.0 + a * law.largest());
        return bracketed(excess, (least, excess(least)), (1.0, excess(1.0)));
    };
    let slow = constant(first);
    if slow * rate <= first {
        return slow;
    }
    let (mut low, mut at_low) = (first / rate, excess(first / rate));
    for &breakpoint in &breakpoints[1..] {
        let high = (breakpoint / rate).min(1.0);
        let at_high = excess(high);
        if at_high >= 0.0 {
            return bracketed(excess, (low, at_low), (high, at_high));
        }
        (low, at_low) = (high, at_high);
    }
    constant(last)
}

/// The root between `low`, where `excess` is negative, and `high`, where it is not, by the
/// Illinois variant of false position (Dowell & Jarratt 1971, 10.1007/BF01934364).
fn bracketed(
    excess: impl Fn(f64) -> f64,
    (mut low, mut at_low): (f64, f64),
    (mut high, mut at_high): (f64, f64),
) -> f64 {
    let mut side = 0;
    for _ in 0..100 {
        if high - low <= 1e-13 * high || at_high == 0.0 {
            break;
        }
        let x = (low * at_high - high * at_low) / (at_high - at_low);
        let at_x = excess(x);
        if at_x < 0.0 {
            (low, at_low) = (x, at_x);
            if side == -1 {
                at_high *= 0.5;
            }
            side = -1;
        } else {
            (high, at_high) = (x, at_x);
            if side == 1 {
                at_low *= 0.5;
            }
            side = 1;
        }
        if at_x.abs() < 1e-12 {
            return x;
        }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Newtonian;

    /// 1/k, m.
    const LENGTH: f64 = 0.029e-6;
    const PARTIAL: WallLaw = WallLaw::PartialSlip {
        influence_length_m: LENGTH,
    };

    #[test]
    fn newtonian_has_the_closed_form() {
        let newtonian = 1.0 / (1.0 + 1.3 * 1e-7 / LENGTH);
        for (law, exact) in [
            (PARTIAL, newtonian),
            (WallLaw::Stick, 0.0),
            (WallLaw::Frictionless, 1.0),
        ] {
            let left = law.remaining_slip(&Newtonian(1.3), 0.5, 1e-7);
            assert!((left - exact).abs() < 1e-14, "{law:?}: {left}");
        }
    }

    /// The remaining slip, and the residual of the law at any slip.
    fn solved<R: Rheology>(law: &R, slip: f64, dose: f64) -> (f64, impl Fn(f64) -> f64) {
        let (rate, a) = (slip / LENGTH, dose / LENGTH);
        let excess = move |x: f64| x * (1.0 + a * law.viscosity(x * rate)) - 1.0;
        (PARTIAL.remaining_slip(law, slip, dose), excess)
    }

    #[test]
    fn the_root_satisfies_the_law_and_is_the_lowest() {
        let table = crate::material::test_table();
        for slip in [1e-9, 1e-7, 1e-6, 1e-5, 1e-3, 1.0] {
            for dose in [1e-12, 1e-10, 1e-9, 1e-8, 1e-6] {
                let (x, excess) = solved(&table, slip, dose);
                let off = excess(x).abs();
                assert!(x > 0.0 && x <= 1.0, "{x}");
                assert!(
                    off < 1e-9 * (1.0 + dose / LENGTH * 210.0),
                    "{slip} {dose}: {off}"
                );
                let mut lower = (1..2000).map(|i| x * 0.999 * f64::from(i) / 2000.0);
                assert!(
                    lower.all(|y| excess(y) < 0.0),
                    "a lower root at {slip} {dose}"
                );
            }
        }
    }

    #[test]
    fn a_law_by_formula_has_one_root() {
        for formula in crate::material::TEST_LAWS {
            for slip in [0.0, 1e-9, 1e-5, 1.0] {
                for dose in [1e-12, 1e-9, 1e-6] {
                    let (x, excess) = solved(&formula, slip, dose);
                    let off = excess(x);
                    assert!(
                        off.abs() < 1e-9,
                        "{formula}: slip {slip} dose {dose}: {off}"
                    );
                }
            }
        }
    }

    /// Plain false position keeps one end of the bracket and needs 34 evaluations instead of 11.
    #[test]
    fn the_root_is_found_in_few_evaluations() {
        let count = std::cell::Cell::new(0);
        let excess = |x: f64| {
            count.set(count.get() + 1);
            x.powi(5) - 0.3
        };
        let x = bracketed(excess, (0.0, -0.3), (1.0, 0.7));
        assert!((x - 0.3_f64.powf(0.2)).abs() < 1e-11, "{x}");
        assert!(count.get() <= 15, "{} evaluations", count.get());
    }
}
