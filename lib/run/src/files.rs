//! Files on the disk: whether they exist or were replaced, and the syncing of folders.

use std::fs::{self, File};
use std::io;
use std::path::Path;

use same_file::Handle;

/// Fails if the open `file` at `path` was removed or replaced by someone else.
pub(crate) fn check_not_replaced(file: &File, path: &Path) -> io::Result<()> {
    let ours = Handle::from_file(file.try_clone()?)?;
    if Handle::from_path(path).is_ok_and(|there| there == ours) {
        return Ok(());
    }
    Err(io::Error::other(
        "it was removed or replaced during the run",
    ))
}

/// Whether anything has this name, a dangling link included.
pub(crate) fn is_taken(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok()
}

/// Syncs the names in a folder to the disk, if the file system can.
pub(crate) fn sync_folder(path: &Path) -> io::Result<()> {
    use io::ErrorKind::{InvalidInput, PermissionDenied, Unsupported};
    match File::open(path).and_then(|folder| folder.sync_all()) {
        Err(e) if matches!(e.kind(), InvalidInput | PermissionDenied | Unsupported) => Ok(()),
        done => done,
    }
}
