//! The mark of a run folder: a file that identifies it.

use std::fs::File;
use std::io::{Read, Write};
use std::path::Path;

use particle_file::Provenance;

use crate::failure::RunFailure;

/// Version of the layout of run folders.
const FORMAT: u32 = 1;

fn mark_text(by: &Provenance) -> String {
    format!(
        "# A run folder: {} replaces its own files here and leaves all others alone.\n\
         format = {FORMAT}\ntool = \"{}\"\nversion = \"{}\"\n",
        by.tool, by.tool, by.version
    )
}

/// Reads the mark and completes one that is empty or cut off, as a kill or a user may leave it.
/// Errors: a file that is no mark of this tool (exit 2); a failed write.
pub(crate) fn complete(marker: &mut File, by: &Provenance, place: &Path) -> Result<(), RunFailure> {
    let mut found = Vec::new();
    let read = (&*marker).take(1 << 12).read_to_end(&mut found);
    read.map_err(RunFailure::write(place))?;
    if let Some(rest) = mark_text(by).as_bytes().strip_prefix(found.as_slice()) {
        if !rest.is_empty() {
            let write = marker.write_all(rest).and_then(|()| marker.sync_all());
            write.map_err(RunFailure::write(place))?;
        }
        return Ok(());
    }
    // A mark of another version of the tool differs in the last line only.
    let mark = mark_text(by);
    let own = mark.rsplit_once("version").map_or(&*mark, |(own, _)| own);
    match found.starts_with(own.as_bytes()) {
        true => Ok(()),
        false => Err(not_a_mark(place)),
    }
}

/// The refusal of a file that has the mark's name but is no mark.
pub(crate) fn not_a_mark(place: &Path) -> RunFailure {
    RunFailure::Usage(format!(
        "'{}' is not the mark of a run folder that this version knows: name another folder",
        place.display()
    ))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use particle_file::RUN_MARK;

    use super::*;
    use crate::folder::tests::by;

    #[test]
    fn a_mark_cut_off_is_filled_in_and_another_file_is_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join(RUN_MARK);
        let opened = |content: &str, version: &str| {
            fs::write(&place, content).unwrap();
            let mut file = File::options().read(true).write(true).open(&place).unwrap();
            complete(&mut file, &by(version), &place)
        };
        let whole = mark_text(&by("1"));
        for cut in [0, 10, whole.len() - 1, whole.len()] {
            opened(&whole[..cut], "1").unwrap();
            assert_eq!(fs::read_to_string(&place).unwrap(), whole);
        }
        opened(&whole, "2").unwrap();
        assert_eq!(fs::read_to_string(&place).unwrap(), whole);
        for other in ["[grid]\n", &whole.replace("= 1", "= 2"), "\u{0}"] {
            let said = opened(other, "1").unwrap_err().to_string();
            assert!(said.contains("not the mark"), "{said}");
            assert_eq!(fs::read_to_string(&place).unwrap(), other);
        }
    }
}
