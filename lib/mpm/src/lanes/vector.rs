//! Operations on whole vectors by the instructions of AVX2 and FMA. Left to itself the compiler takes vectors
//! of several fields apart lane by lane and puts them together otherwise, at up to twice the cost.
//!
//! Called by kernels alone that `simd` runs after it has asked the processor for these instructions.

#![allow(unsafe_code)]

use std::arch::x86_64::*;
use std::mem::transmute;

macro_rules! operations {
    ($name:ident, $n:literal, $vector:ident, $add:ident, $mul:ident, $fma:ident) => {
        pub(super) mod $name {
            use super::*;
            type Array = [f32; $n];

            #[inline(always)]
            fn vector(x: Array) -> $vector {
                // SAFETY: array and vector are the same bits.
                unsafe { transmute::<Array, $vector>(x) }
            }
            #[inline(always)]
            fn array(x: $vector) -> Array {
                // SAFETY: array and vector are the same bits.
                unsafe { transmute::<$vector, Array>(x) }
            }
            /// `a b + c`.
            #[inline(always)]
            pub(in crate::lanes) fn fused(a: Array, b: Array, c: Array) -> Array {
                // SAFETY: `simd` has found FMA.
                array(unsafe { $fma(vector(a), vector(b), vector(c)) })
            }
            #[inline(always)]
            #[allow(unused_unsafe, reason = "four lanes need no feature asked for")]
            pub(in crate::lanes) fn sum(a: Array, b: Array) -> Array {
                // SAFETY: `simd` has found AVX.
                array(unsafe { $add(vector(a), vector(b)) })
            }
            #[inline(always)]
            #[allow(unused_unsafe, reason = "four lanes need no feature asked for")]
            pub(in crate::lanes) fn product(a: Array, b: Array) -> Array {
                // SAFETY: as of `sum`.
                array(unsafe { $mul(vector(a), vector(b)) })
            }
        }
    };
}

operations!(
    eight,
    8,
    __m256,
    _mm256_add_ps,
    _mm256_mul_ps,
    _mm256_fmadd_ps
);
operations!(four, 4, __m128, _mm_add_ps, _mm_mul_ps, _mm_fmadd_ps);

/// `a - b`.
#[inline(always)]
pub(super) fn difference(a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
    // SAFETY: `simd` has found AVX; arrays and vectors are the same bits.
    unsafe {
        let (a, b) = (
            transmute::<[f32; 8], __m256>(a),
            transmute::<[f32; 8], __m256>(b),
        );
        transmute::<__m256, [f32; 8]>(_mm256_sub_ps(a, b))
    }
}

/// The lanes `from` of `x`.
#[inline(always)]
pub(super) fn pick(x: [f32; 8], from: [usize; 8]) -> [f32; 8] {
    let mut index = [0_i32; 8];
    for l in 0..8 {
        index[l] = from[l] as i32;
    }
    // SAFETY: `simd` has found AVX2; the instruction takes the lowest three bits of an index.
    unsafe {
        let index = transmute::<[i32; 8], __m256i>(index);
        let x = transmute::<[f32; 8], __m256>(x);
        transmute::<__m256, [f32; 8]>(_mm256_permutevar8x32_ps(x, index))
    }
}

/// Of vectors 0 and 4, 1 and 5, 2 and 6, 3 and 7, four lanes each: lane 0, 1, 2, 3 of all eight.
#[inline(always)]
pub(super) fn transposed(pairs: [[f32; 8]; 4]) -> [[f32; 8]; 4] {
    // SAFETY: `simd` has found AVX; arrays and vectors are the same bits.
    unsafe {
        let [a, b, c, d] = transmute::<[[f32; 8]; 4], [__m256; 4]>(pairs);
        let (ab, cd) = (_mm256_unpacklo_ps(a, b), _mm256_unpacklo_ps(c, d));
        let (ab, cd) = (_mm256_castps_pd(ab), _mm256_castps_pd(cd));
        let (ef, gh) = (_mm256_unpackhi_ps(a, b), _mm256_unpackhi_ps(c, d));
        let (ef, gh) = (_mm256_castps_pd(ef), _mm256_castps_pd(gh));
        transmute::<[__m256d; 4], [[f32; 8]; 4]>([
            _mm256_unpacklo_pd(ab, cd),
            _mm256_unpackhi_pd(ab, cd),
            _mm256_unpacklo_pd(ef, gh),
            _mm256_unpackhi_pd(ef, gh),
        ])
    }
}

/// The lower halves of two, and their upper halves.
#[inline(always)]
fn halves(x: [f32; 8], y: [f32; 8]) -> [[f32; 8]; 2] {
    // SAFETY: `simd` has found AVX; arrays and vectors are the same bits.
    unsafe {
        let x = transmute::<[f32; 8], __m256>(x);
        let y = transmute::<[f32; 8], __m256>(y);
        transmute::<[__m256; 2], [[f32; 8]; 2]>([
            _mm256_permute2f128_ps::<0x20>(x, y),
            _mm256_permute2f128_ps::<0x31>(x, y),
        ])
    }
}

/// Lane 0, 1, ... 7 of all eight.
#[inline(always)]
pub(super) fn transposed_eight(list: [[f32; 8]; 8]) -> [[f32; 8]; 8] {
    let [a, b, c, d, e, f, g, h] = list;
    let ([a, e], [b, f]) = (halves(a, e), halves(b, f));
    let ([c, g], [d, h]) = (halves(c, g), halves(d, h));
    let ([a, b, c, d], [e, f, g, h]) = (transposed([a, b, c, d]), transposed([e, f, g, h]));
    [a, b, c, d, e, f, g, h]
}
