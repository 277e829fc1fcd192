//! Why a stack cannot be read.

use std::fmt::Display;
use std::io;

/// Why a stack cannot be read or segmented; one sentence that names the file and the page.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The system cannot read a file.
    #[error("cannot read {file}: {cause}")]
    Io {
        /// The file, quoted.
        file: String,
        /// The system's reason.
        cause: io::Error,
    },
    /// A file is not what it should be.
    #[error("{file}: {what}")]
    File {
        /// The file, quoted.
        file: String,
        /// What is wrong and what would be accepted.
        what: String,
    },
    /// A page of a file is not what it should be.
    #[error("{file}, page {page}: {what}")]
    Page {
        /// The file, quoted.
        file: String,
        /// The page, counted from 1.
        page: usize,
        /// What is wrong and what would be accepted.
        what: String,
    },
    /// The data are sound but the arguments do not fit them.
    #[error("{0}")]
    Usage(String),
}

impl Error {
    /// Whether other arguments, not another file, would help.
    pub fn is_usage(&self) -> bool {
        matches!(self, Error::Usage(_))
    }

    pub(crate) fn io(file: impl Display, cause: io::Error) -> Self {
        Error::Io {
            file: file.to_string(),
            cause,
        }
    }

    pub(crate) fn file(file: impl Display, what: impl Display) -> Self {
        Error::File {
            file: file.to_string(),
            what: what.to_string(),
        }
    }

    /// `index` counts from 0, the message from 1.
    pub(crate) fn page(file: impl Display, index: usize, what: impl Display) -> Self {
        Error::Page {
            file: file.to_string(),
            page: index + 1,
            what: what.to_string(),
        }
    }
}
