//! Nodes to points: velocity by every update, its gradient, and the displacement.

use crate::fields::{node, point::J};
use crate::lanes::{Lanes4, Lanes8, first_eight, transposed, transposed_eight};
use crate::lattice::window;
use crate::real::Real;
use crate::runs::run_end;
use crate::settings::{Mode, ShapeFunction};
use crate::simd::Kernel;
use crate::tiles::{Scratch, Tile};
use crate::window::{BATCH, Sides, Window, differences, gather, gather_lane, offsets};

/// Nodes to points: new velocity, velocity gradient and displacement.
///
/// The scratch holds the nodal velocities of [`node`](crate::fields::node).
pub(crate) struct G2p<'a, const D: usize, const MODE: u8> {
    pub(crate) tile: &'a mut Tile,
    pub(crate) scratch: &'a mut Scratch,
    /// dt over cell, s/m.
    pub(crate) dt_over_cell: Real,
    pub(crate) shape: ShapeFunction,
}

const INCREMENT: u8 = Mode::Increment as u8;
const AFFINE: u8 = Mode::Affine as u8;
const FILTER_BEFORE: u8 = Mode::FilterBefore as u8;

/// Of a component at eight points, the new velocity and that of the displacement from their own (`old`), S v+ (`plus`), S of the
/// second half (`second`) and S w_1 (`drift`): the table of docs/methods.md, section 2.3.
#[inline(always)]
fn updated<const MODE: u8, const FMA: bool>(
    [old, plus, second, drift]: [Lanes8; 4],
) -> [Lanes8; 2] {
    match MODE {
        INCREMENT => [
            old.plus::<FMA>(second),
            plus.add_product::<FMA>(Lanes8([-0.5; 8]), second),
        ],
        AFFINE => [plus, plus],
        FILTER_BEFORE => {
            let change = second.minus::<FMA>(old);
            [second, drift.add_product::<FMA>(Lanes8([0.5; 8]), change)]
        }
        // FMPM, and what else has v* = v+: PIC and XPIC(1).
        _ => [second, plus],
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

/// The affine field of APIC at eight points: its derivatives along x, y, z.
#[inline(always)]
fn affine<const D: usize, const FMA: bool>(
    window: &Window,
    moments: &Sides,
) -> [[Lanes4; 3]; BATCH] {
    let mut along = [[Lanes8::ZERO; 3]; 3];
    for c in 0..3 {
        along[c] = gather::<D, FMA>(window, c, moments).1;
    }
    let [x, y, z] = along;
    let o = Lanes8::ZERO;
    let list = transposed_eight::<FMA>(&[x[0], y[0], z[0], o, x[1], y[1], z[1], o]);
    let last = transposed_eight::<FMA>(&[x[2], y[2], z[2], o, o, o, o, o]);
    let mut fields = [[Lanes4::ZERO; 3]; BATCH];
    for p in 0..BATCH {
        fields[p] = [list[p].low(), list[p].high(), last[p].low()];
    }
    fields
}

/// Lanes 0 to 2 of `stress` of up to eight points.
#[inline(always)]
fn drift<const FMA: bool>(stress: &[Lanes8]) -> [Lanes8; 3] {
    let mut list = [Lanes4::ZERO; BATCH];
    for (drift, stress) in list.iter_mut().zip(stress) {
        *drift = stress.low();
    }
    let [x, y, z, _] = transposed::<FMA>(&list);
    [x, y, z]
}

impl<const D: usize, const MODE: u8> Kernel for G2p<'_, D, MODE> {
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
        let (motion, stress) = (&mut points.motion[..n], &points.stress[..n]);
        shift.resize(n, Lanes4::ZERO);
        gradient.resize(n);
        let shift = &mut shift[..n];
        let scale = Lanes8([self.dt_over_cell; BATCH]);
        let mut start = 0;
        while start < n {
            let (base, end) = (usize::from(bases[start]), run_end(bases, start));
            let window = differences::<D, FMA>(&field[base..base + window(D)]);
            while start < end {
                let batch = start..end.min(start + BATCH);
                let d = offsets::<FMA>(&place[start..]);
                let sides = Sides::new::<D, FMA>(self.shape, &d);
                if MODE == AFFINE {
                    let fields = affine::<D, FMA>(&window, &moments::<D>(&d, &sides));
                    for p in batch.clone() {
                        points.affine[p] = fields[p - start];
                    }
                }
                let old = transposed::<FMA>(&first_eight(&motion[start..]));
                let mut drifts = [Lanes8::ZERO; 3];
                if MODE == FILTER_BEFORE {
                    drifts = drift::<FMA>(&stress[start..]);
                }
                // New velocity and j, displacement.
                let mut fields = [Lanes8::ZERO; 8];
                (fields[2], fields[J]) = (old[2], old[J]);
                for c in 0..3 {
                    let (plus, slopes) = gather::<D, FMA>(&window, c, &sides);
                    gradient.set(start, c, &slopes);
                    // Nothing moves along z in plane strain, not even where a body does.
                    if c < D {
                        let mut second = Lanes8::ZERO;
                        if MODE != AFFINE {
                            second = gather_lane::<D, FMA>(&window, node::SECOND + c, &sides.w);
                        }
                        let [new, travel] = updated::<MODE, FMA>([old[c], plus, second, drifts[c]]);
                        (fields[c], fields[4 + c]) = (new, travel.times::<FMA>(scale));
                    }
                }
                let list = transposed_eight::<FMA>(&fields);
                let ends = motion[batch.clone()]
                    .iter_mut()
                    .zip(&mut shift[batch.clone()]);
                for ((motion, shift), end) in ends.zip(&list) {
                    (*motion, *shift) = (end.low(), end.high());
                }
                start = batch.end;
            }
        }
    }
}
