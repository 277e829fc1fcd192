//! Files written in one pass.

use std::io::{self, Write};

use xxhash_rust::xxh3::Xxh3Default;

use crate::bits::BitsRef;
use crate::header::{Block, Header, MAX_HEADER, Stored};
use crate::layout::{self, ALIGN, PREAMBLE, Preamble};
use crate::read::Value;
use crate::section::{Element, Section};

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
    content: Content<'a>,
}

/// The bytes of an array.
enum Content<'a> {
    /// As they are.
    Whole(&'a [u8]),
    /// One piece after the other, each time anew.
    Pieces(Box<Visit<'a>>),
}

/// Gives the bytes of an array piece by piece.
type Visit<'a> = dyn Fn(&mut dyn FnMut(&[u8])) + 'a;

impl Array<'_> {
    /// Its section with the number of rows and the checksum.
    fn counted(&self) -> Result<Section, String> {
        let (mut hasher, mut length) = (Xxh3Default::new(), 0);
        self.content.visit(&mut |bytes| {
            hasher.update(bytes);
            length += bytes.len() as u64;
        });
        let Section {
            name,
            element,
            components,
            rows,
            ..
        } = &self.section;
        let row = u64::from(*components) * element.size();
        let rows = match self.content {
            Content::Whole(_) => *rows,
            Content::Pieces(_) => length / row.max(1),
        };
        match rows.checked_mul(row) == Some(length) {
            true => Ok(Section {
                rows,
                xxh3: hasher.digest(),
                ..self.section.clone()
            }),
            false => Err(format!(
                "'{name}' does not end with a whole row of {components} values"
            )),
        }
    }
}

impl Content<'_> {
    fn visit(&self, take: &mut dyn FnMut(&[u8])) {
        match self {
            Self::Whole(bytes) => take(bytes),
            Self::Pieces(visit) => visit(take),
        }
    }

    /// Writes all, and tells how many bytes that are.
    fn write_to(&self, out: &mut (impl Write + ?Sized)) -> io::Result<u64> {
        let (mut written, mut length) = (Ok(()), 0);
        self.visit(&mut |bytes| {
            if written.is_ok() {
                written = out.write_all(bytes);
                length += bytes.len() as u64;
            }
        });
        written.map(|()| length)
    }
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
            content: Content::Whole(bytemuck::cast_slice(bits.words())),
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
        let content = Content::Whole(bytemuck::cast_slice(values));
        self.push(name, T::ELEMENT, components, rows, content);
        self
    }

    /// Adds a column like [`Draft::column`], not the first, whose values `visit` gives piece by piece: once to be
    /// counted and once to be written, the same both times.
    pub fn pieces<T: Value>(
        mut self,
        name: &str,
        components: u32,
        visit: impl Fn(&mut dyn FnMut(&[T])) + 'a,
    ) -> Self {
        let content = Content::Pieces(Box::new(move |take| {
            visit(&mut |piece| take(bytemuck::cast_slice(piece)));
        }));
        // Counted when it is written.
        self.push(name, T::ELEMENT, components, 0, content);
        self
    }

    /// Adds bytes of any length.
    pub fn blob(mut self, name: &str, bytes: &'a [u8]) -> Self {
        let content = Content::Whole(bytes);
        self.push(name, Element::Blob, 1, bytes.len() as u64, content);
        self
    }

    fn push(
        &mut self,
        name: &str,
        element: Element,
        components: u32,
        rows: u64,
        content: Content<'a>,
    ) {
        self.columns.push(Array {
            section: Section {
                name: name.into(),
                element,
                components,
                rows,
                offset: 0,
                xxh3: 0,
            },
            content,
        });
    }

    /// Writes the file.
    ///
    /// # Errors
    /// What `out` says, or `InvalidInput` when the header or an array is not one of a
    /// particle file (see FORMAT.md): nothing is written then.
    pub fn write_to<W: Write + ?Sized>(&self, out: &mut W) -> io::Result<()> {
        let arrays: Vec<&Array> = self.bits.iter().chain(&self.columns).collect();
        let invalid = |fault: String| {
            let said = format!("a particle file cannot hold this: {fault}");
            io::Error::new(io::ErrorKind::InvalidInput, said)
        };
        let sections: Result<Vec<Section>, String> =
            arrays.iter().map(|array| array.counted()).collect();
        let (head, file_len) = sections.and_then(|s| self.head(s)).map_err(invalid)?;
        let preamble = Preamble::new(&head, file_len);
        out.write_all(&preamble.to_bytes())?;
        out.write_all(&head)?;
        for array in &arrays {
            let length = array.content.write_to(out)?;
            let padding = length.next_multiple_of(ALIGN) - length;
            out.write_all(&[0; ALIGN as usize][..padding as usize])?;
        }
        out.write_all(&layout::end_marker(preamble.checksum))
    }

    /// The encoded header with its padding, and the length of the whole file.
    fn head(&self, sections: Vec<Section>) -> Result<(Vec<u8>, u64), String> {
        let mut stored = Stored {
            header: self.header.clone(),
            sections,
        };
        let fault = stored.header.fault();
        if let Some(fault) = fault.or_else(|| layout::fault(&stored.header, &stored.sections)) {
            return Err(fault);
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
