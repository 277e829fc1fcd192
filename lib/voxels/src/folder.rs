//! The slices in a folder.

use std::fs;
use std::path::{Path, PathBuf};

use crate::source::quoted;
use crate::{Error, foreign};

/// Kinds of slices and their endings.
const KINDS: [(&str, &[&str]); 4] = [
    ("TIFF", &["tif", "tiff"]),
    ("BMP", &["bmp"]),
    ("PNG", &["png"]),
    ("JPEG", &["jpg", "jpeg"]),
];

/// The slices of a folder; hidden and other files are passed over. They are of one kind: which of two the stack is and
/// which are previews nobody can tell.
pub(crate) fn slices(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let unreadable = |e| Error::io(quoted(folder), e);
    let mut kinds = [const { Vec::new() }; KINDS.len()];
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if let Some(kind) = kind_of(&path) {
            check_file(&path)?;
            kinds[kind].push(path);
        }
    }
    kinds.iter_mut().for_each(|slices| slices.sort());
    let found = kinds
        .iter()
        .zip(KINDS)
        .filter(|(slices, _)| !slices.is_empty());
    let what = match found.collect::<Vec<_>>()[..] {
        [] => match foreign::conversion_of_folder(folder) {
            Some(known) => format!("it is {known}"),
            None => "the folder holds no slices; accepted are files ending in .tif, .tiff, .bmp, .png, .jpg or .jpeg".into(),
        },
        [(slices, _)] => return Ok(slices.clone()),
        [(a, (kind, _)), (b, (other, _)), ..] => format!(
            "the folder holds slices of several kinds, {} {kind} and {} {other} files, as {} and {}; accepted is one kind: move the others away, or name the slices, as in FOLDER/*.png",
            a.len(),
            b.len(),
            quoted(&a[0]),
            quoted(&b[0])
        ),
    };
    Err(Error::file(quoted(folder), what))
}

/// Refuses a slice that is no file, such as a link into a store from which it was never fetched.
fn check_file(slice: &Path) -> Result<(), Error> {
    let what = match (fs::metadata(slice), fs::read_link(slice)) {
        (Ok(meta), _) if meta.is_file() => return Ok(()),
        (Ok(_), _) => "it is named as a slice but is no file".into(),
        (Err(_), Ok(target)) => format!(
            "it is a link to {}, which cannot be read: fetch it (of git-annex: git annex get), or remove the link",
            quoted(&target)
        ),
        (Err(e), Err(_)) => return Err(Error::io(quoted(slice), e)),
    };
    Err(Error::file(quoted(slice), what))
}

/// Whether a folder has a file that is named as a slice of a stack.
pub fn holds_slices(folder: &Path) -> bool {
    let mut entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries.any(|entry| kind_of(&entry.path()).is_some())
}

/// Which of [`KINDS`] a file is by its ending.
fn kind_of(path: &Path) -> Option<usize> {
    let hidden = path.file_name()?.to_string_lossy().starts_with('.');
    let ending = path.extension()?.to_string_lossy().to_lowercase();
    let of_kind = |(_, endings): &(&str, &[&str])| endings.contains(&ending.as_str());
    KINDS.iter().position(of_kind).filter(|_| !hidden)
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::symlink;

    use super::*;

    #[test]
    fn slices_are_files_of_one_kind() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let write = |name: &str| fs::write(path(name), b"").unwrap();
        let found = || slices(folder.path()).map(|slices| slices.len());
        let said = || found().unwrap_err().to_string();
        ["._a.tif", "readme.txt"].into_iter().for_each(write);
        assert!(said().contains("no slices"), "{}", said());
        write("a b.TIFF");
        assert_eq!(found().unwrap(), 1);
        // One TIFF among PNG slices hid them all.
        ["a.png", "b.PNG"].into_iter().for_each(write);
        for part in ["several kinds, 1 TIFF and 2 PNG files", "a b.TIFF", "a.png"] {
            assert!(said().contains(part), "{}", said());
        }
        fs::remove_file(path("a b.TIFF")).unwrap();
        symlink("a.png", path("c.png")).unwrap();
        fs::create_dir(path("previews")).unwrap();
        symlink(".annex/key", path(".s9.png")).unwrap();
        assert_eq!(found().unwrap(), 3);
        symlink(".annex/key", path("s2.png")).unwrap();
        assert!(
            said().contains("s2.png': it is a link to '.annex/key'"),
            "{}",
            said()
        );
        fs::remove_file(path("s2.png")).unwrap();
        fs::create_dir(path("s3.png")).unwrap();
        assert!(said().contains("is no file"), "{}", said());
    }
}
