//! Runs a kernel by the widest vector instructions that the processor has.
#![allow(unsafe_code)]

/// Work that is compiled twice: for the baseline processor, and for one with AVX2 and FMA.
pub(crate) trait Kernel {
    /// Does the work; everything in it must be `#[inline(always)]`.
    fn run<const FMA: bool>(self);
}

/// Runs `kernel` in the best version this processor can execute.
#[inline]
pub(crate) fn dispatch<K: Kernel>(kernel: K) {
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
        // SAFETY: the features were just detected on this processor.
        return unsafe { with_avx2(kernel) };
    }
    kernel.run::<false>();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn with_avx2<K: Kernel>(kernel: K) {
    kernel.run::<true>();
}
