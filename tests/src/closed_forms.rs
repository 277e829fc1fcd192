//! Closed forms that runs are compared with. SI throughout.

/// Velocity of a film of thickness `delta` running down an incline, at distance `y` from the
/// floor, with body force `g_along` per mass along the floor (paper Eq. 5).
pub fn film(y: f64, delta: f64, g_along: f64, rho: f64, eta: f64) -> f64 {
    rho * g_along / eta * y * (delta - 0.5 * y)
}

/// Mean velocity between plates `h` apart under a body force `g` per mass, with influence
/// length `l` at both walls (plane Poiseuille flow with Navier slip).
pub fn channel_mean(h: f64, l: f64, g: f64, rho: f64, eta: f64) -> f64 {
    rho * g * h * h / (12.0 * eta) * (1.0 + 6.0 * l / h)
}

/// Liquid speed at the resting wall of a Couette flow, plates `h` apart, upper one at `v`,
/// influence length `l` at both.
pub fn couette_slip(h: f64, l: f64, v: f64) -> f64 {
    v * l / (h + 2.0 * l)
}

/// Force per unit length on a plate of half-length `a` closing at speed `v` on a gap `h`.
pub fn squeeze_plates(a: f64, h: f64, v: f64, eta: f64) -> f64 {
    8.0 * eta * v * (a / h).powi(3)
}

/// Tait pressure at relative volume `j` (paper Eq. 1).
pub fn tait(j: f64, k: f64) -> f64 {
    0.0894 * k * (((1.0 - j) / 0.0894).exp() - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        assert!((film(1.0, 1.0, 2.0, 1.0, 1.0) - 1.0).abs() < 1e-15);
        assert!((couette_slip(1.0, 0.1, 1.2) - 0.1).abs() < 1e-15);
    }
}
