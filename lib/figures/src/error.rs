//! Errors of figures.

/// Why there is no figure.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The data cannot be read or do not hold what the figure shows.
    #[error("{0}")]
    Data(String),
    /// The figure asked for cannot be made of these data.
    #[error("{0}")]
    Request(String),
    /// The picture could not be made.
    #[error("cannot draw the figure: {0}")]
    Draw(String),
}
