//! The text of tables that tools are given.

use std::io::{self, Read};
use std::path::Path;

use crate::{limits, open};

/// The whole text of a table of commas and lines, of which the caller makes `row` bytes for each row and
/// `cell` bytes for each cell, and keeps what they say; `-` is standard input.
///
/// # Errors
/// The system's reason, more than [`limits::TABLE`] bytes, or more rows and cells than there is memory
/// for, whatever lines they stand in.
pub fn read_table(path: &Path, [row, cell]: [u64; 2]) -> io::Result<Vec<u8>> {
    let mut text = Vec::new();
    open(path)?.take(limits::TABLE + 1).read_to_end(&mut text)?;
    if text.len() as u64 > limits::TABLE {
        let most = limits::TABLE;
        let what = format!("it is no table: it has more than {most} bytes");
        return Err(io::Error::other(what));
    }
    let count = |of: u8| text.iter().filter(|byte| **byte == of).count() as u64;
    let rows = count(b'\n') + 1;
    let cells = rows + count(b',');
    match machine::shortage(row * rows + cell * cells + text.len() as u64) {
        None => Ok(text),
        Some(short) => Err(io::Error::other(format!("its {cells} cells need {short}"))),
    }
}
