//! Viscosity laws by formula: power law, Cross, Carreau-Yasuda, Herschel-Bulkley.

use std::fmt;

use super::Rheology;

/// A viscosity law by formula. All are finite at any rate and have a stress that never falls with the
/// rate, so that a flow under a given load is one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// eta = K rate^(n - 1) between two rates, and constant outside (Ostwald 1925; de Waele 1923).
    Power {
        /// K, Pa s^n.
        consistency: f64,
        /// n.
        index: f64,
        /// Where it holds, 1/s.
        rates: [f64; 2],
    },
    /// eta = eta_inf + (eta_0 - eta_inf)/(1 + (rate time)^m) (Cross 1965).
    Cross {
        /// eta_0 and eta_inf, Pa s.
        plateaus: [f64; 2],
        /// s.
        time: f64,
        /// m.
        exponent: f64,
    },
    /// eta = eta_inf + (eta_0 - eta_inf) (1 + (rate time)^a)^((n - 1)/a) (Carreau 1972; Yasuda et al. 1981).
    CarreauYasuda {
        /// eta_0 and eta_inf, Pa s.
        plateaus: [f64; 2],
        /// s.
        time: f64,
        /// n.
        index: f64,
        /// a; 2 is Carreau's.
        transition: f64,
    },
    /// Stress (tau_y + K rate^n) (1 - exp(-rate/r)), finite at rest by the rate r (Papanastasiou 1987 in the
    /// form of Souza Mendes & Dutra 2004): below that of Herschel & Bulkley (1926) by the part exp(-rate/r).
    HerschelBulkley {
        /// tau_y, Pa.
        yield_stress: f64,
        /// K, Pa s^n.
        consistency: f64,
        /// n.
        index: f64,
        /// r, 1/s.
        regularisation: f64,
    },
}

impl Law {
    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Law::Power { .. } => "power law",
            Law::Cross { .. } => "Cross",
            Law::CarreauYasuda { .. } => "Carreau-Yasuda",
            Law::HerschelBulkley { .. } => "Herschel-Bulkley",
        }
    }

    /// Refuses parameters of which no such liquid is known, or whose stress falls with the rate.
    ///
    /// # Errors
    /// One sentence.
    pub fn check(&self) -> Result<(), String> {
        let name = self.name();
        let exponent = |what: &str, value: f64, most: f64| {
            if value > 0.0 && value <= most {
                return Ok(());
            }
            Err(format!(
                "{name}: {what} = {value} is not accepted: a number above 0 and at most {most} is needed"
            ))
        };
        let falling = |[slow, fast]: [f64; 2]| {
            if fast <= slow {
                return Ok(());
            }
            Err(format!(
                "{name}: the viscosity at infinite rate, {fast} Pa s, must not be above that at rest, {slow} Pa s"
            ))
        };
        match *self {
            Law::Power {
                index,
                rates: [from, to],
                ..
            } => {
                exponent("index", index, 1.5)?;
                if from < to {
                    return Ok(());
                }
                Err(format!(
                    "{name}: it holds from {from} 1/s to {to} 1/s: the second rate must be the larger"
                ))
            }
            Law::Cross {
                plateaus,
                exponent: m,
                ..
            } => falling(plateaus).and_then(|()| exponent("exponent", m, 1.0)),
            Law::CarreauYasuda {
                plateaus,
                index,
                transition,
                ..
            } => {
                falling(plateaus)?;
                exponent("index", index, 1.0)?;
                exponent("transition", transition, 10.0)
            }
            Law::HerschelBulkley { index, .. } => exponent("index", index, 1.0),
        }
    }
}

impl Rheology for Law {
    #[inline]
    fn viscosity(&self, rate: f64) -> f64 {
        match *self {
            Law::Power {
                consistency,
                index,
                rates: [from, to],
            } => consistency * rate.clamp(from, to).powf(index - 1.0),
            Law::Cross {
                plateaus: [slow, fast],
                time,
                exponent,
            } => fast + (slow - fast) / (1.0 + (rate * time).powf(exponent)),
            Law::CarreauYasuda {
                plateaus: [slow, fast],
                time,
                index,
                transition,
            } => {
                let bend = 1.0 + (rate * time).powf(transition);
                fast + (slow - fast) * bend.powf((index - 1.0) / transition)
            }
            Law::HerschelBulkley {
                yield_stress,
                consistency,
                index,
                regularisation,
            } => {
                let part = rate / regularisation;
                // (1 - exp(-x))/x, 1 at rest.
                let share = if part > 0.0 {
                    -(-part).exp_m1() / part
                } else {
                    1.0
                };
                (yield_stress + consistency * rate.powf(index)) * share / regularisation
            }
        }
    }

    fn breakpoints(&self) -> &[f64] {
        &[]
    }

    /// For Herschel-Bulkley a bound, of which rest has at least the part tau_y/(tau_y + K r^n).
    fn largest(&self) -> f64 {
        match *self {
            Law::Power { rates, .. } => self.viscosity(rates[0]).max(self.viscosity(rates[1])),
            Law::Cross { plateaus, .. } | Law::CarreauYasuda { plateaus, .. } => plateaus[0],
            Law::HerschelBulkley {
                yield_stress,
                consistency,
                index,
                regularisation: r,
            } => (yield_stress + consistency * r.powf(index)) / r,
        }
    }

    const CONSTANT: bool = false;
}

impl fmt::Display for Law {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, ", self.name())?;
        match *self {
            Law::Power {
                consistency,
                index,
                rates: [from, to],
            } => write!(
                f,
                "{consistency} Pa s^n, n = {index}, from {from} to {to} 1/s ({:.3e} to {:.3e} Pa s), constant outside",
                self.viscosity(from),
                self.viscosity(to)
            ),
            Law::Cross {
                plateaus: [slow, fast],
                time,
                exponent,
            } => write!(f, "{slow} to {fast} Pa s, {time} s, m = {exponent}"),
            Law::CarreauYasuda {
                plateaus: [slow, fast],
                time,
                index,
                transition,
            } => write!(
                f,
                "{slow} to {fast} Pa s, {time} s, n = {index}, a = {transition}"
            ),
            Law::HerschelBulkley {
                yield_stress,
                consistency,
                index,
                regularisation: r,
            } => write!(
                f,
                "yield stress {yield_stress} Pa, {consistency} Pa s^n, n = {index}; regularised: {:.3e} Pa s at rest, stress 0.1 % low at {:.3e} 1/s and less above",
                self.viscosity(0.0),
                -(1e-3_f64).ln() * r
            ),
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub(crate) const ALL: [Law; 4] = [
        Law::Power {
            consistency: 10.0,
            index: 0.3,
            rates: [1.0, 1e6],
        },
        Law::Cross {
            plateaus: [100.0, 0.1],
            time: 0.1,
            exponent: 0.8,
        },
        Law::CarreauYasuda {
            plateaus: [100.0, 0.1],
            time: 0.1,
            index: 0.4,
            transition: 2.0,
        },
        Law::HerschelBulkley {
            yield_stress: 50.0,
            consistency: 10.0,
            index: 0.5,
            regularisation: 0.01,
        },
    ];

    #[test]
    fn values_by_hand() {
        let [power, cross, carreau, yielding] = ALL;
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
        close(power.viscosity(100.0), 10.0 * 100_f64.powf(-0.7));
        assert_eq!(power.viscosity(0.0), 10.0);
        assert_eq!(power.viscosity(1e9), power.viscosity(1e6));
        assert_eq!(
            (cross.viscosity(0.0), carreau.viscosity(0.0)),
            (100.0, 100.0)
        );
        // At one over the time: half way, and 2^(-0.3) of it.
        close(cross.viscosity(10.0), 0.1 + 99.9 / 2.0);
        close(carreau.viscosity(10.0), 0.1 + 99.9 * 2_f64.powf(-0.3));
        // Herschel-Bulkley's own stress at 4 1/s, 50 + 10 sqrt 4.
        close(yielding.viscosity(4.0) * 4.0, 70.0);
        assert_eq!(yielding.viscosity(0.0), 5000.0);
        let low = 7.0 * 0.01;
        let lack = 1.0 - yielding.viscosity(low) * low / (50.0 + 10.0 * low.sqrt());
        assert!((lack - (-7.0_f64).exp()).abs() < 1e-12);
    }

    /// Also what the passes over the viscosity rely on.
    #[test]
    fn the_stress_grows_with_the_rate_and_the_viscosity_is_bounded() {
        for law in ALL {
            law.check().unwrap();
            let rate = |i: i32| 10_f64.powf(f64::from(i) * 0.05);
            for i in -120..160 {
                let (slow, fast) = (rate(i), rate(i + 1));
                let stress = |rate: f64| law.viscosity(rate) * rate;
                assert!(stress(slow) < stress(fast), "{law} at {slow}");
                assert!(law.viscosity(slow) <= law.largest(), "{law} at {slow}");
            }
        }
    }

    #[test]
    fn other_parameters_are_refused_in_a_sentence() {
        let [power, cross, carreau, yielding] = ALL;
        let said = |law: Law| law.check().unwrap_err();
        let mut law = power;
        if let Law::Power { rates, .. } = &mut law {
            rates.reverse();
        }
        assert!(said(law).contains("second rate"), "{}", said(law));
        for (mut law, value) in [(power, 1.6), (carreau, 0.0), (yielding, f64::NAN)] {
            match &mut law {
                Law::Power { index, .. }
                | Law::CarreauYasuda { index, .. }
                | Law::HerschelBulkley { index, .. } => *index = value,
                Law::Cross { .. } => unreachable!(),
            }
            assert!(said(law).contains("index"), "{}", said(law));
        }
        for mut law in [cross, carreau] {
            if let Law::Cross { plateaus, .. } | Law::CarreauYasuda { plateaus, .. } = &mut law {
                plateaus.reverse();
            }
            assert!(said(law).contains("infinite rate"), "{}", said(law));
        }
    }
}
