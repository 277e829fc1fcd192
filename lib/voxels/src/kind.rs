//! The format of a file, told by its first bytes.

/// Bytes from which a format is told.
pub(crate) const HEAD: usize = 512;
/// Lengths of the headers of NIfTI-1 and -2, which are also their first fields.
pub(crate) const NIFTI_HEADERS: [usize; 2] = [348, 540];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Tiff,
    Npy,
    Npz,
    MetaImage,
    Nrrd,
    /// Plain or gzipped; nothing else is read gzipped.
    Nifti,
    Bmp,
    Png,
    Jpeg,
}

impl Kind {
    /// The format of a file that begins with `head`.
    pub(crate) fn of(head: &[u8]) -> Option<Self> {
        let text = String::from_utf8_lossy(head);
        let key = text.split('=').next().unwrap_or_default().trim();
        Some(match head {
            [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..] => Kind::Tiff,
            [0x93, b'N', b'U', b'M', b'P', b'Y', ..] => Kind::Npy,
            [b'P', b'K', 3, 4, ..] => Kind::Npz,
            [b'N', b'R', b'R', b'D', b'0', b'0', b'0', ..] => Kind::Nrrd,
            [b'B', b'M', _, _, _, _, 0, 0, 0, 0, ..] => Kind::Bmp,
            [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n', ..] => Kind::Png,
            [0xff, 0xd8, 0xff, ..] => Kind::Jpeg,
            _ if is_gzip(head) || nifti_version(head).is_some() => Kind::Nifti,
            _ if ["ObjectType", "NDims", "Comment"].contains(&key) => Kind::MetaImage,
            _ => return None,
        })
    }

    pub(crate) fn is_image(self) -> bool {
        matches!(self, Kind::Bmp | Kind::Png | Kind::Jpeg)
    }
}

pub(crate) fn is_gzip(head: &[u8]) -> bool {
    head.starts_with(&[0x1f, 0x8b])
}

/// Which of [`NIFTI_HEADERS`] a file begins with, and whether its numbers are big-endian.
pub(crate) fn nifti_version(head: &[u8]) -> Option<(usize, bool)> {
    let length = *head.first_chunk()?;
    let found = |length: u32| NIFTI_HEADERS.iter().position(|&n| n == length as usize);
    let (version, big_endian) = match found(u32::from_le_bytes(length)) {
        Some(version) => (version, false),
        None => (found(u32::from_be_bytes(length))?, true),
    };
    let magic: &[u8; 4] = head.get([344, 4][version]..)?.first_chunk()?;
    let known = [b"n+1\0", b"ni1\0", b"n+2\0", b"ni2\0"].contains(&magic);
    (known && head.len() >= NIFTI_HEADERS[0]).then_some((version, big_endian))
}
