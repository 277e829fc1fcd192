//! The wall law in series with the layer that the grid resolves.

/// Distance d_eff (cells) over which the difference between a face velocity and its wall acts,
/// so that the friction of a wall is eta (u - U)/d_eff.
///
/// `d` is the distance from the velocity's place to the wall, `opposite` that to the wall on
/// the other side and `path` the free path H across the lumen (both at least `d`).
///
/// Derivation. In a slit of width H driven by a pressure gradient the exact profile is
/// u = s (x - x^2/H) with wall slope s. A staggered scheme gives this parabola at its points
/// plus a constant, which the wall friction fixes. With d_eff = u(d)/s = d (1 - d/H) the
/// constant is zero; yet the discrete flux, sum of point values times control volumes, then
/// exceeds the integral: by 1/24 u'' in each inner volume and by h1 u(d) - int_0^h1 u in the
/// wall volume of thickness h1 = d + 1/2. Spreading that excess over the half slit,
///
/// d_eff = d (1 - d/H) - (2/H^2) [h1 (H d - d^2) - H h1^2/2 + h1^3/3 + (H/2 - h1)/12],
///
/// makes the discrete flux exact for any offset of the walls. Where both walls bound one
/// control volume its velocity is the mean, so u = H^2/12 G/eta wants d_eff = H/6.
pub fn effective_distance(d: f64, opposite: f64, path: f64) -> f64 {
    if d + opposite <= path + 1e-9 && opposite <= 1.0 + 1e-6 {
        return path / 6.0;
    }
    let h1 = d + 0.5;
    let half = 0.5 * path;
    let point = path * d - d * d;
    let excess = h1 * point - half * h1 * h1 + h1.powi(3) / 3.0 + (half - h1) / 12.0;
    (d * (1.0 - d / path) - 2.0 / (path * path) * excess).max(0.2 * d)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Flux through a slit of `n` cells whose lower wall is at `offset` above a grid line, over
    /// the exact one: a finite-volume Poiseuille flow with slivers merged.
    fn flux(n: f64, offset: f64, slip: f64) -> f64 {
        let (low, high) = (offset, offset + n);
        let points: Vec<f64> = (0..60)
            .map(|j| f64::from(j) + 0.5)
            .filter(|y| *y > low + 1e-9 && *y < high - 1e-9)
            .collect();
        let last = points.len() - 1;
        let thickness = |j: usize| {
            (if j == 0 { points[0] - low } else { 0.5 })
                + (if j == last { high - points[last] } else { 0.5 })
        };
        let wall = |d: f64| 1.0 / (effective_distance(d, n - d, n) + slip);
        // Tridiagonal solve; the links between neighbours have coefficient 1.
        let (mut diagonal, mut rhs) = (Vec::new(), Vec::new());
        for j in 0..=last {
            let mut a = f64::from(j > 0) + f64::from(j < last);
            if j == 0 {
                a += wall(points[0] - low);
            }
            if j == last {
                a += wall(high - points[last]);
            }
            let mut b = thickness(j);
            if j > 0 {
                a -= 1.0 / diagonal[j - 1];
                b += rhs[j - 1] / diagonal[j - 1];
            }
            diagonal.push(a);
            rhs.push(b);
        }
        let (mut u, mut sum) = (0.0, 0.0);
        for j in (0..=last).rev() {
            u = (rhs[j] + u) / diagonal[j];
            sum += thickness(j) * u;
        }
        sum / (n.powi(3) / 12.0 * (1.0 + 6.0 * slip / n))
    }

    #[test]
    fn slit_flux_is_exact_at_any_offset() {
        for (n, tolerance) in [
            (1.5, 0.25),
            (2.0, 0.11),
            (3.0, 0.02),
            (6.0, 0.002),
            (12.0, 0.001),
        ] {
            for slip in [0.0, 0.01, 1.0] {
                let errors = (0..20).map(|i| flux(n, 0.05 * f64::from(i), slip) - 1.0);
                let worst = errors.fold(0.0, |a: f64, e| if e.abs() > a.abs() { e } else { a });
                println!("slit of {n} cells, slip {slip}: flux error {worst:+.4}");
                assert!(worst.abs() < tolerance, "{n} cells, slip {slip}: {worst}");
            }
        }
    }
}
