//! The verification page and table.

use std::path::Path;

use super::catalogue::Entry;
use crate::study::Outcome;

/// Writes.
///
/// # Errors
/// The system's reason.
pub fn write(_results: &Path, _entries: &[Entry], _outcomes: &[Outcome]) -> Result<(), String> {
    Ok(())
}
