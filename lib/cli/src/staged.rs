use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::Failure;
use crate::aside;

/// A folder of files that belong together: written aside, and moved into their folder when all
/// of them are whole. A tool that fails before leaves the folder as it was.
pub struct StagedFolder {
    target: PathBuf,
    aside: TempDir,
    /// Tells a sweep that the folder aside is in use.
    _claim: File,
}

impl StagedFolder {
    /// Begins the files of the folder `target`, which need not exist.
    ///
    /// # Errors
    /// Exit 1 with the system's reason.
    pub fn new(target: &Path) -> Result<Self, Failure> {
        let begun = aside::behind_links(target).and_then(|target| {
            let (aside, _claim) = aside::folder_for(&target)?;
            Ok(Self {
                target,
                aside,
                _claim,
            })
        });
        begun.map_err(|e| failure(target, &e))
    }

    /// Where to write the file called `name`.
    pub fn path(&self, name: &str) -> PathBuf {
        self.aside.path().join(name)
    }

    /// Moves the files into their folder, over others of the same names.
    ///
    /// # Errors
    /// Exit 1 with the system's reason.
    pub fn put_in_place(self) -> Result<(), Failure> {
        let put = || {
            fs::create_dir_all(&self.target)?;
            for entry in fs::read_dir(self.aside.path())? {
                let entry = entry?;
                fs::rename(entry.path(), self.target.join(entry.file_name()))?;
            }
            Ok(())
        };
        put().map_err(|e| failure(&self.target, &e))
    }
}

fn failure(target: &Path, error: &io::Error) -> Failure {
    Failure::write(format_args!("'{}'", target.display()), error)
}
