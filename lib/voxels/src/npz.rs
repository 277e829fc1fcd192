//! NumPy's `.npz`: a zip archive of `.npy` arrays, of which one is the volume.

use std::io::{BufReader, Read};

use particle_file::{fill, temporary_file};
use zip::ZipArchive;

use crate::raw::RawVolume;
use crate::source::Source;
use crate::{Error, npy};

/// A volume needs no more arrays beside it than a person would save.
const MOST_ENTRIES: usize = 1024;

pub(crate) fn is_zip(head: &[u8]) -> bool {
    head.starts_with(b"PK\x03\x04")
}

/// Opens the only array of three axes in an archive.
pub(crate) fn open(source: Source) -> Result<RawVolume, Error> {
    let content = source.reader_from(0).map_err(|e| Error::io(&source, e))?;
    let wrong = |what: String| Error::file(&source, what);
    let unreadable = |e: &dyn std::fmt::Display| wrong(format!("its archive cannot be read: {e}"));
    let mut archive = ZipArchive::new(BufReader::new(content)).map_err(|e| unreadable(&e))?;
    if archive.len() > MOST_ENTRIES {
        return Err(wrong(format!(
            "it holds {} files, and is no .npz of a volume",
            archive.len()
        )));
    }
    let mut volumes = Vec::new();
    for i in 0..archive.len() {
        let mut entry = archive.by_index(i).map_err(|e| unreadable(&e))?;
        let mut head = Vec::new();
        (entry
            .by_ref()
            .take(npy::LONGEST_HEAD)
            .read_to_end(&mut head))
        .map_err(|e| unreadable(&e))?;
        let name = entry.name().map_err(|e| unreadable(&e))?.into_owned();
        if npy::is_volume(&head) {
            volumes.push((i, name, entry.size()));
        }
    }
    let &[(index, _, size)] = volumes.as_slice() else {
        let names: Vec<&str> = volumes.iter().map(|v| v.1.as_str()).collect();
        return Err(wrong(format!(
            "it holds {} arrays of three axes{}{}; accepted is one: save it alone, e.g. numpy.save('stack.npy', array)",
            names.len(),
            if names.is_empty() { "" } else { ": " },
            names.join(", ")
        )));
    };
    let entry = archive.by_index(index).map_err(|e| unreadable(&e))?;
    if size > entry.compressed_size().saturating_mul(1032) {
        return Err(wrong(format!(
            "it declares {size} bytes, more than deflate packs into what is stored"
        )));
    }
    let mut array = temporary_file(size).map_err(|e| Error::io(&source, e))?;
    fill(&mut array, entry, size).map_err(|e| unreadable(&e))?;
    let array = source
        .with_content(array)
        .map_err(|e| Error::io(&source, e))?;
    Ok(npy::open(array)?.of_sources(vec![source]))
}
