//! NumPy's `.npy`, format versions 1 to 3
//! (<https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>): an array of
//! shape (pages, rows, columns).

use std::fs::File;
use std::io::{self, BufWriter, Write};

use particle_file::temporary_file;

use crate::Error;
use crate::kind::Kind;
use crate::lattice::voxels;
use crate::raw::Raw;
use crate::sample::{PageFormat, Sample};
use crate::source::Source;
use crate::volume::Volume;

/// A header longer than this is none; NumPy itself reads 10 000 bytes.
const MAX_HEADER: usize = 1 << 16;
/// Bytes that hold the whole header of an array of usual types.
pub(crate) const LONGEST_HEAD: u64 = 4096;

/// Opens an array of three axes (z, y, x) in C or Fortran order, in `source` or in what was `unpacked` from it.
pub(crate) fn open(source: Source, unpacked: Option<Source>) -> Result<Volume, Error> {
    let array = unpacked.as_ref().unwrap_or(&source);
    let (text, offset) = header(array)?;
    let (raw, fortran) = parse(&text, offset).map_err(|what| Error::file(array, what))?;
    if !fortran {
        return raw.volume(vec![source], unpacked);
    }
    let Raw { format, pages, .. } = raw;
    let shape = [pages, format.height, format.width];
    // The same bytes read as C order are an array of shape (x, y, z): checked as such before
    // they are put in order.
    let mut transposed = raw;
    (transposed.format.width, transposed.pages) = (pages, format.width);
    transposed.check(array)?;
    let size = format.sample.bytes();
    if let Some(short) = machine::shortage(array.len()) {
        let what = format!(
            "it is stored with z fastest (fortran_order), and to put it in order needs {short}: save it by numpy.ascontiguousarray"
        );
        return Err(Error::file(array, what));
    }
    let ordered = in_c_order(array, offset, shape, size);
    let ordered = array.with_content(ordered.map_err(|e| Error::io(array, e))?)?;
    Raw { offset: 0, ..raw }.volume(vec![source], Some(ordered))
}

/// Whether a file that begins with `head`, of at least [`LONGEST_HEAD`] bytes where it has as many,
/// is an array of three axes.
pub(crate) fn is_volume(head: &[u8]) -> bool {
    let axes = shape(&String::from_utf8_lossy(head)).map(|axes| axes.len());
    Kind::of(head) == Some(Kind::Npy) && axes == Some(3)
}

/// The header's text and where the data begin.
fn header(source: &Source) -> Result<(String, u64), Error> {
    let corrupt = || Error::file(source, "its .npy header is corrupt or truncated");
    let window = |at, len| source.window(at, len).map_err(|e| Error::io(source, e));
    let (length, begin) = match *window(0, 12)?.as_slice() {
        [.., 1, _, a, b, _, _] => (usize::from(u16::from_le_bytes([a, b])), 10),
        [.., 2 | 3, _, a, b, c, d] => (u32::from_le_bytes([a, b, c, d]) as usize, 12),
        _ => return Err(corrupt()),
    };
    let text = window(begin, length.min(MAX_HEADER))?;
    if text.len() < length {
        return Err(corrupt());
    }
    let text = String::from_utf8(text).map_err(|_| corrupt())?;
    Ok((text, begin + length as u64))
}

/// The pixels behind byte `offset`, and whether they are in Fortran order, by the Python dictionary
/// `{'descr': '<u2', 'fortran_order': False, 'shape': (..)}`.
fn parse(text: &str, offset: u64) -> Result<(Raw, bool), String> {
    let after = |key: &str| {
        let found = text.split_once(key).map(|(_, rest)| rest.trim_start());
        found.ok_or_else(|| format!("its .npy header has no {key}"))
    };
    let descr = after("'descr':")?.split(['\'', '"']).nth(1);
    let (sample, big_endian) = sample_of(descr.unwrap_or_default())?;
    let fortran = after("'fortran_order':")?.starts_with("True");
    let axes = shape(text).and_then(|axes| axes.try_into().ok());
    let [pages, height, width] =
        axes.ok_or("its array has not three axes; accepted is the shape (pages, rows, columns)")?;
    let raw = Raw {
        format: PageFormat::new([width, height], sample, 1),
        pages,
        offset,
        big_endian,
    };
    Ok((raw, fortran))
}

/// The axes of a header's shape.
fn shape(text: &str) -> Option<Vec<usize>> {
    let (_, rest) = text.split_once("'shape':")?;
    let (axes, _) = rest.trim_start().strip_prefix('(')?.split_once(')')?;
    // Python 2 wrote an L behind a number.
    let axis = |n: &str| n.trim().trim_end_matches('L').parse().ok();
    axes.trim()
        .trim_end_matches(',')
        .split(',')
        .map(axis)
        .collect()
}

/// The type of `<u2` and the like, and whether it is big-endian.
fn sample_of(descr: &str) -> Result<(Sample, bool), String> {
    let sample = match descr.get(1..) {
        Some("b1") => Some(Sample::U8),
        Some(kind) => (kind.split_at_checked(1))
            .filter(|(_, bytes)| ["1", "2", "4", "8"].contains(bytes))
            .and_then(|(kind, bytes)| Some((kind, bytes.parse::<u8>().ok()?)))
            .and_then(|(kind, bytes)| Sample::named(&format!("{kind}{}", 8 * bytes))),
        None => None,
    };
    let sample = sample.ok_or_else(|| {
        format!(
            "its array has the type '{descr}'; accepted are integers of 8 to 64 bits, bool, float32 and float64"
        )
    })?;
    match descr.as_bytes()[0] {
        b'|' | b'<' | b'=' => Ok((sample, false)),
        b'>' => Ok((sample, true)),
        _ => Err(format!("its array has the unknown byte order of '{descr}'")),
    }
}

/// Copies an array stored with z fastest to an unnamed file with x fastest.
fn in_c_order(source: &Source, data: u64, shape: [usize; 3], size: usize) -> io::Result<File> {
    let [nz, ny, nx] = shape;
    let stored = source.window(data, nz * ny * nx * size)?;
    let mut out = BufWriter::new(temporary_file(stored.len() as u64)?);
    for [x, y, z] in voxels([nx, ny, nz]) {
        let at = ((x * ny + y) * nz + z) * size;
        out.write_all(&stored[at..at + size])?;
    }
    out.into_inner().map_err(io::IntoInnerError::into_error)
}
