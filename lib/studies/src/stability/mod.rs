//! `make stability`: small scenes with stiff and extreme values through the real `mpm-run`.
//! Whatever a case asks for, the automatic time step keeps it stable or the run refuses it or
//! stops with a reason; nothing ends in NaN silently.

pub mod instability;
pub mod options;
pub mod plan;
pub mod report;
pub mod scenes;
pub mod trial;
