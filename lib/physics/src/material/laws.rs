//! Viscosity laws by formula: power law, Cross, Carreau-Yasuda, Herschel-Bulkley.

use std::fmt;

use super::Rheology;

/// A viscosity law by formula; parameters have the symbols of the formula. All laws are finite at any rate, and their stress
/// never falls with the rate, so that the flow under a given load is unique.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// eta = K rate^(n - 1) between two rates, and constant outside (Ostwald 1925; de Waele 1923).
    Power {
        /// K, Pa s^n.
        k: f64,
        /// n.
        n: f64,
        /// Range of rates, 1/s.
        rates: [f64; 2],
    },
    /// eta = eta_inf + (eta_0 - eta_inf)/(1 + (rate time)^m) (Cross 1965).
    Cross {
        /// eta_0 and eta_inf, Pa s.
        eta: [f64; 2],
        /// s.
        time: f64,
        /// m.
        m: f64,
    },
    /// eta = eta_inf + (eta_0 - eta_inf) (1 + (rate time)^a)^((n - 1)/a) (Carreau 1972; Yasuda et al. 1981).
    CarreauYasuda {
        /// eta_0 and eta_inf, Pa s.
        eta: [f64; 2],
        /// s.
        time: f64,
        /// n.
        n: f64,
        /// a; 2 is Carreau's.
        a: f64,
    },
    /// Stress (tau_y + K rate^n) (1 - exp(-rate/r)), regularised by the rate r (Papanastasiou 1987 in the form of Souza Mendes
    /// & Dutra 2004). It is below that of Herschel & Bulkley (1926) by the fraction exp(-rate/r).
    HerschelBulkley {
        /// tau_y, Pa.
        tau: f64,
        /// K, Pa s^n.
        k: f64,
        /// n.
        n: f64,
        /// r, 1/s.
        r: f64,
    },
}

impl Law {
    /// Name of the law.
    pub fn name(&self) -> &'static str {
        match self {
            Law::Power { .. } => "power law",
            Law::Cross { .. } => "Cross",
            Law::CarreauYasuda { .. } => "Carreau-Yasuda",
            Law::HerschelBulkley { .. } => "Herschel-Bulkley",
        }
    }

    /// Refuses implausible parameters, and those whose stress falls with the rate.
    ///
    /// # Errors
    /// One sentence.
    pub fn check(&self) -> Result<(), String> {
        let name = self.name();
        // Exponents with their largest values, and viscosities at rest and at infinite rate.
        let (exponents, plateaus) = match *self {
            Law::Power { n, .. } => (vec![("index", n, 1.5)], None),
            Law::Cross { eta, m, .. } => (vec![("exponent", m, 1.0)], Some(eta)),
            Law::CarreauYasuda { eta, n, a, .. } => {
                (vec![("index", n, 1.0), ("transition", a, 10.0)], Some(eta))
            }
            Law::HerschelBulkley { n, .. } => (vec![("index", n, 1.0)], None),
        };
        let falls = |[slow, fast]: &[f64; 2]| fast <= slow;
        if let Some([slow, fast]) = plateaus.filter(|eta| !falls(eta)) {
            return Err(format!(
                "{name}: the viscosity at infinite rate, {fast} Pa s, must not be above that at rest, {slow} Pa s"
            ));
        }
        let odd = |(_, value, most): &(&str, f64, f64)| !(*value > 0.0 && value <= most);
        if let Some((what, value, most)) = exponents.into_iter().find(odd) {
            return Err(format!(
                "{name}: {what} = {value} is not accepted: a number above 0 and at most {most} is needed"
            ));
        }
        let [from, to] = match *self {
            Law::Power { rates, .. } => rates,
            _ => return Ok(()),
        };
        if from < to {
            return Ok(());
        }
        Err(format!(
            "{name}: its rates are {from} and {to} 1/s, but the second must be larger"
        ))
    }
}

impl Rheology for Law {
    #[inline]
    fn viscosity(&self, rate: f64) -> f64 {
        match *self {
            Law::Power { k, n, rates } => k * rate.clamp(rates[0], rates[1]).powf(n - 1.0),
            Law::Cross { eta, time, m } => {
                let [slow, fast] = eta;
                fast + (slow - fast) / (1.0 + (rate * time).powf(m))
            }
            Law::CarreauYasuda { eta, time, n, a } => {
                let [slow, fast] = eta;
                let bend = 1.0 + (rate * time).powf(a);
                fast + (slow - fast) * bend.powf((n - 1.0) / a)
            }
            Law::HerschelBulkley { tau, k, n, r } => {
                let part = rate / r;
                // (1 - exp(-x))/x, 1 at rest.
                let share = match part > 0.0 {
                    true => -(-part).exp_m1() / part,
                    false => 1.0,
                };
                (tau + k * rate.powf(n)) * share / r
            }
        }
    }

    fn breakpoints(&self) -> &[f64] {
        &[]
    }

    /// For Herschel-Bulkley an upper bound; the viscosity at rest is at least the fraction tau_y/(tau_y + K r^n) of it.
    fn largest(&self) -> f64 {
        match *self {
            Law::Power { rates, .. } => self.viscosity(rates[0]).max(self.viscosity(rates[1])),
            Law::Cross { eta, .. } | Law::CarreauYasuda { eta, .. } => eta[0],
            Law::HerschelBulkley { tau, k, n, r } => (tau + k * r.powf(n)) / r,
        }
    }

    const CONSTANT: bool = false;
}

impl fmt::Display for Law {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, ", self.name())?;
        let at = |rate| self.viscosity(rate);
        match *self {
            Law::Power { k, n, rates } => {
                let ([from, to], [slow, fast]) = (rates, rates.map(at));
                write!(f, "{k} Pa s^n, n = {n}, from {from} to {to} 1/s ")?;
                write!(f, "({slow:.3e} to {fast:.3e} Pa s), constant outside")
            }
            Law::Cross { eta, time, m } => {
                write!(f, "{} to {} Pa s, {time} s, m = {m}", eta[0], eta[1])
            }
            Law::CarreauYasuda { eta, time, n, a } => {
                write!(
                    f,
                    "{} to {} Pa s, {time} s, n = {n}, a = {a}",
                    eta[0], eta[1]
                )
            }
            Law::HerschelBulkley { tau, k, n, r } => {
                let (rest, low) = (at(0.0), -(1e-3_f64).ln() * r);
                write!(
                    f,
                    "yield stress {tau} Pa, {k} Pa s^n, n = {n}; regularised: {rest:.3e} Pa s "
                )?;
                write!(
                    f,
                    "at rest, stress 0.1 % low at {low:.3e} 1/s and less above"
                )
            }
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub(crate) const ALL: [Law; 4] = [
        Law::Power {
            k: 10.0,
            n: 0.3,
            rates: [1.0, 1e6],
        },
        Law::Cross {
            eta: [100.0, 0.1],
            time: 0.1,
            m: 0.8,
        },
        Law::CarreauYasuda {
            eta: [100.0, 0.1],
            time: 0.1,
            n: 0.4,
            a: 2.0,
        },
        Law::HerschelBulkley {
            tau: 50.0,
            k: 10.0,
            n: 0.5,
            r: 0.01,
        },
    ];

    #[test]
    fn values_by_hand() {
        let [power, cross, carreau, yielding] = ALL;
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
        close(power.viscosity(100.0), 10.0 * 100_f64.powf(-0.7));
        assert_eq!(power.viscosity(0.0), 10.0);
        assert_eq!(power.viscosity(1e9), power.viscosity(1e6));
        assert_eq!([cross, carreau].map(|law| law.viscosity(0.0)), [100.0; 2]);
        // At a rate of 1/time: half way between the plateaus, and 2^(-0.3) of the way.
        close(cross.viscosity(10.0), 0.1 + 99.9 / 2.0);
        close(carreau.viscosity(10.0), 0.1 + 99.9 * 2_f64.powf(-0.3));
        // Herschel-Bulkley's own stress at 4 1/s, 50 + 10 sqrt 4.
        close(yielding.viscosity(4.0) * 4.0, 70.0);
        assert_eq!(yielding.viscosity(0.0), 5000.0);
        let low = 7.0 * 0.01;
        let lack = 1.0 - yielding.viscosity(low) * low / (50.0 + 10.0 * low.sqrt());
        assert!((lack - (-7.0_f64).exp()).abs() < 1e-12);
    }

    /// The iterations over the viscosity rely on both.
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
        for (mut law, value, sentence) in [
            (power, 1.6, "index"),
            (carreau, 0.0, "index"),
            (yielding, f64::NAN, "index"),
            (power, 0.5, "second must be larger"),
            (cross, 0.5, "infinite rate"),
            (carreau, 0.5, "infinite rate"),
        ] {
            match &mut law {
                Law::Power { rates, .. } if sentence != "index" => rates.reverse(),
                Law::Cross { eta, .. } | Law::CarreauYasuda { eta, .. } if sentence != "index" => {
                    eta.reverse();
                }
                Law::Power { n, .. }
                | Law::CarreauYasuda { n, .. }
                | Law::HerschelBulkley { n, .. } => *n = value,
                Law::Cross { .. } => unreachable!(),
            }
            let said = law.check().unwrap_err();
            assert!(said.contains(sentence), "{said}");
        }
    }
}
