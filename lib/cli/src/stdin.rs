//! Standard input in place of a file.

use std::fs::File;
use std::io;
use std::os::fd::AsRawFd;
use std::path::{Path, PathBuf};

use crate::Failure;

/// Puts a temporary copy of standard input in place of the path that is `-`, where there is one, for what is read more than once.
/// The copy has no name and lasts as long as it is kept. Of a pipe that does not begin as `known` no more than the beginning is taken.
///
/// # Errors
/// Exit 2 where several paths are `-`; exit 1 where there is no room for the copy.
pub fn stdin_in_place<'a>(
    paths: impl IntoIterator<Item = &'a mut PathBuf>,
    known: impl Fn(&[u8]) -> bool,
) -> Result<Option<File>, Failure> {
    let mut piped = (paths.into_iter()).filter(|path| path.as_path() == Path::new("-"));
    let Some(path) = piped.next() else {
        return Ok(None);
    };
    if piped.next().is_some() {
        return Err(Failure::usage("'-' can be read only once"));
    }
    let copy = particle_file::spool(io::stdin().lock(), known)
        .map_err(|e| Failure::failed(format!("cannot spool '-': {e}")))?;
    *path = format!("/dev/fd/{}", copy.as_raw_fd()).into();
    Ok(Some(copy))
}
