//! Tait's law: pressure of a compressed liquid.

/// The universal Tait constant C (paper Eq. 1; Li 1967).
pub const TAIT_C: f64 = 0.0894;

/// Tait equation of state, paper Eq. 1: p = C K (exp((1 - J)/C) - 1).
///
/// The state variable is j = J - 1: at K = 1 GPa one ulp of J in f32 is 60 Pa, but one ulp of j near zero is negligible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tait {
    /// Bulk modulus at J = 1, Pa.
    pub bulk_modulus: f64,
}

impl Tait {
    /// Pressure in Pa at relative volume change `j` = J - 1.
    #[inline]
    pub fn pressure(self, j: f64) -> f64 {
        TAIT_C * self.bulk_modulus * (-j / TAIT_C).exp_m1()
    }

    /// Relative volume change J - 1 at pressure `p` in Pa; the inverse of [`Tait::pressure`].
    /// Infinite for pressures at or below the law's limit -C K, which have no J.
    #[inline]
    pub fn volume_change(self, p: f64) -> f64 {
        -TAIT_C * (p / (TAIT_C * self.bulk_modulus)).max(-1.0).ln_1p()
    }

    /// Tangent stiffness -dp/dJ = K exp(-j/C), Pa.
    #[inline]
    pub fn stiffness(self, j: f64) -> f64 {
        self.bulk_modulus * (-j / TAIT_C).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equation_1_and_its_inverse() {
        let tait = Tait { bulk_modulus: 1e9 };
        // exp(0.01/0.0894) - 1 = 0.118354..., times C K
        let by_hand = 0.0894e9 * ((0.01_f64 / 0.0894).exp() - 1.0);
        assert!((tait.pressure(-0.01) / by_hand - 1.0).abs() < 1e-12);
        for j in [-0.5, -0.1, -1e-6, 0.0, 1e-6, 0.2, 0.5] {
            let back = tait.volume_change(tait.pressure(j));
            assert!((back - j).abs() < 1e-9 * j.abs().max(1e-6), "{j} {back}");
        }
    }

    /// -dp/dJ by central differences: the bulk modulus at rest, more under compression (j < 0).
    #[test]
    fn stiffness_is_the_slope_of_the_pressure() {
        let tait = Tait { bulk_modulus: 1e9 };
        for j in [-0.2, -0.05, 0.0, 0.03, 0.1] {
            let slope = (tait.pressure(j - 1e-6) - tait.pressure(j + 1e-6)) / 2e-6;
            assert!((slope / tait.stiffness(j) - 1.0).abs() < 1e-6, "{j}");
        }
        assert_eq!(tait.stiffness(0.0), 1e9);
    }
}
