//! Runs of the scheme against closed forms and finite elements. `--nocapture` prints the errors.

#![allow(clippy::print_stdout, reason = "prints for developers")]

mod plain;
mod runs;

mod air;
mod bond;
mod duct;
mod flows;
mod menisci;
mod opens;
mod refused;
mod rods;
mod statics;
mod tension;
mod tubes;
mod water;
