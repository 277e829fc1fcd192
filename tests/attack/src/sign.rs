//! Particle files carry checksums, which would stop every change at the door. What is changed
//! is signed again: lengths, checksums and end marker are made right, and nothing else.

use xxhash_rust::xxh3::xxh3_64;

const MAGIC: &[u8; 8] = b"\x89MPTS\r\n\x1a";
const PREAMBLE: usize = 32;
const END: usize = 16;

/// The bytes with sound checksums, as far as the header can be followed (FORMAT.md).
pub(crate) fn signed(bytes: &[u8]) -> Vec<u8> {
    let mut file = bytes.to_vec();
    if file.len() < PREAMBLE + END {
        return file;
    }
    file[..8].copy_from_slice(MAGIC);
    file[8..12].copy_from_slice(&1_u32.to_le_bytes());
    let length = file.len() as u64;
    file[16..24].copy_from_slice(&length.to_le_bytes());
    let header = u32::from_le_bytes([file[12], file[13], file[14], file[15]]) as usize;
    let Some(end) = PREAMBLE
        .checked_add(header)
        .filter(|&e| e <= file.len() - END)
    else {
        return file;
    };
    for (at, hash) in sections(&file, end).unwrap_or_default() {
        file[at..at + 8].copy_from_slice(&hash.to_le_bytes());
    }
    let hash = {
        let mut hasher = xxhash_rust::xxh3::Xxh3Default::new();
        hasher.update(&file[..24]);
        hasher.update(&file[PREAMBLE..end]);
        hasher.digest().to_le_bytes()
    };
    file[24..32].copy_from_slice(&hash);
    let marker = file.len() - END;
    file[marker..marker + 8].copy_from_slice(b"MPTS-END");
    file[marker + 8..].copy_from_slice(&hash);
    file
}

/// Where the checksum of each array stands in the header, and what it should be; `None` where
/// the header cannot be followed to its end.
fn sections(file: &[u8], header_end: usize) -> Option<Vec<(usize, u64)>> {
    let mut at = Header(&file[PREAMBLE..header_end]);
    // Kind, voxel, normal, box, time, step.
    at.skip(4 + 8 + 1 + 48 + 8 + 8)?;
    at.each(|block| {
        block.text()?;
        block.skip(4 + 24 + 24 + 8 + 8)
    })?;
    at.skip(8)?;
    at.each(|attribute| {
        attribute.text()?;
        attribute.text()
    })?;
    at.each(|tool| {
        tool.text()?;
        tool.text()?;
        tool.each(Header::text)?;
        tool.each(|input| {
            input.text()?;
            input.skip(8)
        })
    })?;
    let mut found = Vec::new();
    at.each(|section| {
        section.text()?;
        let size = match section.number(4)? {
            1 | 3 => 4,
            5 | 6 => 1,
            _ => 8,
        };
        let components = section.number(4)?;
        let (rows, offset) = (section.number(8)?, section.number(8)?);
        let length = rows.checked_mul(components)?.checked_mul(size)?;
        if let Some(array) = file.get(offset..offset.checked_add(length)?) {
            found.push((header_end - section.0.len(), xxh3_64(array)));
        }
        section.skip(8)
    })?;
    Some(found)
}

/// What is left of a header of fixed-width little-endian integers.
struct Header<'a>(&'a [u8]);

impl<'a> Header<'a> {
    fn take(&mut self, length: usize) -> Option<&'a [u8]> {
        self.0.split_off(..length)
    }

    fn skip(&mut self, length: usize) -> Option<()> {
        self.take(length).map(|_| ())
    }

    /// A whole number of so many bytes.
    fn number(&mut self, bytes: usize) -> Option<usize> {
        let bytes = self.take(bytes)?.iter().rev();
        let number = bytes.fold(0, |number: u64, &byte| number << 8 | u64::from(byte));
        usize::try_from(number).ok()
    }

    fn text(&mut self) -> Option<()> {
        let length = self.number(8)?;
        self.skip(length)
    }

    fn each(&mut self, mut item: impl FnMut(&mut Self) -> Option<()>) -> Option<()> {
        let count = self.number(8)?;
        // Every item is at least a length: a forged count ends at the end of the header.
        (0..count).try_for_each(|_| item(self))
    }
}
