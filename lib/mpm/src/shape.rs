//! Shape functions seen from the nearest node.
//!
//! All three reach at most one node to either side of a point's nearest node, so that with the
//! offset d in [-1/2, 1/2] (cells) three weights per axis are all there is.

use crate::lanes::Lanes4;

/// Weights and slopes (per cell) on the nodes -1, 0, +1 around the nearest one; lanes are axes.
#[derive(Clone, Copy)]
pub(crate) struct Weights {
    pub(crate) w: [Lanes4; 3],
    pub(crate) g: [Lanes4; 3],
}

/// A shape function; kernels are generic over it.
pub(crate) trait Shape: Send + Sync + 'static {
    /// Weights at offsets `d` in cells.
    fn weights(d: Lanes4) -> Weights;
}

/// Uniform GIMP: the hat averaged over a box of half a cell.
pub(crate) struct Gimp;
/// Quadratic B-spline.
pub(crate) struct Bspline2;
/// Hat.
pub(crate) struct Linear;

/// From the weights and slopes on the outer nodes; partition of unity gives the middle one.
#[inline(always)]
fn complete(left: Lanes4, right: Lanes4, left_slope: Lanes4, right_slope: Lanes4) -> Weights {
    let (mut middle, mut middle_slope) = (Lanes4::ZERO, Lanes4::ZERO);
    for a in 0..4 {
        middle.0[a] = 1.0 - left.0[a] - right.0[a];
        middle_slope.0[a] = -(left_slope.0[a] + right_slope.0[a]);
    }
    Weights {
        w: [left, middle, right],
        g: [left_slope, middle_slope, right_slope],
    }
}

impl Shape for Gimp {
    #[inline(always)]
    fn weights(d: Lanes4) -> Weights {
        let (mut l, mut r, mut gl, mut gr) =
            (Lanes4::ZERO, Lanes4::ZERO, Lanes4::ZERO, Lanes4::ZERO);
        for a in 0..4 {
            // Part of the box beyond the node, at most all of it.
            let s = (d.0[a] + 0.25).clamp(0.0, 0.5);
            let t = 0.5 - s;
            r.0[a] = s * s + (d.0[a] - 0.25).max(0.0);
            l.0[a] = t * t + (-d.0[a] - 0.25).max(0.0);
            gr.0[a] = 2.0 * s;
            gl.0[a] = -2.0 * t;
        }
        complete(l, r, gl, gr)
    }
}

impl Shape for Bspline2 {
    #[inline(always)]
    fn weights(d: Lanes4) -> Weights {
        let (mut l, mut r, mut gl, mut gr) =
            (Lanes4::ZERO, Lanes4::ZERO, Lanes4::ZERO, Lanes4::ZERO);
        for a in 0..4 {
            let s = 0.5 + d.0[a];
            let t = 0.5 - d.0[a];
            r.0[a] = 0.5 * s * s;
            l.0[a] = 0.5 * t * t;
            gr.0[a] = s;
            gl.0[a] = -t;
        }
        complete(l, r, gl, gr)
    }
}

impl Shape for Linear {
    #[inline(always)]
    fn weights(d: Lanes4) -> Weights {
        let (mut l, mut r, mut gl, mut gr) =
            (Lanes4::ZERO, Lanes4::ZERO, Lanes4::ZERO, Lanes4::ZERO);
        for a in 0..4 {
            let right = d.0[a] >= 0.0;
            r.0[a] = d.0[a].max(0.0);
            l.0[a] = (-d.0[a]).max(0.0);
            gr.0[a] = if right { 1.0 } else { 0.0 };
            gl.0[a] = if right { 0.0 } else { -1.0 };
        }
        complete(l, r, gl, gr)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::real::Real;

    fn hat(x: f64) -> f64 {
        (1.0 - x.abs()).max(0.0)
    }

    /// The hat averaged over [x - 1/4, x + 1/4] by fine quadrature.
    fn averaged_hat(x: f64) -> f64 {
        let n = 20_000;
        (0..n)
            .map(|i| hat(x - 0.25 + 0.5 * (f64::from(i) + 0.5) / f64::from(n)))
            .sum::<f64>()
            / f64::from(n)
    }

    fn bspline(x: f64) -> f64 {
        match x.abs() {
            a if a < 0.5 => 0.75 - a * a,
            a if a < 1.5 => 0.5 * (1.5 - a).powi(2),
            _ => 0.0,
        }
    }

    fn compare<S: Shape>(reference: impl Fn(f64) -> f64) -> f64 {
        let mut worst = 0.0_f64;
        for i in 0..=100 {
            let d = -0.5 + f64::from(i) / 100.0;
            let weights = S::weights(Lanes4([d as Real; 4]));
            for (node, offset) in [-1.0, 0.0, 1.0].into_iter().enumerate() {
                let w = f64::from(weights.w[node].0[1]);
                worst = worst.max((w - reference(d - offset)).abs());
                let eps = 1e-4;
                if (0.01..0.99).contains(&(d + 0.5)) && (d * 100.0).round() != 0.0 {
                    let slope =
                        (reference(d - offset + eps) - reference(d - offset - eps)) / (2.0 * eps);
                    let g = f64::from(weights.g[node].0[1]);
                    worst = worst.max(0.01 * (g - slope).abs());
                }
            }
        }
        worst
    }

    #[test]
    fn weights_are_those_of_the_definitions() {
        let errors = [
            compare::<Gimp>(averaged_hat),
            compare::<Bspline2>(bspline),
            compare::<Linear>(hat),
        ];
        println!("largest deviation gimp, bspline2, linear: {errors:?}");
        assert!(errors.iter().all(|&e| e < 2e-5));
    }
}
