//! The built tools as a user runs them: pipes, conservation from stack to run folder,
//! repeatability, interruption, and what bad input gets. README.md of this crate says which
//! test checks what.

mod acer_volume;
mod conservation;
mod examples;
mod forged;
mod interruption;
mod refusals;
mod repeatability;
mod workbench;
