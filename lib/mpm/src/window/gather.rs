//! Fields at points from a window of nodal values: at eight points at a time, whose lanes are points, or at one or
//! two, whose lanes are fields.

use super::{Line, Pairs, Plane, Sides, Window};
use crate::lanes::Lanes8;
use crate::lattice::layers;

/// A field at a point with the weights `w`, lane by lane.
#[inline(always)]
pub(crate) fn gather_value<const D: usize, const FMA: bool>(window: &Window, w: &Pairs) -> Lanes8 {
    let mut planes = [Lanes8::ZERO; 3];
    for k in 0..layers(D) {
        planes[k] = plane_value::<FMA>(&window[k], w);
    }
    if D == 2 {
        return planes[0];
    }
    between::<FMA>(&planes, &w[2])
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
    let nodes = nodes_of(plane, c);
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
fn nodes_of(plane: &Plane, c: usize) -> Plane {
    let mut nodes = [[Lanes8::ZERO; 3]; 3];
    for j in 0..3 {
        for i in 0..3 {
            nodes[j][i] = Lanes8([plane[j][i].0[c]; 8]);
        }
    }
    nodes
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
        planes[k] = plane_value::<FMA>(&nodes_of(&window[k], c), w);
    }
    if D == 2 {
        return planes[0];
    }
    between::<FMA>(&planes, &w[2])
}
