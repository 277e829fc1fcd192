//! Nodes to points: velocity by every update, its gradient, and the displacement.

use std::marker::PhantomData;

use crate::fields::node;
use crate::lanes::{Lanes4, Lanes8};
use crate::lattice::{HALO, layers, window};
use crate::real::Real;
use crate::shape::{Shape, Weights};
use crate::simd::Kernel;
use crate::tiles::Tile;

/// Nodes to points: new velocity, velocity gradient and displacement.
///
/// `tile.local` holds the nodal velocities of [`node`].
pub(crate) struct G2p<'a, S, U, const D: usize> {
    pub(crate) tile: &'a mut Tile,
    /// dt over cell, s/m.
    pub(crate) dt_over_cell: Real,
    pub(crate) of: PhantomData<(S, U)>,
}

/// A velocity update: the table of docs/methods.md, section 2.3. Kernels are generic over it.
pub(crate) trait Update {
    /// Points carry an affine field.
    const AFFINE: bool = false;
    /// The second half of a nodal value is a velocity and not an increment.
    const WHOLE: bool = true;

    /// New velocity of a point and the velocity of its displacement from its own (`old`), S v+
    /// (`plus`), S of the second half (`second`) and S w_1 (`drift`). In whole lanes: with three of
    /// four in use the gathers behind them would be computed lane by lane.
    fn apply(old: Lanes4, plus: Lanes4, second: Lanes4, drift: Lanes4) -> (Lanes4, Lanes4);
}

/// FLIP.
pub(crate) struct Increment;
/// PIC, and the filters of order 1.
pub(crate) struct Replace;
/// APIC.
pub(crate) struct Affine;
/// XPIC of order 2 and more.
pub(crate) struct FilterBefore;
/// FMPM of order 2 and more.
pub(crate) struct FilterAfter;

impl Update for Increment {
    const WHOLE: bool = false;
    #[inline(always)]
    fn apply(old: Lanes4, plus: Lanes4, second: Lanes4, _: Lanes4) -> (Lanes4, Lanes4) {
        let new = old.add_scaled::<false>(1.0, second);
        (new, plus.add_scaled::<false>(-0.5, second))
    }
}

impl Update for Replace {
    #[inline(always)]
    fn apply(_: Lanes4, plus: Lanes4, _: Lanes4, _: Lanes4) -> (Lanes4, Lanes4) {
        (plus, plus)
    }
}

impl Update for Affine {
    const AFFINE: bool = true;
    #[inline(always)]
    fn apply(_: Lanes4, plus: Lanes4, _: Lanes4, _: Lanes4) -> (Lanes4, Lanes4) {
        (plus, plus)
    }
}

impl Update for FilterBefore {
    #[inline(always)]
    fn apply(old: Lanes4, _: Lanes4, second: Lanes4, drift: Lanes4) -> (Lanes4, Lanes4) {
        let change = second.add_scaled::<false>(-1.0, old);
        (second, drift.add_scaled::<false>(0.5, change))
    }
}

impl Update for FilterAfter {
    #[inline(always)]
    fn apply(_: Lanes4, plus: Lanes4, second: Lanes4, _: Lanes4) -> (Lanes4, Lanes4) {
        (second, plus)
    }
}

/// A nodal field and its gradient (per cell) at a point.
struct Field {
    value: Lanes8,
    slope: [Lanes8; 3],
}

#[inline(always)]
fn gather<const D: usize, const FMA: bool>(nodes: &[Lanes8], weights: &Weights) -> Field {
    let mut value = Lanes8::ZERO;
    let mut slope = [Lanes8::ZERO; 3];
    for layer in 0..layers(D) {
        let (mut plane, mut plane_x, mut plane_y) = (Lanes8::ZERO, Lanes8::ZERO, Lanes8::ZERO);
        for row in 0..3 {
            let at = layer * HALO * HALO + row * HALO;
            let (mut line, mut line_x) = (Lanes8::ZERO, Lanes8::ZERO);
            for i in 0..3 {
                line = line.add_scaled::<FMA>(weights.w[i].0[0], nodes[at + i]);
                line_x = line_x.add_scaled::<FMA>(weights.g[i].0[0], nodes[at + i]);
            }
            plane = plane.add_scaled::<FMA>(weights.w[row].0[1], line);
            plane_x = plane_x.add_scaled::<FMA>(weights.w[row].0[1], line_x);
            plane_y = plane_y.add_scaled::<FMA>(weights.g[row].0[1], line);
        }
        if D == 3 {
            let (w, g) = (weights.w[layer].0[2], weights.g[layer].0[2]);
            value = value.add_scaled::<FMA>(w, plane);
            slope[0] = slope[0].add_scaled::<FMA>(w, plane_x);
            slope[1] = slope[1].add_scaled::<FMA>(w, plane_y);
            slope[2] = slope[2].add_scaled::<FMA>(g, plane);
        } else {
            (value, slope[0], slope[1]) = (plane, plane_x, plane_y);
        }
    }
    Field { value, slope }
}

/// First moments of the nodal velocity about the point over the moments of inertia of the
/// weights: the affine field of APIC.
#[inline(always)]
fn affine<const D: usize, const FMA: bool>(
    nodes: &[Lanes8],
    weights: &Weights,
    d: Lanes4,
) -> Field {
    let mut moments = Weights {
        w: weights.w,
        g: weights.g,
    };
    for a in 0..4 {
        let arm = [-1.0 - d.0[a], -d.0[a], 1.0 - d.0[a]];
        let inertia: Real = (0..3).map(|i| weights.w[i].0[a] * arm[i] * arm[i]).sum();
        for i in 0..3 {
            moments.g[i].0[a] = weights.w[i].0[a] * arm[i] / inertia;
        }
    }
    gather::<D, FMA>(nodes, &moments)
}

impl<S: Shape, U: Update, const D: usize> Kernel for G2p<'_, S, U, D> {
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Tile { points, local, .. } = self.tile;
        let n = points.len();
        let (place, bases) = (&points.place[..n], &points.base[..n]);
        let motion = &mut points.motion[..n];
        let (shift, gradient) = (&mut points.shift[..n], &mut points.gradient[..n]);
        for p in 0..n {
            let base = usize::from(bases[p]);
            let weights = S::weights(place[p]);
            let nodes = &local[base..base + window(D)];
            let field = gather::<D, FMA>(nodes, &weights);
            for (to, from) in gradient[p].iter_mut().zip(&field.slope) {
                *to = after(from);
            }
            // Every node has 1 there: the sum of the weights as it was rounded. A
            // velocity that is replaced each step would drift by that rounding.
            let plus = after(&field.value).scaled(1.0 / field.value.0[node::ONE]);
            if U::AFFINE {
                let affine = affine::<D, FMA>(nodes, &weights, place[p]);
                for (to, from) in points.affine[p].iter_mut().zip(&affine.slope) {
                    // Beside it is the sum of the moments, zero but for rounding, which times the
                    // velocity itself would be a gradient of liquid that moves as one.
                    *to = after(from).add_scaled::<FMA>(-from.0[node::ONE], plus);
                }
            }
            let second = if U::WHOLE {
                second(&field.value).scaled(1.0 / field.value.0[node::SECOND_ONE])
            } else {
                second(&field.value)
            };
            let (old, drift) = (motion[p], shift[p]);
            let (new, travel) = U::apply(old, plus, second, drift);
            let travel = travel.scaled(self.dt_over_cell);
            if U::WHOLE {
                for a in 0..D {
                    motion[p].0[a] = new.0[a];
                    shift[p].0[a] = travel.0[a];
                }
            } else {
                // The increment is zero beside the velocity, at j, and along z in plane strain.
                (motion[p], shift[p]) = (new, travel);
            }
        }
    }
}

#[inline(always)]
fn after(x: &Lanes8) -> Lanes4 {
    Lanes4(std::array::from_fn(|a| x.0[node::AFTER + a]))
}

#[inline(always)]
fn second(x: &Lanes8) -> Lanes4 {
    Lanes4(std::array::from_fn(|a| x.0[node::SECOND + a]))
}
