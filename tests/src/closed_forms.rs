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

/// Pressure that drives mean speed `v` through a filled length `length` of a slit of width `h`.
pub fn slit_pressure(length: f64, h: f64, v: f64, eta: f64) -> f64 {
    12.0 * eta * v * length / (h * h)
}

/// Mean velocity in a square duct of side `h` per pressure gradient over viscosity: the
/// factor of h^2 (Shah & London 1978; the series of [`duct_factor`] for a = b).
pub fn square_duct_factor() -> f64 {
    duct_factor(1.0, 1.0)
}

/// Mean velocity in a duct of sides `a` >= `b` over (G b^2 / eta), G the pressure gradient.
pub fn duct_factor(a: f64, b: f64) -> f64 {
    let sum: f64 = (0..200)
        .map(|i| f64::from(2 * i + 1))
        .map(|k| (k * std::f64::consts::PI * a / (2.0 * b)).tanh() / k.powi(5))
        .sum();
    (1.0 - 192.0 * b / (std::f64::consts::PI.powi(5) * a) * sum) / 12.0
}

/// Filled length after time `t` at constant pressure `p`, slit of width `h` (Washburn).
pub fn washburn_slit(t: f64, h: f64, p: f64, eta: f64) -> f64 {
    (p * h * h * t / (6.0 * eta)).sqrt()
}

/// Force per unit length on a plate of half-length `a` closing at speed `v` on a gap `h`.
pub fn squeeze_plates(a: f64, h: f64, v: f64, eta: f64) -> f64 {
    8.0 * eta * v * (a / h).powi(3)
}

/// Force on a disc of radius `r` closing at speed `v` on a gap `h` (Stefan, Reynolds).
pub fn squeeze_discs(r: f64, h: f64, v: f64, eta: f64) -> f64 {
    1.5 * std::f64::consts::PI * eta * r.powi(4) * v / h.powi(3)
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
        // White, Viscous Fluid Flow, table 3-1: Q = 0.1406 G b^4/(4 eta) with half side b... as
        // mean velocity over G side^2 / eta this is 0.0351.
        assert!((square_duct_factor() - 0.035_144).abs() < 1e-6);
        assert!((duct_factor(1e4, 1.0) - 1.0 / 12.0).abs() < 1e-5);
        assert!((film(1.0, 1.0, 2.0, 1.0, 1.0) - 1.0).abs() < 1e-15);
        assert!((couette_slip(1.0, 0.1, 1.2) - 0.1).abs() < 1e-15);
    }
}
