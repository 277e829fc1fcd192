//! NRRD, raw, gzipped, by bzip2 or as text, with its pixels behind the header or in files beside it
//! (<https://teem.sourceforge.net/nrrd/format.html>).

use std::path::Path;

use crate::beside::data_files;
use crate::fields::{Fields, whole_numbers};
use crate::pixels::{Coding, Described, MAX_HEADER};
use crate::raw::Raw;
use crate::sample::{PageFormat, Sample};
use crate::voxel_size::{VoxelSize, decimal};

pub(crate) fn parse(head: &[u8], path: &Path) -> Result<Described, String> {
    let is_list = |key: &str, value: &str| key.starts_with("data") && value.starts_with("LIST");
    let header = Fields::read(head, ':', |key, value| {
        key.is_empty() || is_list(key, value)
    })?;
    let field = |keys: &[&str]| header.get(keys).map(|(value, _)| value);
    let needed = |key: &str| header.needed(key).map(|(value, _)| value);
    let data_file = field(&["data file", "datafile"]);
    // A header in a file of its own may end with the file.
    if !header.ended && (data_file.is_none() || head.len() == MAX_HEADER) {
        return Err("its header does not end".into());
    }
    let axes = whole_numbers(needed("sizes")?);
    let (channels, [width, height, pages]) = match axes.as_deref() {
        Some(&[x, y, z]) => Some((1, [x, y, z])),
        Some(&[3, x, y, z]) => Some((3, [x, y, z])),
        _ => None,
    }
    .ok_or("it is no volume of three axes, or four of which the first has 3 colours")?;
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
        Some("big") => Some(true),
        Some("little") => Some(false),
        None if sample.bytes() == 1 || coding == Coding::Text => Some(false),
        _ => None,
    }
    .ok_or("its header does not say whether its bytes are little or big endian")?;
    if field(&["line skip", "lineskip"]).is_some_and(|n| n != "0") {
        return Err("it skips lines of its data file; accepted is a skip of bytes".into());
    }
    let (files, offset) = match data_file {
        None => (Vec::new(), header.end as u64),
        Some(value) => (
            data_files(path, value, &head[header.end..], "data file")?,
            0,
        ),
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
            offset,
            big_endian,
        },
        at_end: skip.is_none(),
        coding,
        skip: skip.unwrap_or(0),
        files,
        voxel_size: voxel_size(&field),
    })
}

fn sample_of(kind: &str) -> Result<Sample, String> {
    // As in C, short and long long may be followed by int; int8 and its like by _t.
    let short = kind
        .strip_suffix(" int")
        .filter(|kind| matches!(kind.rsplit(' ').next(), Some("short" | "long")));
    let sized = kind
        .strip_suffix("_t")
        .filter(|kind| kind.ends_with(char::is_numeric));
    let name = short.or(sized).unwrap_or(kind);
    Sample::named(name).ok_or_else(|| {
        format!("its type is '{kind}'; accepted are integers of 8 to 64 bits, float and double")
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
