//! Pipes as temporary files.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

/// Bytes from which a format is told.
const HEAD: usize = 512;

/// Copies a pipe to an unnamed temporary file, to be read in any order.
///
/// Of a pipe whose first bytes are not `recognised` only these are taken, so that a reader
/// refuses it for what it is and a device without an end fills no disk. A pipe may take half of
/// what is free in the folder of temporary files.
///
/// # Errors
/// The system's reason, or a pipe that gives more.
pub fn spool(mut pipe: impl Read, recognised: impl Fn(&[u8]) -> bool) -> io::Result<File> {
    let mut file = unnamed_file()?;
    let mut head = Vec::with_capacity(HEAD);
    pipe.by_ref().take(HEAD as u64).read_to_end(&mut head)?;
    file.write_all(&head)?;
    if recognised(&head) {
        let most = most(&file)?;
        copy(pipe, &mut file, most)?;
    }
    file.seek(SeekFrom::Start(0))?;
    Ok(file)
}

/// Copies what `content` gives to `file`, `bytes` and no more, and goes back to its start.
///
/// # Errors
/// The system's reason, or content that ends before.
pub fn fill(file: &mut File, content: impl Read, bytes: u64) -> io::Result<()> {
    let found = io::copy(&mut content.take(bytes), file)?;
    if found < bytes {
        let what = format!("it ends after {found} of {bytes} bytes");
        return Err(io::Error::other(what));
    }
    file.seek(SeekFrom::Start(0)).map(|_| ())
}

/// An unnamed temporary file that will hold `bytes`.
///
/// # Errors
/// The system's reason, or more bytes than half of what is free in the folder of temporary files.
pub fn temporary_file(bytes: u64) -> io::Result<File> {
    let file = unnamed_file()?;
    refuse_above(most(&file)?, bytes).map(|()| file)
}

fn unnamed_file() -> io::Result<File> {
    tempfile::tempfile().map_err(|e| {
        let folder = std::env::temp_dir();
        let what = format!(
            "no temporary file can be made in '{}' ({e}): set TMPDIR to a folder that can be written",
            folder.display()
        );
        io::Error::new(e.kind(), what)
    })
}

/// Half of what is free where `file` is, bytes.
fn most(file: &File) -> io::Result<u64> {
    let free = rustix::fs::fstatvfs(file)?;
    Ok(free.f_bavail.saturating_mul(free.f_frsize) / 2)
}

/// Copies all of `pipe` unless it is more than `most` bytes.
fn copy(pipe: impl Read, file: &mut File, most: u64) -> io::Result<()> {
    let bytes = io::copy(&mut pipe.take(most.saturating_add(1)), file)?;
    refuse_above(most, bytes)
}

fn refuse_above(most: u64, bytes: u64) -> io::Result<()> {
    if bytes <= most {
        return Ok(());
    }
    Err(io::Error::other(format!(
        "it gives more than {:.1} GB, half of what is free in '{}' for temporary files: \
         write it to a file and give its name, or set TMPDIR to a larger disk",
        most as f64 / 1e9,
        std::env::temp_dir().display()
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn content(mut file: File) -> Vec<u8> {
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).unwrap();
        bytes
    }

    #[test]
    fn a_pipe_without_an_end_is_cut_or_refused() {
        assert_eq!(content(spool(io::repeat(0), |_| false).unwrap()), [0; HEAD]);
        let mut file = tempfile::tempfile().unwrap();
        let said = copy(io::repeat(1), &mut file, 1 << 20).unwrap_err();
        assert!(said.to_string().contains("TMPDIR"), "{said}");
        let pipe = [vec![7; 600], vec![8; 3]].concat();
        let whole = spool(pipe.as_slice(), |head| head == [7; HEAD]).unwrap();
        assert_eq!(content(whole), pipe);
        assert_eq!(content(spool([9].as_slice(), |_| true).unwrap()), [9]);
        let mut file = temporary_file(2).unwrap();
        fill(&mut file, io::repeat(3), 2).unwrap();
        assert_eq!(content(file), [3, 3]);
        let said = fill(&mut temporary_file(2).unwrap(), [9].as_slice(), 2).unwrap_err();
        assert!(said.to_string().contains("1 of 2 bytes"), "{said}");
        assert!(temporary_file(u64::MAX).is_err());
    }
}
