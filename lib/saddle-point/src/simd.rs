//! Runs a kernel with AVX2 where the processor has it, to the same bits.
#![allow(unsafe_code)]

/// Work that is compiled twice, with and without AVX2. Both versions round every product and sum alike, since none are
/// fused, so results do not depend on the processor.
pub(crate) trait Kernel {
    /// Result.
    type Output;
    /// Does the work; everything in it must be `#[inline(always)]`.
    fn run(self) -> Self::Output;
}

/// Runs `kernel` in the widest version that this processor can execute.
#[inline]
pub(crate) fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the feature was just detected on this processor.
        return unsafe { with_avx2(kernel) };
    }
    kernel.run()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn with_avx2<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}
