//! The 3 x 3 x 3 nodes that a point reaches, seen from its nearest one.
//!
//! The three weights along an axis add up to 1 and their slopes to 0, so that those of the lower and the
//! upper node are all there is: f = f_m + w_l (f_l - f_m) + w_u (f_u - f_m) and f' = g_l (f_l - f_m) + g_u
//! (f_u - f_m). A window of nodal values is turned into such differences once for all points that share it
//! ([`differences`]); what these points add to the nodes is summed in the same form, every point's whole in the
//! middle and its parts beside it, and turned back once ([`nodal`], the transpose). That saves a third of the
//! work, and a uniform field is its own value at a point to the last bit, with no gradient.

// Functions, not closures: only what is inlined always may hold instructions of a processor asked at run time.
use crate::lanes::{Lanes4, Lanes8, first_eight, transposed};
use crate::lattice::{HALO, layers};
use crate::shape::Shape;

/// Points whose weights are computed at once.
pub(crate) const BATCH: usize = 8;

type Line = [Lanes8; 3];
type Plane = [Line; 3];
/// A value for each node, by z, y, x; one plane of it in two dimensions.
pub(crate) type Window = [Plane; 3];
/// All zero.
pub(crate) const NOTHING: Window = [[[Lanes8::ZERO; 3]; 3]; 3];

/// For the lower and the upper node along x, y, z.
pub(crate) type Pairs = [[Lanes8; 2]; 3];

/// Weights and slopes (per cell) of eight points; lanes are points.
pub(crate) struct Sides {
    /// Weights.
    pub(crate) w: Pairs,
    /// Slopes.
    pub(crate) g: Pairs,
}

impl Sides {
    /// Of points at the offsets `d` along x, y, z from their nearest node.
    #[inline(always)]
    pub(crate) fn new<S: Shape, const D: usize, const FMA: bool>(d: &[Lanes8; 3]) -> Self {
        let [wx, gx] = S::sides::<FMA>(&d[0]);
        let [wy, gy] = S::sides::<FMA>(&d[1]);
        let [wz, gz] = if D == 3 {
            S::sides::<FMA>(&d[2])
        } else {
            [[Lanes8::ZERO; 2]; 2]
        };
        Self {
            w: [wx, wy, wz],
            g: [gx, gy, gz],
        }
    }
}

/// Offsets along x, y, z of the first eight points; lanes are points, beyond the last it is repeated.
#[inline(always)]
pub(crate) fn offsets<const FMA: bool>(places: &[Lanes4]) -> [Lanes8; 3] {
    let [x, y, z, _] = transposed::<FMA>(&first_eight(places));
    [x, y, z]
}

/// The values of point `p`, each in all lanes.
#[inline(always)]
pub(crate) fn of_point(x: &Pairs, p: usize) -> Pairs {
    of_points(x, x, p)
}

/// The values of point `p`, those of `low` in lanes 0 to 3 and those of `high` in lanes 4 to 7.
#[inline(always)]
pub(crate) fn of_points(low: &Pairs, high: &Pairs, p: usize) -> Pairs {
    let mut r = [[Lanes8::ZERO; 2]; 3];
    for a in 0..3 {
        for side in 0..2 {
            let (l, h) = (low[a][side].0[p], high[a][side].0[p]);
            r[a][side] = Lanes8([l, l, l, l, h, h, h, h]);
        }
    }
    r
}

/// Node values of the window that begins a part of a halo, in the form of differences.
#[inline(always)]
pub(crate) fn differences<const D: usize, const FMA: bool>(nodes: &[Lanes8]) -> Window {
    let mut window = NOTHING;
    for k in 0..layers(D) {
        for j in 0..3 {
            let at = (k * HALO + j) * HALO;
            let [lower, middle, upper] = [nodes[at], nodes[at + 1], nodes[at + 2]];
            window[k][j] = [
                lower.minus::<FMA>(middle),
                middle,
                upper.minus::<FMA>(middle),
            ];
        }
        let [lower, middle, upper] = &mut window[k];
        part::<FMA>(lower, middle, upper);
    }
    if D == 3 {
        let [lower, middle, upper] = &mut window;
        for j in 0..3 {
            part::<FMA>(&mut lower[j], &middle[j], &mut upper[j]);
        }
    }
    window
}

#[inline(always)]
fn part<const FMA: bool>(lower: &mut Line, middle: &Line, upper: &mut Line) {
    for i in 0..3 {
        lower[i] = lower[i].minus::<FMA>(middle[i]);
        upper[i] = upper[i].minus::<FMA>(middle[i]);
    }
}

/// Sums over points in the form of differences as sums at the nodes.
#[inline(always)]
pub(crate) fn nodal<const D: usize, const FMA: bool>(window: &mut Window) {
    if D == 3 {
        let [lower, middle, upper] = window;
        for j in 0..3 {
            leave::<FMA>(&lower[j], &mut middle[j], &upper[j]);
        }
    }
    for k in 0..layers(D) {
        let [lower, middle, upper] = &mut window[k];
        leave::<FMA>(lower, middle, upper);
        for j in 0..3 {
            let [lower, middle, upper] = window[k][j];
            window[k][j][1] = middle.minus::<FMA>(lower.plus::<FMA>(upper));
        }
    }
}

#[inline(always)]
fn leave<const FMA: bool>(lower: &Line, middle: &mut Line, upper: &Line) {
    for i in 0..3 {
        middle[i] = middle[i].minus::<FMA>(lower[i].plus::<FMA>(upper[i]));
    }
}

/// Adds a window of node values to a part of a halo.
#[inline(always)]
pub(crate) fn add<const D: usize, const FMA: bool>(nodes: &mut [Lanes8], window: &Window) {
    for k in 0..layers(D) {
        for j in 0..3 {
            let at = (k * HALO + j) * HALO;
            for i in 0..3 {
                nodes[at + i] = nodes[at + i].plus::<FMA>(window[k][j][i]);
            }
        }
    }
}

/// A field at a point with the weights `w`, lane by lane.
#[inline(always)]
pub(crate) fn gather_value<const D: usize, const FMA: bool>(window: &Window, w: &Pairs) -> Lanes8 {
    let first = plane_value::<FMA>(&window[0], w);
    if D == 2 {
        return first;
    }
    let (second, third) = (
        plane_value::<FMA>(&window[1], w),
        plane_value::<FMA>(&window[2], w),
    );
    between::<FMA>(&[first, second, third], &w[2])
}

#[inline(always)]
fn plane_value<const FMA: bool>(plane: &Plane, w: &Pairs) -> Lanes8 {
    let lines = [
        between::<FMA>(&plane[0], &w[0]),
        between::<FMA>(&plane[1], &w[0]),
        between::<FMA>(&plane[2], &w[0]),
    ];
    between::<FMA>(&lines, &w[1])
}

#[inline(always)]
fn between<const FMA: bool>(f: &Line, w: &[Lanes8; 2]) -> Lanes8 {
    f[1].add_product::<FMA>(w[0], f[0])
        .add_product::<FMA>(w[1], f[2])
}

/// Lane `c` of the field at eight points, and its derivatives along x, y, z (per cell); lanes are points.
#[inline(always)]
pub(crate) fn gather<const D: usize, const FMA: bool>(
    window: &Window,
    c: usize,
    sides: &Sides,
) -> (Lanes8, [Lanes8; 3]) {
    let Sides { w, g } = sides;
    let (first, first_x, first_y) = plane_of::<FMA>(&window[0], c, w, g);
    if D == 2 {
        return (first, [first_x, first_y, Lanes8::ZERO]);
    }
    let (second, second_x, second_y) = plane_of::<FMA>(&window[1], c, w, g);
    let (third, third_x, third_y) = plane_of::<FMA>(&window[2], c, w, g);
    let planes = [first, second, third];
    let slopes = [
        between::<FMA>(&[first_x, second_x, third_x], &w[2]),
        between::<FMA>(&[first_y, second_y, third_y], &w[2]),
        slope::<FMA>(&planes, &g[2]),
    ];
    (between::<FMA>(&planes, &w[2]), slopes)
}

/// Value, and derivatives along x and y.
#[inline(always)]
fn plane_of<const FMA: bool>(
    plane: &Plane,
    c: usize,
    w: &Pairs,
    g: &Pairs,
) -> (Lanes8, Lanes8, Lanes8) {
    let nodes = [
        in_all(&plane[0], c),
        in_all(&plane[1], c),
        in_all(&plane[2], c),
    ];
    let lines = [
        between::<FMA>(&nodes[0], &w[0]),
        between::<FMA>(&nodes[1], &w[0]),
        between::<FMA>(&nodes[2], &w[0]),
    ];
    let slopes = [
        slope::<FMA>(&nodes[0], &g[0]),
        slope::<FMA>(&nodes[1], &g[0]),
        slope::<FMA>(&nodes[2], &g[0]),
    ];
    (
        between::<FMA>(&lines, &w[1]),
        between::<FMA>(&slopes, &w[1]),
        slope::<FMA>(&lines, &g[1]),
    )
}

/// Lane `c` of each node in all lanes.
#[inline(always)]
fn in_all(line: &Line, c: usize) -> Line {
    [
        Lanes8([line[0].0[c]; 8]),
        Lanes8([line[1].0[c]; 8]),
        Lanes8([line[2].0[c]; 8]),
    ]
}

#[inline(always)]
fn slope<const FMA: bool>(f: &Line, g: &[Lanes8; 2]) -> Lanes8 {
    f[0].times::<FMA>(g[0]).add_product::<FMA>(g[1], f[2])
}

/// Lane `c` of the field at eight points.
#[inline(always)]
pub(crate) fn gather_lane<const D: usize, const FMA: bool>(
    window: &Window,
    c: usize,
    w: &Pairs,
) -> Lanes8 {
    let mut planes = [Lanes8::ZERO; 3];
    for k in 0..layers(D) {
        let plane = &window[k];
        let lines = [
            between::<FMA>(&in_all(&plane[0], c), &w[0]),
            between::<FMA>(&in_all(&plane[1], c), &w[0]),
            between::<FMA>(&in_all(&plane[2], c), &w[0]),
        ];
        planes[k] = between::<FMA>(&lines, &w[1]);
    }
    if D == 2 {
        return planes[0];
    }
    between::<FMA>(&planes, &w[2])
}

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
