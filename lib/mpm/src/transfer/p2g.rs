//! Points to nodes: mass, momentum, impulse of the stress, and what contact needs.

use std::marker::PhantomData;

use crate::fields::point::{J, VOLUME};
use crate::fields::{sum, wall_sum};
use crate::lanes::{Lanes4, Lanes8};
use crate::lattice::{HALO, layers, window};
use crate::real::Real;
use crate::shape::{Shape, Weights};
use crate::simd::Kernel;
use crate::tiles::Tile;

/// Points to nodes: mass, momentum, internal impulse and volume into `tile.local`, and first
/// moment of mass and volume gradient near bodies into `tile.wall_local`.
pub(crate) struct P2g<'a, S, const D: usize, const AFFINE: bool> {
    pub(crate) tile: &'a mut Tile,
    /// dt over cell, s/m.
    pub(crate) dt_over_cell: Real,
    pub(crate) shape: PhantomData<S>,
}

/// Offsets of the window's nodes from the nearest one.
const OFFSET: [Real; 3] = [-1.0, 0.0, 1.0];

/// Lanes 0..4 weighted for momentum that varies linearly (APIC), 4..8 for stress.
#[inline(always)]
fn slope<const AFFINE: bool>(weights: &Weights, node: usize, axis: usize) -> Lanes8 {
    let g = weights.g[node].0[axis];
    if AFFINE {
        let w = OFFSET[node] * weights.w[node].0[axis];
        Lanes8([w, w, w, w, g, g, g, g])
    } else {
        Lanes8([g; 8])
    }
}

impl<S: Shape, const D: usize, const AFFINE: bool> Kernel for P2g<'_, S, D, AFFINE> {
    /// A loop of its own for tiles without a body in reach: the others' extra sums, never taken
    /// there, would take registers from it.
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        if self.tile.bodies == 0 {
            self.sum::<FMA, false>();
        } else {
            self.sum::<FMA, true>();
        }
    }
}

impl<S: Shape, const D: usize, const AFFINE: bool> P2g<'_, S, D, AFFINE> {
    #[inline(always)]
    fn sum<const FMA: bool, const WALLS: bool>(self) {
        let Tile {
            points,
            local,
            wall_local,
            near_wall,
            ..
        } = self.tile;
        local.fill(Lanes8::ZERO);
        if WALLS {
            wall_local.fill(Lanes8::ZERO);
        }
        let n = points.len();
        let (place, motion) = (&points.place[..n], &points.motion[..n]);
        let (stress, bases) = (&points.stress[..n], &points.base[..n]);
        for p in 0..n {
            let base = usize::from(bases[p]);
            let (d, v) = (place[p], motion[p]);
            let weights = S::weights(d);
            let mass = d.0[VOLUME];
            let volume = mass * (1.0 + v.0[J]);
            let k = -self.dt_over_cell * volume;
            let [xx, yy, zz, xy, xz, yz, ..] = stress[p].0;
            let mut q = Lanes8([
                mass,
                mass * v.0[0],
                mass * v.0[1],
                mass * v.0[2],
                0.0,
                0.0,
                0.0,
                volume,
            ]);
            let mut flux = [
                Lanes8([0.0, 0.0, 0.0, 0.0, k * xx, k * xy, k * xz, 0.0]),
                Lanes8([0.0, 0.0, 0.0, 0.0, k * xy, k * yy, k * yz, 0.0]),
                Lanes8([0.0, 0.0, 0.0, 0.0, k * xz, k * yz, k * zz, 0.0]),
            ];
            if AFFINE {
                let affine = &points.affine[p];
                for (a, f) in flux.iter_mut().enumerate().take(D) {
                    for l in 0..3 {
                        let c = mass * affine[a].0[l];
                        q.0[sum::MOMENTUM + l] -= c * d.0[a];
                        f.0[sum::MOMENTUM + l] = c;
                    }
                }
            }
            let nodes = &mut local[base..base + window(D)];
            for layer in 0..layers(D) {
                let (top, side, along) = if D == 3 {
                    let wz = weights.w[layer].0[2];
                    let gz = slope::<AFFINE>(&weights, layer, 2);
                    (
                        q.scaled(wz).add_product::<FMA>(gz, flux[2]),
                        flux[1].scaled(wz),
                        flux[0].scaled(wz),
                    )
                } else {
                    (q, flux[1], flux[0])
                };
                for row in 0..3 {
                    let wy = weights.w[row].0[1];
                    let gy = slope::<AFFINE>(&weights, row, 1);
                    let constant = top.scaled(wy).add_product::<FMA>(gy, side);
                    let linear = along.scaled(wy);
                    let at = layer * HALO * HALO + row * HALO;
                    for i in 0..3 {
                        nodes[at + i] = nodes[at + i]
                            .add_scaled::<FMA>(weights.w[i].0[0], constant)
                            .add_product::<FMA>(slope::<AFFINE>(&weights, i, 0), linear);
                    }
                }
            }
            if WALLS && near_wall[base] {
                let nodes = &mut wall_local[base..base + window(D)];
                wall_sums::<D, FMA>(nodes, &weights, d, mass, volume);
            }
        }
    }
}

/// Adds the sums of [`wall_sum`]: mass-weighted position relative to each node, volume gradient.
#[inline(always)]
fn wall_sums<const D: usize, const FMA: bool>(
    nodes: &mut [Lanes8],
    weights: &Weights,
    d: Lanes4,
    mass: Real,
    volume: Real,
) {
    let scale = Lanes8([mass, mass, mass, volume, volume, volume, 0.0, 0.0]);
    let lanes = |node: usize, axis: usize| {
        let w = weights.w[node].0[axis];
        let mut r = Lanes8([w; 8]);
        r.0[wall_sum::MOMENT + axis] = w * (d.0[axis] - OFFSET[node]);
        r.0[wall_sum::GRADIENT + axis] = weights.g[node].0[axis];
        r
    };
    let x = [lanes(0, 0), lanes(1, 0), lanes(2, 0)];
    for layer in 0..layers(D) {
        let z = if D == 3 {
            scale.times(lanes(layer, 2))
        } else {
            let mut flat = scale;
            flat.0[wall_sum::MOMENT + 2] = 0.0;
            flat.0[wall_sum::GRADIENT + 2] = 0.0;
            flat
        };
        for row in 0..3 {
            let zy = z.times(lanes(row, 1));
            let at = layer * HALO * HALO + row * HALO;
            for (i, x) in x.iter().enumerate() {
                nodes[at + i] = nodes[at + i].add_product::<FMA>(*x, zy);
            }
        }
    }
}
