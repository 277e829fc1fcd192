//! Errors of measurements.

/// Why a file cannot be measured: a sentence that follows the file's name.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// The values in the file cannot be those of a bond line.
    #[error("{0}")]
    Data(String),
    /// The file is sound, but the requested measurement does not apply to it.
    #[error("{0}")]
    Usage(String),
}

impl Error {
    /// Whether other arguments, not another file, would help.
    pub fn is_usage(&self) -> bool {
        matches!(self, Error::Usage(_))
    }
}

impl From<particle_file::Error> for Error {
    fn from(error: particle_file::Error) -> Self {
        Error::Data(error.without_name())
    }
}

impl From<bondline::Error> for Error {
    fn from(error: bondline::Error) -> Self {
        let said = error.to_string();
        if error.is_unfit_data() {
            Error::Data(said)
        } else {
            Error::Usage(format!("{said}, or --reference plane=LEN"))
        }
    }
}
