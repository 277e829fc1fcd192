//! The kernels of a run, chosen once by dimensions, update and viscosity law.

use super::filter::Filter;
use super::g2p::G2p;
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
    /// Points to nodes, with dt over cell.
    pub(crate) p2g: fn(&mut Tile, Real, ShapeFunction),
    /// Nodes to points, with dt over cell.
    pub(crate) g2p: fn(&mut Tile, &mut Scratch, Real, ShapeFunction),
    /// One round of the velocity filter of a nodal field; whether to keep the gathered value.
    pub(crate) filter: fn(&mut Tile, &[Lanes8], bool, ShapeFunction),
}

impl Kernels {
    // Inlined, the kernels would be compiled again in each crate that starts a run.
    #[inline(never)]
    pub(crate) fn new(three: bool, mode: Mode) -> Self {
        if three {
            Self::within::<3>(mode)
        } else {
            Self::within::<2>(mode)
        }
    }

    fn within<const D: usize>(mode: Mode) -> Self {
        match mode {
            Mode::Increment => Self::exact::<D, { Mode::Increment as u8 }, false>(),
            Mode::Affine => Self::exact::<D, { Mode::Affine as u8 }, true>(),
            Mode::FilterBefore => Self::exact::<D, { Mode::FilterBefore as u8 }, false>(),
            Mode::FilterAfter | Mode::Replace => {
                Self::exact::<D, { Mode::FilterAfter as u8 }, false>()
            }
        }
    }

    fn exact<const D: usize, const MODE: u8, const AFFINE: bool>() -> Self {
        Self {
            p2g: |tile, dt_over_cell, shape| {
                dispatch(P2g::<D, AFFINE> {
                    tile,
                    dt_over_cell,
                    shape,
                });
            },
            g2p: |tile, scratch, dt_over_cell, shape| {
                dispatch(G2p::<D, MODE> {
                    tile,
                    scratch,
                    dt_over_cell,
                    shape,
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
