//! One round of the velocity filter of XPIC and FMPM: nodes to points and back.

use std::marker::PhantomData;

use crate::fields::node;
use crate::fields::point::VOLUME;
use crate::lanes::Lanes4;
use crate::lattice::{HALO, layers, window};
use crate::shape::Shape;
use crate::simd::Kernel;
use crate::tiles::Tile;

/// One application of S+ S before division by the nodal mass: gathers `tile.filter_in` to the
/// points and sums it, weighted by mass, into `tile.filter_out`.
pub(crate) struct Filter<'a, S, const D: usize> {
    pub(crate) tile: &'a mut Tile,
    /// Keep the gathered value, which is S w1 in the first round.
    pub(crate) keep: bool,
    pub(crate) shape: PhantomData<S>,
}

impl<S: Shape, const D: usize> Kernel for Filter<'_, S, D> {
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Tile {
            points,
            filter_in,
            filter_out,
            ..
        } = self.tile;
        filter_out.fill(Lanes4::ZERO);
        let n = points.len();
        let (place, bases, shift) = (
            &points.place[..n],
            &points.base[..n],
            &mut points.shift[..n],
        );
        for p in 0..n {
            let base = usize::from(bases[p]);
            let weights = S::weights(place[p]);
            let (w, nodes) = (&weights.w, &filter_in[base..base + window(D)]);
            let mut value = Lanes4::ZERO;
            for layer in 0..layers(D) {
                let mut plane = Lanes4::ZERO;
                for row in 0..3 {
                    let at = layer * HALO * HALO + row * HALO;
                    let line = nodes[at]
                        .scaled(w[0].0[0])
                        .add_scaled::<FMA>(w[1].0[0], nodes[at + 1])
                        .add_scaled::<FMA>(w[2].0[0], nodes[at + 2]);
                    plane = plane.add_scaled::<FMA>(w[row].0[1], line);
                }
                value = if D == 3 {
                    value.add_scaled::<FMA>(w[layer].0[2], plane)
                } else {
                    plane
                };
            }
            // Every node has 1 there: the sum of the weights as it was rounded.
            let value = value.scaled(1.0 / value.0[node::ONE]);
            if self.keep {
                shift[p] = value;
            }
            let momentum = value.scaled(place[p].0[VOLUME]);
            let nodes = &mut filter_out[base..base + window(D)];
            for layer in 0..layers(D) {
                let plane = if D == 3 {
                    momentum.scaled(w[layer].0[2])
                } else {
                    momentum
                };
                for row in 0..3 {
                    let line = plane.scaled(w[row].0[1]);
                    let at = layer * HALO * HALO + row * HALO;
                    for i in 0..3 {
                        nodes[at + i] = nodes[at + i].add_scaled::<FMA>(w[i].0[0], line);
                    }
                }
            }
        }
    }
}
