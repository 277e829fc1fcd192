//! MetaImage: a text header (`.mhd`) and pixels, raw or by zlib, beside it or behind it
//! (<https://itk.org/Wiki/ITK/MetaIO/Documentation>).

use std::path::{Path, PathBuf};

use crate::Error;
use crate::beside::data_file;
use crate::raw::RawVolume;
use crate::sample::{PageFormat, Sample};
use crate::source::Source;
use crate::unpacked::{self, Packing};
use crate::voxel_size::{VoxelSize, decimal};

/// Spacings that can be meant, in whatever unit.
const SPACING: std::ops::RangeInclusive<f64> = 1e-12..=1e12;
/// A header longer than this is none.
const MAX_HEADER: usize = 1 << 16;

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
    let header = Header::parse(&head).map_err(|what| Error::file(&source, what))?;
    let format = PageFormat {
        width: header.dims[0],
        height: header.dims[1],
        sample: header.sample,
        channels: header.channels,
    };
    let voxel_size = header.voxel_size;
    let (sources, offset) = match &header.data {
        Data::Behind(offset) => (vec![source], *offset),
        Data::File(name) => {
            let beside = data_file(path, name, "ElementDataFile")
                .map_err(|what| Error::file(&source, what))?;
            (vec![source, Source::open(&beside)?], header.skip)
        }
    };
    let (pages, big) = (header.dims[2], header.big_endian);
    let bytes = format.page_bytes().and_then(|n| n.checked_mul(pages));
    let volume = match (header.compressed, bytes, sources.last()) {
        (true, Some(bytes), Some(pixels)) => {
            let file = unpacked::unpack(pixels, offset, Packing::Zlib, bytes as u64)?;
            RawVolume::unpacked(sources, file, format, pages, 0, big)?
        }
        _ => RawVolume::new(sources, format, pages, offset, big)?,
    };
    Ok((volume, voxel_size))
}

enum Data {
    /// In the header's own file, from this byte.
    Behind(u64),
    File(PathBuf),
}

struct Header {
    dims: [usize; 3],
    sample: Sample,
    channels: usize,
    /// By zlib.
    compressed: bool,
    big_endian: bool,
    /// Bytes to skip in the data file.
    skip: u64,
    data: Data,
    voxel_size: Option<VoxelSize>,
}

impl Header {
    fn parse(head: &[u8]) -> Result<Self, String> {
        let (fields, end) = fields(head)?;
        let field = |key: &str| {
            let found = fields.iter().find(|f| f.key == key);
            found.map(|f| (f.value.as_str(), f.line))
        };
        let wrong =
            |line, accepted: &str| format!("line {line} of its header: accepted is {accepted}");
        let needed = |key: &str| field(key).ok_or_else(|| format!("its header has no {key}"));
        let number = |key: &str, default| match field(key) {
            None => Ok(default),
            Some((v, line)) => v.parse::<u64>().map_err(|_| wrong(line, "a number from 0")),
        };
        let flag = |key: &str| field(key).is_some_and(|(v, _)| v.eq_ignore_ascii_case("true"));

        let (dims, line) = needed("DimSize")?;
        let axes: Option<Vec<usize>> = dims.split_whitespace().map(|n| n.parse().ok()).collect();
        let dims = axes
            .and_then(|axes| axes.try_into().ok())
            .ok_or_else(|| wrong(line, "three numbers of voxels along x, y, z"))?;
        let (kind, line) = needed("ElementType")?;
        let sample = sample_of(kind).ok_or_else(|| {
            wrong(line, "MET_UCHAR, MET_CHAR, MET_USHORT, MET_SHORT, MET_UINT, MET_INT, MET_FLOAT or MET_DOUBLE")
        })?;
        let channels = number("ElementNumberOfChannels", 1)?;
        if channels != 1 && channels != 3 {
            return Err("its pixels have neither 1 nor 3 channels".into());
        }
        let (file, line) = needed("ElementDataFile")?;
        let data = match file {
            "LOCAL" => Data::Behind(end as u64),
            "LIST" | "" => return Err(wrong(line, "one file name or LOCAL")),
            _ => Data::File(file.into()),
        };
        Ok(Self {
            dims,
            sample,
            channels: channels as usize,
            compressed: flag("CompressedData"),
            big_endian: flag("ElementByteOrderMSB") || flag("BinaryDataByteOrderMSB"),
            skip: number("HeaderSize", 0)?,
            data,
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
        "MET_UINT" => Sample::U32,
        "MET_INT" => Sample::I32,
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
