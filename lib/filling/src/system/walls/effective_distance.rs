//! The wall law in series with the layer that the grid resolves.

/// Distance d_eff (cells) over which the difference between a face velocity and its wall acts,
/// so that the friction of a wall is eta (u - U)/d_eff.
///
/// `d` is the distance from the face's centre to the wall, `opposite` that to the wall on the
/// other side and `width` that of the lumen, H (both at least `d`).
///
/// Derivation. The velocity is the mean over a control volume of thickness h1 = d + 1/2 at the
/// wall. In a slit of width H driven by a pressure gradient the exact profile is
/// u = s (x - x^2/H) with wall slope s, whose mean there is s (h1/2 - h1^2/(3 H)); the first
/// term is where the mean lies in linear flow. Differences of means over equal volumes are
/// exact, but that between the wall volume and the next is short by e = s (h1^2 - 1)/(3 H). Spreading
/// this defect over the half slit,
///
/// d_eff = h1/2 - h1^2/(3 H) + (1 - 2 h1/H) (h1^2 - 1)/(3 H),
///
/// makes the discrete flux exact for any offset of the walls. Where both walls bound one
/// control volume, u = H^2/12 G/eta requires d_eff = H/6. Only the part `slit` of the defect counts,
/// less than all of it beside edges, where flow is none between plane walls.
pub(crate) fn effective_distance(d: f64, opposite: f64, width: f64, slit: f64) -> f64 {
    if d + opposite <= width + 1e-9 && opposite <= 1.0 + 1e-6 {
        return width / 6.0;
    }
    let h1 = d + 0.5;
    let lack = slit * (1.0 - 2.0 * h1 / width) * (h1 * h1 - 1.0);
    (0.5 * h1 + (lack - h1 * h1) / (3.0 * width)).max(0.1 * h1)
}

/// Place (cells) of the mean over a control volume that a wall at distance `d` from the face's
/// centre bounds, away from the wall.
pub(crate) fn shift_of_mean(d: f64) -> f64 {
    0.5 * (0.5 - d)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Finite-volume flow between walls `n` cells apart, the lower one at `offset` above a grid
    /// line and the upper one moving with `upper`, under a pressure gradient, with slivers
    /// merged: thicknesses and velocities of the control volumes.
    fn flow(n: f64, offset: f64, slip: f64, gradient: f64, upper: f64) -> Vec<[f64; 2]> {
        let (low, high) = (offset, offset + n);
        let points: Vec<f64> = (0..60)
            .map(|j| f64::from(j) + 0.5)
            .filter(|y| *y > low + 1e-9 && *y < high - 1e-9)
            .collect();
        let last = points.len() - 1;
        let walls = |j: usize| {
            let near = |d: f64, end: bool| if end { d } else { 0.5 };
            [
                near(points[j] - low, j == 0),
                near(high - points[j], j == last),
            ]
        };
        let place = |j: usize| {
            let [below, above] = walls(j);
            points[j] + shift_of_mean(below) - shift_of_mean(above)
        };
        let friction = |d: f64| 1.0 / (effective_distance(d, n - d, n, 1.0) + slip);
        let link = |j: usize| 1.0 / (place(j + 1) - place(j));
        // Tridiagonal solve.
        let (mut diagonal, mut rhs) = (Vec::new(), Vec::new());
        for j in 0..=last {
            let [below, above] = walls(j);
            let mut a = if j > 0 { link(j - 1) } else { friction(below) };
            let mut b = (below + above) * gradient;
            a += if j < last { link(j) } else { friction(above) };
            if j == last {
                b += friction(above) * upper;
            }
            if j > 0 {
                a -= link(j - 1).powi(2) / diagonal[j - 1];
                b += link(j - 1) * rhs[j - 1] / diagonal[j - 1];
            }
            diagonal.push(a);
            rhs.push(b);
        }
        let (mut u, mut found) = (0.0, Vec::new());
        for j in (0..=last).rev() {
            let from_above = if j < last { link(j) * u } else { 0.0 };
            u = (rhs[j] + from_above) / diagonal[j];
            found.push([walls(j).iter().sum(), u]);
        }
        found.reverse();
        found
    }

    /// Flux through a slit over the exact one.
    fn flux(n: f64, offset: f64, slip: f64) -> f64 {
        let sum: f64 = (flow(n, offset, slip, 1.0, 0.0).iter())
            .map(|[h, u]| h * u)
            .sum();
        sum / (n.powi(3) / 12.0 * (1.0 + 6.0 * slip / n))
    }

    #[test]
    fn slit_flux_is_exact_at_any_offset() {
        for (n, tolerance) in [
            (1.5, 0.25),
            (2.0, 0.115),
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

    /// The slip velocity follows from the stress, which the discrete walls make a little large.
    #[test]
    fn slip_at_a_wall_under_a_moving_one() {
        for (n, tolerance) in [(3.0, 0.2), (6.0, 0.05), (12.0, 0.02)] {
            for slip in [0.1, 1.0] {
                let errors = (0..20).map(|i| {
                    let offset = 0.05 * f64::from(i);
                    let first = flow(n, offset, slip, 0.0, 1.0)[0];
                    let d = first[0] - 0.5;
                    let stress = first[1] / (effective_distance(d, n - d, n, 1.0) + slip);
                    stress * (n + 2.0 * slip) - 1.0
                });
                let worst = errors.fold(0.0, |a: f64, e| if e.abs() > a.abs() { e } else { a });
                println!("Couette {n} cells, slip {slip}: slip velocity error {worst:+.4}");
                assert!(worst.abs() < tolerance, "{n} cells, slip {slip}: {worst}");
            }
        }
    }
}
