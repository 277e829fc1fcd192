//! Figures and Table 2 of the pipeline, from the tools' own output files.
//!
//! A figure is read from data into a plain struct (`Closing`, `WpMap`, `ShearRates`,
//! `Slices`, `Views`), drawn into a [`Drawing`] and written as SVG, PNG or PDF. The font is embedded, so a
//! machine without fonts or display gives the same picture. No chart is drawn from data that
//! are not there: a missing column or an empty file is an [`Error`].

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
mod drawing;
mod error;
mod frame;
mod legend;
mod measure;
mod measured;
mod movie;
mod outcome;
mod page;
mod panels;
mod pdf;
mod penetration;
mod plot;
mod pores;
mod raster;
mod replay;
mod response;
mod run_end;
mod section;
mod setup;
mod shear_rate;
mod slice;
mod solid;
mod svg;
mod table;
mod table2;
mod table_picture;
mod text;
mod view;
mod wp_map;

pub use cell_error::CellErrors;
pub use closing::Closing;
pub use clouds::{Clouds, Spot};
pub use drawing::{Drawing, TextBox};
pub use error::Error;
pub use movie::Movie;
pub use page::Page;
pub use penetration::{Shown, penetrations};
pub use plot::{Mark, Plot};
pub use pores::pores;
pub use response::Response;
pub use run_end::{RunEnd, summary_beside};
pub use setup::Setup;
pub use shear_rate::ShearRates;
pub use slice::{Colouring, Cut, Position, Slices};
pub use table2::{Case, Table2};
pub use view::{Direction, Views, Wood};
pub use wp_map::WpMap;

use std::path::PathBuf;

/// A data file with the name it goes by in a figure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Labelled {
    /// Name in legends and titles.
    pub label: String,
    /// The file.
    pub path: PathBuf,
}
