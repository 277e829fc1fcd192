use std::fs;
use std::path::{Path, PathBuf};

use crate::aside;
use crate::{Failure, Output};

/// Refuses outputs that would replace a file that is read, or one another.
///
/// # Errors
/// Exit 2 with the file that is named twice.
pub fn keep_apart<'a>(
    inputs: impl IntoIterator<Item = &'a Path>,
    outputs: impl IntoIterator<Item = &'a Output>,
) -> Result<(), Failure> {
    let read: Vec<PathBuf> = inputs.into_iter().filter_map(place).collect();
    let mut written = Vec::new();
    for output in outputs {
        let Output::File(path) = output else { continue };
        // What cannot be placed cannot be written either, and is refused then.
        let Some(place) = place(path) else { continue };
        if read.contains(&place) {
            return Err(Failure::usage(format!(
                "{output} is read and cannot be the output too: give another file name"
            )));
        }
        if written.contains(&place) {
            return Err(Failure::usage(format!(
                "{output} is given for two outputs: give each a file name of its own"
            )));
        }
        written.push(place);
    }
    Ok(())
}

/// Where a regular file is or would be; `None` for devices and pipes, which hold nothing that
/// could be replaced.
fn place(path: &Path) -> Option<PathBuf> {
    if let Ok(found) = fs::metadata(path) {
        return found.is_file().then(|| fs::canonicalize(path).ok())?;
    }
    let target = aside::behind_links(path).ok()?;
    let folder = fs::canonicalize(aside::folder_of(&target)).ok()?;
    Some(folder.join(target.file_name()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_file_by_another_path_is_found_and_devices_are_not() {
        let folder = tempfile::tempdir().unwrap();
        let inside = |name: &str| folder.path().join(name);
        fs::write(inside("a"), b"x").unwrap();
        fs::create_dir(inside("b")).unwrap();
        let file = |name: &str| Output::File(inside(name));
        let [input, other] = [inside("a"), inside("none")];
        let check = |outputs: &[Output]| keep_apart([input.as_path(), &other], outputs);
        assert!(check(&[file("b/../a")]).is_err());
        assert!(check(&[file("c"), file("b/../c")]).is_err());
        assert!(check(&[file("c"), file("b/c"), Output::Stdout]).is_ok());
        std::os::unix::fs::symlink("b/new", inside("link")).unwrap();
        assert!(check(&[file("link"), file("b/new")]).is_err());
        let null = || Output::File("/dev/null".into());
        assert!(check(&[null(), null()]).is_ok());
    }
}
