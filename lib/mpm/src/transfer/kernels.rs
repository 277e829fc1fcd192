//! The kernels of a run, chosen once by shape function, dimensions, update and viscosity law.

use std::marker::PhantomData;

use super::filter::Filter;
use super::g2p::{Affine, FilterAfter, FilterBefore, G2p, Increment, Replace, Update};
use super::p2g::P2g;
use crate::lanes::{Lanes4, Lanes8};
use crate::material::{Constant, Flow, Segments, Stress};
use crate::real::Real;
use crate::settings::{Mode, ShapeFunction};
use crate::shape::{Bspline2, Gimp, Linear, Shape};
use crate::simd::{Kernel, dispatch};
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
}

impl AnyFlow {
    /// Volume change, shear rate and stress of a tile's points after a step of `dt`, from the gradient of
    /// velocity at each.
    pub(crate) fn update(
        &self,
        points: &mut Points,
        gradient: &[[Lanes4; 3]],
        stress: &Stress,
        dt: Real,
    ) {
        match self {
            Self::Constant(flow) => dispatch(Refresh {
                points,
                gradient,
                stress,
                flow,
                dt,
            }),
            Self::Segments(flow) => dispatch(Refresh {
                points,
                gradient,
                stress,
                flow,
                dt,
            }),
        }
    }
}

struct Refresh<'a, F> {
    points: &'a mut Points,
    gradient: &'a [[Lanes4; 3]],
    stress: &'a Stress,
    flow: &'a F,
    dt: Real,
}

impl<F: Flow> Kernel for Refresh<'_, F> {
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        self.stress
            .update(self.points, self.gradient, self.flow, self.dt);
    }
}
