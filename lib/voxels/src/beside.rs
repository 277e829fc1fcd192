//! Pixels in a file beside their header's.

use std::path::{Component, Path, PathBuf};

/// The file `name`, which the header at `path` calls its `field`, in the folder of the header;
/// nothing outside that folder is read, be it through `..` or a link.
pub(crate) fn data_file(path: &Path, name: &Path, field: &str) -> Result<PathBuf, String> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let refused = |why: &str| {
        format!(
            "its {field} '{}' {why}; accepted is a file in the header's own folder or in one inside it",
            name.display()
        )
    };
    let stays = |part| matches!(part, Component::Normal(_) | Component::CurDir);
    if !name.components().all(stays) {
        return Err(refused("is an absolute path or has '..' in it"));
    }
    let beside = folder.join(name);
    let unreadable = |e: std::io::Error| refused(&format!("cannot be read: {e}"));
    let place = beside.canonicalize().map_err(unreadable)?;
    if !place.starts_with(folder.canonicalize().map_err(unreadable)?) {
        return Err(refused("is a link that leaves the folder"));
    }
    match place.is_file() {
        true => Ok(beside),
        false => Err(refused("is no regular file")),
    }
}
