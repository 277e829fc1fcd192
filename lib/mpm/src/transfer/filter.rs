//! One round of the velocity filter of XPIC and FMPM: nodes to points and back.

use crate::fields::point::VOLUME;
use crate::lanes::{Lanes4, Lanes8};
use crate::lattice::{HALO, layers, window};
use crate::runs::run_end;
use crate::settings::ShapeFunction;
use crate::simd::Kernel;
use crate::tiles::Tile;
use crate::window::{
    BATCH, NOTHING, Sides, Window, differences, gather_value, nodal, of_points, offsets,
    spread_value,
};

/// One application of S+ S before division by the nodal mass: gathers `field` to the
/// points and sums it, weighted by mass, into `tile.filtered`. Two points at a time, one in the lower
/// and one in the upper four lanes.
pub(crate) struct Filter<'a, const D: usize> {
    pub(crate) tile: &'a mut Tile,
    /// Nodal values, each twice.
    pub(crate) field: &'a [Lanes8],
    /// Keep the gathered value, which is S w1 in the first round, in place of the points' stress: the nodes
    /// have that already, and it is new after nodes to points.
    pub(crate) keep: bool,
    pub(crate) shape: ShapeFunction,
}

impl<const D: usize> Kernel for Filter<'_, D> {
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Tile {
            points, filtered, ..
        } = self.tile;
        filtered.fill(Lanes4::ZERO);
        let n = points.len();
        let (place, bases) = (&points.place[..n], &points.base[..n]);
        let stress = &mut points.stress[..n];
        let mut start = 0;
        while start < n {
            let (base, end) = (usize::from(bases[start]), run_end(bases, start));
            let field = differences::<D, FMA>(&self.field[base..base + window(D)]);
            let mut sums = NOTHING;
            while start < end {
                let places = &place[start..end.min(start + BATCH)];
                let sides = Sides::new::<D, FMA>(self.shape, &offsets::<FMA>(&place[start..]));
                for p in (0..places.len()).step_by(2) {
                    let pair = of_points((&sides.w, p), (&sides.w, p + 1));
                    let value = gather_value::<D, FMA>(&field, &pair);
                    // The last of an odd number goes with one of no mass.
                    let (a, mut b) = (places[p].0[VOLUME], 0.0);
                    if p + 1 < places.len() {
                        b = places[p + 1].0[VOLUME];
                        if self.keep {
                            stress[start + p + 1] = Lanes8::of(value.high(), Lanes4::ZERO);
                        }
                    }
                    if self.keep {
                        stress[start + p] = Lanes8::of(value.low(), Lanes4::ZERO);
                    }
                    let momentum = value.times::<FMA>(Lanes8([a, a, a, a, b, b, b, b]));
                    spread_value::<D, FMA>(&mut sums, &pair, momentum);
                }
                start += places.len();
            }
            nodal::<D, FMA>(&mut sums);
            add_both::<D, FMA>(&mut filtered[base..base + window(D)], &sums);
        }
    }
}

/// Adds the sums of both points.
#[inline(always)]
fn add_both<const D: usize, const FMA: bool>(nodes: &mut [Lanes4], sums: &Window) {
    for k in 0..layers(D) {
        for j in 0..3 {
            let at = (k * HALO + j) * HALO;
            for i in 0..3 {
                let sum = sums[k][j][i];
                let both = sum.low().plus::<FMA>(sum.high());
                nodes[at + i] = nodes[at + i].plus::<FMA>(both);
            }
        }
    }
}
