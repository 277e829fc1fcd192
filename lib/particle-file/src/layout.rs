//! Where things stand in the file. FORMAT.md is the specification.

use std::collections::HashSet;

use xxhash_rust::xxh3::{Xxh3Default, xxh3_64};

use crate::bits::word_count;
use crate::error::ensure;
use crate::header::{Header, Kind, MAX_HEADER};
use crate::limits;
use crate::section::{Element, Section};

/// First bytes of every particle file; a transfer in text mode damages them.
pub(crate) const MAGIC: [u8; 8] = *b"\x89MPTS\r\n\x1a";
pub(crate) const END: [u8; 8] = *b"MPTS-END";
pub(crate) const VERSION: u32 = 1;
/// Columns start at multiples of this many bytes: a cache line, the widest vector.
pub(crate) const ALIGN: u64 = 64;
pub(crate) const PREAMBLE: usize = 32;
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

/// Whether the sections belong to this header; else why not.
pub(crate) fn check(header: &Header, sections: &[Section]) -> Result<(), String> {
    let (n, most) = (sections.len(), limits::ARRAYS);
    ensure(n <= most, || format!("{n} arrays are more than {most}"))?;
    let attributes = header.attributes.iter().map(|(name, _)| name);
    let mut all = attributes.chain(sections.iter().map(|s| &s.name));
    ensure(all.all(|name| name.len() <= limits::NAME), || {
        format!("a name has more than {} bytes", limits::NAME)
    })?;
    let mut names = HashSet::with_capacity(n);
    for Section { name, .. } in sections {
        let fresh = !name.is_empty() && names.insert(name);
        ensure(fresh, || {
            format!("the name '{name}' is empty or used twice")
        })?;
    }
    let (bits, arrays) = (sections.split_at_checked(header.blocks.len()))
        .ok_or("there are fewer arrays than blocks")?;
    for (block, section) in header.blocks.iter().zip(bits) {
        let fits = section.name == block.name
            && section.element == Element::Bits
            && u64::from(section.components) == block.dims[0].div_ceil(u64::BITS.into())
            && Some(section.rows) == block.dims[1].checked_mul(block.dims[2])
            && usize_dims(block.dims).and_then(word_count).is_some();
        let name = &block.name;
        ensure(fits, || format!("the bits of block '{name}' do not fit it"))?;
    }
    let points = header.particles;
    let mut columns = arrays.iter().filter(|s| s.element != Element::Blob);
    ensure(points == 0 || columns.any(|s| s.rows == points), || {
        format!("no column has a row for each of {points} material points")
    })?;
    for section in arrays {
        let Section {
            name,
            components,
            rows,
            ..
        } = section;
        let rows_fit = match section.element {
            Element::Bits => false,
            Element::Blob => *components == 1,
            _ => *rows == points || header.kind == Kind::Checkpoint,
        };
        ensure(rows_fit && *components > 0, || {
            format!(
                "column '{name}' has {rows} rows of {components} values for {points} material points"
            )
        })?;
    }
    Ok(())
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
            let begun = !file.is_empty() && MAGIC.starts_with(&file[..file.len().min(8)]);
            ensure(begun, not_a_particle_file)?;
            return Err("is truncated within its first 32 bytes".into());
        };
        ensure(bytes[..8] == MAGIC, not_a_particle_file)?;
        let u32_at = |at| u32::from_le_bytes(std::array::from_fn(|i| bytes[at + i]));
        let u64_at = |at| u64::from_le_bytes(std::array::from_fn(|i| bytes[at + i]));
        let version = u32_at(8);
        ensure(version == VERSION, || {
            format!("has version {version}; this tool reads version {VERSION}")
        })?;
        let (header_len, file_len, len) = (u32_at(12) as usize, u64_at(16), file.len());
        ensure(file_len == len as u64, || {
            format!(
                "is {len} bytes long but its header says {file_len}; it is truncated or damaged"
            )
        })?;
        ensure(header_len <= MAX_HEADER, || {
            format!("claims a header of {header_len} bytes; at most {MAX_HEADER} are accepted")
        })?;
        Ok(Self {
            header_len,
            file_len,
            checksum: u64_at(24),
        })
    }
}

fn not_a_particle_file() -> String {
    "is not a particle file; accepted are .mpts files".into()
}

/// The last bytes of a file whose preamble has `checksum`.
pub(crate) fn end_marker(checksum: u64) -> [u8; END_LEN] {
    let mut bytes = [0; END_LEN];
    bytes[..8].copy_from_slice(&END);
    bytes[8..].copy_from_slice(&checksum.to_le_bytes());
    bytes
}

pub(crate) fn checksum(bytes: &[u8]) -> u64 {
    xxh3_64(bytes)
}
