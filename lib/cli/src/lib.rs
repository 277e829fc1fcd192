//! Parts that every tool of the pipeline shares: arguments, exit status, messages, output that is
//! never half written, provenance, progress and signals.
//!
//! A tool is a `clap` parser that flattens [`Common`] and one function:
//!
//! ```no_run
//! #[derive(clap::Parser)]
//! #[command(version, about = "Doubles a number")]
//! struct Arguments {
//!     number: f64,
//!     #[command(flatten)]
//!     common: cli::Common,
//! }
//! fn run(arguments: Arguments) -> Result<(), cli::Failure> {
//!     cli::Output::Stdout.write(|out| writeln!(out, "{}", 2.0 * arguments.number))
//! }
//! fn main() -> std::process::ExitCode {
//!     cli::main(|a: &Arguments| &a.common, run)
//! }
//! ```

mod apart;
mod aside;
mod common;
mod exit;
mod message;
mod output;
mod progress;
mod provenance;
mod signals;
mod staged;
mod stdin;

pub use apart::{keep_apart, keep_apart_with_records};
pub use common::{Common, main};
pub use exit::{Failure, Status};
pub use message::{cell, detail, harmless, note, print, warn};
pub use output::Output;
pub use progress::{Progress, duration};
pub use provenance::{InputRecord, Record, hash_reader};
pub use signals::{catch_interrupts, interrupted};
pub use staged::StagedFolder;
pub use stdin::stdin_in_place;
