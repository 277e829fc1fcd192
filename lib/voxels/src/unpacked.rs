//! Volumes that stand compressed in their files, unpacked to unnamed temporary files.

use std::fs::File;
use std::io::{BufReader, Read};

use flate2::read::{MultiGzDecoder, ZlibDecoder};
use particle_file::spool_exactly;

use crate::Error;
use crate::source::Source;

/// How bytes are compressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Packing {
    /// RFC 1950, as of MetaImage.
    Zlib,
    /// RFC 1952, as of NRRD and NIfTI.
    Gzip,
}

/// Most bytes that deflate makes of one.
const DEFLATE: u64 = 1032;

pub(crate) fn is_gzip(head: &[u8]) -> bool {
    head.starts_with(&[0x1f, 0x8b])
}

/// What is packed in `source` from byte `offset`.
pub(crate) fn reader(
    source: &Source,
    offset: u64,
    packing: Packing,
) -> Result<Box<dyn Read>, Error> {
    let stored = source
        .reader_from(offset)
        .map_err(|e| Error::io(source, e))?;
    let stored = BufReader::with_capacity(1 << 20, stored);
    Ok(match packing {
        Packing::Zlib => Box::new(ZlibDecoder::new(stored)),
        Packing::Gzip => Box::new(MultiGzDecoder::new(stored)),
    })
}

/// The first `bytes` that are packed in `source` from byte `offset`.
///
/// # Errors
/// More than the stored bytes can make, more than half of the free space for temporary files,
/// fewer or more bytes than that, damaged data.
pub(crate) fn unpack(
    source: &Source,
    offset: u64,
    packing: Packing,
    bytes: u64,
) -> Result<File, Error> {
    let stored = source.len().saturating_sub(offset);
    if bytes > stored.saturating_mul(DEFLATE) {
        let what = format!(
            "it declares {bytes} bytes of pixels, but {stored} compressed bytes are stored: its size or the file is corrupt"
        );
        return Err(Error::file(source, what));
    }
    let unreadable = |e| Error::file(source, format!("its compressed pixels cannot be read: {e}"));
    let mut content = reader(source, offset, packing)?;
    let file = spool_exactly(&mut content, bytes).map_err(unreadable)?;
    // Checksums stand at the end, which is reached by asking for more.
    match content.read(&mut [0]).map_err(unreadable)? {
        0 => Ok(file),
        _ => Err(Error::file(
            source,
            format!("it unpacks to more than the {bytes} bytes of pixels that its header declares"),
        )),
    }
}
