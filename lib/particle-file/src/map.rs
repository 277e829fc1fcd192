use std::fs::File;
use std::io;
use std::ops::Deref;
use std::path::Path;

use memmap2::{Mmap, MmapMut};

/// The bytes of a file, mapped; the only place of the workspace that maps files.
///
/// `-` is standard input. What is not a regular file (a pipe) is spooled to a temporary
/// file first.
#[derive(Debug)]
pub struct Mapped(Mmap);

impl Mapped {
    /// Maps the file at `path`, or standard input for `-`.
    ///
    /// # Errors
    /// The system's reason.
    pub fn open(path: &Path) -> io::Result<Self> {
        if path == Path::new("-") {
            Self::standard_input()
        } else {
            Self::of(File::open(path)?)
        }
    }

    /// A copy of `bytes`, aligned as a mapped file is.
    ///
    /// # Errors
    /// When there is no memory for it.
    pub fn copy_of(bytes: &[u8]) -> io::Result<Self> {
        let mut map = MmapMut::map_anon(bytes.len().max(1))?;
        map[..bytes.len()].copy_from_slice(bytes);
        Ok(Self(map.make_read_only()?))
    }

    fn of(mut file: File) -> io::Result<Self> {
        let kind = file.metadata()?;
        if kind.is_dir() {
            return Err(io::Error::other("it is a folder"));
        }
        if kind.is_file() {
            return map(&file);
        }
        let mut spool = tempfile::tempfile()?;
        io::copy(&mut file, &mut spool)?;
        map(&spool)
    }

    #[cfg(unix)]
    fn standard_input() -> io::Result<Self> {
        use std::os::fd::AsFd;
        Self::of(io::stdin().as_fd().try_clone_to_owned()?.into())
    }

    #[cfg(not(unix))]
    fn standard_input() -> io::Result<Self> {
        let mut spool = tempfile::tempfile()?;
        io::copy(&mut io::stdin().lock(), &mut spool)?;
        map(&spool)
    }
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
