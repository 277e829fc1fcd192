use std::fs;
use std::path::{Path, PathBuf};

use crate::source::quoted;
use crate::{Error, foreign};

/// The endings of each kind of slice. TIFF comes first: pictures beside TIFF slices are previews.
const KINDS: [&[&str]; 4] = [&["tif", "tiff"], &["bmp"], &["png"], &["jpg", "jpeg"]];

/// The slices of a folder in natural order, all of one kind; hidden and other files are passed
/// over.
pub(crate) fn slices(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let entries = fs::read_dir(folder).map_err(|e| Error::io(quoted(folder), e))?;
    let mut kinds = [const { Vec::new() }; 4];
    for entry in entries {
        let path = entry.map_err(|e| Error::io(quoted(folder), e))?.path();
        if let Some(kind) = kind_of(&path) {
            kinds[kind].push(path);
        }
    }
    let [tiff, bmp, png, jpeg] = kinds;
    let pictures = [bmp, png, jpeg].into_iter().filter(|k| !k.is_empty());
    let mut kinds = match tiff.is_empty() {
        true => pictures.collect(),
        false => vec![tiff],
    };
    let Some(mut slices) = kinds.pop().filter(|_| kinds.is_empty()) else {
        let what = match kinds.is_empty() {
            true => foreign::conversion_of_folder(folder).unwrap_or(
                "the folder holds no slices; accepted are files ending in .tif, .tiff, .bmp, .png, .jpg or .jpeg",
            ),
            false => "the folder holds slices of several kinds; accepted is one of BMP, PNG and JPEG",
        };
        return Err(Error::file(quoted(folder), what));
    };
    sort_naturally(&mut slices);
    Ok(slices)
}

/// Which of [`KINDS`] a file is by its ending.
fn kind_of(path: &Path) -> Option<usize> {
    let hidden = path
        .file_name()
        .is_none_or(|name| name.to_string_lossy().starts_with('.'));
    let ending = path.extension()?.to_string_lossy().to_lowercase();
    let kind = KINDS.iter().position(|k| k.contains(&ending.as_str()));
    kind.filter(|_| !hidden && path.is_file())
}

/// `slice_2` before `slice_10`; names that only differ in spaces or zeros by their bytes.
pub(crate) fn sort_naturally(paths: &mut [PathBuf]) {
    paths.sort_by(|a, b| {
        natord::compare(&a.to_string_lossy(), &b.to_string_lossy()).then_with(|| a.cmp(b))
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_count_and_case_of_the_ending_does_not() {
        let mut paths: Vec<PathBuf> = ["s 10.tif", "s 9.TIF", "s 1.tiff", "s 100.tif"]
            .map(PathBuf::from)
            .to_vec();
        sort_naturally(&mut paths);
        let sorted: Vec<_> = paths.iter().map(|p| p.display().to_string()).collect();
        assert_eq!(sorted, ["s 1.tiff", "s 9.TIF", "s 10.tif", "s 100.tif"]);
    }

    #[test]
    fn a_folder_without_slices_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("._a.tif"), b"hidden").unwrap();
        fs::write(folder.path().join("readme.txt"), b"text").unwrap();
        assert!(slices(folder.path()).is_err());
        fs::write(folder.path().join("a b.TIFF"), b"").unwrap();
        assert_eq!(slices(folder.path()).unwrap().len(), 1);
        // Previews beside slices are none, but pictures of two kinds are no stack.
        fs::write(folder.path().join("a.png"), b"").unwrap();
        fs::write(folder.path().join("a.BMP"), b"").unwrap();
        assert_eq!(slices(folder.path()).unwrap().len(), 1);
        fs::remove_file(folder.path().join("a b.TIFF")).unwrap();
        let said = slices(folder.path()).unwrap_err().to_string();
        assert!(said.contains("several kinds"), "{said}");
    }
}
