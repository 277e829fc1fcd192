//! Surface tension and contact angle, which draw a liquid into a pore throat or keep it out.

/// Wetting of the walls by the liquid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wetting {
    /// Surface tension sigma, N/m.
    pub tension: f64,
    /// Contact angle theta, measured in the liquid, rad, 0 to pi. The liquid wets below a right angle.
    pub contact_angle: f64,
}

impl Wetting {
    /// Adhesion tension sigma cos(theta), N/m: the force along a wall per length of contact line. Times perimeter over area of
    /// a throat (2/r in a tube, 2/H in a slit) it is the pressure jump across a meniscus in the throat (Young 1805, Laplace
    /// 1806).
    pub fn adhesion(&self) -> f64 {
        self.tension * self.contact_angle.cos()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_right_angle_neither_draws_nor_holds() {
        for (degrees, exact) in [(0.0_f64, 0.05), (60.0, 0.025), (90.0, 0.0), (120.0, -0.025)] {
            let (tension, contact_angle) = (0.05, degrees.to_radians());
            let wetting = Wetting {
                tension,
                contact_angle,
            };
            assert!((wetting.adhesion() - exact).abs() < 1e-15, "{degrees}");
        }
    }
}
