//! Errors in finding or building a bond line.

use std::fmt;

/// Why there is no bond line to build or to find; one sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    what: String,
    help: String,
    unfit: bool,
}

impl Error {
    pub(crate) fn new(what: impl Into<String>) -> Self {
        Self {
            what: what.into(),
            help: String::new(),
            unfit: false,
        }
    }

    /// Adds a remedy, punctuation included.
    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = help.into();
        self
    }

    /// An error of the specimen itself, which no option can mend.
    pub(crate) fn unfit(what: impl Into<String>) -> Self {
        let unfit = true;
        Self {
            unfit,
            ..Self::new(what)
        }
    }

    /// The error for a specimen without adhesive.
    pub fn no_adhesive() -> Self {
        Self::new("the specimen has no adhesive voxel").help(
            ": a bonded specimen is needed, or, to bond wood alone, build-bondline with --slab or --spread",
        )
    }

    pub(crate) fn no_wood(place: impl fmt::Display) -> Self {
        Self::new(format!(
            "there is no wood {place}: a specimen with an adherend on each side is needed"
        ))
        .help(", or another --normal")
    }

    /// Whether the specimen itself is at fault, so that no option helps.
    pub fn is_unfit_data(&self) -> bool {
        self.unfit
    }

    /// The sentence without the remedy.
    pub fn what(&self) -> &str {
        &self.what
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.what, self.help)
    }
}

impl std::error::Error for Error {}
