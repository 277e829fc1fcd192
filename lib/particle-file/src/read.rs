//! Files read: header first, arrays when they are asked for.

use std::io;
use std::path::Path;
use std::sync::OnceLock;

use bytemuck::Pod;

use crate::bits::BitsRef;
use crate::error::Error;
use crate::header::{Block, Header, Stored};
use crate::layout::{self, END_LEN, PREAMBLE, Preamble};
use crate::map::Mapped;
use crate::section::{Element, Section};

/// A type that columns are made of.
pub trait Value: Pod + Send + Sync {
    /// Its name in the file.
    const ELEMENT: Element;
}

macro_rules! values {
    ($($number:ty: $element:ident),*) => {
        $(impl Value for $number {
            const ELEMENT: Element = Element::$element;
        })*
    };
}
values!(f32: F32, f64: F64, u32: U32, u64: U64, u8: U8);

/// An opened particle file: header and layout are checked, arrays are read when asked for
/// and checked against their checksum then. What is absent or damaged is an error.
#[derive(Debug)]
pub struct ParticleFile {
    name: String,
    bytes: Mapped,
    stored: Stored,
    /// Whether each section agrees with its checksum, once somebody wanted to know.
    sound: Vec<OnceLock<bool>>,
}

impl ParticleFile {
    /// Opens the file at `path`; `-` is standard input.
    ///
    /// # Errors
    /// When it cannot be read, is not a particle file, is truncated, or its header is
    /// damaged.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        Self::of_input(path, Mapped::open(path, Self::recognises))
    }

    /// As [`ParticleFile::open`], but nothing that happens to the file later matters: for one
    /// that is needed as long as a run takes.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        Self::of_input(path, Mapped::read(path, Self::recognises))
    }

    fn of_input(path: &Path, bytes: io::Result<Mapped>) -> Result<Self, Error> {
        let name = match path == Path::new("-") {
            true => "standard input".to_owned(),
            false => path.display().to_string(),
        };
        match bytes {
            Ok(bytes) => Self::from_mapped(name, bytes),
            Err(reason) => Err(Error::unreadable(name, &reason)),
        }
    }

    /// Reads a file that lies in memory.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        Self::of_input("bytes in memory".as_ref(), Mapped::copy_of(bytes))
    }

    /// Reads an input that was mapped already, e.g. to see what it is; `name` is for
    /// messages.
    pub fn from_mapped(name: String, bytes: Mapped) -> Result<Self, Error> {
        match read_header(&bytes) {
            Ok(stored) => Ok(Self {
                name,
                bytes,
                sound: stored.sections.iter().map(|_| OnceLock::new()).collect(),
                stored,
            }),
            Err(what) => Err(Error::new(name, what)),
        }
    }

    /// Length of the file, bytes.
    pub fn len_bytes(&self) -> u64 {
        self.bytes.len() as u64
    }

    /// Whether `bytes` begin like a particle file.
    pub fn recognises(bytes: &[u8]) -> bool {
        bytes.starts_with(&layout::MAGIC)
    }

    /// The file as the user named it; "standard input" for `-`.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What the file says about itself.
    pub fn header(&self) -> &Header {
        &self.stored.header
    }

    /// All arrays: the blocks' bits, then columns and blobs.
    pub fn sections(&self) -> &[Section] {
        &self.stored.sections
    }

    /// The columns.
    pub fn columns(&self) -> impl Iterator<Item = &Section> {
        let bulk = |s: &&Section| !matches!(s.element, Element::Bits | Element::Blob);
        self.stored.sections.iter().filter(bulk)
    }

    /// XXH3-64 of the whole file, as provenance records it.
    pub fn content_hash(&self) -> u64 {
        layout::checksum(&self.bytes)
    }

    /// Block `index` and its voxels.
    pub fn block(&self, index: usize) -> Result<(&Block, BitsRef<'_>), Error> {
        let block = (self.header().blocks.get(index))
            .ok_or_else(|| self.missing(format!("block number {index}")))?;
        let words = self.values_of(index)?;
        let dims = layout::usize_dims(block.dims);
        match dims.and_then(|dims| BitsRef::from_words(dims, words)) {
            Some(bits) if bits.count() == block.count => Ok((block, bits)),
            _ => Err(self.corrupt(format!(
                "says that block '{}' has {} voxels, but its bits say otherwise",
                block.name, block.count
            ))),
        }
    }

    /// The block called `name` and its voxels.
    pub fn block_named(&self, name: &str) -> Result<(&Block, BitsRef<'_>), Error> {
        let index = self.header().blocks.iter().position(|b| b.name == name);
        self.block(index.ok_or_else(|| self.missing(format!("block '{name}'")))?)
    }

    /// The values of column `name`, row by row.
    pub fn column<T: Value>(&self, name: &str) -> Result<&[T], Error> {
        let wanted = || format!("column '{name}' of type {:?}", T::ELEMENT);
        self.array(name, T::ELEMENT, wanted)
    }

    /// The vectors of column `name`, which has three components.
    pub fn vectors(&self, name: &str) -> Result<&[[f32; 3]], Error> {
        let fits = |s: &Section| s.name == name && s.components == 3;
        if self.columns().any(fits) {
            Ok(bytemuck::cast_slice(self.column::<f32>(name)?))
        } else {
            Err(self.missing(format!("column '{name}' of vectors")))
        }
    }

    /// Positions (m) and volumes (m3) of the liquid points.
    ///
    /// # Errors
    /// Columns that are absent or damaged, a position or volume that is not finite, or a volume
    /// that is not positive.
    pub fn liquid(&self) -> Result<(&[[f32; 3]], &[f32]), Error> {
        let position = self.vectors("position")?;
        let volume = self.column::<f32>("volume")?;
        let unfit = position
            .iter()
            .zip(volume)
            .position(|(p, &v)| !(p.iter().all(|x| x.is_finite()) && v.is_finite() && v > 0.0));
        match unfit {
            None => Ok((position, volume)),
            Some(i) => Err(self.corrupt(format!(
                "has a material point {i} at {:?} m with a volume of {} m3: finite numbers and a positive volume are needed",
                position[i], volume[i]
            ))),
        }
    }

    /// The bytes of blob `name`.
    pub fn blob(&self, name: &str) -> Result<&[u8], Error> {
        self.array(name, Element::Blob, || format!("blob '{name}'"))
    }

    fn array<T: Pod>(
        &self,
        name: &str,
        element: Element,
        wanted: impl Fn() -> String,
    ) -> Result<&[T], Error> {
        let matches = |s: &Section| s.name == name && s.element == element;
        match self.stored.sections.iter().position(matches) {
            Some(index) => self.values_of(index),
            None => Err(self.missing(wanted())),
        }
    }

    /// The bytes of one of [`ParticleFile::sections`], without padding.
    pub fn bytes_of(&self, section: &Section) -> Result<&[u8], Error> {
        let index = self.stored.sections.iter().position(|s| s == section);
        self.values_of(index.ok_or_else(|| self.missing(format!("array '{}'", section.name)))?)
    }

    pub(crate) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The checked bytes of section `index` as values of its type.
    pub(crate) fn values_of<T: Pod>(&self, index: usize) -> Result<&[T], Error> {
        let section = &self.stored.sections[index];
        let bytes = &self.bytes[section.range()];
        let sound = self.sound[index].get_or_init(|| layout::checksum(bytes) == section.xxh3);
        match bytemuck::try_cast_slice(bytes) {
            Ok(values) if *sound => Ok(values),
            _ => Err(self.corrupt(format!(
                "has a damaged array '{}': its checksum does not agree",
                section.name
            ))),
        }
    }

    pub(crate) fn corrupt(&self, what: String) -> Error {
        Error::new(&self.name, what)
    }

    fn missing(&self, wanted: String) -> Error {
        const NAMED: usize = 20;
        let sections = &self.stored.sections;
        let named = (sections.iter().take(NAMED))
            .map(|s| format!("'{}' ({:?} x {})", s.name, s.element, s.components));
        let more = sections.len().saturating_sub(NAMED);
        let more = (more > 0).then(|| format!("and {more} more"));
        let present = match sections.is_empty() {
            true => "no arrays".into(),
            false => named.chain(more).collect::<Vec<_>>().join(", "),
        };
        self.corrupt(format!("has no {wanted}; it holds {present}"))
    }
}

/// Everything about the file but the arrays' values; the error says what is wrong with it.
fn read_header(file: &[u8]) -> Result<Stored, String> {
    let preamble = Preamble::from_file(file)?;
    let header = (file.get(PREAMBLE..PREAMBLE + preamble.header_len))
        .ok_or("ends within its header; it is truncated or damaged")?;
    if preamble.checksum_with(header) != preamble.checksum {
        return Err("has a damaged header: its checksum does not agree".into());
    }
    let stored = Stored::decode(header).map_err(|what| format!("has a header that {what}"))?;
    (stored.header.check())
        .and_then(|()| layout::check(&stored.header, &stored.sections))
        .map_err(|fault| format!("has an impossible header: {fault}"))?;
    let mut placed = stored.sections.clone();
    let file_len = layout::place(&mut placed, preamble.header_len);
    if file_len != Some(preamble.file_len) || placed != stored.sections {
        return Err("has arrays that do not follow one another".into());
    }
    match file.last_chunk::<END_LEN>() {
        Some(end) if *end == layout::end_marker(preamble.checksum) => Ok(stored),
        _ => Err("does not end with its end marker; it is truncated or damaged".into()),
    }
}

#[cfg(test)]
mod tests;
