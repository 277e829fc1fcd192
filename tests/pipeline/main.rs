//! The built tools as a user runs them: pipes, conservation from stack to run folder,
//! repeatability, interruption, and what bad input gets. README.md of this crate says which
//! test checks what.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "prints for developers"
)]

mod acer_volume;
mod apart;
mod cell_error;
mod clone;
mod conservation;
mod examples;
mod exported;
mod forged;
mod hostile;
mod interruption;
mod makefile;
mod quoted;
mod refusals;
mod repeatability;
mod report;
mod room;
mod run_folder;
mod slow_modes;
mod stale;
mod started;
mod sweep;
mod sweep_tables;
mod too_large;
mod verdicts;
mod wood;
mod workbench;
