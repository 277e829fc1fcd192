use std::fs;
use std::path::{Path, PathBuf};

use crate::Error;
use crate::source::quoted;

/// The TIFF files of a folder in natural order; hidden and other files are passed over.
pub(crate) fn slices(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let entries = fs::read_dir(folder).map_err(|e| Error::io(quoted(folder), e))?;
    let mut slices = Vec::new();
    for entry in entries {
        let path = entry.map_err(|e| Error::io(quoted(folder), e))?.path();
        if is_slice(&path) {
            slices.push(path);
        }
    }
    if slices.is_empty() {
        return Err(Error::file(
            quoted(folder),
            "the folder holds no slices; accepted are files ending in .tif or .tiff",
        ));
    }
    sort_naturally(&mut slices);
    Ok(slices)
}

fn is_slice(path: &Path) -> bool {
    let hidden = path
        .file_name()
        .is_none_or(|name| name.to_string_lossy().starts_with('.'));
    let tiff = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("tif") || e.eq_ignore_ascii_case("tiff"));
    tiff && !hidden && path.is_file()
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
    }
}
