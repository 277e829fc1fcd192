//! Nodes to points: velocity by every update, its gradient, and the displacement.

use std::marker::PhantomData;

use super::{layers, window};
use crate::lanes::{Oct, Quad};
use crate::lattice::HALO;
use crate::real::Real;
use crate::settings::VelocityUpdate;
use crate::shape::{Shape, Weights};
use crate::simd::Kernel;
use crate::tiles::Tile;

/// Nodes to points: new velocity, velocity gradient and displacement.
///
/// `tile.local` holds the nodal velocity v+ in lanes 0..3; lanes 4..7 hold its increment for
/// FLIP and the filtered velocity v* for XPIC and FMPM; lanes 3 and 7 are 1.
pub(crate) struct G2p<'a, S, const D: usize, const AFFINE: bool> {
    pub(crate) tile: &'a mut Tile,
    /// dt over cell, s/m.
    pub(crate) dt_over_cell: Real,
    pub(crate) update: VelocityUpdate,
    pub(crate) shape: PhantomData<S>,
}

/// A nodal field and its gradient (per cell) at a point.
struct Field {
    value: Oct,
    slope: [Oct; 3],
}

#[inline(always)]
fn gather<const D: usize, const FMA: bool>(nodes: &[Oct], weights: &Weights) -> Field {
    let mut value = Oct::ZERO;
    let mut slope = [Oct::ZERO; 3];
    for layer in 0..layers(D) {
        let (mut plane, mut plane_x, mut plane_y) = (Oct::ZERO, Oct::ZERO, Oct::ZERO);
        for row in 0..3 {
            let at = layer * HALO * HALO + row * HALO;
            let (mut line, mut line_x) = (Oct::ZERO, Oct::ZERO);
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
fn affine<const D: usize, const FMA: bool>(nodes: &[Oct], weights: &Weights, d: Quad) -> Field {
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

impl<S: Shape, const D: usize, const AFFINE: bool> Kernel for G2p<'_, S, D, AFFINE> {
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
                *to = low(from);
            }
            // Lanes 3 and 7 are 1 at every node: the sum of the weights as it was rounded. A
            // velocity that is replaced each step would drift by that rounding.
            let plus = low(&field.value).scaled(1.0 / field.value.0[3]);
            if AFFINE {
                let affine = affine::<D, FMA>(nodes, &weights, place[p]);
                for (to, from) in points.affine[p].iter_mut().zip(&affine.slope) {
                    // Lane 3 is the sum of the moments, zero but for rounding, which times the
                    // velocity itself would be a gradient of liquid that moves as one.
                    *to = low(from).add_scaled::<FMA>(-from.0[3], plus);
                }
            }
            let second = match self.update {
                VelocityUpdate::Flip => high(&field.value),
                _ => high(&field.value).scaled(1.0 / field.value.0[7]),
            };
            let (old, drift) = (motion[p], shift[p]);
            for a in 0..D {
                let (new, travel) = match self.update {
                    VelocityUpdate::Flip => (old.0[a] + second.0[a], plus.0[a] - 0.5 * second.0[a]),
                    VelocityUpdate::Pic | VelocityUpdate::Apic => (plus.0[a], plus.0[a]),
                    VelocityUpdate::Xpic(1) => (plus.0[a], plus.0[a]),
                    VelocityUpdate::Xpic(_) => {
                        let new = second.0[a];
                        (new, drift.0[a] + 0.5 * (new - old.0[a]))
                    }
                    VelocityUpdate::Fmpm(1) => (plus.0[a], plus.0[a]),
                    VelocityUpdate::Fmpm(_) => (second.0[a], plus.0[a]),
                };
                motion[p].0[a] = new;
                shift[p].0[a] = self.dt_over_cell * travel;
            }
        }
    }
}

#[inline(always)]
fn low(x: &Oct) -> Quad {
    Quad([x.0[0], x.0[1], x.0[2], x.0[3]])
}

#[inline(always)]
fn high(x: &Oct) -> Quad {
    Quad([x.0[4], x.0[5], x.0[6], x.0[7]])
}
