//! The skeleton of a TIFF or BigTIFF file: byte order, chain of directories, tag values.
//!
//! The `tiff` crate decodes pixels (see `decode`), but it hides what tells planes, palettes
//! and inverted greys apart, and reads a directory only together with its interpretation.

use std::collections::{BTreeMap, HashSet};
use std::fs::File;
use std::os::unix::fs::FileExt;

use ::tiff::tags::Tag;

use crate::kind::Kind;
use crate::source::Source;

/// Planes of a directory (SGI's) and, by its count, of a file (MetaMorph's STK).
pub(crate) const IMAGE_DEPTH: Tag = Tag::Unknown(32997);
pub(crate) const UIC2: Tag = Tag::Unknown(33629);

/// An open file with its byte order and flavour.
pub(crate) struct Container<'a> {
    source: &'a Source,
    file: &'a File,
    big_endian: bool,
    big_tiff: bool,
    first: u64,
}

/// A directory: where the values of each tag stand.
pub(crate) struct Directory<'a> {
    tiff: &'a Container<'a>,
    entries: BTreeMap<u16, Entry>,
    /// Bytes that the file's header, the directory and the values of its tags fill.
    pub(crate) bytes: u64,
}

#[derive(Clone, Copy)]
struct Entry {
    kind: u16,
    count: u64,
    /// Where the values begin in the file, be it inside the entry or elsewhere.
    at: u64,
}

impl<'a> Container<'a> {
    pub(crate) fn open(source: &'a Source, file: &'a File) -> Result<Self, String> {
        let head = source.window(0, 16).map_err(|e| e.to_string())?;
        if Kind::of(&head) != Some(Kind::Tiff) {
            return Err("it is not a TIFF file".into());
        }
        let big_endian = head[0] == b'M';
        let mut container = Self {
            source,
            file,
            big_endian,
            big_tiff: head[2].max(head[3]) == 43,
            first: 0,
        };
        let offset = match container.big_tiff {
            true => head.get(8..16),
            false => head.get(4..8),
        };
        container.first = container.uint(offset.ok_or("its header is truncated")?);
        Ok(container)
    }

    /// All directories of the chain in order; an error names the index of the page at fault.
    pub(crate) fn directories(&self) -> Result<Vec<Directory<'_>>, (usize, String)> {
        let mut directories = Vec::new();
        let mut seen = HashSet::new();
        let mut at = self.first;
        while at != 0 {
            let page = directories.len();
            if !seen.insert(at) {
                let what = "its directory was read before: the chain of pages is a loop";
                return Err((page, what.into()));
            }
            let (directory, next) = self.directory(at).map_err(|what| (page, what))?;
            directories.push(directory);
            at = next;
        }
        Ok(directories)
    }

    fn directory(&self, at: u64) -> Result<(Directory<'_>, u64), String> {
        let (count_bytes, entry_bytes, offset_bytes, header) = match self.big_tiff {
            true => (8, 20, 8, 16),
            false => (2, 12, 4, 8),
        };
        let truncated = || {
            format!(
                "its directory at byte {at} reaches beyond the end of the file at byte {}: the file is truncated",
                self.source.len()
            )
        };
        let window = |len| self.source.window(at, len).map_err(|e| e.to_string());
        let count = window(count_bytes)?;
        let count = self.uint(count.get(..count_bytes).ok_or_else(truncated)?);
        let size = (usize::try_from(count).ok())
            .and_then(|n| {
                n.checked_mul(entry_bytes)?
                    .checked_add(count_bytes + offset_bytes)
            })
            .ok_or_else(truncated)?;
        let bytes = window(size)?;
        let list = bytes.get(count_bytes..size).ok_or_else(truncated)?;
        let (list, next) = list.split_at(size - count_bytes - offset_bytes);
        let mut entries = BTreeMap::new();
        let mut filled = header + size as u64;
        for (i, entry) in list.chunks_exact(entry_bytes).enumerate() {
            let (head, value) = entry.split_at(entry_bytes - offset_bytes);
            let kind = self.uint(&head[2..4]) as u16;
            let count = self.uint(&head[4..]);
            let bytes = type_bytes(kind).and_then(|n| count.checked_mul(n));
            let at = if bytes <= Some(offset_bytes as u64) {
                at + (count_bytes + (i + 1) * entry_bytes - offset_bytes) as u64
            } else {
                filled = filled.saturating_add(bytes.unwrap_or(0));
                self.uint(value)
            };
            entries.insert(self.uint(&head[..2]) as u16, Entry { kind, count, at });
        }
        let directory = Directory {
            tiff: self,
            entries,
            bytes: filled,
        };
        Ok((directory, self.uint(next)))
    }

    /// Bytes of a tag's value; the size is checked against the file before it is allocated.
    fn bytes(&self, tag: Tag, entry: Entry) -> Result<Vec<u8>, String> {
        let size = type_bytes(entry.kind)
            .and_then(|n| n.checked_mul(entry.count))
            .ok_or_else(|| format!("tag {} has an unknown type or size", tag.to_u16()))?;
        let end = entry.at.checked_add(size);
        if end.is_none_or(|end| end > self.source.len()) {
            return Err(format!(
                "tag {} lies beyond the end of the file at byte {}: the file is truncated",
                tag.to_u16(),
                self.source.len()
            ));
        }
        let size = usize::try_from(size).map_err(|e| e.to_string())?;
        let mut bytes = vec![0; size];
        self.file
            .read_exact_at(&mut bytes, entry.at)
            .map_err(|e| e.to_string())?;
        Ok(bytes)
    }

    /// An unsigned integer of up to 8 bytes in the file's byte order.
    fn uint(&self, bytes: &[u8]) -> u64 {
        let join = |value: u64, byte: &u8| value << 8 | u64::from(*byte);
        match self.big_endian {
            true => bytes.iter().fold(0, join),
            false => bytes.iter().rev().fold(0, join),
        }
    }
}

impl Directory<'_> {
    pub(crate) fn is_big_endian(&self) -> bool {
        self.tiff.big_endian
    }

    /// A tag's type and the bytes of its values; none if it is absent.
    fn value(&self, tag: Tag) -> Result<Option<(u16, Vec<u8>)>, String> {
        let read = |entry: &Entry| Ok((entry.kind, self.tiff.bytes(tag, *entry)?));
        self.entries.get(&tag.to_u16()).map(read).transpose()
    }

    /// The unsigned integers of a tag; none if it is absent.
    pub(crate) fn uints(&self, tag: Tag) -> Result<Option<Vec<u64>>, String> {
        let Some((kind, bytes)) = self.value(tag)? else {
            return Ok(None);
        };
        let (1 | 3 | 4 | 13 | 16 | 18, Some(size)) = (kind, type_bytes(kind)) else {
            return Err(format!(
                "tag {} does not hold unsigned integers",
                tag.to_u16()
            ));
        };
        let values = bytes.chunks_exact(size as usize);
        Ok(Some(values.map(|b| self.tiff.uint(b)).collect()))
    }

    /// The first unsigned integer of a tag; none if it is absent.
    pub(crate) fn uint(&self, tag: Tag) -> Result<Option<u64>, String> {
        let empty = || format!("tag {} is empty", tag.to_u16());
        let first = |values: Vec<u64>| values.first().copied().ok_or_else(empty);
        self.uints(tag)?.map(first).transpose()
    }

    /// How many values a tag has; none if it is absent.
    pub(crate) fn count(&self, tag: Tag) -> Option<u64> {
        Some(self.entries.get(&tag.to_u16())?.count)
    }

    /// The first rational of a tag; none if it is absent or no number.
    pub(crate) fn rational(&self, tag: Tag) -> Option<f64> {
        let (kind, bytes) = self.value(tag).ok()??;
        let uint = |bytes| self.tiff.uint(bytes) as f64;
        let value = uint(bytes.get(..4)?) / uint(bytes.get(4..8)?);
        (kind == 5 && value.is_finite()).then_some(value)
    }

    /// A tag's text, which is UTF-8 or, from ImageJ, Latin-1; empty if it is absent.
    pub(crate) fn text(&self, tag: Tag) -> Result<String, String> {
        let mut bytes = self.value(tag)?.map_or(Vec::new(), |(_, bytes)| bytes);
        bytes.truncate(bytes.iter().position(|b| *b == 0).unwrap_or(bytes.len()));
        let latin = |bytes: &[u8]| bytes.iter().map(|b| char::from(*b)).collect();
        Ok(String::from_utf8(bytes).unwrap_or_else(|e| latin(e.as_bytes())))
    }
}

/// Bytes of one value of a tag type (TIFF 6.0, p. 15; BigTIFF adds 13, 16 to 18).
fn type_bytes(kind: u16) -> Option<u64> {
    match kind {
        1 | 2 | 6 | 7 => Some(1),
        3 | 8 => Some(2),
        4 | 9 | 11 | 13 => Some(4),
        5 | 10 | 12 | 16 | 17 | 18 => Some(8),
        _ => None,
    }
}
