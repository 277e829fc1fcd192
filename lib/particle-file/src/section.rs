//! The arrays of a file.

use std::mem::size_of;
use std::ops::Range;

use bincode::{Decode, Encode};

/// Type of the values of a section.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Encode, Decode)]
pub enum Element {
    /// Voxels of a block, one bit each.
    Bits,
    /// 32-bit float.
    F32,
    /// 64-bit float.
    F64,
    /// 32-bit unsigned integer.
    U32,
    /// 64-bit unsigned integer.
    U64,
    /// 8-bit unsigned integer.
    U8,
    /// Bytes that are not one row per material point.
    Blob,
}

impl Element {
    /// Bytes of one value; for bits, of the word that is the unit of storage.
    pub fn size(self) -> u64 {
        let size = match self {
            Element::U8 | Element::Blob => size_of::<u8>(),
            Element::F32 | Element::U32 => size_of::<u32>(),
            Element::Bits | Element::F64 | Element::U64 => size_of::<u64>(),
        };
        size as u64
    }
}

/// One array of the file: the bits of a block, a column, or a blob.
#[derive(Clone, Debug, PartialEq, Eq, Encode, Decode)]
pub struct Section {
    /// Name, unique in the file; that of the block for bits.
    pub name: String,
    /// Type of the values.
    pub element: Element,
    /// Values per row: 3 for a vector; for bits, words per row of voxels.
    pub components: u32,
    /// Number of rows.
    pub rows: u64,
    /// Position of the first byte in the file, a multiple of 64.
    pub offset: u64,
    /// XXH3-64 of the bytes, without padding.
    pub xxh3: u64,
}

impl Section {
    /// Length in bytes without padding, if it is a number.
    pub(crate) fn bytes(&self) -> Option<u64> {
        self.rows
            .checked_mul(u64::from(self.components))?
            .checked_mul(self.element.size())
    }

    /// Where its bytes are in a file whose sections were found to lie within it.
    pub(crate) fn range(&self) -> Range<usize> {
        let len = self.rows * u64::from(self.components) * self.element.size();
        self.offset as usize..(self.offset + len) as usize
    }
}
