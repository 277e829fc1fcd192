//! Points to nodes: mass, momentum, impulse of the stress, and what contact needs.

use crate::fields::point::{J, VOLUME};
use crate::lanes::{Lanes4, Lanes8};
use crate::lattice::{HALO, layers, window};
use crate::real::Real;
use crate::runs::run_end;
use crate::settings::ShapeFunction;
use crate::simd::Kernel;
use crate::tiles::{Points, Tile};
use crate::window::{
    BATCH, NOTHING, Pairs, Sides, Window, add, nodal, of_point, of_points, offsets, spread,
    spread_value,
};

/// Points to nodes: mass, momentum, internal impulse and volume into `tile.local`, and first
/// moment of mass and volume gradient near bodies into `tile.wall_local`.
pub(crate) struct P2g<'a, const D: usize, const AFFINE: bool> {
    pub(crate) tile: &'a mut Tile,
    /// dt over cell, s/m.
    pub(crate) dt_over_cell: Real,
    pub(crate) shape: ShapeFunction,
}

impl<const D: usize, const AFFINE: bool> Kernel for P2g<'_, D, AFFINE> {
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Tile {
            points,
            local,
            wall_local,
            near_wall,
            bodies,
            ..
        } = self.tile;
        local.fill(Lanes8::ZERO);
        if *bodies != 0 {
            wall_local.fill(Lanes8::ZERO);
        }
        let mut start = 0;
        while start < points.len() {
            let base = usize::from(points.base[start]);
            let end = run_end(&points.base, start);
            let run = NodePoints {
                points,
                start,
                end,
                dt_over_cell: self.dt_over_cell,
                shape: self.shape,
            };
            let reach = base..base + window(D);
            if *bodies != 0 && near_wall[base] {
                let parts = run.sums::<D, FMA, AFFINE, true>();
                add_near::<D, FMA>(&mut local[reach.clone()], &mut wall_local[reach], &parts);
            } else {
                let (sums, _) = run.sums::<D, FMA, AFFINE, false>();
                add::<D, FMA>(&mut local[reach], &sums);
            }
            start = end;
        }
    }
}

/// Points of one node, which share its window.
struct NodePoints<'a> {
    points: &'a Points,
    start: usize,
    end: usize,
    dt_over_cell: Real,
    shape: ShapeFunction,
}

impl NodePoints<'_> {
    /// Sums at the nodes of [`sum`](crate::fields::sum). With `NEAR` only its impulse and volume, and in the
    /// upper four lanes the gradient of volume; momentum and mass are then in the second window, and beside them the first
    /// moment of mass about the nearest node.
    #[inline(always)]
    fn sums<const D: usize, const FMA: bool, const AFFINE: bool, const NEAR: bool>(
        &self,
    ) -> (Window, Window) {
        let (mut sums, mut values) = (NOTHING, NOTHING);
        let mut start = self.start;
        while start < self.end {
            let places = &self.points.place[start..self.end.min(start + BATCH)];
            let d = offsets::<FMA>(&self.points.place[start..]);
            let sides = Sides::new::<D, FMA>(self.shape, &d);
            let arms = if AFFINE { arms(&d, &sides) } else { sides.g };
            let motion = &self.points.motion[start..start + places.len()];
            let stress = &self.points.stress[start..start + places.len()];
            for p in 0..places.len() {
                let mass = places[p].0[VOLUME];
                let volume = mass * (1.0 + motion[p].0[J]);
                let mut s = stress[p].scaled::<FMA>(-self.dt_over_cell * volume);
                (s.0[6], s.0[7]) = (volume, 0.0);
                let bulk = Lanes4([0.0, 0.0, 0.0, volume]);
                let momentum = beside::<FMA>(&motion[p], 1.0, mass);
                let mut carried = [Lanes4::ZERO; 3];
                if AFFINE {
                    let affine = &self.points.affine[start + p];
                    for a in 0..3 {
                        carried[a] = beside::<FMA>(&affine[a], 0.0, mass);
                    }
                }
                let w = of_point(&sides.w, p);
                if NEAR {
                    let flux = [
                        s.pick::<FMA>([0, 3, 4, 7, 6, 7, 7, 7]),
                        s.pick::<FMA>([3, 1, 5, 7, 7, 6, 7, 7]),
                        s.pick::<FMA>([4, 5, 2, 7, 7, 7, 6, 7]),
                    ];
                    let g = of_point(&sides.g, p);
                    let x = Lanes8::of(bulk, Lanes4::ZERO);
                    spread::<D, FMA>(&mut sums, (&w, &g), x, flux);
                    let x = Lanes8::of(momentum, places[p].scaled::<FMA>(mass));
                    if AFFINE {
                        let mut flux = [Lanes8::ZERO; 3];
                        for a in 0..3 {
                            flux[a] = Lanes8::of(carried[a], Lanes4::ZERO);
                        }
                        let g = of_point(&arms, p);
                        spread::<D, FMA>(&mut values, (&w, &g), x, flux);
                    } else {
                        spread_value::<D, FMA>(&mut values, &w, x);
                    }
                    continue;
                }
                let mut flux = [
                    s.pick::<FMA>([7, 7, 7, 7, 0, 3, 4, 7]),
                    s.pick::<FMA>([7, 7, 7, 7, 3, 1, 5, 7]),
                    s.pick::<FMA>([7, 7, 7, 7, 4, 5, 2, 7]),
                ];
                let mut g = of_point(&sides.g, p);
                if AFFINE {
                    for a in 0..3 {
                        flux[a] = Lanes8::of(carried[a], flux[a].high());
                    }
                    g = of_points((&arms, p), (&sides.g, p));
                }
                spread::<D, FMA>(&mut sums, (&w, &g), Lanes8::of(momentum, bulk), flux);
            }
            start += places.len();
        }
        nodal::<D, FMA>(&mut sums);
        if NEAR {
            nodal::<D, FMA>(&mut values);
        }
        (sums, values)
    }
}

/// A velocity, or a derivative of one, with `last` in the fourth lane, times the mass.
#[inline(always)]
fn beside<const FMA: bool>(velocity: &Lanes4, last: Real, mass: Real) -> Lanes4 {
    let [x, y, z, _] = velocity.0;
    Lanes4([x, y, z, last]).scaled::<FMA>(mass)
}

/// Weights times the way from the point to the lower and the upper node: what carries a velocity that
/// varies linearly (APIC). Those of the three nodes add up to 0, as slopes do.
#[inline(always)]
fn arms(d: &[Lanes8; 3], sides: &Sides) -> Pairs {
    let mut arms = sides.w;
    for a in 0..3 {
        for p in 0..BATCH {
            arms[a][0].0[p] *= -1.0 - d[a].0[p];
            arms[a][1].0[p] *= 1.0 - d[a].0[p];
        }
    }
    arms
}

/// Adds the two parts of a run near bodies to the sums of [`sum`](crate::fields::sum) and
/// [`wall_sum`](crate::fields::wall_sum).
#[inline(always)]
fn add_near<const D: usize, const FMA: bool>(
    nodes: &mut [Lanes8],
    near: &mut [Lanes8],
    (fluxes, values): &(Window, Window),
) {
    for k in 0..layers(D) {
        for j in 0..3 {
            let at = (k * HALO + j) * HALO;
            for i in 0..3 {
                let (flux, value) = (fluxes[k][j][i], values[k][j][i]);
                let sum = Lanes8::of(value.low(), flux.low());
                nodes[at + i] = nodes[at + i].plus::<FMA>(sum);
                // From the nearest node to this one; there is no other along z in plane strain.
                let deep = if D == 3 { k as Real - 1.0 } else { 0.0 };
                let way = Lanes4([1.0 - i as Real, 1.0 - j as Real, -deep, 0.0]);
                let moment = value.high().add_scaled::<FMA>(value.0[VOLUME], way);
                near[at + i] = near[at + i].plus::<FMA>(Lanes8::of(moment, flux.high()));
            }
        }
    }
}
