//! NRRD, raw, gzipped, by bzip2 or as text, with its pixels behind the header or in files beside it
//! (<https://teem.sourceforge.net/nrrd/format.html>).

use std::path::Path;

use crate::Error;
use crate::beside::data_files;
use crate::pixels::{self, Coding, Described, MAX_HEADER, whole_numbers};
use crate::raw::Raw;
use crate::sample::{PageFormat, Sample};
use crate::source::Source;
use crate::volume::Volume;
use crate::voxel_size::{VoxelSize, decimal};

/// Opens the header in `source` and the pixels it points to.
pub(crate) fn open(source: Source) -> Result<Volume, Error> {
    pixels::open(source, parse)
}

fn parse(head: &[u8], path: &Path) -> Result<Described, String> {
    let (fields, end) = fields(head)?;
    let field = |keys: &[&str]| {
        let found = fields.iter().find(|(key, _)| keys.contains(&key.as_str()));
        found.map(|(_, value)| value.as_str())
    };
    let needed = |key: &str| field(&[key]).ok_or_else(|| format!("its header has no {key}"));
    let (channels, [width, height, pages]) = match whole_numbers(needed("sizes")?).as_deref() {
        Some(&[x, y, z]) => (1, [x, y, z]),
        Some(&[3, x, y, z]) => (3, [x, y, z]),
        _ => {
            let what = "it is no volume of three axes, or four of which the first has 3 colours";
            return Err(what.into());
        }
    };
    let sample = sample_of(needed("type")?)?;
    let coding = match needed("encoding")? {
        "raw" => Coding::Raw,
        "gzip" | "gz" => Coding::Gzip,
        "bzip2" | "bz2" => Coding::Bzip2,
        "ascii" | "text" | "txt" => Coding::Text,
        other => {
            return Err(format!(
                "its encoding is '{other}'; accepted are raw, gzip, bzip2 and ascii: save it again, e.g. with unu save -f nrrd -e gzip"
            ));
        }
    };
    let big_endian = match field(&["endian"]) {
        Some("big") => true,
        Some("little") => false,
        None if sample.bytes() == 1 || coding == Coding::Text => false,
        _ => {
            let what = "its header does not say whether its bytes are little or big endian";
            return Err(what.into());
        }
    };
    if field(&["line skip", "lineskip"]).is_some_and(|n| n != "0") {
        return Err("it skips lines of its data file; accepted is a skip of bytes".into());
    }
    let files = match field(&["data file", "datafile"]) {
        None => Vec::new(),
        Some(value) => data_files(path, value, &head[end..], "data file")?,
    };
    let skip = match field(&["byte skip", "byteskip"]) {
        None => Some(0),
        Some("-1") => None,
        Some(n) => {
            let number = n.parse().ok();
            Some(number.ok_or("its byte skip is neither -1 nor a number from 0")?)
        }
    };
    Ok(Described {
        raw: Raw {
            format: PageFormat::new([width, height], sample, channels),
            pages,
            offset: if files.is_empty() { end as u64 } else { 0 },
            big_endian,
        },
        at_end: skip.is_none(),
        coding,
        skip: skip.unwrap_or(0),
        files,
        voxel_size: voxel_size(&field),
    })
}

/// `key: value` lines in lower case up to the empty line that ends the header, or a list of files,
/// and the byte behind it; comments and `key:=value` pairs are passed over.
fn fields(head: &[u8]) -> Result<(Vec<(String, String)>, usize), String> {
    let mut fields = Vec::new();
    let mut end = 0;
    for (i, line) in head.split_inclusive(|b| *b == b'\n').enumerate() {
        end += line.len();
        if i == 0 {
            // The magic, which is_nrrd has seen.
            continue;
        }
        let text = String::from_utf8_lossy(line);
        let text = text.trim_end();
        if text.is_empty() && line.ends_with(b"\n") {
            return Ok((fields, end));
        }
        if text.starts_with('#') || text.contains(":=") {
            continue;
        }
        let (key, value) = text
            .split_once(':')
            .ok_or("a line of its header is not KEY: VALUE")?;
        fields.push((key.trim().to_lowercase(), value.trim().to_owned()));
        if key.starts_with("data") && value.trim().starts_with("LIST") {
            return Ok((fields, end));
        }
    }
    // A header in a file of its own may end with the file.
    match fields.iter().any(|(key, _)| key.starts_with("data")) && head.len() < MAX_HEADER {
        true => Ok((fields, end)),
        false => Err("its header does not end".into()),
    }
}

fn sample_of(kind: &str) -> Result<Sample, String> {
    Ok(match kind {
        "uchar" | "unsigned char" | "uint8" | "uint8_t" => Sample::U8,
        "signed char" | "int8" | "int8_t" => Sample::I8,
        "ushort" | "unsigned short" | "unsigned short int" | "uint16" | "uint16_t" => Sample::U16,
        "short" | "short int" | "signed short" | "signed short int" | "int16" | "int16_t" => {
            Sample::I16
        }
        "uint" | "unsigned int" | "uint32" | "uint32_t" => Sample::U32,
        "int" | "signed int" | "int32" | "int32_t" => Sample::I32,
        "ulonglong" | "unsigned long long" | "unsigned long long int" | "uint64" | "uint64_t" => {
            Sample::U64
        }
        "longlong"
        | "long long"
        | "long long int"
        | "signed long long"
        | "signed long long int"
        | "int64"
        | "int64_t" => Sample::I64,
        "float" => Sample::F32,
        "double" => Sample::F64,
        _ => {
            return Err(format!(
                "its type is '{kind}'; accepted are integers of 8 to 64 bits, float and double"
            ));
        }
    })
}

/// Spacings, or lengths of space directions, with the unit of each; without units they are no size.
/// The colours of an axis in front have neither.
fn voxel_size<'a>(field: &impl Fn(&[&str]) -> Option<&'a str>) -> Option<VoxelSize> {
    let text = field(&["space units", "units"])?;
    let units: Vec<&str> = (text.split('"').skip(1).step_by(2))
        .filter(|unit| !unit.trim().is_empty())
        .collect();
    let edges: Option<Vec<f64>> = match field(&["spacings"]) {
        Some(text) => (text.split_whitespace())
            .filter(|edge| !edge.eq_ignore_ascii_case("nan"))
            .map(decimal)
            .collect(),
        None => (field(&["space directions"])?.split(')'))
            .filter_map(|vector| Some(length(vector.split_once('(')?.1)))
            .collect(),
    };
    let edges = edges?.try_into().ok()?;
    VoxelSize::in_units(edges, units.try_into().ok()?, "NRRD spacings")
}

/// The length of a vector of three numbers.
fn length(vector: &str) -> Option<f64> {
    let parts: Option<Vec<f64>> = (vector.split(',').map(|x| x.trim().parse().ok())).collect();
    let [x, y, z]: [f64; 3] = parts?.try_into().ok()?;
    Some((x * x + y * y + z * z).sqrt())
}
