//! Surface tension and contact angle: what draws a liquid into a pore throat, or keeps it out.

/// How the liquid wets the walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wetting {
    /// Surface tension sigma, N/m.
    pub tension: f64,
    /// Contact angle theta, measured in the liquid: below a right angle it wets. Rad, 0 to pi.
    pub contact_angle: f64,
}

impl Wetting {
    /// Adhesion tension sigma cos(theta), N/m: the force along a wall of a unit of contact line. Times
    /// the perimeter over the area of a throat it is the pressure jump of a meniscus that spans it
    /// (Young 1805, Laplace 1806): 2/r in a tube, 2/H in a slit.
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
