//! The kernels of a run, chosen once by shape function, dimensions, update and viscosity law.

use std::marker::PhantomData;

use super::filter::Filter;
use super::g2p::{Affine, FilterAfter, FilterBefore, G2p, Increment, Replace, Update};
use super::p2g::P2g;
use crate::gradient::Gradient;
use crate::lanes::Lanes8;
use crate::material::{Constant, Flow, Formula, Segments};
use crate::real::Real;
use crate::settings::{Mode, ShapeFunction};
use crate::shape::{Bspline2, Gimp, Linear, Shape};
use crate::simd::{Kernel, dispatch};
use crate::stress::Stress;
use crate::tiles::{Points, Scratch, Tile};

/// The kernels of a run, chosen once, so that no scene pays for what it does not use.
#[derive(Clone, Copy)]
pub(crate) struct Kernels {
    /// Points to nodes, with dt over cell.
    pub(crate) p2g: fn(&mut Tile, Real),
    /// Nodes to points, with dt over cell.
    pub(crate) g2p: fn(&mut Tile, &mut Scratch, Real),
    /// One round of the velocity filter of a nodal field; whether to keep the gathered value.
    pub(crate) filter: fn(&mut Tile, &[Lanes8], bool),
}

impl Kernels {
    pub(crate) fn new(shape: ShapeFunction, three: bool, mode: Mode) -> Self {
        match shape {
            ShapeFunction::Gimp => Self::of::<Gimp>(three, mode),
            ShapeFunction::Bspline2 => Self::of::<Bspline2>(three, mode),
            ShapeFunction::Linear => Self::of::<Linear>(three, mode),
        }
    }

    fn of<S: Shape>(three: bool, mode: Mode) -> Self {
        if three {
            Self::within::<S, 3>(mode)
        } else {
            Self::within::<S, 2>(mode)
        }
    }

    fn within<S: Shape, const D: usize>(mode: Mode) -> Self {
        match mode {
            Mode::Increment => Self::exact::<S, Increment, D, false>(),
            Mode::Replace => Self::exact::<S, Replace, D, false>(),
            Mode::Affine => Self::exact::<S, Affine, D, true>(),
            Mode::FilterBefore => Self::exact::<S, FilterBefore, D, false>(),
            Mode::FilterAfter => Self::exact::<S, FilterAfter, D, false>(),
        }
    }

    fn exact<S: Shape, U: Update, const D: usize, const AFFINE: bool>() -> Self {
        Self {
            p2g: |tile, dt_over_cell| {
                let shape = PhantomData::<S>;
                dispatch(P2g::<S, D, AFFINE> {
                    tile,
                    dt_over_cell,
                    shape,
                });
            },
            g2p: |tile, scratch, dt_over_cell| {
                let of = PhantomData;
                dispatch(G2p::<S, U, D> {
                    tile,
                    scratch,
                    dt_over_cell,
                    of,
                });
            },
            filter: |tile, field, keep| {
                let shape = PhantomData::<S>;
                dispatch(Filter::<S, D> {
                    tile,
                    field,
                    keep,
                    shape,
                });
            },
        }
    }
}

/// The liquid's flow law, resolved once per run.
pub(crate) enum AnyFlow {
    /// One viscosity.
    Constant(Constant),
    /// A table.
    Segments(Segments),
    /// A formula.
    Formula(Formula),
}

impl AnyFlow {
    /// Volume change, shear rate and stress of a tile's points after a step of `dt`, from the gradient of
    /// velocity at each.
    pub(crate) fn update(
        &self,
        points: &mut Points,
        gradient: &Gradient,
        stress: &Stress,
        dt: Real,
    ) {
        match self {
            Self::Constant(flow) => dispatch(Refresh(points, gradient, stress, flow, dt)),
            Self::Segments(flow) => dispatch(Refresh(points, gradient, stress, flow, dt)),
            Self::Formula(flow) => dispatch(Refresh(points, gradient, stress, flow, dt)),
        }
    }
}

struct Refresh<'a, F>(&'a mut Points, &'a Gradient, &'a Stress, &'a F, Real);

impl<F: Flow> Kernel for Refresh<'_, F> {
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Self(points, gradient, stress, flow, dt) = self;
        stress.update::<F, FMA>(points, gradient, flow, dt);
    }
}

#[cfg(all(test, target_arch = "x86_64", not(feature = "double")))]
mod tests {
    use super::*;
    use crate::lanes::Lanes4;
    use crate::lattice::Lattice;
    use crate::stages::Present;
    use crate::tiles::{Point, base_of};

    /// What a step and a round of the filter do to a tile by its points.
    struct Transfers<'a>(&'a mut Tile, &'a mut Scratch, &'a Stress);

    impl Kernel for Transfers<'_> {
        #[inline(always)]
        fn run<const FMA: bool>(self) {
            let Self(tile, scratch, stress) = self;
            let (dt_over_cell, dt, keep) = (1e-3, 1e-9, false);
            let (shape, of) = (PhantomData::<Gimp>, PhantomData::<(Gimp, Increment)>);
            let p2g = P2g::<Gimp, 3, false> {
                tile,
                dt_over_cell,
                shape,
            };
            p2g.run::<FMA>();
            let twice = tile.local.iter().map(|x| Lanes8::of(x.low(), x.low()));
            scratch.field = twice.collect();
            let field = &scratch.field[..];
            let filter = Filter::<Gimp, 3> {
                tile,
                field,
                keep,
                shape,
            };
            filter.run::<FMA>();
            let g2p = G2p::<Gimp, _, 3> {
                tile,
                scratch,
                dt_over_cell,
                of,
            };
            g2p.run::<FMA>();
            let (flow, gradient) = (&Constant::new(1.3, 1200.0), &scratch.gradient);
            let points = &mut tile.points;
            Refresh(points, gradient, stress, flow, dt).run::<FMA>();
        }
    }

    /// A tile half of whose nodes are near a body, with one to nine points a node.
    fn tile() -> Tile {
        let lattice = Lattice {
            cells: [8; 3],
            boundary: [physics::Boundary::Open; 3],
            three: true,
        };
        let present = Present {
            filter: true,
            ..Present::CONTACT
        };
        let mut tile = Tile::new(lattice.tile_key([4; 3]), &lattice, present, 1);
        tile.bodies = 1;
        tile.wall_local = vec![Lanes8::ZERO; lattice.halo_len()];
        let mut seed = 1_u32;
        let mut noise = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 8) as f32 / (1 << 24) as f32 - 0.5
        };
        for node in 0..64 {
            let base = base_of([node % 4, node / 4 % 4, node / 16]);
            tile.near_wall[usize::from(base)] = node % 2 == 0;
            for id in 0..=node as u32 % 9 {
                let point = Point {
                    id,
                    place: Lanes4([noise(), noise(), noise(), 0.125]),
                    motion: Lanes4([noise(), noise(), noise(), 1e-3 * noise()]),
                    stress: Lanes8([(); 8].map(|()| noise())),
                    affine: [Lanes4::ZERO; 3],
                };
                tile.points.push(&point, base, false);
            }
        }
        tile
    }

    fn bits(tile: &Tile, scratch: &Scratch) -> Vec<u32> {
        let points = &tile.points;
        let eights = tile.local.iter().chain(&tile.wall_local);
        let eights = eights.chain(&points.stress).flat_map(|x| x.0);
        let fours = points.motion.iter().chain(&tile.filtered);
        let fours = fours.chain(&scratch.shift).flat_map(|x| x.0);
        let starts = (0..scratch.shift.len()).step_by(8);
        let slopes = starts.flat_map(|p| scratch.gradient.of_eight(p));
        let all = eights
            .chain(fours)
            .chain(slopes.flatten().flat_map(|x| x.0));
        all.map(f32::to_bits).collect()
    }

    #[test]
    fn avx512_gives_the_bits_of_avx2() {
        let liquid = physics::Liquid {
            density: 1200.0,
            tait: physics::Tait { bulk_modulus: 1e9 },
            viscosity: physics::Viscosity::Newtonian(physics::Newtonian(1.3)),
            shear_rate: physics::ShearRate::Paper,
            cure: None,
            water: None,
            cavitation_pressure: None,
            wetting: None,
        };
        let stress = Stress::new(&liquid, 2.9e-6, f64::INFINITY);
        let (mut first, mut second) = (tile(), tile());
        let (mut narrow, mut wide) = (Scratch::default(), Scratch::default());
        let before = bits(&first, &narrow);
        let both = crate::simd::by_each(
            Transfers(&mut first, &mut narrow, &stress),
            Transfers(&mut second, &mut wide, &stress),
        );
        if both {
            let after = bits(&first, &narrow);
            assert!(after == bits(&second, &wide));
            assert!(after.len() > before.len() && after[..before.len()] != before[..]);
        }
    }
}
