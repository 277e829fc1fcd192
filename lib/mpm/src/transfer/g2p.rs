//! Nodes to points: velocity by every update, its gradient, and the displacement.

use std::marker::PhantomData;

use crate::fields::point::J;
use crate::lanes::{Lanes4, Lanes8};
use crate::lattice::window;
use crate::real::Real;
use crate::runs::run_end;
use crate::shape::Shape;
use crate::simd::Kernel;
use crate::tiles::{Scratch, Tile};
use crate::window::{BATCH, Sides, differences, gather, offsets};

/// Nodes to points: new velocity, velocity gradient and displacement.
///
/// The scratch holds the nodal velocities of [`node`](crate::fields::node).
pub(crate) struct G2p<'a, S, U, const D: usize> {
    pub(crate) tile: &'a mut Tile,
    pub(crate) scratch: &'a mut Scratch,
    /// dt over cell, s/m.
    pub(crate) dt_over_cell: Real,
    pub(crate) of: PhantomData<(S, U)>,
}

/// A velocity update: the table of docs/methods.md, section 2.3. Kernels are generic over it.
pub(crate) trait Update {
    /// Points carry an affine field.
    const AFFINE: bool = false;

    /// New velocity of a point and the velocity of its displacement from its own (`old`), S v+
    /// (`plus`), S of the second half (`second`) and S w_1 (`drift`).
    fn apply<const FMA: bool>(
        old: Lanes4,
        plus: Lanes4,
        second: Lanes4,
        drift: Lanes4,
    ) -> (Lanes4, Lanes4);
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
    #[inline(always)]
    fn apply<const FMA: bool>(
        old: Lanes4,
        plus: Lanes4,
        second: Lanes4,
        _: Lanes4,
    ) -> (Lanes4, Lanes4) {
        let new = old.add_scaled::<FMA>(1.0, second);
        (new, plus.add_scaled::<FMA>(-0.5, second))
    }
}

impl Update for Replace {
    #[inline(always)]
    fn apply<const FMA: bool>(_: Lanes4, plus: Lanes4, _: Lanes4, _: Lanes4) -> (Lanes4, Lanes4) {
        (plus, plus)
    }
}

impl Update for Affine {
    const AFFINE: bool = true;
    #[inline(always)]
    fn apply<const FMA: bool>(_: Lanes4, plus: Lanes4, _: Lanes4, _: Lanes4) -> (Lanes4, Lanes4) {
        (plus, plus)
    }
}

impl Update for FilterBefore {
    #[inline(always)]
    fn apply<const FMA: bool>(
        old: Lanes4,
        _: Lanes4,
        second: Lanes4,
        drift: Lanes4,
    ) -> (Lanes4, Lanes4) {
        let change = second.add_scaled::<FMA>(-1.0, old);
        (second, drift.add_scaled::<FMA>(0.5, change))
    }
}

impl Update for FilterAfter {
    #[inline(always)]
    fn apply<const FMA: bool>(
        _: Lanes4,
        plus: Lanes4,
        second: Lanes4,
        _: Lanes4,
    ) -> (Lanes4, Lanes4) {
        (second, plus)
    }
}

/// The weights, and in place of their slopes the first moments of the weights about the points over the
/// moments of inertia: what gives the affine field of APIC.
#[inline(always)]
fn moments<const D: usize>(d: &[Lanes8; 3], sides: &Sides) -> Sides {
    let mut g = sides.w;
    for a in 0..D {
        for p in 0..BATCH {
            let (lower, upper) = (sides.w[a][0].0[p], sides.w[a][1].0[p]);
            let arm = [-1.0 - d[a].0[p], -d[a].0[p], 1.0 - d[a].0[p]];
            let w = [lower, 1.0 - lower - upper, upper];
            let inertia: Real = (0..3).map(|i| w[i] * arm[i] * arm[i]).sum();
            g[a][0].0[p] = lower * arm[0] / inertia;
            g[a][1].0[p] = upper * arm[2] / inertia;
        }
    }
    Sides { w: sides.w, g }
}

impl<S: Shape, U: Update, const D: usize> Kernel for G2p<'_, S, U, D> {
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Tile { points, .. } = self.tile;
        let Scratch {
            field,
            shift,
            gradient,
        } = self.scratch;
        let n = points.len();
        let (place, bases) = (&points.place[..n], &points.base[..n]);
        let motion = &mut points.motion[..n];
        shift.resize(n, Lanes4::ZERO);
        gradient.resize(n, [Lanes4::ZERO; 3]);
        let (shift, gradient) = (&mut shift[..n], &mut gradient[..n]);
        let stress = &points.stress[..n];
        let s = self.dt_over_cell;
        let scale = Lanes4([s, s, if D == 3 { s } else { 0.0 }, 0.0]);
        let mut start = 0;
        while start < n {
            let (base, end) = (usize::from(bases[start]), run_end(bases, start));
            let nodes = &field[base..base + window(D)];
            let window = differences::<D, FMA>(nodes);
            while start < end {
                let places = &place[start..end.min(start + BATCH)];
                let d = offsets::<FMA>(places);
                let sides = Sides::new::<S, D, FMA>(&d);
                if U::AFFINE {
                    let moments = moments::<D>(&d, &sides);
                    for p in 0..places.len() {
                        points.affine[start + p] = gather::<D, FMA>(&window, &moments, p).1;
                    }
                }
                for p in 0..places.len() {
                    let at = start + p;
                    let (value, slope) = gather::<D, FMA>(&window, &sides, p);
                    gradient[at] = slope;
                    let (old, drift) = (motion[at], stress[at].low());
                    let (new, travel) = U::apply::<FMA>(old, value.low(), value.high(), drift);
                    let [x, y, z, _] = new.0;
                    // Nothing moves along z in plane strain, not even where a body does.
                    motion[at] = Lanes4([x, y, if D == 3 { z } else { old.0[2] }, old.0[J]]);
                    shift[at] = travel.times::<FMA>(scale);
                }
                start += places.len();
            }
        }
    }
}
