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
    content: Box<Visit<'a>>,
}

/// Gives the bytes of an array piece by piece, the same each time.
type Visit<'a> = dyn Fn(&mut dyn FnMut(&[u8])) + 'a;

impl Array<'_> {
    /// Its section with the number of rows and the checksum.
    fn counted(&self) -> Result<Section, String> {
        let (mut hasher, mut length) = (Xxh3Default::new(), 0);
        (self.content)(&mut |bytes| {
            hasher.update(bytes);
            length += bytes.len() as u64;
        });
        let mut section = self.section.clone();
        let row = u64::from(section.components) * section.element.size();
        section.rows = length / row.max(1);
        section.xxh3 = hasher.digest();
        match section.rows * row == length {
            true => Ok(section),
            false => Err(format!(
                "'{}' does not end with a whole row of {} values",
                section.name, section.components
            )),
        }
    }

    /// Writes all bytes and the padding behind them.
    fn write_to(&self, out: &mut (impl Write + ?Sized)) -> io::Result<()> {
        let (mut written, mut length) = (Ok(()), 0);
        (self.content)(&mut |bytes| {
            if written.is_ok() {
                written = out.write_all(bytes);
                length += bytes.len() as u64;
            }
        });
        written?;
        let padding = length.next_multiple_of(ALIGN) - length;
        out.write_all(&[0; ALIGN as usize][..padding as usize])
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
        let words = u32::try_from(dims[0].div_ceil(u64::BITS as usize)).unwrap_or(u32::MAX);
        let content = move |take: &mut dyn FnMut(&[u8])| take(bytemuck::cast_slice(bits.words()));
        let array = array(&block.name, Element::Bits, words, content);
        self.bits.push(array);
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
        if name == "position" || self.columns.is_empty() {
            self.header.particles = values.len() as u64 / u64::from(components.max(1));
        }
        self.pieces(name, components, move |take| take(values))
    }

    /// Adds a column like [`Draft::column`], not the first, whose values `visit` gives piece by piece: once to be
    /// counted and once to be written, the same both times.
    pub fn pieces<T: Value>(
        mut self,
        name: &str,
        components: u32,
        visit: impl Fn(&mut dyn FnMut(&[T])) + 'a,
    ) -> Self {
        let content = move |take: &mut dyn FnMut(&[u8])| {
            visit(&mut |piece| take(bytemuck::cast_slice(piece)));
        };
        let array = array(name, T::ELEMENT, components, content);
        self.columns.push(array);
        self
    }

    /// Adds bytes of any length.
    pub fn blob(mut self, name: &str, bytes: &'a [u8]) -> Self {
        let content = move |take: &mut dyn FnMut(&[u8])| take(bytes);
        self.columns.push(array(name, Element::Blob, 1, content));
        self
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
            array.write_to(out)?;
        }
        out.write_all(&layout::end_marker(preamble.checksum))
    }

    /// The encoded header with its padding, and the length of the whole file.
    fn head(&self, sections: Vec<Section>) -> Result<(Vec<u8>, u64), String> {
        let mut stored = Stored {
            header: self.header.clone(),
            sections,
        };
        stored.header.check()?;
        layout::check(&stored.header, &stored.sections)?;
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

/// An array whose rows are counted when it is written.
fn array<'a>(
    name: &str,
    element: Element,
    components: u32,
    content: impl Fn(&mut dyn FnMut(&[u8])) + 'a,
) -> Array<'a> {
    Array {
        section: Section {
            name: name.into(),
            element,
            components,
            rows: 0,
            offset: 0,
            xxh3: 0,
        },
        content: Box::new(content),
    }
}
