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
    let mut at = Walk {
        bytes: &file[..header_end],
        at: PREAMBLE,
    };
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
        tool.each(Walk::text)?;
        tool.each(|input| {
            input.text()?;
            input.skip(8)
        })
    })?;
    let mut found = Vec::new();
    at.each(|section| {
        section.text()?;
        let size = match section.u32()? {
            1 | 3 => 4,
            5 | 6 => 1,
            _ => 8,
        };
        let components = u64::from(section.u32()?);
        let (rows, offset) = (section.u64()?, section.u64()?);
        let length = rows.checked_mul(components)?.checked_mul(size)?;
        let range =
            usize::try_from(offset).ok()?..usize::try_from(offset.checked_add(length)?).ok()?;
        if let Some(array) = file.get(range) {
            found.push((section.at, xxh3_64(array)));
        }
        section.skip(8)
    })?;
    Some(found)
}

/// Goes through a header of fixed-width little-endian integers.
struct Walk<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Walk<'_> {
    fn skip(&mut self, length: usize) -> Option<()> {
        self.at = self
            .at
            .checked_add(length)
            .filter(|&at| at <= self.bytes.len())?;
        Some(())
    }

    fn u32(&mut self) -> Option<u32> {
        let from = self.at;
        self.skip(4)?;
        self.bytes[from..self.at]
            .try_into()
            .ok()
            .map(u32::from_le_bytes)
    }

    fn u64(&mut self) -> Option<u64> {
        let from = self.at;
        self.skip(8)?;
        self.bytes[from..self.at]
            .try_into()
            .ok()
            .map(u64::from_le_bytes)
    }

    fn text(&mut self) -> Option<()> {
        let length = usize::try_from(self.u64()?).ok()?;
        self.skip(length)
    }

    fn each(&mut self, mut item: impl FnMut(&mut Self) -> Option<()>) -> Option<()> {
        let count = self.u64()?;
        // Every item is at least a length: a forged count ends at the end of the header.
        (0..count).try_for_each(|_| item(self))
    }
}
