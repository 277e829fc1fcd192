//! Closed forms that runs are compared with. SI throughout.

use crate::numbers::last;

/// Velocity of a film of thickness `delta` running down an incline, at distance `y` from the
/// floor, with body force `g_along` per mass along the floor (paper Eq. 5).
pub(crate) fn film(y: f64, delta: f64, g_along: f64, rho: f64, eta: f64) -> f64 {
    rho * g_along / eta * y * (delta - 0.5 * y)
}

/// Velocity at distance `y` from one of two plates `h` apart under a body force `g` per mass, with
/// influence length `l` at both walls (plane Poiseuille flow with Navier slip).
pub(crate) fn channel(y: f64, h: f64, l: f64, g: f64, rho: f64, eta: f64) -> f64 {
    rho * g / (2.0 * eta) * (y * (h - y) + h * l)
}

/// Liquid speed at the resting wall of a Couette flow, plates `h` apart, upper one at `v`,
/// influence length `l` at both.
pub(crate) fn couette_slip(h: f64, l: f64, v: f64) -> f64 {
    v * l / (h + 2.0 * l)
}

/// Force per unit length on a plate of half-length `a` closing at speed `v` on a gap `h`.
pub(crate) fn squeeze_plates(a: f64, h: f64, v: f64, eta: f64) -> f64 {
    8.0 * eta * v * (a / h).powi(3)
}

/// Gap of a film between plates, `h` wide and `a` in half-length before an impulse per length of half of
/// it (force times time, N s/m) closed it: its volume stays, so that h^-5 grows with the impulse (Stefan 1874).
pub(crate) fn closing_film(h: f64, a: f64, impulse: f64, eta: f64) -> f64 {
    (h.powi(-5) + 1.25 * impulse / (eta * (a * h).powi(3))).powf(-0.2)
}

/// Force on a disc of radius `r` closing at speed `v` on a gap `h` (Stefan 1874).
pub(crate) fn squeeze_discs(r: f64, h: f64, v: f64, eta: f64) -> f64 {
    1.5 * std::f64::consts::PI * eta * v * r.powi(4) / h.powi(3)
}

/// Velocity over the distance from one of two plates `h` apart under a body force `g` per mass for a
/// viscosity that depends on the shear rate, `eta(rate)`, with a stress that grows with the rate up to
/// `fastest` (1/s): quadrature of the rate over the half gap, linear between its places.
pub(crate) fn channel_of(
    eta: impl Fn(f64) -> f64,
    fastest: f64,
    h: f64,
    g: f64,
    rho: f64,
) -> impl Fn(f64) -> f64 {
    const PARTS: usize = 4000;
    let step = 0.5 * h / PARTS as f64;
    let rate = |from_middle: f64| last(fastest, |rate| eta(rate) * rate < rho * g * from_middle);
    let mut velocity = vec![0.0];
    for i in 0..PARTS {
        let before = velocity[i];
        velocity.push(before + step * rate(0.5 * h - (i as f64 + 0.5) * step));
    }
    move |y: f64| {
        let place = (y.min(h - y) / step).clamp(0.0, PARTS as f64);
        let i = (place as usize).min(PARTS - 1);
        velocity[i] + (place - i as f64) * (velocity[i + 1] - velocity[i])
    }
}

/// Tait pressure at relative volume `j` (paper Eq. 1).
pub(crate) fn tait(j: f64, k: f64) -> f64 {
    0.0894 * k * (((1.0 - j) / 0.0894).exp() - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        assert!((film(1.0, 1.0, 2.0, 1.0, 1.0) - 1.0).abs() < 1e-15);
        let newtonian = channel_of(|_| 2.0, 1e3, 1.0, 3.0, 5.0);
        for y in [0.1, 0.3333, 0.5, 0.9] {
            let exact = channel(y, 1.0, 0.0, 3.0, 5.0, 2.0);
            assert!((newtonian(y) / exact - 1.0).abs() < 1e-6, "{y}");
        }
        // The film's own speed, from the force that it takes at that speed.
        let (h, a, eta, impulse) = (2.0, 16.0, 3.0, 1e-3);
        let speed = (h - closing_film(h, a, impulse, eta)) / impulse;
        assert!((0.5 * squeeze_plates(a, h, speed, eta) - 1.0).abs() < 1e-3);
        assert!((couette_slip(1.0, 0.1, 1.2) - 0.1).abs() < 1e-15);
    }
}
