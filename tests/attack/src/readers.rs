//! Where forged files lie, and the readers of forged cases and stacks.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use run::Request;
use voxels::{Crop, Phases, Stack, VoxelEdge, segment};

use crate::seeds;

/// A folder for the files that the readers read, one for each thread that feeds them.
pub(crate) fn scratch() -> &'static Path {
    thread_local! {
        static FOLDER: &'static Path = {
            let folder = tempfile::tempdir().map(tempfile::TempDir::keep);
            Box::leak(folder.unwrap_or_else(|_| std::env::temp_dir()).into_boxed_path())
        };
    }
    FOLDER.with(|folder| *folder)
}

/// A file of that folder with these bytes.
pub(crate) fn file(name: &str, bytes: &[u8]) -> PathBuf {
    let path = scratch().join(name);
    let written = fs::write(&path, bytes);
    assert!(written.is_ok(), "{}: {written:?}", path.display());
    path
}

/// A sound bond file.
pub(crate) fn bond() -> PathBuf {
    static BOND: OnceLock<Vec<u8>> = OnceLock::new();
    file("bond.mpts", BOND.get_or_init(seeds::bond))
}

/// Reads, resolves and explains a case, as a scene of its own and with a bond.
pub(crate) fn case(bytes: &[u8]) -> bool {
    let case = file("case.toml", bytes);
    let alone = explained(&case, None);
    explained(&case, Some(&bond())) || alone
}

/// Asks for the plan of a run; whether there is one.
pub(crate) fn explained(case: &Path, bond: Option<&Path>) -> bool {
    Request::read(case, bond, &[]).is_ok_and(|request| {
        let _ = request.warnings();
        request.explain().is_ok()
    })
}

/// Opens a stack, reads its voxel size and segments it whole, by labels and by grey values.
pub(crate) fn stack(name: &str, bytes: &[u8]) -> bool {
    // What a MetaImage may point to.
    file("a.raw", &[0, 1, 2, 128, 255].repeat(240));
    let Ok(stack) = Stack::open(&[file(name, bytes)]) else {
        return false;
    };
    // A refusal for want of a voxel size does not keep the user from giving one.
    let _ = VoxelEdge::resolve(None, stack.voxel_size(), stack.name());
    let crop = Crop::whole(stack.dims());
    let grey = "wood=0.5..1.5,adhesive=1.6..".parse().map(Phases::Grey);
    let segmented = |phases: &Phases| segment(&stack, phases, &crop, || {}).is_ok();
    let guessed = segmented(&Phases::Guess);
    grey.is_ok_and(|phases| segmented(&phases)) || guessed
}
