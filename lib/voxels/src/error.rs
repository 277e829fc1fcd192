//! Why a stack cannot be read.

use std::fmt::Display;
use std::io;

/// Why a stack cannot be read or segmented; one sentence that names the file and the page.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file, or a page of it, cannot be read or is not what it should be.
    #[error("{0}")]
    Data(String),
    /// The data are sound but the arguments do not fit them.
    #[error("{0}")]
    Usage(String),
}

/// What is said of a file at whose content a decoder gave up.
pub(crate) fn damaged(cause: impl Display) -> String {
    // Some decoders end their sentences with a line.
    format!("the file is cut or damaged ({})", cause.to_string().trim())
}

impl Error {
    /// Whether other arguments, not another file, would help.
    pub fn is_usage(&self) -> bool {
        matches!(self, Error::Usage(_))
    }

    pub(crate) fn io(file: impl Display, cause: io::Error) -> Self {
        Error::Data(format!("cannot read {file}: {cause}"))
    }

    pub(crate) fn file(file: impl Display, what: impl Display) -> Self {
        Error::Data(format!("{file}: {what}"))
    }

    /// `index` counts from 0, the message from 1.
    pub(crate) fn page(file: impl Display, index: usize, what: impl Display) -> Self {
        Error::Data(format!("{file}, page {}: {what}", index + 1))
    }
}
