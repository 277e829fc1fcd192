//! The slices in a folder.

use std::fs;
use std::path::{Path, PathBuf};

use crate::source::quoted;
use crate::{Error, foreign};

/// The endings of each kind of slice.
const KINDS: [&[&str]; 4] = [&["tif", "tiff"], &["bmp"], &["png"], &["jpg", "jpeg"]];
const NAMES: [&str; 4] = ["TIFF", "BMP", "PNG", "JPEG"];

/// The slices of a folder, all of one kind; hidden and other files are passed over.
///
/// # Errors
/// A folder that cannot be read, holds no slices, slices that are not there, or slices of two kinds: which of them the
/// stack is and which are previews nobody can tell.
pub(crate) fn slices(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let entries = fs::read_dir(folder).map_err(|e| Error::io(quoted(folder), e))?;
    let mut kinds = [const { Vec::new() }; 4];
    for entry in entries {
        let path = entry.map_err(|e| Error::io(quoted(folder), e))?.path();
        if let Some(kind) = kind_of(&path) {
            check_file(&path)?;
            kinds[kind].push(path);
        }
    }
    kinds.iter_mut().for_each(|slices| slices.sort());
    let found = || {
        kinds
            .iter()
            .zip(NAMES)
            .filter(|(slices, _)| !slices.is_empty())
    };
    let what = match (found().next(), found().nth(1)) {
        (Some((slices, _)), None) => return Ok(slices.clone()),
        (Some((a, kind)), Some((b, other))) => format!(
            "the folder holds slices of several kinds, {} {kind} and {} {other} files, as {} and {}; accepted is one kind: move the others away, or name the slices, as in FOLDER/*.png",
            a.len(),
            b.len(),
            quoted(&a[0]),
            quoted(&b[0])
        ),
        _ => foreign::conversion_of_folder(folder).unwrap_or(
            "the folder holds no slices; accepted are files ending in .tif, .tiff, .bmp, .png, .jpg or .jpeg",
        ).to_owned(),
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
    let hidden = path
        .file_name()
        .is_none_or(|name| name.to_string_lossy().starts_with('.'));
    let ending = path.extension()?.to_string_lossy().to_lowercase();
    let kind = KINDS.iter().position(|k| k.contains(&ending.as_str()));
    kind.filter(|_| !hidden)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_without_slices_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("._a.tif"), b"hidden").unwrap();
        fs::write(folder.path().join("readme.txt"), b"text").unwrap();
        assert!(slices(folder.path()).is_err());
        fs::write(folder.path().join("a b.TIFF"), b"").unwrap();
        assert_eq!(slices(folder.path()).unwrap().len(), 1);
        // One TIFF among PNG slices hid them all.
        fs::write(folder.path().join("a.png"), b"").unwrap();
        fs::write(folder.path().join("b.PNG"), b"").unwrap();
        let said = slices(folder.path()).unwrap_err().to_string();
        assert!(
            said.contains("several kinds, 1 TIFF and 2 PNG files"),
            "{said}"
        );
        assert!(
            said.contains("a b.TIFF") && said.contains("a.png"),
            "{said}"
        );
        fs::remove_file(folder.path().join("a b.TIFF")).unwrap();
        assert_eq!(slices(folder.path()).unwrap().len(), 2);
    }

    #[test]
    fn what_is_named_as_a_slice_must_be_a_file() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().unwrap();
        let slice = |name: &str| folder.path().join(name);
        fs::write(slice("s0.tif"), b"").unwrap();
        symlink("s0.tif", slice("s1.tif")).unwrap();
        fs::create_dir(slice("previews")).unwrap();
        symlink(".annex/key", slice(".s9.tif")).unwrap();
        assert_eq!(slices(folder.path()).unwrap().len(), 2);
        symlink(".annex/key", slice("s2.tif")).unwrap();
        let said = slices(folder.path()).unwrap_err().to_string();
        assert!(
            said.contains("s2.tif': it is a link to '.annex/key'"),
            "{said}"
        );
        fs::remove_file(slice("s2.tif")).unwrap();
        fs::create_dir(slice("s3.tif")).unwrap();
        let said = slices(folder.path()).unwrap_err().to_string();
        assert!(said.contains("is no file"), "{said}");
    }
}
