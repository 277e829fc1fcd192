//! One page of HTML about the runs of a pipeline: pictures, tables, what the runs say of themselves and the
//! pressed bond in 3D. Everything is in the file; it asks no network for anything and is whole without scripts.

mod folder;
mod html;
mod mesh;
mod page;
mod picture;
mod scene;
mod setup;
mod summary;
mod table;

use std::fs::File;
use std::io::Read;
use std::path::Path;

pub use figures::{Error, Labelled};
pub use folder::{Measured, RunFolder, measured};
pub use picture::picture;
pub use scene::scene;
pub use table::table;

/// What a page holds, in its order; tables, pictures and scenes as HTML.
#[derive(Default)]
pub struct Report {
    /// Its title.
    pub title: String,
    /// Experiments, as [`measured`] reads them.
    pub experiments: Vec<Measured>,
    /// Run folders.
    pub runs: Vec<RunFolder>,
    /// CSV tables, as [`table`] makes them.
    pub tables: Vec<String>,
    /// As [`picture`] makes them.
    pub pictures: Vec<String>,
    /// States in 3D, as [`scene`] makes them.
    pub scenes: Vec<String>,
    /// The command that made it.
    pub command: String,
    /// The files that it is made of, with their hashes.
    pub inputs: Vec<[String; 2]>,
}

/// The bytes of a file of at most `most` bytes.
fn read(path: &Path, most: u64) -> Result<Vec<u8>, Error> {
    let name = path.display();
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(most + 1).read_to_end(&mut bytes))
        .map_err(|e| Error::Data(format!("cannot read '{name}': {e}")))?;
    match bytes.len() as u64 > most {
        false => Ok(bytes),
        true => Err(Error::Data(format!(
            "'{name}' has more than {most} bytes, the limit for such a file in a page"
        ))),
    }
}

/// The same as text.
fn read_text(path: &Path, most: u64) -> Result<String, Error> {
    let text = String::from_utf8(read(path, most)?);
    text.map_err(|_| Error::Data(format!("'{}' is not UTF-8 text", path.display())))
}
