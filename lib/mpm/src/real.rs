//! The precision of state and arithmetic: single, or double when built with the feature
//! `double`, which shows how large rounding errors are and what it costs. Sums over the whole run, positions
//! of bodies and the clamp are in double precision in both.

use physics::{Pieces, Saved, Saving};

/// A number of a point or node.
#[cfg(not(feature = "double"))]
pub(crate) type Real = f32;
/// A number of a point or node.
#[cfg(feature = "double")]
pub(crate) type Real = f64;

/// Bytes of a [`Real`].
pub(crate) const BYTES: u64 = size_of::<Real>() as u64;

/// Numbers as they are kept in checkpoints.
pub(crate) fn saving(pieces: Pieces<'_, Real>) -> Saving<'_> {
    #[cfg(not(feature = "double"))]
    return Saving::F32(pieces);
    #[cfg(feature = "double")]
    return Saving::F64(pieces);
}

/// What [`saving`] kept under `name`; a checkpoint of the other precision is refused.
pub(crate) fn saved<'a>(saved: &'a Saved, name: &str) -> Result<&'a [Real], String> {
    #[cfg(not(feature = "double"))]
    return saved.f32s(name);
    #[cfg(feature = "double")]
    return saved.f64s(name);
}

/// Terms after which the series of exp(x) - 1 for |x| < 1/4 is exact to rounding.
pub(crate) const TERMS: usize = if BYTES == 4 { 7 } else { 13 };
/// 1/k!.
pub(crate) const RECIPROCALS: [Real; TERMS + 1] = {
    let (mut list, mut factorial, mut k) = ([1.0; TERMS + 1], 1.0, 1);
    while k <= TERMS {
        factorial *= k as Real;
        list[k] = 1.0 / factorial;
        k += 1;
    }
    list
};

/// exp(x) - 1 without cancellation: a series where it is exact to rounding, else by exp.
#[inline(always)]
pub(crate) fn exp_m1(x: Real) -> Real {
    if x.abs() < 0.25 {
        let mut tail = RECIPROCALS[TERMS];
        for k in (2..TERMS).rev() {
            tail = RECIPROCALS[k] + x * tail;
        }
        x + x * x * tail
    } else {
        x.exp() - 1.0
    }
}
