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
pub mod closed_forms;
pub mod crash;
pub mod experiments;
pub mod job;
pub mod leave_out;
pub mod load_control;
pub mod method;
pub mod options;
pub mod outputs;
pub mod scene;
pub mod stability;
pub mod study;
pub mod tradeoff;
pub mod verification;
pub mod voxels;
