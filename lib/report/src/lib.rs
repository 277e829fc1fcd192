//! One page of HTML about the runs of a pipeline: pictures, tables, what the runs say of themselves and the
//! pressed bond in 3D. Everything is in the file; it asks no network for anything and is whole without scripts.

mod folder;
mod html;
mod mesh;
mod page;
mod penetration;
mod picture;
mod scene;
mod setup;
mod summary;
mod table;

use std::path::{Path, PathBuf};

pub use folder::RunFolder;
pub use picture::Picture;
pub use scene::Scene;
pub use table::Table;

/// Why a page cannot be made; one sentence.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Error(pub String);

/// A file and what it is called.
#[derive(Clone, Debug)]
pub struct Labelled {
    /// For people.
    pub label: String,
    /// Where.
    pub path: PathBuf,
}

/// What a page holds, in its order.
#[derive(Default)]
pub struct Report {
    /// Its title.
    pub title: String,
    /// Run folders.
    pub runs: Vec<RunFolder>,
    /// CSV tables.
    pub tables: Vec<Table>,
    /// Pictures.
    pub pictures: Vec<Picture>,
    /// States in 3D.
    pub scenes: Vec<Scene>,
    /// The command that made it.
    pub command: String,
    /// The files that it is made of, with their hashes.
    pub inputs: Vec<[String; 2]>,
}

impl Report {
    /// The page.
    pub fn to_html(&self) -> String {
        page::write(self)
    }
}

/// The bytes of a file of at most `most` bytes.
fn read(path: &Path, most: u64) -> Result<Vec<u8>, Error> {
    use std::io::Read;
    let name = path.display();
    let mut bytes = Vec::new();
    std::fs::File::open(path)
        .and_then(|file| file.take(most + 1).read_to_end(&mut bytes))
        .map_err(|e| Error(format!("cannot read '{name}': {e}")))?;
    if bytes.len() as u64 > most {
        return Err(Error(format!(
            "'{name}' has more than {most} bytes, the most that a page takes of such a file"
        )));
    }
    Ok(bytes)
}

/// The same as text.
fn read_text(path: &Path, most: u64) -> Result<String, Error> {
    let text = String::from_utf8(read(path, most)?);
    text.map_err(|_| Error(format!("'{}' is not a text in UTF-8", path.display())))
}
