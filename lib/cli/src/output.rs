//! Standard output or a file, never half written.

use std::ffi::OsString;
use std::fmt;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::{Failure, Record};
use crate::{aside, provenance};

/// Where a tool's data go: standard output (`-`) or a file.
///
/// A regular file appears whole or not at all: it is written beside its target and renamed.
/// What it replaces must not be write-protected, and passes its permissions on. Devices and pipes are written in place. A symbolic link is followed: what it points to is
/// replaced or made, and the link stays.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Output {
    /// Standard output.
    Stdout,
    /// A file.
    File(PathBuf),
}

impl From<OsString> for Output {
    fn from(text: OsString) -> Self {
        if text == "-" {
            Output::Stdout
        } else {
            Output::File(text.into())
        }
    }
}

impl fmt::Display for Output {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Output::Stdout => f.write_str("standard output"),
            Output::File(path) => write!(f, "'{}'", path.display()),
        }
    }
}

impl Output {
    /// Writes with `body` into a buffered writer and puts the result in place.
    ///
    /// # Errors
    /// Exit 1 with the target and the system's reason; a closed pipe ends quietly.
    pub fn write(
        &self,
        body: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let written = match self {
            Output::Stdout => {
                let mut out = BufWriter::with_capacity(1 << 16, io::stdout().lock());
                body(&mut out).and_then(|()| out.flush())
            }
            Output::File(path) => write_file(path, body),
        };
        written.map_err(|e| Failure::write(self, &e))
    }

    /// As [`Output::write`], for formats with no room for provenance (CSV, pictures): the
    /// record goes into `<file>.provenance.json` beside the file. Tools check the place of the
    /// record before they work, by [`crate::keep_apart_with_records`].
    ///
    /// # Errors
    /// As [`Output::write`]; exit 2 when a file that is no record stands where the record goes.
    pub fn write_with_record(
        &self,
        record: &Record,
        body: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let Some(beside) = self.record_path() else {
            return self.write(body);
        };
        provenance::may_replace(&beside)?;
        self.write(body)?;
        Output::File(beside).write(|out| out.write_all(record.to_json().as_bytes()))
    }

    /// Where the provenance record of a regular file goes.
    pub(crate) fn record_path(&self) -> Option<PathBuf> {
        match self {
            Output::File(path) if !is_special(path) => Some(provenance::beside(path)),
            _ => None,
        }
    }
}

fn is_special(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|m| !m.is_file())
}

/// Where a file to be written at `path` goes; nothing for devices and pipes, which are written in place.
pub(crate) fn target(path: &Path) -> io::Result<Option<PathBuf>> {
    if path.is_dir() {
        return Err(io::Error::other("it is a folder; a file name is needed"));
    }
    if is_special(path) {
        return Ok(None);
    }
    let target = aside::behind_links(path)?;
    let folder = aside::folder_of(&target);
    if !folder.is_dir() {
        return Err(io::Error::other(format!(
            "there is no folder '{}'",
            folder.display()
        )));
    }
    Ok(Some(target))
}

fn write_file(path: &Path, body: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let Some(target) = target(path)? else {
        let mut out = BufWriter::new(File::options().write(true).open(path)?);
        body(&mut out)?;
        return out.flush();
    };
    let mut file = aside::file_for(&target)?;
    {
        let mut out = BufWriter::with_capacity(1 << 20, file.as_file_mut());
        body(&mut out)?;
        out.flush()?;
    }
    file.persist(target).map_err(|e| e.error)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::fs::Permissions;
    use std::os::unix::fs::PermissionsExt;

    use super::*;

    #[test]
    fn a_failed_body_leaves_the_old_file_and_no_litter() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a.csv");
        let output = Output::File(target.clone());
        output.write(|out| out.write_all(b"old")).unwrap();
        let failed = output.write(|out| {
            out.write_all(b"half")?;
            Err(io::Error::other("disk on fire"))
        });
        assert!(failed.is_err());
        assert_eq!(fs::read(&target).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_link_stays_and_what_it_points_to_is_replaced_or_made() {
        let folder = tempfile::tempdir().unwrap();
        let inside = |name: &str| folder.path().join(name);
        fs::create_dir(inside("elsewhere")).unwrap();
        fs::write(inside("elsewhere/old"), b"old").unwrap();
        let link = |to: &str, name: &str| std::os::unix::fs::symlink(to, inside(name)).unwrap();
        link("elsewhere/old", "a");
        link("elsewhere/new", "dangling");
        link("dangling", "twice");
        link("loop", "loop");
        for (name, at) in [("a", "elsewhere/old"), ("twice", "elsewhere/new")] {
            let output = Output::File(inside(name));
            output.write(|out| out.write_all(b"x")).unwrap();
            assert!(inside(name).is_symlink());
            assert!(!inside(at).is_symlink() && fs::read(inside(at)).unwrap() == b"x");
        }
        assert!(inside("dangling").is_symlink());
        let round = Output::File(inside("loop")).write(|out| out.write_all(b"x"));
        assert!(round.is_err());
        assert_eq!(fs::read_dir(inside("elsewhere")).unwrap().count(), 2);
    }

    #[test]
    fn permissions_are_kept_and_write_protection_is_heeded() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a.csv");
        let output = Output::File(target.clone());
        let record = Record::new("tool", "1.0", Vec::new());
        let write = || output.write_with_record(&record, |out| out.write_all(b"x"));
        write().unwrap();
        let record = fs::read_to_string(provenance::beside(&target)).unwrap();
        assert!(record.contains("\"tool\": \"tool\""), "{record}");
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
        let set = |path: &Path, mode| fs::set_permissions(path, Permissions::from_mode(mode));
        let beside = provenance::beside(&target);
        assert_eq!(mode(&target), mode(&beside), "as the umask has it");
        for bits in [0o600, 0o640, 0o666] {
            set(&target, bits).unwrap();
            write().unwrap();
            assert_eq!(mode(&target), bits);
        }
        for path in [&target, &beside] {
            set(path, 0o444).unwrap();
            let refused = crate::keep_apart_with_records([], [&output]);
            assert!(refused.is_err() && write().is_err());
            assert_eq!(mode(path), 0o444);
            set(path, 0o644).unwrap();
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
        write().unwrap();
    }
}
