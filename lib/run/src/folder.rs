//! The run folder: carries a mark, is locked by one run at a time, and is written file by file.
//!
//! The order of writing, which lets `--resume` reach the same end after a kill at any time:
//!
//! 1. New run: `final.mpts`, `checkpoint.mpts`, `summary.json`, `history.csv` and snapshots of the earlier run are removed, in
//!    this order; then `resolved.toml` and the header of `history.csv` are written.
//! 2. A row is one `write` to the end of `history.csv`. Every other file is written under a temporary name, synced and renamed,
//!    and its folder is synced.
//! 3. Checkpoint: `history.csv` is synced, then `checkpoint.mpts` replaces the one before.
//! 4. Continued run: the start of `history.csv` must match the checkpoint (length and hash), else the run ends with 3. The rest
//!    of it is cut off; later snapshots and `summary.json` are removed.
//! 5. End: last row, sync, `summary.json`, `final.mpts`, then the checkpoint is removed. A checkpoint beside `final.mpts` is a
//!    leftover.

use std::cell::RefCell;
use std::collections::HashMap;
use std::fs::{self, File, Permissions, TryLockError};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use particle_file::{Provenance, RUN_MARK};

use crate::failure::RunFailure;
use crate::files::{check_not_replaced, is_taken, sync_folder};
use crate::folder_mark;

/// The final state; a run with this file has ended.
pub(crate) const FINAL: &str = "final.mpts";
/// The state from which a run continues.
pub(crate) const CHECKPOINT: &str = "checkpoint.mpts";
/// The summary: end, verdict, measures and cost of the run.
pub(crate) const SUMMARY: &str = "summary.json";
/// The history: one row per interval.
pub(crate) const HISTORY: &str = "history.csv";
/// The case as run.
pub(crate) const RESOLVED: &str = "resolved.toml";
/// The folder of the snapshots.
pub(crate) const SNAPSHOTS: &str = "snapshots";
/// Temporary name of a file while it is written, in its folder.
pub(crate) const TEMPORARY: &str = ".mpm-run.tmp";

/// Name of a snapshot in the run folder.
pub(crate) fn snapshot_name(number: u32) -> String {
    format!("{SNAPSHOTS}/{number:04}.mpts")
}

/// A run folder, locked by this process against other runs.
#[derive(Debug)]
pub(crate) struct RunFolder {
    path: PathBuf,
    /// The mark, open and locked until the process ends or dies.
    marker: File,
    /// Why the mark could not be locked.
    unlocked: Option<io::Error>,
    /// Permissions of removed files, for the files that replace them.
    removed: RefCell<HashMap<PathBuf, Permissions>>,
}

impl RunFolder {
    /// Locks the folder at `path`; `None` if it has no mark of a run folder or does not exist.
    /// Errors: no folder, or one locked by another run.
    pub(crate) fn lock_existing(path: &Path, by: &Provenance) -> Result<Option<Self>, RunFailure> {
        match fs::metadata(path) {
            Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(e) => return Err(RunFailure::write(path)(e)),
            Ok(found) if found.is_dir() => {}
            Ok(_) => {
                return Err(RunFailure::Usage(format!(
                    "'{}' is a file; a run needs a folder",
                    path.display()
                )));
            }
        }
        if !is_taken(&path.join(RUN_MARK)) {
            return Ok(None);
        }
        Self::lock(path, by).map(Some)
    }

    /// Makes a run folder at `path`. An existing folder may be used if it holds no file with a name of a run.
    /// Errors: a folder that cannot become a run folder, or was locked by another run meanwhile.
    pub(crate) fn make(path: &Path, by: &Provenance) -> Result<Self, RunFailure> {
        fs::create_dir_all(path).map_err(RunFailure::write(path))?;
        let names = [
            FINAL, CHECKPOINT, SUMMARY, HISTORY, RESOLVED, SNAPSHOTS, TEMPORARY,
        ];
        let taken = names.iter().find(|name| is_taken(&path.join(name)));
        // Another run may have marked the folder since; `lock` or the check of earlier runs handles that.
        if let Some(name) = taken.filter(|_| !is_taken(&path.join(RUN_MARK))) {
            return Err(RunFailure::Usage(format!(
                "'{0}' holds '{name}' but is not marked as a run folder, so nothing in it is replaced or continued: \
                 name another folder, or, if it is a run of an earlier version, create an empty file '{1}' and use --overwrite",
                path.display(),
                path.join(RUN_MARK).display(),
            )));
        }
        let folder = Self::lock(path, by)?;
        let place = fs::canonicalize(path).ok();
        if let Some(parent) = place.as_deref().and_then(Path::parent) {
            sync_folder(parent).map_err(RunFailure::write(path))?;
        }
        Ok(folder)
    }

    /// Opens and locks the mark, and completes one that is empty or cut off.
    fn lock(path: &Path, by: &Provenance) -> Result<Self, RunFailure> {
        let place = path.join(RUN_MARK);
        if fs::symlink_metadata(&place).is_ok_and(|found| !found.is_file()) {
            return Err(folder_mark::not_a_mark(&place));
        }
        let open = File::options()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(&place);
        let mut marker = open.map_err(RunFailure::write(&place))?;
        let unlocked = match marker.try_lock() {
            Ok(()) => None,
            Err(TryLockError::WouldBlock) => {
                return Err(RunFailure::Usage(format!(
                    "another run is writing to '{}': wait for its end or name another folder",
                    path.display()
                )));
            }
            Err(TryLockError::Error(error)) => Some(error),
        };
        folder_mark::complete(&mut marker, by, &place)?;
        sync_folder(path).map_err(RunFailure::write(path))?;
        Ok(Self {
            path: path.to_owned(),
            marker,
            unlocked,
            removed: RefCell::default(),
        })
    }

    /// A warning if the file system has no locks: two runs would not notice each other.
    pub(crate) fn warning(&self) -> Option<String> {
        let error = self.unlocked.as_ref()?;
        Some(format!(
            "'{}' cannot be locked ({error}): make sure that no other run writes to it",
            self.path.display()
        ))
    }

    /// Path of the folder.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Path of `name` in the folder.
    pub(crate) fn path_of(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Writes `name` whole or not at all: under a temporary name, synced, and then renamed. The permissions of the replaced file
    /// are kept.
    /// Errors: the file and the system's reason; the replaced file is write-protected.
    pub(crate) fn write_whole(
        &self,
        name: &str,
        body: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), RunFailure> {
        let path = self.path_of(name);
        let within = path.parent().unwrap_or(&self.path);
        let aside = within.join(TEMPORARY);
        let place = self.path_of(RUN_MARK);
        check_not_replaced(&self.marker, &place).map_err(RunFailure::write(&place))?;
        let replaced = machine::replaced_permissions(&path).map_err(RunFailure::write(&path))?;
        // Must be a new file, so that nothing is written through a link.
        let file = File::create_new(&aside).map_err(RunFailure::write(&path))?;
        let write = || {
            if let Some(permissions) = replaced.or_else(|| self.removed.borrow_mut().remove(&path))
            {
                file.set_permissions(permissions)?;
            }
            let mut out = BufWriter::with_capacity(1 << 20, file);
            body(&mut out)?;
            out.into_inner().map_err(|e| e.into_error())?.sync_all()?;
            fs::rename(&aside, &path)?;
            sync_folder(within)
        };
        write().map_err(|error| {
            // A leftover that cannot be removed does no harm.
            let _ = fs::remove_file(&aside);
            RunFailure::write(&path)(error)
        })
    }

    /// Writes a text file whole or not at all.
    pub(crate) fn write_text(&self, name: &str, text: &str) -> Result<(), RunFailure> {
        self.write_whole(name, |out| out.write_all(text.as_bytes()))
    }

    /// Removes the file `name`, if it exists.
    pub(crate) fn remove(&self, name: &str) -> Result<(), RunFailure> {
        let path = self.path_of(name);
        let remove = || match machine::replaced_permissions(&path)? {
            Some(permissions) => {
                fs::remove_file(&path)?;
                self.removed.borrow_mut().insert(path.clone(), permissions);
                Ok(())
            }
            None => Ok(()),
        };
        remove().map_err(RunFailure::write(&path))
    }

    /// Fails if the folder is not writable or one of `names` is write-protected. Called before anything is removed.
    /// Errors: the folder or file and the reason.
    pub(crate) fn check_writable(&self, names: &[String]) -> Result<(), RunFailure> {
        for name in names {
            let path = self.path_of(name);
            machine::replaced_permissions(&path).map_err(RunFailure::write(&path))?;
        }
        for within in [self.path.clone(), self.path_of(SNAPSHOTS)] {
            let aside = within.join(TEMPORARY);
            match File::create_new(&aside).and_then(|_| fs::remove_file(&aside)) {
                Err(e) if e.kind() == io::ErrorKind::NotFound => {}
                tried => tried.map_err(RunFailure::write(&within))?,
            }
        }
        Ok(())
    }

    /// Makes the folder of the snapshots; the run folder itself must still exist.
    pub(crate) fn make_snapshots(&self) -> Result<(), RunFailure> {
        let path = self.path_of(SNAPSHOTS);
        match fs::create_dir(&path) {
            Err(e) if e.kind() == io::ErrorKind::AlreadyExists => Ok(()),
            made => made.and_then(|()| sync_folder(&self.path)),
        }
        .map_err(RunFailure::write(&path))
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub(crate) fn by(version: &str) -> Provenance {
        Provenance {
            tool: "mpm-run".into(),
            version: version.into(),
            ..Provenance::default()
        }
    }

    /// A run folder for a test, with the guard of its temporary folder.
    pub(crate) fn test_folder() -> (tempfile::TempDir, RunFolder) {
        let place = tempfile::tempdir().unwrap();
        let folder = RunFolder::make(place.path(), &by("1")).unwrap();
        (place, folder)
    }

    #[test]
    fn a_folder_without_locks_is_used_with_a_warning() {
        let (place, mut folder) = test_folder();
        assert_eq!(folder.warning(), None);
        folder.unlocked = Some(io::ErrorKind::Unsupported.into());
        let said = folder.warning().unwrap();
        assert!(said.contains(&place.path().display().to_string()), "{said}");
        assert!(said.contains("cannot be locked (unsupported)"), "{said}");
    }

    #[test]
    fn whether_files_can_be_made_is_tried_in_both_folders() {
        let (place, folder) = test_folder();
        folder.make_snapshots().unwrap();
        for within in [place.path().to_owned(), place.path().join(SNAPSHOTS)] {
            folder.check_writable(&[]).unwrap();
            assert!(!is_taken(&within.join(TEMPORARY)));
            fs::write(within.join(TEMPORARY), "theirs").unwrap();
            assert!(folder.check_writable(&[]).is_err());
            fs::remove_file(within.join(TEMPORARY)).unwrap();
        }
        fs::remove_dir(place.path().join(SNAPSHOTS)).unwrap();
        folder.check_writable(&[]).unwrap();
    }

    #[test]
    fn a_folder_that_was_replaced_is_not_written_into() {
        let (place, folder) = test_folder();
        folder.write_text(SUMMARY, "1").unwrap();
        fs::remove_file(place.path().join(RUN_MARK)).unwrap();
        fs::write(place.path().join(RUN_MARK), "").unwrap();
        let said = folder.write_text(SUMMARY, "2").unwrap_err().to_string();
        let why = "bondline-run.toml: it was removed or replaced";
        assert!(said.contains(why), "{said}");
        assert_eq!(fs::read(place.path().join(SUMMARY)).unwrap(), b"1");
        assert!(!is_taken(&place.path().join(TEMPORARY)));
    }

    #[test]
    fn a_failed_write_leaves_the_old_file_and_no_litter() {
        let (place, folder) = test_folder();
        folder.write_text(SUMMARY, "1").unwrap();
        let full = |out: &mut dyn Write| {
            out.write_all(b"half")?;
            Err(io::Error::other("disk on fire"))
        };
        assert!(folder.write_whole(SUMMARY, full).is_err());
        assert_eq!(fs::read(place.path().join(SUMMARY)).unwrap(), b"1");
        // An existing file of the temporary name, which could be a link, is not overwritten.
        fs::write(place.path().join(TEMPORARY), "theirs").unwrap();
        assert!(folder.write_text(SUMMARY, "2").is_err());
        assert_eq!(fs::read(place.path().join(TEMPORARY)).unwrap(), b"theirs");
    }
}
