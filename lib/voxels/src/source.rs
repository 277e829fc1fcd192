//! Input files read at any place from any thread.

use std::fmt;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use particle_file::{open, spool};

use crate::Error;
use crate::kind::Kind;

/// One input file, read at positions from any thread.
///
/// Positioned reads instead of a memory map: equally fast for whole pages, and a file that
/// shrinks while it is read is an error instead of a SIGBUS.
#[derive(Debug)]
pub struct Source {
    /// The path as given; `-` is standard input.
    path: PathBuf,
    name: String,
    /// None where it is opened for each page, so that a folder of thousands of slices does not exhaust
    /// the file descriptors.
    file: Option<Arc<File>>,
    len: u64,
}

impl Source {
    /// Opens `path`; `-` is standard input. Whatever is not a regular file is copied to an
    /// unnamed temporary file first, because pages are not read in order.
    pub(crate) fn open(path: &Path) -> Result<Self, Error> {
        let name = quoted(path);
        let file = regular_file(path).map_err(|e| Error::io(&name, e))?;
        let source = Self::of_file(path.to_owned(), name, file)?;
        match source.len {
            0 => Err(Error::file(source, "it is empty")),
            _ => Ok(source),
        }
    }

    /// Wraps a regular file that is open already; `name` stands for it in messages.
    pub(crate) fn of_file(path: PathBuf, name: String, file: File) -> Result<Self, Error> {
        let len = file.metadata().map_err(|e| Error::io(&name, e))?.len();
        Ok(Self {
            path,
            name,
            file: Some(Arc::new(file)),
            len,
        })
    }

    /// The same input with `file`, which holds its content unpacked or in another order.
    pub(crate) fn with_content(&self, file: File) -> Result<Self, Error> {
        Self::of_file(self.path.clone(), self.name.clone(), file)
    }

    /// As [`Source::open`], but holds no file open between reads.
    pub(crate) fn open_slice(path: &Path) -> Result<Self, Error> {
        let mut source = Self::open(path)?;
        if path.is_file() {
            source.file = None;
        }
        Ok(source)
    }

    /// The path as given; `-` is standard input.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The name as it stands in messages: the quoted path or `standard input`.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Bytes in the file.
    pub(crate) fn len(&self) -> u64 {
        self.len
    }

    /// A handle for a few reads.
    pub(crate) fn file(&self) -> io::Result<Arc<File>> {
        match &self.file {
            Some(file) => Ok(Arc::clone(file)),
            None => File::open(&self.path).map(Arc::new),
        }
    }

    /// Up to `len` bytes at `offset`, fewer at the end of the file.
    pub(crate) fn window(&self, offset: u64, len: usize) -> io::Result<Vec<u8>> {
        let left = self.len.saturating_sub(offset);
        let mut bytes = vec![0; usize::try_from(left).map_or(len, |left| left.min(len))];
        self.file()?.read_exact_at(&mut bytes, offset)?;
        Ok(bytes)
    }

    /// The content from its first byte, e.g. to hash it; not from two threads at a time.
    ///
    /// # Errors
    /// The system's reason when the file cannot be opened again.
    pub fn reader(&self) -> io::Result<impl Read + use<>> {
        self.reader_from(0)
    }

    /// The content from byte `at`, as [`Source::reader`].
    pub(crate) fn reader_from(&self, at: u64) -> io::Result<File> {
        let mut file = self.file()?.try_clone()?;
        file.seek(SeekFrom::Start(at)).map(|_| file)
    }
}

fn regular_file(path: &Path) -> io::Result<File> {
    let file = open(path)?;
    match file.metadata()? {
        meta if meta.is_dir() => Err(io::Error::other("it is a folder")),
        meta if meta.is_file() => Ok(file),
        _ => spool(file, |head| Kind::of(head).is_some()),
    }
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)
    }
}

/// A path as it stands in messages.
pub(crate) fn quoted(path: &Path) -> String {
    match path.as_os_str() == "-" {
        true => "standard input".into(),
        false => format!("'{}'", path.display()),
    }
}
