//! The velocity profile over the control volume of a face.

/// Distance between two walls below which they count as steps of one staircase, cells.
const LEAST_ROOM: f64 = 0.5;

/// Mean of a profile over the columns of a staircase below which the profile is not used.
const LEAST_MEAN: f64 = 0.3;

/// Profile over the two tangential directions of a face, a biquadratic polynomial
/// sum c[3 m + n] a^m b^n of the distances a, b (cells) from the face's centre.
///
/// Derivation. Along one tangential direction a wall at distance d below the centre makes the
/// velocity U_b + s (xi + l - xi^2/H), xi = d + a the distance from the wall: plane Poiseuille
/// flow in a lumen of width H over a wall that slips by l times the wall slope (l = 1/(k h)).
/// Divided by its mean over the control volume 0 < xi < h1,
///
/// g(a) = (xi + l - xi^2/H) / (h1/2 + l - h1^2/(3 H)),
///
/// has mean 1. Between walls in both directions the product U_b + (U - U_b) g(a) g(b) keeps the
/// mean U, because a mean of products over a rectangle is the product of the means, and it is at
/// the wall's velocity on both walls (for stick), which a sum of two parabolas is not. Where one
/// direction is free of walls, its variation f(b), the parabola with mean 0 that has the means
/// of the neighbours over their control volumes, is carried by the other's g:
/// U_b + g(a) (U - U_b + f(b)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Profile([f32; 9]);

/// What a face sees along one of its tangential directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Across {
    /// No wall in the control volume; `f` are the coefficients of f.
    Free { f: [f64; 3] },
    /// A wall that moves with `velocity`; `g` are the coefficients of g.
    Wall { velocity: f64, g: [f64; 3] },
}

impl Across {
    /// No variation.
    pub(super) const FLAT: Self = Across::Free { f: [0.0; 3] };

    /// The parabola with mean 0 over the face's own unit width and with means `rise` over the
    /// control volumes of the neighbours below and above, which are `width` wide.
    pub(super) fn free(rise: [f64; 2], width: [f64; 2]) -> Self {
        // Means of a and of a^2 - 1/12 over the neighbours, by distance from the centre.
        let first = width.map(|w| 0.5 + 0.5 * w);
        let second = width.map(|w| (0.25 + 0.5 * (0.5 + w) + (0.5 + w).powi(2)) / 3.0 - 1.0 / 12.0);
        let det = first[1] * second[0] + first[0] * second[1];
        let c1 = (rise[1] * second[0] - rise[0] * second[1]) / det;
        let c2 = (first[0] * rise[1] + first[1] * rise[0]) / det;
        Across::Free {
            f: [-c2 / 12.0, c1, c2],
        }
    }

    /// A wall at distance `d`, below or `above`, with the opposite wall at `opposite`, width
    /// of the lumen `width` and influence length `l`, all in cells.
    ///
    /// The nearest walls of two columns may leave next to no room between them (a staircase
    /// through the face); no profile fits there, and the variation is left out.
    pub(super) fn wall(velocity: f64, above: bool, [d, opposite, width, l]: [f64; 4]) -> Self {
        if d + opposite < LEAST_ROOM {
            return Self::FLAT;
        }
        let h1 = d + if opposite > 1.0 + 1e-6 { 0.5 } else { opposite };
        let width = width.max(h1);
        let mean = 0.5 * h1 + l - h1 * h1 / (3.0 * width);
        let way = if above { -1.0 } else { 1.0 };
        let g = [
            (d + l - d * d / width) / mean,
            way * (1.0 - 2.0 * d / width) / mean,
            -1.0 / (width * mean),
        ];
        Across::Wall { velocity, g }
    }

    /// This profile with mean 1 over columns that reach from the centre as far down and up as
    /// `extents` say, cells; none where it has next to no mean there.
    pub(super) fn with_mean_over(self, extents: impl Iterator<Item = [f64; 2]>) -> Self {
        let Across::Wall { velocity, g } = self else {
            return self;
        };
        let antiderivative = |a: f64| a * (g[0] + a * (g[1] / 2.0 + a * g[2] / 3.0));
        let (sum, length) = extents.fold((0.0, 0.0), |(sum, length), [down, up]| {
            (
                sum + antiderivative(up) - antiderivative(-down),
                length + up + down,
            )
        });
        if sum < LEAST_MEAN * length {
            return Self::FLAT;
        }
        Across::Wall {
            velocity,
            g: g.map(|g| g * length / sum),
        }
    }
}

impl Profile {
    /// Profile with mean `u` from what lies across.
    pub(super) fn new(u: f64, across: [Across; 2]) -> Self {
        let mut c = [0.0; 9];
        match across {
            [Across::Free { f }, Across::Free { f: other }] => {
                for m in 0..3 {
                    c[3 * m] += f[m];
                    c[m] += other[m];
                }
                c[0] += u;
            }
            [Across::Wall { velocity, g }, Across::Free { f }] => {
                let f = [f[0] + u - velocity, f[1], f[2]];
                product(&mut c, g, f);
                c[0] += velocity;
            }
            [Across::Free { f }, Across::Wall { velocity, g }] => {
                let f = [f[0] + u - velocity, f[1], f[2]];
                product(&mut c, f, g);
                c[0] += velocity;
            }
            [Across::Wall { velocity, g }, Across::Wall { g: other, .. }] => {
                product(&mut c, g.map(|g| g * (u - velocity)), other);
                c[0] += velocity;
            }
        }
        Self(c.map(|x| x as f32))
    }

    /// The coefficients c[3 m + n].
    pub(super) fn coefficients(&self) -> &[f32; 9] {
        &self.0
    }

    #[inline]
    pub(super) fn value(&self, [a, b]: [f32; 2]) -> f32 {
        let c = &self.0;
        let row = |m: usize| c[3 * m] + b * (c[3 * m + 1] + b * c[3 * m + 2]);
        row(0) + a * (row(1) + a * row(2))
    }

    /// Derivative along the first (0) or second tangential direction.
    #[inline]
    pub(super) fn slope(&self, [a, b]: [f32; 2], which: usize) -> f32 {
        let c = &self.0;
        if which == 0 {
            let row = |m: usize| c[3 * m] + b * (c[3 * m + 1] + b * c[3 * m + 2]);
            row(1) + 2.0 * a * row(2)
        } else {
            let row = |m: usize| c[3 * m + 1] + 2.0 * b * c[3 * m + 2];
            row(0) + a * (row(1) + a * row(2))
        }
    }
}

fn product(c: &mut [f64; 9], a: [f64; 3], b: [f64; 3]) {
    for (m, a) in a.iter().enumerate() {
        for (n, b) in b.iter().enumerate() {
            c[3 * m + n] = a * b;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean over a rectangle by Simpson's rule, exact for cubics.
    fn mean(p: &Profile, a: [f64; 2], b: [f64; 2]) -> f64 {
        let simpson = |[x, y]: [f64; 2]| [(x, 1.0), (0.5 * (x + y), 4.0), (y, 1.0)];
        let mut sum = 0.0;
        for (x, w) in simpson(a) {
            for (y, v) in simpson(b) {
                sum += w * v * f64::from(p.value([x as f32, y as f32])) / 36.0;
            }
        }
        sum
    }

    #[test]
    fn the_mean_is_kept_and_walls_stick() {
        let free = Across::free([-0.7, 0.2], [1.3, 1.0]);
        for d in [0.05, 0.25, 0.5, 0.75, 1.0] {
            for width in [2.0, 3.0, 12.0] {
                for l in [0.0, 0.01, 3.0] {
                    let low = Across::wall(0.4, false, [d, width - d, width, l]);
                    let high = Across::wall(0.4, true, [d, width - d, width, l]);
                    let h = [-d, if width - d > 1.0 { 0.5 } else { width - d }];
                    let up = [-h[1], d];
                    let bulk = [-0.5, 0.5];
                    for (across, a, b) in [
                        ([low, free], h, bulk),
                        ([free, high], bulk, up),
                        ([low, high], h, up),
                        ([free, free], bulk, bulk),
                    ] {
                        let p = Profile::new(2.0, across);
                        let found = mean(&p, a, b);
                        assert!((found - 2.0).abs() < 1e-5, "{across:?}: {found}");
                        if l == 0.0 && across != [free, free] {
                            let at_wall = [a[0] as f32, b[1] as f32];
                            assert!((p.value(at_wall) - 0.4).abs() < 1e-5);
                        }
                    }
                }
            }
        }
    }

    /// A lumen 1.5 cells wide in half the columns and half a cell narrower in the others.
    #[test]
    fn along_steps_the_mean_over_all_columns_is_kept() {
        let extents = [[0.75, 0.75], [0.25, 0.75]];
        let across =
            Across::wall(0.0, false, [0.75, 0.75, 1.5, 0.01]).with_mean_over(extents.into_iter());
        let p = Profile::new(2.0, [across, Across::FLAT]);
        let flux: f64 = extents
            .map(|[down, up]| mean(&p, [-down, up], [-0.5, 0.5]) * (up + down))
            .iter()
            .sum();
        assert!((flux - 2.0 * 2.5).abs() < 1e-5, "{flux}");
        for a in [-0.75_f32, -0.3, 0.2, 0.75] {
            assert!((-1e-3..4.0).contains(&p.value([a, 0.1])), "at {a}");
        }
    }

    #[test]
    fn walls_without_room_between_them_leave_the_velocity_finite() {
        for (d, opposite) in [(0.0, 0.0), (0.0, 1e-9), (1e-12, 0.0), (0.2, 0.25)] {
            let across = Across::wall(0.4, false, [d, opposite, d + opposite, 0.0]);
            let p = Profile::new(2.0, [across, Across::FLAT]);
            for a in [-0.5_f32, 0.0, 0.5] {
                assert_eq!(p.value([a, 0.1]), 2.0, "walls at {d} and {opposite}");
            }
        }
    }

    /// Half a cell of room makes a profile; so does one whose mean over a staircase is a third of
    /// its own, while at a quarter nothing is left to be scaled.
    #[test]
    fn a_profile_needs_room_and_a_mean() {
        let room = |opposite: f64| Across::wall(0.0, false, [0.25, opposite, 1.0, 0.0]);
        assert!(room(0.2) == Across::FLAT && room(0.3) != Across::FLAT);
        // Parabola between walls one cell apart, mean (1 - 6 s^2 - 4 s^3)/(1 + 2 s) over s beyond.
        let mean_over = |s: f64| {
            let across = Across::wall(0.0, false, [0.5, 0.5, 1.0, 0.0]);
            across.with_mean_over([[0.5 + s; 2]].into_iter())
        };
        assert!(mean_over(0.26) != Across::FLAT && mean_over(0.29) == Across::FLAT);
    }

    /// The means of a parabola over three control volumes give it back.
    #[test]
    fn parabolas_are_exact_in_the_bulk() {
        let exact = |a: f64| 0.3 + 0.5 * a - 0.4 * a * a;
        let mean = |p: f64, q: f64| (exact(p) + 4.0 * exact(0.5 * (p + q)) + exact(q)) / 6.0;
        for width in [[1.0, 1.0], [0.75, 1.25], [1.5, 1.0]] {
            let u = mean(-0.5, 0.5);
            let rise = [
                mean(-0.5 - width[0], -0.5) - u,
                mean(0.5, 0.5 + width[1]) - u,
            ];
            let p = Profile::new(u, [Across::FLAT, Across::free(rise, width)]);
            for b in [-0.5_f32, -0.1, 0.0, 0.4] {
                let error = f64::from(p.value([0.2, b])) - exact(b.into());
                assert!(error.abs() < 1e-6, "{width:?}: {error}");
            }
        }
    }

    #[test]
    fn slopes_are_derivatives() {
        let low = Across::wall(0.4, false, [0.3, 2.0, 2.3, 0.01]);
        let high = Across::wall(0.4, true, [0.6, 3.0, 3.6, 0.01]);
        let p = Profile::new(2.0, [low, high]);
        let (x, e) = ([0.1_f32, -0.2_f32], 0.01);
        for which in 0..2 {
            let (mut a, mut b) = (x, x);
            a[which] -= e;
            b[which] += e;
            let difference = (p.value(b) - p.value(a)) / (2.0 * e);
            assert!((difference - p.slope(x, which)).abs() < 1e-4);
        }
    }
}
