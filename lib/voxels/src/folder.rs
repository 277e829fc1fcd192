//! The slices in a folder, in order.

use std::fs;
use std::path::{Path, PathBuf};

use crate::source::quoted;
use crate::{Error, foreign};

/// The endings of each kind of slice.
const KINDS: [&[&str]; 4] = [&["tif", "tiff"], &["bmp"], &["png"], &["jpg", "jpeg"]];
const NAMES: [&str; 4] = ["TIFF", "BMP", "PNG", "JPEG"];

/// The slices of a folder in natural order, all of one kind; hidden and other files are passed
/// over.
///
/// # Errors
/// A folder that cannot be read, holds no slices, or slices of two kinds: which of them the stack
/// is and which are previews nobody can tell.
pub(crate) fn slices(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let entries = fs::read_dir(folder).map_err(|e| Error::io(quoted(folder), e))?;
    let mut kinds = [const { Vec::new() }; 4];
    for entry in entries {
        let path = entry.map_err(|e| Error::io(quoted(folder), e))?.path();
        if let Some(kind) = kind_of(&path) {
            kinds[kind].push(path);
        }
    }
    let counts: Vec<String> = (kinds.iter().zip(NAMES))
        .filter(|(slices, _)| !slices.is_empty())
        .map(|(slices, name)| format!("{} {name}", slices.len()))
        .collect();
    let mut found = kinds.into_iter().filter(|slices| !slices.is_empty());
    let (Some(mut slices), None) = (found.next(), found.next()) else {
        let what = match counts.is_empty() {
            true => foreign::conversion_of_folder(folder).unwrap_or(
                "the folder holds no slices; accepted are files ending in .tif, .tiff, .bmp, .png, .jpg or .jpeg",
            ).to_owned(),
            false => format!(
                "the folder holds slices of several kinds, {} files; accepted is one kind: move the others away, or name the slices, as in FOLDER/*.png",
                counts.join(" and ")
            ),
        };
        return Err(Error::file(quoted(folder), what));
    };
    sort_naturally(&mut slices);
    Ok(slices)
}

/// What is missing among slices in natural order whose names differ in one number alone: the first
/// gap in what is else counted evenly, as a sentence. Names that are not counted evenly in at
/// least half of their steps, such as times, have no gaps.
pub(crate) fn gap(slices: &[PathBuf]) -> Option<String> {
    let counted: Option<Vec<_>> = slices.iter().map(|path| last_number(path)).collect();
    let counted = counted?;
    let around = |i: usize| (&counted[i].0, &counted[i].2);
    if counted.len() < 3 || (1..counted.len()).any(|i| around(i) != around(0)) {
        return None;
    }
    let steps = || {
        counted
            .windows(2)
            .map(|pair| pair[1].1.checked_sub(pair[0].1))
    };
    let even = steps().flatten().filter(|step| *step > 0).min()?;
    let odd = |step: &Option<u64>| *step != Some(even);
    let gaps = steps().filter(odd).count();
    let at = steps().position(|step| odd(&step))?;
    let [before, behind] = [at, at + 1].map(|i| quoted(&slices[i]));
    (2 * gaps < counted.len()).then(|| {
        format!(
            "the slices are numbered in steps of {even}, but between {before} and {behind} {}{}: the stack is read as if nothing were missing",
            match counted[at + 1].1.saturating_sub(counted[at].1) {
                0 => "there is none".to_owned(),
                step => format!("it is {step}"),
            },
            match gaps {
                1 => String::new(),
                n => format!(", and at {} more places", n - 1),
            }
        )
    })
}

/// The last number in the name of a file, and what stands before and behind it.
fn last_number(path: &Path) -> Option<(String, u64, String)> {
    let stem = path.file_stem()?.to_str()?;
    let digit = |c: char| c.is_ascii_digit();
    let end = stem.rfind(digit)? + 1;
    let start = stem[..end].rfind(|c| !digit(c)).map_or(0, |at| at + 1);
    // A letter before the number may take more than one byte.
    let start =
        (start..end).find(|&at| stem.is_char_boundary(at) && stem[at..end].chars().all(digit))?;
    let number = stem[start..end].parse().ok()?;
    Some((stem[..start].to_owned(), number, stem[end..].to_owned()))
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
        // One TIFF among PNG slices hid them all.
        fs::write(folder.path().join("a.png"), b"").unwrap();
        fs::write(folder.path().join("b.PNG"), b"").unwrap();
        let said = slices(folder.path()).unwrap_err().to_string();
        assert!(
            said.contains("several kinds, 1 TIFF and 2 PNG files"),
            "{said}"
        );
        fs::remove_file(folder.path().join("a b.TIFF")).unwrap();
        assert_eq!(slices(folder.path()).unwrap().len(), 2);
    }

    #[test]
    fn a_slice_that_is_missing_is_missed() {
        let gap = |names: &[&str]| gap(&names.iter().map(PathBuf::from).collect::<Vec<_>>());
        let said = gap(&["s_08.tif", "s_09.tif", "s_12.tif", "s_13.tif"]).unwrap();
        assert!(
            said.contains("'s_09.tif' and 's_12.tif' it is 3:"),
            "{said}"
        );
        let said = gap(&["s1", "s3", "s5", "s9", "s11", "s15", "s17"]).unwrap();
        assert!(
            said.contains("steps of 2") && said.contains("1 more places"),
            "{said}"
        );
        let said = gap(&["s1.tif", "s01.tif", "s2.tif"]).unwrap();
        assert!(said.contains("there is none"), "{said}");
        for whole in [
            &["s_08.tif", "s_09.tif", "s_10.tif"][..],
            &["a5", "a10", "a15"],
            &["µ0", "µ1", "µ2"],
            // Times, names without a number, of two series.
            &["t103015", "t103047", "t103112", "t103214"],
            &["a", "b", "c"],
            &["a1", "a2", "b5"],
            &["s1", "s9"],
        ] {
            assert_eq!(gap(whole), None, "{whole:?}");
        }
    }
}
