//! MetaImage: a text header (`.mhd`) and pixels, raw, by zlib or as text, beside it or behind it
//! (<https://itk.org/Wiki/ITK/MetaIO/Documentation>).

use std::path::Path;

use crate::beside::data_files;
use crate::fields::{Fields, whole_numbers};
use crate::pixels::{Coding, Described};
use crate::raw::Raw;
use crate::sample::{PageFormat, Sample};
use crate::voxel_size::{VoxelSize, decimal};

/// Spacings that can be meant, in whatever unit.
const SPACING: std::ops::RangeInclusive<f64> = 1e-12..=1e12;

pub(crate) fn parse(head: &[u8], path: &Path) -> Result<Described, String> {
    // It is the last one by definition.
    let header = Fields::read(head, '=', |key, _| key == "elementdatafile")?;
    let field = |key: &str| header.get(&[key]);
    let wrong = |line, accepted: &str| format!("line {line} of its header: accepted is {accepted}");
    // As its own library reads them.
    let is = |key: &str, first: [char; 3]| field(key).is_some_and(|(v, _)| v.starts_with(first));
    let flag = |key: &str| is(key, ['T', 't', '1']);

    let (value, of_value) = header.needed("ElementDataFile")?;
    let (dims, line) = header.needed("DimSize")?;
    let axes = whole_numbers(dims).and_then(|axes| axes.try_into().ok());
    let [width, height, pages] =
        axes.ok_or_else(|| wrong(line, "three numbers of voxels along x, y, z"))?;
    let (kind, line) = header.needed("ElementType")?;
    let sample = Sample::named(kind).ok_or_else(|| {
        wrong(line, "MET_ and UCHAR, CHAR, USHORT, SHORT, UINT, INT, ULONG, LONG, ULONG_LONG, LONG_LONG, FLOAT or DOUBLE")
    })?;
    let channels = match field("ElementNumberOfChannels") {
        None | Some(("1", _)) => 1,
        Some(("3", _)) => 3,
        Some(_) => return Err("its pixels have neither 1 nor 3 channels".into()),
    };
    let local = value == "LOCAL";
    if value.is_empty() {
        return Err(wrong(of_value, "a file name, LOCAL or LIST"));
    }
    let skip = field("HeaderSize").filter(|_| !local);
    let at_end = skip.is_some_and(|(n, _)| n == "-1");
    let offset = match skip {
        _ if local => header.end as u64,
        Some((n, line)) if !at_end => n
            .parse()
            .map_err(|_| wrong(line, "a number from 0, or -1"))?,
        _ => 0,
    };
    let files = match local {
        true => Vec::new(),
        false => data_files(path, value, &head[header.end..], "ElementDataFile")?,
    };
    Ok(Described {
        raw: Raw {
            format: PageFormat::new([width, height], sample, channels),
            pages,
            offset,
            big_endian: flag("ElementByteOrderMSB") || flag("BinaryDataByteOrderMSB"),
        },
        at_end,
        coding: match () {
            () if flag("CompressedData") => Coding::Zlib,
            () if is("BinaryData", ['F', 'f', '0']) => Coding::Text,
            () => Coding::Raw,
        },
        skip: 0,
        files,
        voxel_size: voxel_size(field("ElementSpacing"), field("DistanceUnits"))?,
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
        let (low, high) = (SPACING.start(), SPACING.end());
        return Err(format!(
            "line {line} of its header: accepted are three spacings along x, y, z from {low:e} to {high:e}"
        ));
    };
    let size = |(unit, _)| VoxelSize::in_units([x, y, z], [unit; 3], "MetaImage spacing");
    Ok(units.and_then(size))
}
