//! Files written in one pass.

use std::io::{self, Write};

use rayon::prelude::*;

use crate::bits::BitsRef;
use crate::header::{Block, Header, MAX_HEADER, Stored};
use crate::layout::{self, ALIGN, Element, PREAMBLE, Preamble, Section};
use crate::read::Value;

/// A particle file to be written: a header and borrowed arrays.
///
/// Written in one pass, without seeking, so that a pipe will do.
pub struct Draft<'a> {
    header: Header,
    bits: Vec<Array<'a>>,
    columns: Vec<Array<'a>>,
}

struct Array<'a> {
    section: Section,
    bytes: &'a [u8],
}

impl<'a> Draft<'a> {
    /// A draft with `header`, whose list of blocks and number of particles are replaced by
    /// what is added.
    pub fn new(header: Header) -> Self {
        let header = Header {
            blocks: Vec::new(),
            particles: 0,
            ..header
        };
        Self {
            header,
            bits: Vec::new(),
            columns: Vec::new(),
        }
    }

    /// Adds a block; its dimensions and count are taken from `bits`.
    pub fn block(mut self, block: Block, bits: impl Into<BitsRef<'a>>) -> Self {
        let bits = bits.into();
        let dims = bits.dims();
        self.bits.push(Array {
            section: Section {
                name: block.name.clone(),
                element: Element::Bits,
                components: u32::try_from(dims[0].div_ceil(u64::BITS as usize)).unwrap_or(u32::MAX),
                rows: dims[1] as u64 * dims[2] as u64,
                offset: 0,
                xxh3: 0,
            },
            bytes: bytemuck::cast_slice(bits.words()),
        });
        self.header.blocks.push(Block {
            dims: dims.map(|n| n as u64),
            count: bits.count(),
            ..block
        });
        self
    }

    /// Adds a column of `components` values per row, rows one behind the other.
    ///
    /// In a specimen, bond or state all columns have one row per liquid material point; in a
    /// checkpoint each has its own length.
    pub fn column<T: Value>(mut self, name: &str, components: u32, values: &'a [T]) -> Self {
        let rows = values.len() as u64 / u64::from(components.max(1));
        if name == "position" || self.columns.is_empty() {
            self.header.particles = rows;
        }
        self.push(
            name,
            T::ELEMENT,
            components,
            rows,
            bytemuck::cast_slice(values),
        );
        self
    }

    /// Adds bytes of any length.
    pub fn blob(mut self, name: &str, bytes: &'a [u8]) -> Self {
        self.push(name, Element::Blob, 1, bytes.len() as u64, bytes);
        self
    }

    fn push(&mut self, name: &str, element: Element, components: u32, rows: u64, bytes: &'a [u8]) {
        self.columns.push(Array {
            section: Section {
                name: name.into(),
                element,
                components,
                rows,
                offset: 0,
                xxh3: 0,
            },
            bytes,
        });
    }

    /// Writes the file.
    ///
    /// # Errors
    /// What `out` says, or `InvalidInput` when the header or an array is not one of a
    /// particle file (see FORMAT.md): nothing is written then.
    pub fn write_to<W: Write + ?Sized>(&self, out: &mut W) -> io::Result<()> {
        let arrays: Vec<&Array> = self.bits.iter().chain(&self.columns).collect();
        let (head, file_len) = self.head(&arrays).map_err(|fault| {
            io::Error::new(
                io::ErrorKind::InvalidInput,
                format!("a particle file cannot hold this: {fault}"),
            )
        })?;
        let preamble = Preamble::new(&head, file_len);
        out.write_all(&preamble.to_bytes())?;
        out.write_all(&head)?;
        for array in &arrays {
            out.write_all(array.bytes)?;
            let padding = array.bytes.len().next_multiple_of(ALIGN as usize) - array.bytes.len();
            out.write_all(&[0; ALIGN as usize][..padding])?;
        }
        out.write_all(&layout::end_marker(preamble.checksum))
    }

    /// The encoded header with its padding, and the length of the whole file.
    fn head(&self, arrays: &[&Array]) -> Result<(Vec<u8>, u64), String> {
        let sections: Vec<Section> = arrays
            .par_iter()
            .map(|array| Section {
                xxh3: layout::checksum(array.bytes),
                ..array.section.clone()
            })
            .collect();
        let mut stored = Stored {
            header: self.header.clone(),
            sections,
        };
        let fault = stored.header.fault();
        if let Some(fault) = fault.or_else(|| layout::fault(&stored.header, &stored.sections)) {
            return Err(fault);
        }
        for array in arrays {
            if array.section.bytes() != Some(array.bytes.len() as u64) {
                let (name, n) = (&array.section.name, array.section.components);
                return Err(format!(
                    "'{name}' does not end with a whole row of {n} values"
                ));
            }
        }
        // All integers have a fixed width: the length does not depend on the offsets.
        let header_len = layout::padded_header(stored.encode()?.len());
        if header_len > MAX_HEADER - PREAMBLE {
            return Err(format!("its header has {header_len} bytes"));
        }
        let file_len = layout::place(&mut stored.sections, header_len)
            .ok_or("it is longer than a file can be")?;
        let mut head = stored.encode()?;
        head.resize(header_len, 0);
        Ok((head, file_len))
    }
}
