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
    if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma") {
        if std::arch::is_x86_feature_detected!("avx512f")
            && std::arch::is_x86_feature_detected!("avx512vl")
            && std::arch::is_x86_feature_detected!("avx512dq")
        {
            // SAFETY: all five features were just detected on this processor.
            return unsafe { with_avx512(kernel) };
        }
        // SAFETY: both features were just detected on this processor.
        return unsafe { with_avx2(kernel) };
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
