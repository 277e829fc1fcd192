//! Pixels in files beside their header's.

use std::path::{Component, Path, PathBuf};

use particle_file::limits;

/// The files that a header at `path` names by `value` of its `field`: one, many by a pattern and
/// its numbers (`slice%03d.raw 0 99 1`), or those in the lines `below` it (`LIST`).
pub(crate) fn data_files(
    path: &Path,
    value: &str,
    below: &[u8],
    field: &str,
) -> Result<Vec<PathBuf>, String> {
    let text = String::from_utf8_lossy(below);
    let names: Vec<String> = match value.split_whitespace().next() {
        Some("LIST") => {
            let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
            lines.map(str::to_owned).collect()
        }
        _ if value.contains('%') => numbered(value).ok_or_else(|| {
            format!("its {field} '{value}' is no pattern; accepted is such as slice%03d.raw 0 99 1")
        })?,
        _ => vec![value.to_owned()],
    };
    if names.is_empty() {
        return Err(format!("its {field} LIST has no names below it"));
    }
    let file = |name: &String| data_file(path, Path::new(name), field);
    names.iter().map(file).collect()
}

/// The names of a pattern, first number, last number and step; none where they are not such.
fn numbered(value: &str) -> Option<Vec<String>> {
    let mut words = value.split_whitespace();
    let (before, rest) = words.next()?.split_once('%')?;
    let (width, behind) = rest.split_once('d')?;
    // No flag or width prints as width 0.
    let width = format!("0{width}").parse().ok();
    let width = width.filter(|width: &usize| *width < 20)?;
    let width = if rest.starts_with('0') { width } else { 0 };
    let numbers: Option<Vec<u64>> = words.map(|n| n.parse().ok()).collect();
    let (first, last, step) = match numbers?[..] {
        [first, last] => (first, last, 1),
        // A fourth tells the axes of a file.
        [first, last, step] | [first, last, step, _] => (first, last, step),
        _ => return None,
    };
    if step == 0 || last < first || (last - first) / step >= limits::PER_AXIS {
        return None;
    }
    let name = |n: u64| format!("{before}{n:0width$}{behind}");
    Some((first..=last).step_by(step as usize).map(name).collect())
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_as_printf_reads_them() {
        let padded = numbered("a%03d.raw 8 12 2").unwrap();
        assert_eq!(padded, ["a008.raw", "a010.raw", "a012.raw"]);
        assert_eq!(numbered("a%d 9 10 1 2").unwrap(), ["a9", "a10"]);
        for none in [
            "a%03d",
            "a%s 1 2 1",
            "a%d 2 1 1",
            "a%d 1 2 0",
            "a%d 0 99999999 1",
            "a%d -1 2 1",
        ] {
            assert_eq!(numbered(none), None, "{none}");
        }
    }
}
