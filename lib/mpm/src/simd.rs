//! Runs a kernel by the widest vector instructions that the processor has.
#![allow(unsafe_code)]

/// Work that is compiled three times: for the baseline processor, for one with AVX2 and FMA, and for one with
/// AVX-512 beside them. The last two give the same bits: AVX-512 brings more registers and wider loads, no
/// other order of operations.
pub(crate) trait Kernel {
    /// Does the work; everything in it must be `#[inline(always)]`.
    fn run<const FMA: bool>(self);
}

/// Runs `kernel` in the best version this processor can execute.
#[inline]
pub(crate) fn dispatch<K: Kernel>(kernel: K) {
    #[cfg(target_arch = "x86_64")]
    if avx512() {
        // SAFETY: the features were just detected on this processor.
        return unsafe { with_avx512(kernel) };
    } else if avx2() {
        // SAFETY: as above.
        return unsafe { with_avx2(kernel) };
    }
    kernel.run::<false>();
}

#[cfg(target_arch = "x86_64")]
#[inline]
fn avx2() -> bool {
    is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")
}

#[cfg(target_arch = "x86_64")]
#[inline]
fn avx512() -> bool {
    avx2()
        && is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512vl")
        && is_x86_feature_detected!("avx512dq")
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,avx512f,avx512vl,avx512dq")]
fn with_avx512<K: Kernel>(kernel: K) {
    kernel.run::<true>();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn with_avx2<K: Kernel>(kernel: K) {
    kernel.run::<true>();
}

/// Runs the first kernel with AVX2 and the second with AVX-512; says whether the processor has both.
#[cfg(all(test, target_arch = "x86_64", not(feature = "double")))]
pub(crate) fn by_each<K: Kernel>(first: K, second: K) -> bool {
    let wide = avx512();
    if wide {
        // SAFETY: the features of both were just detected on this processor.
        unsafe {
            with_avx2(first);
            with_avx512(second);
        }
    }
    wide
}
