//! Memory maps of files.

use std::fs::File;
use std::io::{self, Read};
use std::ops::Deref;
use std::os::fd::AsFd;
use std::path::Path;

use memmap2::{Mmap, MmapMut};

use crate::RUN_MARK;
use crate::spool::spool;

/// The bytes of a file, mapped; the only place of the workspace that maps files.
///
/// `-` is standard input. What is not a regular file (a pipe) is spooled first.
#[derive(Debug)]
pub struct Mapped(Mmap);

impl Mapped {
    /// Maps the file at `path`, or standard input for `-`. Of a pipe that does not begin as
    /// `recognised` wants it no more than the beginning is taken.
    ///
    /// # Errors
    /// The system's reason, or a pipe without an end.
    pub fn open(path: &Path, recognised: impl Fn(&[u8]) -> bool) -> io::Result<Self> {
        opened(path, recognised).and_then(|(file, _)| map(&file))
    }

    /// As [`Mapped::open`], but a file that has a name is read into memory, where nobody can
    /// change or truncate it any more: for what is used longer than it takes to read it.
    pub fn read(path: &Path, recognised: impl Fn(&[u8]) -> bool) -> io::Result<Self> {
        let (mut file, named) = opened(path, recognised)?;
        if !named {
            return map(&file);
        }
        let len = file.metadata()?.len();
        if let Some(short) = machine::shortage(len) {
            return Err(io::Error::other(format!("reading it needs {short}")));
        }
        let len = usize::try_from(len).map_err(io::Error::other)?;
        let mut bytes = MmapMut::map_anon(len.max(1))?;
        file.read_exact(&mut bytes[..len])?;
        Ok(Self(bytes.make_read_only()?))
    }

    /// A copy of `bytes`, aligned as a mapped file is.
    pub(crate) fn copy_of(bytes: &[u8]) -> io::Result<Self> {
        let mut map = MmapMut::map_anon(bytes.len().max(1))?;
        map[..bytes.len()].copy_from_slice(bytes);
        Ok(Self(map.make_read_only()?))
    }
}

/// The file at `path`, or standard input for `-`.
///
/// # Errors
/// The system's reason.
pub fn open(path: &Path) -> io::Result<File> {
    match path == Path::new("-") {
        true => Ok(io::stdin().as_fd().try_clone_to_owned()?.into()),
        false => File::open(path),
    }
}

/// A regular file, which has a name and which others can write to, or the private copy of a pipe; and
/// whether it has a name.
fn opened(path: &Path, recognised: impl Fn(&[u8]) -> bool) -> io::Result<(File, bool)> {
    let file = open(path)?;
    let kind = file.metadata()?;
    if kind.is_dir() {
        return Err(io::Error::other(match path.join(RUN_MARK).is_file() {
            true => "it is the folder of a run: name a state in it, such as final.mpts",
            false => "it is a folder",
        }));
    }
    if kind.is_file() {
        return Ok((file, true));
    }
    Ok((spool(file, recognised)?, false))
}

impl Deref for Mapped {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        &self.0
    }
}

#[allow(unsafe_code)]
fn map(file: &File) -> io::Result<Mapped> {
    // SAFETY: the mapped bytes must not change while the map lives. A spool file is private
    // to this process. A named file is never written in place by a tool of this workspace:
    // every output is a new file that is renamed over its target (cli::Output), which leaves
    // the mapped one as it was. Only plain numbers are read from a map (bytemuck::Pod), for
    // which every bit pattern is a value, and lengths come from a header that was copied out
    // and checked once, so that even a foreign program that writes into a mapped file can
    // make the numbers wrong but not the memory accesses; one that truncates it ends us by
    // SIGBUS.
    unsafe { Mmap::map(file) }.map(Mapped)
}
