//! Figures and Table 2 of the pipeline, from the tools' own output files.
//!
//! A figure is read from files and drawn for a [`Page`] into a [`Drawing`], which is written as SVG, PNG or PDF.
//! The font is embedded, so a machine without fonts or display gives the same picture. No chart is drawn from data
//! that are not there: a missing column or an empty file is an [`Error`].

mod axes;
mod bitmap;
mod camera;
mod cell_band;
mod cell_error;
mod closing;
mod clouds;
mod colour;
mod colour_bar;
mod column_name;
mod command_line;
mod drawing;
mod frame;
mod known;
mod legend;
mod measure;
mod movie;
mod origin;
mod outcome;
mod page;
mod panels;
mod pdf;
mod penetration;
mod plot;
mod pores;
mod replay;
mod response;
mod run_end;
mod section;
mod setup;
mod shear_rate;
mod slice;
mod solid;
mod stages;
mod svg;
mod table;
mod table2;
mod table_picture;
mod text;
mod view;
mod wp_map;

pub use cell_error::AT_THE_END;
pub use closing::{closing, time_unit};
pub use clouds::{Clouds, Spot};
pub use column_name::worded;
pub use drawing::{Drawing, TextBox};
pub use known::{Known, fixed, pressure_limit, signed};
pub use measure::undrawn;
pub use movie::movie;
pub use origin::{check_origin, record};
pub use page::Page;
pub use penetration::{Shown, penetrations};
pub use plot::{Mark, Plot};
pub use pores::pores;
pub use response::response;
pub use run_end::{RunEnd, read_beside};
pub use setup::setup;
pub use shear_rate::shear_rates;
pub use slice::{Colouring, Cut, Position, Slices};
pub use svg::base64;
pub use table::Table;
pub use table2::{Case, ERRORS, Table2};
pub use view::{Direction, Views, Wood};
pub use wp_map::wp_maps;

use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

/// A data file with the name it goes by in a figure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Labelled {
    /// Name in legends and titles.
    pub label: String,
    /// The file.
    pub path: PathBuf,
}

impl Labelled {
    /// Of `LABEL=PATH`, which need not be UTF-8.
    pub fn split(text: &OsStr) -> Option<Self> {
        let bytes = text.as_bytes();
        let at = bytes.iter().position(|b| *b == b'=')?;
        Some(Self {
            label: String::from_utf8_lossy(&bytes[..at]).into_owned(),
            path: OsStr::from_bytes(&bytes[at + 1..]).into(),
        })
    }

    /// Puts its path behind a label that several files have.
    pub fn tell_apart(files: &mut [Self]) {
        let labels: Vec<String> = files.iter().map(|file| file.label.clone()).collect();
        let shared = |file: &&mut Self| labels.iter().filter(|l| **l == file.label).count() > 1;
        for file in files.iter_mut().filter(shared) {
            file.label += &format!(" ({})", file.path.display());
        }
    }

    /// Of `LABEL=PATH`, or of a path alone, which `named` says the label of.
    ///
    /// # Errors
    /// A sentence where the label or the path is empty.
    pub fn parse(text: &OsStr, named: fn(&Path) -> String) -> Result<Self, String> {
        let path = Path::new(text);
        let parsed = Self::split(text).unwrap_or_else(|| Self {
            label: named(path),
            path: path.into(),
        });
        match parsed.label.is_empty() || parsed.path.as_os_str().is_empty() {
            true => Err(format!(
                "'{}' needs a label and a path, as in FLIP=out/pf-flip",
                text.display()
            )),
            false => Ok(parsed),
        }
    }
}

/// Why there is no figure, in one sentence.
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

impl From<particle_file::Error> for Error {
    fn from(error: particle_file::Error) -> Self {
        Self::Data(error.to_string())
    }
}
