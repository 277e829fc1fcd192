//! The kernels of a run, chosen once by shape function, dimensions, update and viscosity law.

use std::marker::PhantomData;

use super::{Filter, G2p, P2g};
use crate::material::{Constant, Flow, Segments, Stress};
use crate::real::Real;
use crate::settings::{ShapeFunction, VelocityUpdate};
use crate::shape::{Bspline2, Gimp, Linear, Shape};
use crate::simd::{Kernel, dispatch};
use crate::tiles::Tile;

/// The kernels of a run, chosen once, so that no scene pays for what it does not use.
#[derive(Clone, Copy)]
pub(crate) struct Kernels {
    /// Points to nodes, with dt over cell.
    pub(crate) p2g: fn(&mut Tile, Real),
    /// Nodes to points, with dt over cell.
    pub(crate) g2p: fn(&mut Tile, Real, VelocityUpdate),
    /// One round of the velocity filter; whether to keep the gathered value.
    pub(crate) filter: fn(&mut Tile, bool),
}

impl Kernels {
    pub(crate) fn new(shape: ShapeFunction, three: bool, affine: bool) -> Self {
        match shape {
            ShapeFunction::Gimp => Self::of::<Gimp>(three, affine),
            ShapeFunction::Bspline2 => Self::of::<Bspline2>(three, affine),
            ShapeFunction::Linear => Self::of::<Linear>(three, affine),
        }
    }

    fn of<S: Shape>(three: bool, affine: bool) -> Self {
        match (three, affine) {
            (true, true) => Self::exact::<S, 3, true>(),
            (true, false) => Self::exact::<S, 3, false>(),
            (false, true) => Self::exact::<S, 2, true>(),
            (false, false) => Self::exact::<S, 2, false>(),
        }
    }

    fn exact<S: Shape, const D: usize, const AFFINE: bool>() -> Self {
        Self {
            p2g: |tile, dt_over_cell| {
                let shape = PhantomData::<S>;
                dispatch(P2g::<S, D, AFFINE> {
                    tile,
                    dt_over_cell,
                    shape,
                });
            },
            g2p: |tile, dt_over_cell, update| {
                let shape = PhantomData::<S>;
                dispatch(G2p::<S, D, AFFINE> {
                    tile,
                    dt_over_cell,
                    update,
                    shape,
                });
            },
            filter: |tile, keep| {
                let shape = PhantomData::<S>;
                dispatch(Filter::<S, D> { tile, keep, shape });
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
}

impl AnyFlow {
    /// Volume change, shear rate and stress of a tile's points after a step of `dt`.
    pub(crate) fn update(&self, tile: &mut Tile, stress: &Stress, dt: Real) {
        match self {
            Self::Constant(flow) => dispatch(Update {
                tile,
                stress,
                flow,
                dt,
            }),
            Self::Segments(flow) => dispatch(Update {
                tile,
                stress,
                flow,
                dt,
            }),
        }
    }
}

struct Update<'a, F> {
    tile: &'a mut Tile,
    stress: &'a Stress,
    flow: &'a F,
    dt: Real,
}

impl<F: Flow> Kernel for Update<'_, F> {
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        self.stress
            .update(&mut self.tile.points, self.flow, self.dt);
    }
}
