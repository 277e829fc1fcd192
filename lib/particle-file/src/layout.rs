//! Where things stand in the file. FORMAT.md is the specification.

use std::collections::HashSet;

use xxhash_rust::xxh3::{Xxh3Default, xxh3_64};

use crate::bits::word_count;
use crate::header::{Header, Kind, MAX_HEADER};
use crate::limits;
use crate::section::{Element, Section};

/// First bytes of every particle file; a transfer in text mode damages them.
pub(crate) const MAGIC: [u8; 8] = *b"\x89MPTS\r\n\x1a";
/// First bytes of the end marker.
pub(crate) const END: [u8; 8] = *b"MPTS-END";
/// Version of the format.
pub(crate) const VERSION: u32 = 1;
/// Columns start at multiples of this many bytes: a cache line, the widest vector.
pub(crate) const ALIGN: u64 = 64;
/// Bytes before the header.
pub(crate) const PREAMBLE: usize = 32;
/// Bytes of the end marker.
pub(crate) const END_LEN: usize = 16;

/// Puts the sections one behind the other after a header of `header_len` bytes (with its
/// padding) and gives the length of the file, or `None` on overflow.
pub(crate) fn place(sections: &mut [Section], header_len: usize) -> Option<u64> {
    let mut end = (PREAMBLE as u64).checked_add(header_len as u64)?;
    for section in sections {
        section.offset = end;
        end = end
            .checked_add(section.bytes()?)?
            .checked_next_multiple_of(ALIGN)?;
    }
    end.checked_add(END_LEN as u64)
}

/// Length of a header with the padding that aligns the first section.
pub(crate) fn padded_header(len: usize) -> usize {
    (PREAMBLE + len).next_multiple_of(ALIGN as usize) - PREAMBLE
}

/// Why the sections do not belong to this header, if so.
pub(crate) fn fault(header: &Header, sections: &[Section]) -> Option<String> {
    if sections.len() > limits::ARRAYS {
        let (n, most) = (sections.len(), limits::ARRAYS);
        return Some(format!("{n} arrays are more than {most}"));
    }
    let attributes = header.attributes.iter().map(|(name, _)| name);
    if attributes
        .chain(sections.iter().map(|s| &s.name))
        .any(|name| name.len() > limits::NAME)
    {
        return Some(format!("a name has more than {} bytes", limits::NAME));
    }
    let mut names = HashSet::with_capacity(sections.len());
    for section in sections {
        if section.name.is_empty() || !names.insert(&section.name) {
            return Some(format!(
                "the name '{}' is empty or used twice",
                section.name
            ));
        }
    }
    let (bits, arrays) = match sections.split_at_checked(header.blocks.len()) {
        Some(split) => split,
        None => return Some("there are fewer arrays than blocks".into()),
    };
    for (block, section) in header.blocks.iter().zip(bits) {
        let words = usize_dims(block.dims).and_then(word_count);
        let rows = block.dims[1].checked_mul(block.dims[2]);
        let fits = section.name == block.name
            && section.element == Element::Bits
            && u64::from(section.components) == block.dims[0].div_ceil(u64::BITS.into())
            && Some(section.rows) == rows
            && words.is_some();
        if !fits {
            return Some(format!("the bits of block '{}' do not fit it", block.name));
        }
    }
    let is_column = |s: &&Section| s.element != Element::Blob;
    let mut columns = arrays.iter().filter(is_column);
    if header.particles > 0 && !columns.any(|s| s.rows == header.particles) {
        return Some(format!(
            "no column has a row for each of {} material points",
            header.particles
        ));
    }
    for section in arrays {
        let rows_fit = match section.element {
            Element::Bits => false,
            Element::Blob => section.components == 1,
            _ => section.rows == header.particles || header.kind == Kind::Checkpoint,
        };
        if !rows_fit || section.components == 0 {
            return Some(format!(
                "column '{}' has {} rows of {} values for {} material points",
                section.name, section.rows, section.components, header.particles
            ));
        }
    }
    None
}

/// Dimensions as indices of this machine, if they are.
pub(crate) fn usize_dims(dims: [u64; 3]) -> Option<[usize; 3]> {
    let [x, y, z] = dims.map(|n| usize::try_from(n).ok());
    Some([x?, y?, z?])
}

/// The bytes before the header, which stand for the whole of it by their checksum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Preamble {
    pub(crate) header_len: usize,
    pub(crate) file_len: u64,
    pub(crate) checksum: u64,
}

impl Preamble {
    pub(crate) fn new(header: &[u8], file_len: u64) -> Self {
        let mut preamble = Self {
            header_len: header.len(),
            file_len,
            checksum: 0,
        };
        preamble.checksum = preamble.checksum_with(header);
        preamble
    }

    /// XXH3-64 of the preamble before the checksum, then the header with its padding.
    pub(crate) fn checksum_with(&self, header: &[u8]) -> u64 {
        let mut hasher = Xxh3Default::new();
        hasher.update(&self.to_bytes()[..24]);
        hasher.update(header);
        hasher.digest()
    }

    pub(crate) fn to_bytes(self) -> [u8; PREAMBLE] {
        let mut bytes = [0; PREAMBLE];
        bytes[..8].copy_from_slice(&MAGIC);
        bytes[8..12].copy_from_slice(&VERSION.to_le_bytes());
        bytes[12..16].copy_from_slice(&(self.header_len as u32).to_le_bytes());
        bytes[16..24].copy_from_slice(&self.file_len.to_le_bytes());
        bytes[24..].copy_from_slice(&self.checksum.to_le_bytes());
        bytes
    }

    /// Reads the preamble of a file; the error says what is wrong with the file.
    pub(crate) fn from_file(file: &[u8]) -> Result<Self, String> {
        let Some((bytes, _)) = file.split_first_chunk::<PREAMBLE>() else {
            return Err(
                if MAGIC.starts_with(&file[..file.len().min(8)]) && !file.is_empty() {
                    "is truncated within its first 32 bytes".into()
                } else {
                    "is not a particle file; accepted are .mpts files".into()
                },
            );
        };
        if bytes[..8] != MAGIC {
            return Err("is not a particle file; accepted are .mpts files".into());
        }
        let u32_at = |at| u32::from_le_bytes(std::array::from_fn(|i| bytes[at + i]));
        let u64_at = |at| u64::from_le_bytes(std::array::from_fn(|i| bytes[at + i]));
        if u32_at(8) != VERSION {
            return Err(format!(
                "has version {}; this tool reads version {VERSION}",
                u32_at(8)
            ));
        }
        let preamble = Self {
            header_len: u32_at(12) as usize,
            file_len: u64_at(16),
            checksum: u64_at(24),
        };
        if preamble.file_len != file.len() as u64 {
            return Err(format!(
                "is {} bytes long but its header says {}; it is truncated or damaged",
                file.len(),
                preamble.file_len
            ));
        }
        if preamble.header_len > MAX_HEADER {
            return Err(format!(
                "claims a header of {} bytes; at most {MAX_HEADER} are accepted",
                preamble.header_len
            ));
        }
        Ok(preamble)
    }
}

/// The last bytes of a file whose preamble has `checksum`.
pub(crate) fn end_marker(checksum: u64) -> [u8; END_LEN] {
    let mut bytes = [0; END_LEN];
    bytes[..8].copy_from_slice(&END);
    bytes[8..].copy_from_slice(&checksum.to_le_bytes());
    bytes
}

/// The checksum of a section.
pub(crate) fn checksum(bytes: &[u8]) -> u64 {
    xxh3_64(bytes)
}
