//! The 3 x 3 x 3 nodes that a point reaches, seen from its nearest one.
//!
//! The three weights along an axis add up to 1 and their slopes to 0, so that those of the lower and the
//! upper node are all there is: f = f_m + w_l (f_l - f_m) + w_u (f_u - f_m) and f' = g_l (f_l - f_m) + g_u
//! (f_u - f_m). A window of nodal values is turned into such differences once for all points that share it
//! ([`differences`]); what these points add to the nodes is summed in the same form, every point's whole in the
//! middle and its parts beside it, and turned back once ([`nodal`], the transpose). That saves a third of the
//! work, and a uniform field is its own value at a point to the last bit, with no gradient.

// Functions, not closures: only what is inlined always may hold instructions of a processor asked at run time.

mod gather;
mod spread;

use crate::lanes::{Lanes4, Lanes8, first_eight, transposed};
use crate::lattice::{HALO, layers};
use crate::settings::ShapeFunction;
pub(crate) use gather::{gather, gather_lane, gather_value};
pub(crate) use spread::{spread, spread_value};

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
    pub(crate) fn new<const D: usize, const FMA: bool>(
        shape: ShapeFunction,
        d: &[Lanes8; 3],
    ) -> Self {
        let [[wx, gx], [wy, gy], [wz, gz]] = shape.sides::<D, FMA>(d);
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
    of_points((x, p), (x, p))
}

/// The values of a point of `low` in lanes 0 to 3 and those of one of `high` in lanes 4 to 7.
#[inline(always)]
pub(crate) fn of_points((low, p): (&Pairs, usize), (high, q): (&Pairs, usize)) -> Pairs {
    let mut r = [[Lanes8::ZERO; 2]; 3];
    for a in 0..3 {
        for side in 0..2 {
            let (l, h) = (low[a][side].0[p], high[a][side].0[q]);
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
