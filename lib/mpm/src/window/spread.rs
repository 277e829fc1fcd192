//! Sums of points on the nodes of a window, in the form of differences.

use super::{Line, Pairs, Plane, Window};
use crate::lanes::Lanes8;

/// Adds `x` of a point by its weights `w`, lane by lane, to sums in the form of differences.
#[inline(always)]
pub(crate) fn spread_value<const D: usize, const FMA: bool>(
    window: &mut Window,
    w: &Pairs,
    x: Lanes8,
) {
    if D == 2 {
        return spread_plane_value::<FMA>(&mut window[0], w, x);
    }
    spread_plane_value::<FMA>(&mut window[0], w, x.times::<FMA>(w[2][0]));
    spread_plane_value::<FMA>(&mut window[1], w, x);
    spread_plane_value::<FMA>(&mut window[2], w, x.times::<FMA>(w[2][1]));
}

#[inline(always)]
fn spread_plane_value<const FMA: bool>(plane: &mut Plane, w: &Pairs, x: Lanes8) {
    let parts = [x.times::<FMA>(w[1][0]), x, x.times::<FMA>(w[1][1])];
    for (line, x) in plane.iter_mut().zip(parts) {
        line[0] = line[0].add_product::<FMA>(w[0][0], x);
        line[1] = line[1].plus::<FMA>(x);
        line[2] = line[2].add_product::<FMA>(w[0][1], x);
    }
}

/// Adds `x` of a point by its weights `w` and, along each axis, `flux` by the slopes `g`, lane by lane, to
/// sums in the form of differences.
#[inline(always)]
pub(crate) fn spread<const D: usize, const FMA: bool>(
    window: &mut Window,
    (w, g): (&Pairs, &Pairs),
    x: Lanes8,
    [fx, fy, fz]: [Lanes8; 3],
) {
    if D == 2 {
        return spread_plane::<FMA>(&mut window[0], (w, g), [x, fx, fy]);
    }
    let [wl, wu] = w[2];
    let lower = x.times::<FMA>(wl).add_product::<FMA>(g[2][0], fz);
    let upper = x.times::<FMA>(wu).add_product::<FMA>(g[2][1], fz);
    let lower = [lower, fx.times::<FMA>(wl), fy.times::<FMA>(wl)];
    let upper = [upper, fx.times::<FMA>(wu), fy.times::<FMA>(wu)];
    spread_plane::<FMA>(&mut window[0], (w, g), lower);
    spread_plane::<FMA>(&mut window[1], (w, g), [x, fx, fy]);
    spread_plane::<FMA>(&mut window[2], (w, g), upper);
}

#[inline(always)]
fn spread_plane<const FMA: bool>(
    plane: &mut Plane,
    (w, g): (&Pairs, &Pairs),
    [x, fx, fy]: [Lanes8; 3],
) {
    let [wl, wu] = w[1];
    let lower = x.times::<FMA>(wl).add_product::<FMA>(g[1][0], fy);
    let upper = x.times::<FMA>(wu).add_product::<FMA>(g[1][1], fy);
    spread_line::<FMA>(&mut plane[0], (&w[0], &g[0]), lower, fx.times::<FMA>(wl));
    spread_line::<FMA>(&mut plane[1], (&w[0], &g[0]), x, fx);
    spread_line::<FMA>(&mut plane[2], (&w[0], &g[0]), upper, fx.times::<FMA>(wu));
}

#[inline(always)]
fn spread_line<const FMA: bool>(
    line: &mut Line,
    (w, g): (&[Lanes8; 2], &[Lanes8; 2]),
    x: Lanes8,
    flux: Lanes8,
) {
    line[0] = line[0]
        .add_product::<FMA>(w[0], x)
        .add_product::<FMA>(g[0], flux);
    line[1] = line[1].plus::<FMA>(x);
    line[2] = line[2]
        .add_product::<FMA>(w[1], x)
        .add_product::<FMA>(g[1], flux);
}
