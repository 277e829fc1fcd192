//! The pixels of a volume where its header says that they are: raw, compressed or as text, behind
//! the header, in a file beside it or in many.
//!
//! One raw file is read where it stands. All else is unpacked to an unnamed temporary file.

use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use bzip2::read::MultiBzDecoder;
use flate2::read::{MultiGzDecoder, ZlibDecoder};
use particle_file::{limits, temporary_file};

use crate::Error;
use crate::error::damaged;
use crate::raw::Raw;
use crate::sample::Sample;
use crate::source::Source;
use crate::volume::Volume;
use crate::voxel_size::VoxelSize;

/// A header with pixels behind it is no longer than this; it may name thousands of files.
pub(crate) const MAX_HEADER: usize = 1 << 20;

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

/// What is stored in `source` from byte `offset`.
pub(crate) fn reader(source: &Source, offset: u64, coding: Coding) -> io::Result<Box<dyn Read>> {
    let stored = BufReader::with_capacity(1 << 20, source.reader_from(offset)?);
    Ok(match coding {
        Coding::Raw | Coding::Text => Box::new(stored),
        Coding::Zlib => Box::new(ZlibDecoder::new(stored)),
        Coding::Gzip => Box::new(MultiGzDecoder::new(stored)),
        Coding::Bzip2 => Box::new(MultiBzDecoder::new(stored)),
    })
}

/// Pixels as a header describes them.
#[derive(Debug)]
pub(crate) struct Described {
    /// Where they begin, in each file where there are several.
    pub(crate) raw: Raw,
    /// They end with their file instead.
    pub(crate) at_end: bool,
    pub(crate) coding: Coding,
    /// Bytes to pass over before them, counted once unpacked.
    pub(crate) skip: u64,
    /// Files of equal parts; none where they are in the header's own.
    pub(crate) files: Vec<PathBuf>,
    pub(crate) voxel_size: Option<VoxelSize>,
}

/// Opens the volume that the header in `source` describes, by the `parse` of its format from its
/// bytes and the path that files beside it are relative to.
pub(crate) fn open(
    source: Source,
    parse: impl Fn(&[u8], &Path) -> Result<Described, String>,
) -> Result<Volume, Error> {
    let head = source.window(0, MAX_HEADER);
    let head = head.map_err(|e| Error::io(&source, e))?;
    let described = parse(&head, source.path()).map_err(|what| Error::file(&source, what))?;
    described.open(source)
}

impl Described {
    /// Opens them in `header` itself or in the files beside it, as [`open`] does.
    pub(crate) fn open(mut self, header: Source) -> Result<Volume, Error> {
        let (pages, parts) = (self.raw.pages, self.files.len().max(1));
        let wrong = |file: &Source, what: String| Err(Error::file(file, what));
        let Some(bytes) = self.raw.format.volume_bytes(pages) else {
            return wrong(
                &header,
                "it declares more voxels than can be counted".into(),
            );
        };
        let mut sources = vec![header];
        for file in &self.files {
            sources.push(Source::open_slice(file)?);
        }
        if !pages.is_multiple_of(parts) {
            let what =
                format!("its {pages} pages are in {parts} files, which cannot hold as many each");
            return wrong(&sources[0], what);
        }
        let files = &sources[sources.len() - parts..];
        let part = bytes / parts as u64;
        let voxel_size = self.voxel_size.take();
        let unpacked = if let (Coding::Raw, [file]) = (self.coding, files) {
            self.raw.offset = self.begin(file, part)?.saturating_add(self.skip);
            None
        } else {
            let mut stored: u64 = 0;
            for file in files {
                stored += file.len().saturating_sub(self.begin(file, part)?);
            }
            if bytes > stored.saturating_mul(self.coding.most()) {
                let what = format!(
                    "it declares {bytes} bytes of pixels, but {stored} {}bytes are stored: its size or the file is corrupt",
                    self.coding.adjective()
                );
                return wrong(&files[0], what);
            }
            let unpacked = temporary_file(bytes).map_err(|e| Error::io(&files[0], e))?;
            for file in files {
                self.unpack(file, part, &unpacked)?;
            }
            self.raw.offset = 0;
            self.raw.big_endian = match self.coding {
                Coding::Text => cfg!(target_endian = "big"),
                _ => self.raw.big_endian,
            };
            Some(files[parts - 1].with_content(unpacked)?)
        };
        let volume = self.raw.volume(sources, unpacked)?;
        Ok(Volume {
            voxel_size,
            ..volume
        })
    }

    /// The byte of `file` at which its `bytes` of raw pixels begin.
    fn begin(&self, file: &Source, bytes: u64) -> Result<u64, Error> {
        if !self.at_end {
            return Ok(self.raw.offset);
        }
        let what = match (self.coding, file.len().checked_sub(bytes)) {
            (Coding::Raw, Some(at)) => return Ok(at),
            (Coding::Raw, None) => format!(
                "it holds {} bytes, fewer than the {bytes} of its pixels: it is truncated",
                file.len()
            ),
            _ => "its header says that pixels end with the file, which only raw pixels can".into(),
        };
        Err(Error::file(file, what))
    }

    /// Appends the `bytes` of pixels that `file` holds to `out`.
    fn unpack(&self, file: &Source, bytes: u64, mut out: &File) -> Result<(), Error> {
        let unreadable = |e: io::Error| {
            let what = match self.coding {
                Coding::Raw | Coding::Text => format!("its pixels cannot be read: {e}"),
                _ => format!("its compressed pixels cannot be read: {}", damaged(e)),
            };
            Error::file(file, what)
        };
        let content = reader(file, self.begin(file, bytes)?, self.coding);
        let mut content = content.map_err(|e| Error::io(file, e))?;
        let skipped = io::copy(&mut content.by_ref().take(self.skip), &mut io::sink());
        skipped.map_err(unreadable)?;
        if self.coding == Coding::Text {
            let sample = self.raw.format.sample;
            let numbers = bytes / sample.bytes() as u64;
            let read = from_text(
                BufReader::new(content),
                sample,
                numbers,
                BufWriter::new(out),
            );
            return read.map_err(unreadable);
        }
        let found = io::copy(&mut content.by_ref().take(bytes), &mut out).map_err(unreadable)?;
        if found < bytes {
            let what = format!("they end after {found} of {bytes} bytes");
            return Err(unreadable(io::Error::other(what)));
        }
        // Checksums stand at the end, which is reached by asking for more.
        match content.read(&mut [0]).map_err(unreadable)? {
            0 => Ok(()),
            _ => {
                let what = format!(
                    "it unpacks to more than the {bytes} bytes of pixels that its header declares"
                );
                Err(Error::file(file, what))
            }
        }
    }
}

/// Writes the `count` numbers of a text as samples in native byte order.
fn from_text(
    text: impl BufRead,
    sample: Sample,
    count: u64,
    mut out: impl Write,
) -> io::Result<()> {
    /// No number is written longer.
    const LONGEST: usize = 64;
    let (mut number, mut found) = (String::new(), 0);
    for byte in text.bytes().chain([Ok(b' ')]) {
        let byte = byte?;
        if !byte.is_ascii_whitespace() && byte != b',' && number.len() < LONGEST {
            number.push(char::from(byte));
            continue;
        }
        if !number.is_empty() {
            found += 1;
            let bytes = sample.parse(&number).ok_or_else(|| {
                io::Error::other(format!(
                    "number {found} of its text is '{number}', which is not {sample}"
                ))
            })?;
            out.write_all(&bytes)?;
            number.clear();
        }
    }
    match found == count {
        true => out.flush(),
        false => Err(io::Error::other(format!(
            "its text holds {found} numbers, not the {count} that its header declares"
        ))),
    }
}
