//! Where forged files lie, and the plan of a forged case.

use std::fs;
use std::path::Path;
use std::sync::OnceLock;

use run::Request;

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

/// A sound bond file.
pub(crate) fn bond() -> &'static [u8] {
    static BOND: OnceLock<Vec<u8>> = OnceLock::new();
    BOND.get_or_init(seeds::bond)
}

/// Reads, resolves and explains a case, as a scene of its own and with a bond.
pub(crate) fn case(bytes: &[u8]) -> bool {
    let (case, bond_file) = (scratch().join("case.toml"), scratch().join("bond.mpts"));
    if fs::write(&case, bytes)
        .and_then(|()| fs::write(&bond_file, bond()))
        .is_err()
    {
        return false;
    }
    let alone = explained(&case, None);
    explained(&case, Some(&bond_file)) || alone
}

/// Asks for the plan of a run; whether there is one.
pub(crate) fn explained(case: &Path, bond: Option<&Path>) -> bool {
    Request::read(case, bond, &[]).is_ok_and(|request| {
        let _ = request.warnings();
        request.explain().is_ok()
    })
}
