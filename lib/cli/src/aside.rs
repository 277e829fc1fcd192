//! Files and folders written beside their target, which they replace when they are whole.

use std::fs::{self, File};
use std::io;
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile, TempDir};
use xxhash_rust::xxh3::xxh3_64;

/// What Linux follows before it calls a chain of links a loop.
const MOST_LINKS: usize = 40;
const ENDING: &str = ".tmp";

/// The path that `path` stands for once symbolic links are followed, whether or not there is
/// something at their end.
pub(crate) fn behind_links(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&path) {
            Ok(target) => path = folder_of(&path).join(target),
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::other("its symbolic links form a loop"))
}

pub(crate) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// An empty file beside `target` that nobody else takes for forgotten, with the permissions of the file that it is to
/// replace, or those of a new one by the user's umask; nothing for a target that is write-protected.
pub(crate) fn file_for(target: &Path) -> io::Result<NamedTempFile> {
    let replaced = machine::replaced_permissions(target)?;
    let new = || fs::Permissions::from_mode(0o666);
    made_for(target, |builder, folder| {
        builder.permissions(replaced.clone().unwrap_or_else(new));
        let file = builder.tempfile_in(folder)?;
        // The umask holds for new files only.
        if let Some(permissions) = &replaced {
            file.as_file().set_permissions(permissions.clone())?;
        }
        Ok((file.as_file().try_clone()?, file))
    })
    .map(|(_, file)| file)
}

/// An empty folder beside `target`, claimed as long as the handle lives.
pub(crate) fn folder_for(target: &Path) -> io::Result<(File, TempDir)> {
    made_for(target, |builder, folder| {
        let made = builder.tempdir_in(folder)?;
        Ok((File::open(made.path())?, made))
    })
}

/// What `make` makes in the folder of `target`, and a handle of it, locked.
fn made_for<T>(
    target: &Path,
    make: impl Fn(&mut Builder, &Path) -> io::Result<(File, T)>,
) -> io::Result<(File, T)> {
    sweep(target);
    loop {
        let prefix = prefix(target);
        let mut builder = Builder::new();
        let made = make(builder.prefix(&prefix).suffix(ENDING), folder_of(target));
        // tempfile adds the path, which is no name that the user gave.
        let (handle, made) = made.map_err(|error| {
            let said = error.to_string();
            let reason = said.split(" at path ").next().unwrap_or_default();
            io::Error::new(error.kind(), reason)
        })?;
        // Where the file system knows no locks nothing is swept either.
        let _ = handle.lock();
        // A sweep may have taken it for forgotten in between.
        if handle.metadata()?.nlink() > 0 {
            return Ok((handle, made));
        }
    }
}

/// Names of what is written for `target` begin alike.
fn prefix(target: &Path) -> String {
    let name = target.file_name().unwrap_or_default();
    format!(".bondline-{:016x}-", xxh3_64(name.as_encoded_bytes()))
}

/// Removes what a process that was killed left beside `target`: its lock went with it.
fn sweep(target: &Path) {
    let Ok(entries) = fs::read_dir(folder_of(target)) else {
        return;
    };
    let prefix = prefix(target);
    for entry in entries.flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        // Opening a pipe would wait for its other end.
        let regular = entry.file_type().is_ok_and(|t| t.is_file() || t.is_dir());
        if !(regular && name.starts_with(&prefix) && name.ends_with(ENDING)) {
            continue;
        }
        let Ok(left) = File::open(entry.path()) else {
            continue;
        };
        if left.try_lock().is_ok() {
            // What cannot be removed stays, and nothing depends on it.
            let _ = match entry.file_type().is_ok_and(|t| t.is_dir()) {
                true => fs::remove_dir_all(entry.path()),
                false => fs::remove_file(entry.path()),
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_killed_process_left_is_swept_and_what_is_being_written_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("=a.csv");
        let left = file_for(&target).unwrap().keep().unwrap();
        drop(left.0);
        let (lock, dir) = folder_for(&target).unwrap();
        assert!(!left.1.exists(), "a forgotten file is swept");
        let folder_left = dir.keep();
        fs::write(folder_left.join("part"), b"x").unwrap();
        let busy = file_for(&target).unwrap();
        assert!(folder_left.exists(), "a claimed folder is not swept");
        drop(lock);
        let other = file_for(&folder.path().join("other")).unwrap();
        assert!(folder_left.exists(), "it is not that target's");
        let nowhere = file_for(&folder.path().join("none/a")).unwrap_err();
        assert!(!nowhere.to_string().contains(ENDING), "{nowhere}");
        let again = file_for(&target).unwrap();
        assert!(!folder_left.exists(), "a forgotten folder is swept");
        assert!(busy.path().exists() && other.path().exists() && again.path().exists());
    }
}
