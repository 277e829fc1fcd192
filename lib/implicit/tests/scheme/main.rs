//! Runs of the scheme against closed forms and finite elements. `--nocapture` prints the errors.

#![allow(clippy::print_stdout, reason = "prints for developers")]

#[path = "../../../physics/tests/plain/mod.rs"]
mod plain;
mod runs;

mod air;
mod bond;
mod fills;
mod flows;
mod menisci;
mod opens;
mod refused;
mod tension;
mod water;
