//! Verification of the real `mpm-run` against closed forms and converged references, and the
//! long studies built on it. tests/README.md says which test checks which equation, with which
//! tolerance and why.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "prints for developers"
)]

pub mod bench;
pub mod case_text;
pub mod crash;
pub mod experiments;
pub mod job;
pub mod leave_out;
mod lines;
pub mod load_control;
pub mod method;
pub mod numbers;
pub mod options;
pub mod outputs;
mod press;
pub mod stability;
pub mod steps;
pub mod study;
pub mod tradeoff;
pub mod verification;
mod voxels;

/// What went wrong, as a sentence.
pub type Error = Box<dyn std::error::Error + Send + Sync>;
/// With that error where no other is named.
pub type Result<T, E = Error> = std::result::Result<T, E>;
