//! Effective wall distance of a non-Newtonian liquid (docs/methods.md section 3.8).

use physics::Viscosity;

/// Width, cells, beyond which the Newtonian distance is used: the correction falls with the width, its cost grows.
const MAX_WIDTH: f64 = 60.0;
/// Lower bound on the distance over that of a Newtonian liquid, which keeps friction finite beside low rows.
const MIN_RATIO: f64 = 0.02;

/// Effective distance of a face from its wall, cells, for a liquid whose rate goes with the power `p` of its stress.
/// `distance` is that of a Newtonian liquid, `width` the width H of the slit, `first` the distance h1 of the first edge from
/// the wall, cells.
///
/// Derivation. In a slit the stress falls linearly from the wall to the middle, and the rate is (1 - 2 y/H)^p of the wall's.
/// Faces differ by the rate at the edge between them, at y = h1, h1 + 1, ... < H/2, times their distance, w = (h1 + 1)/2 at
/// the first edge and 1 at others; the flux that follows is that of the profile, the wall's rate times (H/2)^2/(p + 2) on
/// each side, if
///
/// d(p) = H/(2 (p + 2)) - sum over edges of w (1 - 2 y/H)^(p + 1),
///
/// which for p = 1 is d_w of section 3.5. Returned is `distance` d(p)/d(1).
pub(super) fn thinning_distance(distance: f64, width: f64, first: f64, p: f64) -> f64 {
    if width > MAX_WIDTH {
        return distance;
    }
    let of = |p: f64| {
        let (mut sum, mut y, mut spacing) = (0.0, first, 0.5 * (first + 1.0));
        while 2.0 * y < width {
            sum += spacing * (1.0 - 2.0 * y / width).powf(p + 1.0);
            (y, spacing) = (y + 1.0, 1.0);
        }
        0.5 * width / (p + 2.0) - sum
    };
    distance * (of(p) / of(1.0)).max(MIN_RATIO)
}

/// d ln(rate)/d ln(stress) of a law at a rate, 1/s; infinite at a yield stress.
pub(super) fn steepness(law: &Viscosity, rate: f64) -> f64 {
    /// Ratio of the two rates of the difference quotient: a smaller one is lost in rounding, a larger one misses curvature.
    const RATE_RATIO: f64 = 1.01;
    let index = 1.0 + (law.at(RATE_RATIO * rate) / law.at(rate)).ln() / RATE_RATIO.ln();
    1.0 / index.max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Flux through half a slit of `n` cells whose first edge lies `first` from the wall, per rate at the wall.
    #[test]
    fn the_flux_between_plates_is_that_of_the_profile() {
        for (n, first) in [(2, 1.0), (3, 1.0), (6, 1.0), (12, 1.0), (3, 0.5), (6, 0.5)] {
            let width = f64::from(n);
            let edges = |p: f64| {
                let mut edges = vec![(first, 0.5 * (first + 1.0))];
                edges.extend((1..n).map(|j| (first + f64::from(j), 1.0)));
                edges.retain(|edge| 2.0 * edge.0 < width);
                let step =
                    |&(y, spacing): &(f64, f64)| (y, spacing * (1.0 - 2.0 * y / width).powf(p));
                edges.iter().map(step).collect::<Vec<_>>()
            };
            let flux = |wall: f64, p: f64| {
                // Velocity of the cells from each edge on, times what is left of the half slit there.
                let beyond = |(y, step): (f64, f64)| step * (0.5 * width - y);
                wall * 0.5 * width + edges(p).into_iter().map(beyond).sum::<f64>()
            };
            let exact = |p: f64| 0.25 * width * width / (p + 2.0);
            let newtonian = (exact(1.0) - flux(0.0, 1.0)) / (0.5 * width);
            for p in [0.7, 1.0, 2.0, 10.0 / 3.0, 8.0] {
                let distance = thinning_distance(newtonian, width, first, p);
                let error = flux(distance, p) / exact(p) - 1.0;
                assert!(error.abs() < 1e-9, "{n} cells, p = {p}: {error}");
            }
            let yielding = thinning_distance(newtonian, width, first, f64::INFINITY);
            assert_eq!(yielding, MIN_RATIO * newtonian);
        }
    }
}
