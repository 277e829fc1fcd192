//! MetaImage: a text header (`.mhd`) and pixels, raw, by zlib or as text, beside it or behind it
//! (<https://itk.org/Wiki/ITK/MetaIO/Documentation>).

use std::path::{Path, PathBuf};

use crate::Error;
use crate::beside::data_files;
use crate::pixels::{Coding, Pixels, Start};
use crate::raw::RawVolume;
use crate::sample::{PageFormat, Sample};
use crate::source::Source;
use crate::voxel_size::{VoxelSize, decimal};

/// Spacings that can be meant, in whatever unit.
const SPACING: std::ops::RangeInclusive<f64> = 1e-12..=1e12;
/// A header longer than this is none; it may name thousands of files.
const MAX_HEADER: usize = 1 << 20;

pub(crate) fn is_mhd(head: &[u8]) -> bool {
    let text = String::from_utf8_lossy(head);
    let key = text.split('=').next().unwrap_or_default().trim();
    ["ObjectType", "NDims", "Comment"].contains(&key)
}

/// Opens the header in `source` and the pixels it points to, relative to `path`.
pub(crate) fn open(source: Source, path: &Path) -> Result<(RawVolume, Option<VoxelSize>), Error> {
    let head = source
        .window(0, MAX_HEADER)
        .map_err(|e| Error::io(&source, e))?;
    let wrong = |what| Error::file(&source, what);
    let header = Header::parse(&head, path).map_err(wrong)?;
    let beside = (header.files.iter())
        .map(|file| Source::open_slice(file))
        .collect::<Result<_, _>>()?;
    Ok((header.pixels.open(source, beside)?, header.voxel_size))
}

struct Header {
    pixels: Pixels,
    /// None where the pixels stand behind the header.
    files: Vec<PathBuf>,
    voxel_size: Option<VoxelSize>,
}

impl Header {
    fn parse(head: &[u8], path: &Path) -> Result<Self, String> {
        let (fields, end) = fields(head)?;
        let field = |key: &str| {
            let found = fields.iter().find(|f| f.key == key);
            found.map(|f| (f.value.as_str(), f.line))
        };
        let wrong =
            |line, accepted: &str| format!("line {line} of its header: accepted is {accepted}");
        let needed = |key: &str| field(key).ok_or_else(|| format!("its header has no {key}"));
        // As its own library reads them.
        let is =
            |key: &str, first: [char; 3]| field(key).is_some_and(|(v, _)| v.starts_with(first));
        let flag = |key: &str| is(key, ['T', 't', '1']);

        let (dims, line) = needed("DimSize")?;
        let axes: Option<Vec<usize>> = dims.split_whitespace().map(|n| n.parse().ok()).collect();
        let [width, height, pages] = axes
            .and_then(|axes| axes.try_into().ok())
            .ok_or_else(|| wrong(line, "three numbers of voxels along x, y, z"))?;
        let (kind, line) = needed("ElementType")?;
        let sample = sample_of(kind).ok_or_else(|| {
            wrong(line, "MET_ and UCHAR, CHAR, USHORT, SHORT, UINT, INT, ULONG, LONG, ULONG_LONG, LONG_LONG, FLOAT or DOUBLE")
        })?;
        let channels = match field("ElementNumberOfChannels") {
            None | Some(("1", _)) => 1,
            Some(("3", _)) => 3,
            Some(_) => return Err("its pixels have neither 1 nor 3 channels".into()),
        };
        let (value, line) = needed("ElementDataFile")?;
        let (files, start) = match (value, field("HeaderSize")) {
            ("", _) => return Err(wrong(line, "a file name, LOCAL or LIST")),
            ("LOCAL", _) => (Vec::new(), Start::At(end as u64)),
            (_, skip) => {
                let start = match skip {
                    None => Start::At(0),
                    Some(("-1", _)) => Start::FromEnd,
                    Some((n, line)) => Start::At(
                        n.parse()
                            .map_err(|_| wrong(line, "a number from 0, or -1"))?,
                    ),
                };
                (
                    data_files(path, value, &head[end..], "ElementDataFile")?,
                    start,
                )
            }
        };
        Ok(Self {
            pixels: Pixels {
                format: PageFormat {
                    width,
                    height,
                    sample,
                    channels,
                },
                pages,
                big_endian: flag("ElementByteOrderMSB") || flag("BinaryDataByteOrderMSB"),
                coding: match () {
                    () if flag("CompressedData") => Coding::Zlib,
                    () if is("BinaryData", ['F', 'f', '0']) => Coding::Text,
                    () => Coding::Raw,
                },
                start,
                skip: 0,
            },
            files,
            voxel_size: voxel_size(field("ElementSpacing"), field("DistanceUnits"))?,
        })
    }
}

struct Field {
    key: String,
    value: String,
    line: usize,
}

/// `key = value` lines with their line numbers up to ElementDataFile, which is the last one
/// by definition, and the byte behind it.
fn fields(head: &[u8]) -> Result<(Vec<Field>, usize), String> {
    let mut fields = Vec::new();
    let mut end = 0;
    for (i, line) in head.split_inclusive(|b| *b == b'\n').enumerate() {
        end += line.len();
        let text = String::from_utf8_lossy(line);
        if text.trim().is_empty() {
            continue;
        }
        let (key, value) = text
            .split_once('=')
            .ok_or_else(|| format!("line {} of its header is not KEY = VALUE", i + 1))?;
        let key = key.trim().to_owned();
        let last = key == "ElementDataFile";
        let value = value.trim().to_owned();
        fields.push(Field {
            key,
            value,
            line: i + 1,
        });
        if last {
            return Ok((fields, end));
        }
    }
    Err("its header has no ElementDataFile".into())
}

fn sample_of(kind: &str) -> Option<Sample> {
    Some(match kind {
        "MET_UCHAR" => Sample::U8,
        "MET_CHAR" => Sample::I8,
        "MET_USHORT" => Sample::U16,
        "MET_SHORT" => Sample::I16,
        // Four bytes wherever they are written.
        "MET_UINT" | "MET_ULONG" => Sample::U32,
        "MET_INT" | "MET_LONG" => Sample::I32,
        "MET_ULONG_LONG" => Sample::U64,
        "MET_LONG_LONG" => Sample::I64,
        "MET_FLOAT" => Sample::F32,
        "MET_DOUBLE" => Sample::F64,
        _ => return None,
    })
}

/// MetaImage gives spacings a unit only by DistanceUnits; without it they are not a size.
fn voxel_size(
    spacing: Option<(&str, usize)>,
    units: Option<(&str, usize)>,
) -> Result<Option<VoxelSize>, String> {
    let Some((text, line)) = spacing else {
        return Ok(None);
    };
    let edges: Option<Vec<f64>> = (text.split_whitespace())
        .map(|edge| decimal(edge).filter(|e| SPACING.contains(e)))
        .collect();
    let Some(&[x, y, z]) = edges.as_deref() else {
        return Err(format!(
            "line {line} of its header: accepted are three spacings along x, y, z from {:e} to {:e}",
            SPACING.start(),
            SPACING.end()
        ));
    };
    let size = |(unit, _)| VoxelSize::in_units([x, y, z], [unit; 3], "MetaImage spacing");
    Ok(units.and_then(size))
}
