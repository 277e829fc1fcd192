//! Shape functions seen from the nearest node.
//!
//! All three reach at most one node to either side of a point's nearest node, so that with the
//! offset d in [-1/2, 1/2] (cells) three weights per axis are all there is; the middle one is what the
//! others leave of 1.

use crate::lanes::Lanes8;
use crate::real::Real;
use crate::settings::ShapeFunction;

/// Of every lane what `of` gives; a loop of its own for each, so that it becomes one instruction or two.
#[inline(always)]
fn each(d: &Lanes8, of: impl Fn(Real) -> Real) -> Lanes8 {
    let mut x = d.0;
    for x in &mut x {
        *x = of(*x);
    }
    Lanes8(x)
}

/// The part of `x` above 0; unlike `max` without a word on what is no number.
#[inline(always)]
fn above(x: Real) -> Real {
    if x > 0.0 { x } else { 0.0 }
}

/// Along one axis, of eight points: weights on the lower and the upper node, and slopes of these (per cell).
type Axis = [[Lanes8; 2]; 2];

impl ShapeFunction {
    /// Along each axis, at the offsets `d` (cells) of eight points. Which function is asked once for all of
    /// them: kernels are not compiled for each.
    #[inline(always)]
    pub(crate) fn sides<const D: usize, const FMA: bool>(self, d: &[Lanes8; 3]) -> [Axis; 3] {
        let mut axes = [[[Lanes8::ZERO; 2]; 2]; 3];
        match self {
            Self::Gimp => {
                for a in 0..D {
                    axes[a] = gimp::<FMA>(&d[a]);
                }
            }
            Self::Bspline2 => {
                for a in 0..D {
                    axes[a] = bspline2::<FMA>(&d[a]);
                }
            }
            Self::Linear => {
                for a in 0..D {
                    axes[a] = linear(&d[a]);
                }
            }
        }
        axes
    }
}

/// The hat averaged over a box of half a cell.
#[inline(always)]
fn gimp<const FMA: bool>(d: &Lanes8) -> Axis {
    // Part of the box beyond the node, at most all of it.
    let s = each(d, |d| {
        let s = above(d + 0.25);
        if s < 0.5 { s } else { 0.5 }
    });
    let t = each(&s, |s| 0.5 - s);
    let upper = s.times::<FMA>(s).plus::<FMA>(each(d, |d| above(d - 0.25)));
    let lower = t.times::<FMA>(t).plus::<FMA>(each(d, |d| above(-d - 0.25)));
    [
        [lower, upper],
        [t.scaled::<FMA>(-2.0), s.scaled::<FMA>(2.0)],
    ]
}

#[inline(always)]
fn bspline2<const FMA: bool>(d: &Lanes8) -> Axis {
    let (s, t) = (each(d, |d| 0.5 + d), each(d, |d| 0.5 - d));
    let half = |x: Lanes8| x.times::<FMA>(x).scaled::<FMA>(0.5);
    [[half(t), half(s)], [t.scaled::<FMA>(-1.0), s]]
}

#[inline(always)]
fn linear(d: &Lanes8) -> Axis {
    let (lower, upper) = (each(d, |d| above(-d)), each(d, above));
    let slopes = [
        each(d, |d| if d < 0.0 { -1.0 } else { 0.0 }),
        each(d, |d| if d < 0.0 { 0.0 } else { 1.0 }),
    ];
    [[lower, upper], slopes]
}

#[cfg(test)]
mod tests {
    use super::*;

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

    fn compare(shape: ShapeFunction, reference: impl Fn(f64) -> f64) -> f64 {
        let mut worst = 0.0_f64;
        for i in 0..=100 {
            let d = -0.5 + f64::from(i) / 100.0;
            let [_, along_y, _] = shape.sides::<3, false>(&[Lanes8([d as Real; 8]); 3]);
            let [w, g] = along_y.map(|x| x.map(|x| f64::from(x.0[1])));
            let weights = [w[0], 1.0 - w[0] - w[1], w[1]];
            let slopes = [g[0], -(g[0] + g[1]), g[1]];
            for (node, offset) in [-1.0, 0.0, 1.0].into_iter().enumerate() {
                let w = weights[node];
                worst = worst.max((w - reference(d - offset)).abs());
                let eps = 1e-4;
                if (0.01..0.99).contains(&(d + 0.5)) && (d * 100.0).round() != 0.0 {
                    let slope =
                        (reference(d - offset + eps) - reference(d - offset - eps)) / (2.0 * eps);
                    let g = slopes[node];
                    worst = worst.max(0.01 * (g - slope).abs());
                }
            }
        }
        worst
    }

    #[test]
    fn weights_are_those_of_the_definitions() {
        let errors = [
            compare(ShapeFunction::Gimp, averaged_hat),
            compare(ShapeFunction::Bspline2, bspline),
            compare(ShapeFunction::Linear, hat),
        ];
        println!("largest deviation gimp, bspline2, linear: {errors:?}");
        assert!(errors.iter().all(|&e| e < 2e-5));
    }
}
