//! NumPy's `.npz`: a zip archive of `.npy` arrays, of which one is the volume.

use std::fmt::Display;
use std::io::{BufReader, Read};

use particle_file::{fill, temporary_file};
use zip::ZipArchive;

use crate::error::damaged;
use crate::source::Source;
use crate::volume::Volume;
use crate::{Error, npy};

/// A volume needs no more arrays beside it than a person would save.
const MOST_ENTRIES: usize = 1024;

/// Opens the only array of three axes in an archive.
pub(crate) fn open(source: Source) -> Result<Volume, Error> {
    let content = source.reader_from(0).map_err(|e| Error::io(&source, e))?;
    let wrong = |what: String| Err(Error::file(&source, what));
    let unreadable = |e: &dyn Display| {
        Error::file(
            &source,
            format!("its archive cannot be read: {}", damaged(e)),
        )
    };
    let mut archive = ZipArchive::new(BufReader::new(content)).map_err(|e| unreadable(&e))?;
    let entries = archive.len();
    if entries > MOST_ENTRIES {
        return wrong(format!(
            "it holds {entries} files, and is no .npz of a volume"
        ));
    }
    let (mut index, mut names) = (0, Vec::new());
    for i in 0..entries {
        let mut entry = archive.by_index(i).map_err(|e| unreadable(&e))?;
        let mut head = Vec::new();
        let read = entry
            .by_ref()
            .take(npy::LONGEST_HEAD)
            .read_to_end(&mut head);
        read.map_err(|e| unreadable(&e))?;
        if npy::is_volume(&head) {
            index = i;
            names.push(entry.name().map_err(|e| unreadable(&e))?.into_owned());
        }
    }
    if names.len() != 1 {
        return wrong(format!(
            "it holds {} arrays of three axes{}{}; accepted is one: save it alone, e.g. numpy.save('stack.npy', array)",
            names.len(),
            if names.is_empty() { "" } else { ": " },
            names.join(", ")
        ));
    }
    let entry = archive.by_index(index).map_err(|e| unreadable(&e))?;
    let size = entry.size();
    if size > entry.compressed_size().saturating_mul(1032) {
        return wrong(format!(
            "it declares {size} bytes, more than deflate packs into what is stored"
        ));
    }
    let mut array = temporary_file(size).map_err(|e| Error::io(&source, e))?;
    fill(&mut array, entry, size).map_err(|e| unreadable(&e))?;
    let array = source.with_content(array)?;
    npy::open(source, Some(array))
}
