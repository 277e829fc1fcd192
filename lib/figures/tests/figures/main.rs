//! The figures as files: SVG parses and says what it should, PNG decodes and is not blank, and
//! what is drawn follows the data.

mod curves;
mod layout;
mod maps;
mod slices;
mod table;

use std::path::PathBuf;

use figures::{Drawing, Labelled};

const BLUE: [u8; 3] = [0, 114, 178];
const VERMILION: [u8; 3] = [213, 94, 0];

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn file(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.path().join(name);
        std::fs::write(&path, content).unwrap();
        path
    }

    fn labelled(&self, label: &str, content: impl AsRef<[u8]>) -> Labelled {
        let name: String = label.chars().filter(char::is_ascii_alphanumeric).collect();
        let path = self.file(&name, content);
        let label = label.into();
        Labelled { label, path }
    }
}

/// A table of rows below their header.
fn csv(header: &str, rows: impl IntoIterator<Item = String>) -> String {
    let rows = rows.into_iter().map(|row| row + "\n");
    format!("{header}\n{}", rows.collect::<String>())
}

/// All text of an SVG document, which must parse.
fn texts(drawing: &Drawing) -> Vec<String> {
    let svg = drawing.to_svg().unwrap();
    let document = roxmltree::Document::parse(&svg).unwrap();
    let texts = document.descendants().filter(|n| n.has_tag_name("text"));
    texts
        .map(|n| n.text().unwrap_or_default().trim().into())
        .collect()
}

/// Each of the words is a text of the drawing.
fn says(drawing: &Drawing, words: &[&str]) {
    let said = texts(drawing);
    for word in words {
        assert!(said.iter().any(|t| t == word), "{word} is not in {said:?}");
    }
}

/// Width and pixels of the PNG.
fn pixels(drawing: &Drawing) -> (usize, Vec<[u8; 3]>) {
    let bytes = std::io::Cursor::new(drawing.to_png().unwrap());
    let mut reader = png::Decoder::new(bytes).read_info().unwrap();
    let mut buffer = vec![0; reader.output_buffer_size().unwrap()];
    let width = reader.next_frame(&mut buffer).unwrap().width as usize;
    (width, buffer.as_chunks().0.to_vec())
}

fn share(pixels: &[[u8; 3]], colour: [u8; 3]) -> f64 {
    pixels.iter().filter(|p| **p == colour).count() as f64 / pixels.len() as f64
}
