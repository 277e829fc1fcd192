//! The pixels of a volume where its header says that they are: raw, compressed or as text, behind
//! the header, in a file beside it or in many.
//!
//! One raw file is read where it stands. All else is unpacked to an unnamed temporary file.

use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Read, Write};

use bzip2::read::MultiBzDecoder;
use flate2::read::{MultiGzDecoder, ZlibDecoder};
use particle_file::{limits, temporary_file};

use crate::Error;
use crate::raw::RawVolume;
use crate::sample::{PageFormat, Sample};
use crate::source::Source;

/// How numbers are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Coding {
    Raw,
    /// RFC 1950.
    Zlib,
    /// RFC 1952.
    Gzip,
    Bzip2,
    /// Decimal numbers with blanks between them.
    Text,
}

impl Coding {
    /// Most bytes of pixels that are believed of one stored byte.
    fn most(self) -> u64 {
        match self {
            // A file that is too short is told by its own length.
            Coding::Raw => u64::MAX,
            Coding::Zlib | Coding::Gzip => 1032,
            // It packs more, and a stack is not believed more voxels.
            Coding::Bzip2 => limits::VOXELS_PER_BYTE,
            // A digit, and a blank behind it but for the last.
            Coding::Text => 8,
        }
    }

    /// As it stands before `bytes` and `pixels` in messages.
    fn adjective(self) -> &'static str {
        match self {
            Coding::Raw | Coding::Text => "",
            Coding::Zlib | Coding::Gzip | Coding::Bzip2 => "compressed ",
        }
    }
}

pub(crate) fn is_gzip(head: &[u8]) -> bool {
    head.starts_with(&[0x1f, 0x8b])
}

/// What is stored in `source` from byte `offset`.
pub(crate) fn reader(source: &Source, offset: u64, coding: Coding) -> Result<Box<dyn Read>, Error> {
    let stored = source
        .reader_from(offset)
        .map_err(|e| Error::io(source, e))?;
    let stored = BufReader::with_capacity(1 << 20, stored);
    Ok(match coding {
        Coding::Raw | Coding::Text => Box::new(stored),
        Coding::Zlib => Box::new(ZlibDecoder::new(stored)),
        Coding::Gzip => Box::new(MultiGzDecoder::new(stored)),
        Coding::Bzip2 => Box::new(MultiBzDecoder::new(stored)),
    })
}

/// Where in a file its pixels begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Start {
    /// At this byte.
    At(u64),
    /// They end with the file.
    FromEnd,
}

/// Pixels as a header describes them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pixels {
    pub(crate) format: PageFormat,
    pub(crate) pages: usize,
    pub(crate) big_endian: bool,
    pub(crate) coding: Coding,
    /// Where they begin, in each file where there are several.
    pub(crate) start: Start,
    /// Bytes to pass over from there, counted once unpacked.
    pub(crate) skip: u64,
}

impl Pixels {
    /// Opens them in `header` itself, or in the files `beside` it, which hold equal parts.
    ///
    /// # Errors
    /// Files that hold more or fewer than declared, or damaged data; more bytes than half of the
    /// free space for temporary files.
    pub(crate) fn open(mut self, header: Source, beside: Vec<Source>) -> Result<RawVolume, Error> {
        let bytes = self
            .format
            .volume_bytes(self.pages)
            .ok_or_else(|| Error::file(&header, "it declares more voxels than can be counted"))?;
        let files = beside.len().max(1);
        if !self.pages.is_multiple_of(files) {
            let what = format!(
                "its {} pages are in {files} files, which cannot hold as many each",
                self.pages
            );
            return Err(Error::file(&header, what));
        }
        let sources: Vec<Source> = [header].into_iter().chain(beside).collect();
        let parts = &sources[sources.len() - files..];
        let part = bytes / files as u64;
        if let (Coding::Raw, [file]) = (self.coding, parts) {
            let offset = self.begin(file, part)?.saturating_add(self.skip);
            return RawVolume::new(sources, self.format, self.pages, offset, self.big_endian);
        }
        let mut stored: u64 = 0;
        for file in parts {
            stored += file.len().saturating_sub(self.begin(file, part)?);
        }
        if bytes > stored.saturating_mul(self.coding.most()) {
            let what = format!(
                "it declares {bytes} bytes of pixels, but {stored} {}bytes are stored: its size or the file is corrupt",
                self.coding.adjective()
            );
            return Err(Error::file(&parts[0], what));
        }
        let named = |e| Error::io(&parts[0], e);
        let unpacked = temporary_file(bytes).map_err(named)?;
        for file in parts {
            self.unpack(file, part, &unpacked)?;
        }
        if self.coding == Coding::Text {
            self.big_endian = cfg!(target_endian = "big");
        }
        let Self { format, pages, .. } = self;
        RawVolume::unpacked(sources, unpacked, format, pages, 0, self.big_endian)
    }

    /// The byte of `file` at which its `bytes` of raw pixels begin.
    fn begin(&self, file: &Source, bytes: u64) -> Result<u64, Error> {
        match self.start {
            Start::At(at) => Ok(at),
            Start::FromEnd if self.coding == Coding::Raw => {
                file.len().checked_sub(bytes).ok_or_else(|| {
                    let what = format!(
                        "it holds {} bytes, fewer than the {bytes} of its pixels: it is truncated",
                        file.len()
                    );
                    Error::file(file, what)
                })
            }
            Start::FromEnd => Err(Error::file(
                file,
                "its header says that pixels end with the file, which only raw pixels can",
            )),
        }
    }

    /// Appends the `bytes` of pixels that `file` holds to `out`.
    fn unpack(&self, file: &Source, bytes: u64, mut out: &File) -> Result<(), Error> {
        let unreadable = |e: std::io::Error| {
            let what = format!("its {}pixels cannot be read: {e}", self.coding.adjective());
            Error::file(file, what)
        };
        let mut content = reader(file, self.begin(file, bytes)?, self.coding)?;
        let skipped = std::io::copy(&mut content.by_ref().take(self.skip), &mut std::io::sink());
        skipped.map_err(unreadable)?;
        if self.coding == Coding::Text {
            let numbers = bytes / self.format.sample.bytes() as u64;
            let content = BufReader::new(content);
            return from_text(content, self.format.sample, numbers, BufWriter::new(out))
                .map_err(unreadable);
        }
        let found = std::io::copy(&mut content.by_ref().take(bytes), &mut out);
        let found = found.map_err(unreadable)?;
        if found < bytes {
            let what = format!("they end after {found} of {bytes} bytes");
            return Err(unreadable(std::io::Error::other(what)));
        }
        // Checksums stand at the end, which is reached by asking for more.
        match content.read(&mut [0]).map_err(unreadable)? {
            0 => Ok(()),
            _ => Err(Error::file(
                file,
                format!(
                    "it unpacks to more than the {bytes} bytes of pixels that its header declares"
                ),
            )),
        }
    }
}

/// Writes the `count` numbers of a text as samples in native byte order.
fn from_text(
    text: impl BufRead,
    sample: Sample,
    count: u64,
    mut out: impl Write,
) -> std::io::Result<()> {
    /// No number is written longer.
    const LONGEST: usize = 64;
    let wrong = |what: String| Err(std::io::Error::other(what));
    let (mut number, mut found) = (String::new(), 0);
    for byte in text.bytes().chain([Ok(b' ')]) {
        let byte = byte?;
        if !byte.is_ascii_whitespace() && byte != b',' && number.len() < LONGEST {
            number.push(char::from(byte));
            continue;
        }
        if !number.is_empty() {
            found += 1;
            let Some(bytes) = sample.parse(&number) else {
                return wrong(format!(
                    "number {found} of its text is '{number}', which is not {sample}"
                ));
            };
            out.write_all(&bytes)?;
            number.clear();
        }
    }
    match found == count {
        true => out.flush(),
        false => wrong(format!(
            "its text holds {found} numbers, not the {count} that its header declares"
        )),
    }
}
