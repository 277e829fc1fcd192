//! Runs a kernel by the widest vector instructions that the processor has.
#![allow(unsafe_code)]

/// Work that is compiled three times: for the baseline processor, for one with AVX2 and FMA, and for one with AVX-512 beside them.
/// The last two give the same bits: of AVX-512 come twice as many registers, no other order of operations.
pub(crate) trait Kernel {
    /// Does the work; everything in it must be `#[inline(always)]`.
    fn run<const FMA: bool>(self);
}

/// Runs `kernel` in the best version this processor can execute.
#[inline]
pub(crate) fn dispatch<K: Kernel>(kernel: K) {
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
        let more = is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl");
        // SAFETY: the features were just detected on this processor.
        return match more && is_x86_feature_detected!("avx512dq") {
            true => unsafe { with_avx512(kernel) },
            false => unsafe { with_avx2(kernel) },
        };
    }
    kernel.run::<false>();
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
