//! From a case file to a run folder.

pub mod case;
pub mod resolve;
