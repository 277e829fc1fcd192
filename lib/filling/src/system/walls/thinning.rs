//! The wall's effective distance where a liquid is not Newtonian.

/// Lumens this wide (cells) are as wide as any.
const WIDEST: f64 = 60.0;
/// Least part of a Newtonian liquid's distance.
const LEAST: f64 = 0.02;

/// Distance (cells) over which the difference between a face velocity and its wall acts for a liquid whose
/// rate goes with the power `p` of its stress, where that for a Newtonian liquid is `distance`, the d_eff
/// of [`super::effective_distance`], in a lumen of this `width` H (cells).
///
/// Derivation. In a slit the stress falls linearly from the wall to the middle, and the rate is (1 - 2 y/H)^p of
/// the wall's. Faces differ by the rate at the edge between them, at y = h1, h1 + 1, ... < H/2, times
/// their distance, w = (h1 + 1)/2 at the first edge and 1 at others; the flux that follows is that of the profile,
/// the wall's rate times (H/2)^2/(p + 2) on each side, if
///
/// d(p) = H/(2 (p + 2)) - sum over edges of w (1 - 2 y/H)^(p + 1),
///
/// which for p = 1 is d_eff, but for small terms where h1 is not 1. What is returned is d_eff d(p)/d(1), h1
/// that of d_eff without these.
pub(crate) fn thinning_distance(distance: f64, width: f64, p: f64) -> f64 {
    if width > WIDEST {
        return distance;
    }
    // 2 h1/H; where both walls bound one control volume, d_eff = H/6, each has a half of it.
    let part = 1.5
        * (1.0
            - (1.0 - 16.0 * distance / (3.0 * width))
                .max(1.0 / 9.0)
                .sqrt());
    let first = 0.5 * part * width;
    let of = |p: f64| {
        let (mut sum, mut y, mut apart) = (0.0, first, 0.5 * (first + 1.0));
        while 2.0 * y < width {
            sum += apart * (1.0 - 2.0 * y / width).powf(p + 1.0);
            (y, apart) = (y + 1.0, 1.0);
        }
        0.5 * width / (p + 2.0) - sum
    };
    distance * (of(p) / of(1.0)).max(LEAST)
}

#[cfg(test)]
mod tests {
    use super::super::effective_distance::effective_distance;
    use super::*;

    /// Flux through half a slit of `n` cells, walls `offset` off the grid, in units of the wall's rate.
    #[test]
    fn the_flux_between_plates_is_that_of_the_profile() {
        for (n, tolerance) in [(1_i32, 1e-9), (2, 1e-3), (3, 1e-3), (6, 1e-3), (12, 1e-3)] {
            let width = f64::from(n);
            let newtonian = effective_distance(0.5, width - 0.5, width, 1.0);
            for p in [0.7, 1.0, 2.0, 10.0 / 3.0, 8.0] {
                let (mut u, mut flux) = (thinning_distance(newtonian, width, p), 0.0);
                for j in 0..(n + 1) / 2 {
                    let y = f64::from(j);
                    if j > 0 {
                        u += (1.0 - 2.0 * y / width).powf(p);
                    }
                    flux += u * (0.5 * width - y).min(1.0);
                }
                let error = flux / (0.25 * width * width / (p + 2.0)) - 1.0;
                assert!(error.abs() < tolerance, "{n} cells, p = {p}: {error}");
            }
        }
    }

    /// Far from any wall nothing is to be made up for, nor where the distance would end below a fiftieth:
    /// in a slit of ten cells with a wall next to its face.
    #[test]
    fn width_and_distance_have_their_limits() {
        assert_eq!(thinning_distance(0.4, 61.0, 3.0), 0.4);
        assert!((thinning_distance(0.4, 59.0, 3.0) / 0.4 - 1.0).abs() > 1e-3);
        assert!((thinning_distance(0.05, 10.0, 20.0) / 0.05 - 0.02).abs() < 1e-12);
    }
}
