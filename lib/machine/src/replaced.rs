//! Files that may be replaced, and what their successors keep of them.

use std::fs::{self, File, Permissions};
use std::io;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;

/// The permissions that a file put in the place of `path` must have; nothing where none is there.
///
/// # Errors
/// A file that is write-protected, which renaming another to its name would pass over, or that this user may not write.
pub fn replaced_permissions(path: &Path) -> io::Result<Option<Permissions>> {
    let found = match fs::metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        found => found?,
    };
    let permissions = found.permissions();
    // The superuser may write it all the same.
    if permissions.readonly() {
        return Err(io::Error::new(
            io::ErrorKind::PermissionDenied,
            "it is write-protected: make it writable or give another name",
        ));
    }
    if found.is_file() {
        File::options().write(true).open(path)?;
    }
    Ok(Some(Permissions::from_mode(permissions.mode() & 0o777)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_write_protected_file_is_not_replaced_and_others_keep_their_mode() {
        let path = std::env::temp_dir().join(format!("replaced-{}", std::process::id()));
        assert!(replaced_permissions(&path).unwrap().is_none());
        fs::write(&path, "x").unwrap();
        for mode in [0o600, 0o640, 0o664] {
            fs::set_permissions(&path, Permissions::from_mode(mode)).unwrap();
            let kept = replaced_permissions(&path).unwrap().unwrap();
            assert_eq!(kept.mode() & 0o777, mode);
        }
        fs::set_permissions(&path, Permissions::from_mode(0o444)).unwrap();
        let said = replaced_permissions(&path).unwrap_err().to_string();
        assert!(said.contains("write-protected"), "{said}");
        fs::remove_file(&path).unwrap();
    }
}
