//! Errors of files.

use std::{fmt, io};

/// Why a particle file cannot be used: exit status 3, or 2 where [`Error::is_usage`].
#[derive(Debug)]
pub struct Error {
    /// As the user named it, "standard input" for `-`.
    file: String,
    what: String,
    unreadable: bool,
    usage: bool,
}

impl Error {
    /// Of a file that is not a particle file, truncated or damaged, that lacks what is asked for or of which more would
    /// be made than fits into memory: `what` is the rest of the sentence that begins with the name of the file.
    pub fn new(file: impl Into<String>, what: impl Into<String>) -> Self {
        Self {
            file: file.into(),
            what: what.into(),
            unreadable: false,
            usage: false,
        }
    }

    /// Of a sound file that does not go with the others.
    pub(crate) fn misplaced(file: String, what: String) -> Self {
        Self {
            usage: true,
            ..Self::new(file, what)
        }
    }

    /// Whether another choice of files would do.
    pub fn is_usage(&self) -> bool {
        self.usage
    }

    /// Of a file that the system refuses to read.
    pub(crate) fn unreadable(file: String, reason: &io::Error) -> Self {
        Self {
            file,
            what: reason.to_string(),
            unreadable: true,
            usage: false,
        }
    }

    /// The sentence without the file's name, for callers that put it first.
    pub fn without_name(&self) -> String {
        match self.unreadable {
            true => format!("the file cannot be read: {}", self.what),
            false => format!("the file {}", self.what),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, what, .. } = self;
        match self.unreadable {
            true => write!(f, "cannot read '{file}': {what}"),
            false => write!(f, "'{file}' {what}"),
        }
    }
}

impl std::error::Error for Error {}

/// An error that says `fault` unless `sound`.
pub(crate) fn ensure(sound: bool, fault: impl FnOnce() -> String) -> Result<(), String> {
    if sound { Ok(()) } else { Err(fault()) }
}
