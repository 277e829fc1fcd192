//! Refusal of work that is too large for the memory of this machine, before it is begun.

use std::fmt::Display;

use crate::{Failure, message};

/// Refuses `what`, which takes `bytes` of memory, where this process may not have them; the end of the
/// sentence, `instead`, says what to ask for. With `--yes-really` it is a warning.
pub fn enough_memory(
    what: impl Display,
    bytes: u64,
    instead: &str,
    however_large: bool,
) -> Result<(), Failure> {
    let Some(short) = machine::shortage(bytes) else {
        return Ok(());
    };
    let said = format!("{what} needs {short}; {instead} is needed");
    if however_large {
        message::warn(said);
        return Ok(());
    }
    Err(Failure::usage(format!(
        "{said}; --yes-really goes on all the same"
    )))
}
