//! The kernels of a run, chosen once by dimensions, update and viscosity law.

use std::marker::PhantomData;

use super::filter::Filter;
use super::g2p::{Affine, FilterAfter, FilterBefore, G2p, Increment, Update};
use super::p2g::P2g;
use crate::gradient::Gradient;
use crate::lanes::Lanes8;
use crate::material::{Constant, Flow, Formula, Segments};
use crate::real::Real;
use crate::settings::{Mode, ShapeFunction};
use crate::simd::{Kernel, dispatch};
use crate::stress::Stress;
use crate::tiles::{Points, Scratch, Tile};

/// The kernels of a run, chosen once, so that no scene pays for what it does not use.
#[derive(Clone, Copy)]
pub(crate) struct Kernels {
    shape: ShapeFunction,
    p2g: fn(&mut Tile, Real, ShapeFunction),
    g2p: fn(&mut Tile, &mut Scratch, Real, ShapeFunction),
    filter: fn(&mut Tile, &[Lanes8], bool, ShapeFunction),
}

impl Kernels {
    pub(crate) fn new(shape: ShapeFunction, three: bool, mode: Mode) -> Self {
        if three {
            Self::within::<3>(shape, mode)
        } else {
            Self::within::<2>(shape, mode)
        }
    }

    fn within<const D: usize>(shape: ShapeFunction, mode: Mode) -> Self {
        match mode {
            Mode::Increment => Self::exact::<Increment, D, false>(shape),
            Mode::Affine => Self::exact::<Affine, D, true>(shape),
            Mode::FilterBefore => Self::exact::<FilterBefore, D, false>(shape),
            Mode::FilterAfter | Mode::Replace => Self::exact::<FilterAfter, D, false>(shape),
        }
    }

    fn exact<U: Update, const D: usize, const AFFINE: bool>(shape: ShapeFunction) -> Self {
        Self {
            shape,
            p2g: |tile, dt_over_cell, shape| {
                dispatch(P2g::<D, AFFINE> {
                    tile,
                    dt_over_cell,
                    shape,
                });
            },
            g2p: |tile, scratch, dt_over_cell, shape| {
                let update = PhantomData;
                dispatch(G2p::<U, D> {
                    tile,
                    scratch,
                    dt_over_cell,
                    shape,
                    update,
                });
            },
            filter: |tile, field, keep, shape| {
                dispatch(Filter::<D> {
                    tile,
                    field,
                    keep,
                    shape,
                });
            },
        }
    }

    /// Points to nodes, with dt over cell.
    pub(crate) fn p2g(&self, tile: &mut Tile, dt_over_cell: Real) {
        (self.p2g)(tile, dt_over_cell, self.shape);
    }

    /// Nodes to points, with dt over cell.
    pub(crate) fn g2p(&self, tile: &mut Tile, scratch: &mut Scratch, dt_over_cell: Real) {
        (self.g2p)(tile, scratch, dt_over_cell, self.shape);
    }

    /// One round of the velocity filter of a nodal field; whether to keep the gathered value.
    pub(crate) fn filter(&self, tile: &mut Tile, field: &[Lanes8], keep: bool) {
        (self.filter)(tile, field, keep, self.shape);
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
