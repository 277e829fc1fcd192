//! Errors of files.

use std::io;

use machine::Shortage;

/// Why a particle file cannot be used; every case is exit status 3.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The system refuses to read it.
    #[error("cannot read '{file}': {source}")]
    Unreadable {
        /// The file as the user named it, "standard input" for `-`.
        file: String,
        /// The system's reason.
        source: io::Error,
    },
    /// Not a particle file, of another version, truncated, or damaged.
    #[error("'{file}' {what}")]
    Corrupt {
        /// The file as the user named it, "standard input" for `-`.
        file: String,
        /// What is wrong and what would be accepted.
        what: String,
    },
    /// More would be made of it than fits into memory.
    #[error("'{file}' is too large: {what} would take {short}")]
    TooLarge {
        /// The file as the user named it, "standard input" for `-`.
        file: String,
        /// What would be made.
        what: String,
        /// What it takes and what there is.
        short: Shortage,
    },
    /// A sound file without the block or column asked for.
    #[error("'{file}' has no {wanted}; it holds {present}")]
    Missing {
        /// The file as the user named it, "standard input" for `-`.
        file: String,
        /// What was asked for.
        wanted: String,
        /// What there is.
        present: String,
    },
}

impl Error {
    /// The sentence without the file's name, for callers that put it first.
    pub fn without_name(&self) -> String {
        match self {
            Error::Unreadable { source, .. } => format!("the file cannot be read: {source}"),
            Error::Corrupt { what, .. } => format!("the file {what}"),
            Error::TooLarge { what, short, .. } => {
                format!("the file is too large: {what} would take {short}")
            }
            Error::Missing {
                wanted, present, ..
            } => format!("the file has no {wanted}; it holds {present}"),
        }
    }
}

/// An error that says `fault` unless `sound`.
pub(crate) fn ensure(sound: bool, fault: impl FnOnce() -> String) -> Result<(), String> {
    if sound { Ok(()) } else { Err(fault()) }
}
