//! A folder of files that come together or not at all.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::{Failure, aside, provenance};

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
    pub fn new(target: &Path) -> Result<Self, Failure> {
        let begun = aside::behind_links(target).and_then(|target| {
            let (_claim, aside) = aside::folder_for(&target)?;
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

    /// Moves the files into their folder, over those of the same names that are `ours`: parts of
    /// an earlier output.
    ///
    /// # Errors
    /// Exit 2 where another file has one of the names, and exit 1 where one is write-protected, before
    /// anything is moved; exit 1 with the system's reason.
    pub fn put_in_place(self, ours: impl Fn(&Path) -> bool) -> Result<(), Failure> {
        let moves = self.moves().map_err(|e| failure(&self.target, &e))?;
        for (from, to) in &moves {
            if let Ok(found) = to.symlink_metadata() {
                // A file with a record of its own is an output that was asked for by its name.
                let named = provenance::beside(to).exists();
                if !found.is_file() || named || !ours(to) {
                    return Err(Failure::usage(format!(
                        "'{}' is not part of an earlier output and would be replaced: give another file name",
                        to.display()
                    )));
                }
                let keep = || match machine::replaced_permissions(to)? {
                    Some(permissions) => fs::set_permissions(from, permissions),
                    None => Ok(()),
                };
                keep().map_err(|e| failure(to, &e))?;
            }
        }
        let put = || {
            fs::create_dir_all(&self.target)?;
            moves.iter().try_for_each(|(from, to)| fs::rename(from, to))
        };
        put().map_err(|e| failure(&self.target, &e))
    }

    fn moves(&self) -> io::Result<Vec<(PathBuf, PathBuf)>> {
        let entries = fs::read_dir(self.aside.path())?;
        let place = |entry: fs::DirEntry| (entry.path(), self.target.join(entry.file_name()));
        entries.map(|entry| entry.map(place)).collect()
    }
}

fn failure(target: &Path, error: &io::Error) -> Failure {
    Failure::write(format_args!("'{}'", target.display()), error)
}

#[cfg(test)]
mod tests {
    use std::fs::Permissions;
    use std::os::unix::fs::PermissionsExt;

    use super::*;

    #[test]
    fn parts_keep_the_mode_of_those_they_replace_and_spare_the_write_protected() {
        let place = tempfile::tempdir().unwrap();
        let target = place.path().join("parts");
        let put = || {
            let staged = StagedFolder::new(&target).unwrap();
            for name in ["a", "b"] {
                fs::write(staged.path(name), "new").unwrap();
            }
            staged.put_in_place(|_| true)
        };
        put().unwrap();
        let set = |name: &str, mode| {
            fs::write(target.join(name), "old").unwrap();
            fs::set_permissions(target.join(name), Permissions::from_mode(mode)).unwrap();
        };
        let read = |name: &str| fs::read_to_string(target.join(name)).unwrap();
        set("a", 0o600);
        set("b", 0o444);
        assert!(put().is_err());
        assert_eq!((read("a"), read("b")), ("old".into(), "old".into()));
        fs::set_permissions(target.join("b"), Permissions::from_mode(0o640)).unwrap();
        put().unwrap();
        let metadata = |name| fs::metadata(target.join(name)).unwrap();
        let mode = |name| metadata(name).permissions().mode() & 0o777;
        assert_eq!((mode("a"), mode("b")), (0o600, 0o640));
        assert_eq!(read("a"), "new");
    }
}
