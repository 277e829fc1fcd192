//! The image description of a TIFF as programs write it: the number of planes and the size
//! of a voxel. ImageJ writes `key=value` lines, tifffile the shape, OME an XML document.

use std::collections::BTreeSet;

use ::tiff::tags::Tag;

use super::ifd::{Directory, UIC2};
use super::layout::PageLayout;
use super::ome;
use crate::source::Source;
use crate::voxel_size::{VoxelSize, decimal, metres_of_unit};

/// What the first page says about the whole file.
#[derive(Debug, Default)]
pub(crate) struct Description {
    pub(crate) planes: Option<u64>,
    /// Whether it gives a size of a voxel, be it no length, so that resolution tags do not.
    pub(crate) states_size: bool,
    pub(crate) voxel_size: Option<VoxelSize>,
    /// Which planes stand where, if that is told; else they stand in file order.
    pub(crate) blocks: Vec<Block>,
}

/// Planes that follow one another in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Block {
    pub(super) plane: u64,
    /// Their file in the folder of the description; none is the file that holds it.
    pub(super) file: Option<String>,
    /// The directory of the first.
    pub(super) directory: u64,
    /// How many they are; none for all that the file holds from there.
    pub(super) planes: Option<u64>,
}

impl Description {
    /// The files that the planes of `source` are in, its own in place of none; there are none where its blocks name one
    /// at most, which is the description's own, whatever it is called by now.
    pub(crate) fn files(&mut self, source: &Source) -> Vec<String> {
        let own = source.path().file_name().unwrap_or_default();
        let own = own.to_string_lossy().into_owned();
        let named = |blocks: &[Block]| -> BTreeSet<String> {
            let files = blocks.iter().filter_map(|block| block.file.clone());
            files.collect()
        };
        if named(&self.blocks).len() < 2 {
            return Vec::new();
        }
        for block in self.blocks.iter_mut() {
            block.file.get_or_insert_with(|| own.clone());
        }
        named(&self.blocks).into_iter().collect()
    }
}

/// Refuses hyperstacks: of channels, slices and frames only one may be more than 1.
pub(super) fn one_axis(counts: [u64; 3]) -> Result<(), String> {
    if counts.iter().filter(|n| **n > 1).count() > 1 {
        let [c, z, t] = counts;
        return Err(format!(
            "it declares {c} channels, {z} slices and {t} frames; one series of planes is accepted"
        ));
    }
    Ok(())
}

/// Reads the description of the first page.
pub(crate) fn describe(page: &Directory, layout: &PageLayout) -> Result<Description, String> {
    let text = page.text(Tag::ImageDescription)?;
    let resolution = [Tag::XResolution, Tag::YResolution].map(|t| page.rational(t));
    let mut description = if text.starts_with("ImageJ=") {
        imagej(&text, resolution)?
    } else if let Some(shape) = shape(&text)? {
        shaped(&shape, layout)?
    } else if text.contains("<OME") {
        ome::describe(&text, layout)?
    } else {
        Description::default()
    };
    // MetaMorph's STK has a value of this tag for each plane behind its only directory.
    description.planes = description.planes.or(page.count(UIC2));
    if let (false, [Some(x), Some(y)]) = (description.states_size, resolution) {
        let unit = page.uint(Tag::ResolutionUnit)?.unwrap_or(2);
        description.voxel_size = VoxelSize::from_resolution(x, y, unit);
    }
    Ok(description)
}

/// ImageJ: XResolution counts pixels per `unit`, YResolution per `yunit`; `spacing` is the distance
/// of planes in `zunit`.
fn imagej(text: &str, resolution: [Option<f64>; 2]) -> Result<Description, String> {
    let value = |key: &str| {
        let mut lines = text.lines();
        let value = lines.find_map(|line| line.strip_prefix(key)?.strip_prefix('='));
        value.map(str::trim)
    };
    let count = |key| value(key).and_then(|n| n.parse::<u64>().ok());
    one_axis(["channels", "slices", "frames"].map(|key| count(key).unwrap_or(1)))?;
    let metres = |key| metres_of_unit(value(key).or(value("unit"))?);
    let voxel_size = || {
        let z = match value("spacing") {
            None => None,
            Some(text) => Some(decimal(text)?.abs() * metres("zunit")?),
        };
        let [x, y] = [("unit", resolution[0]), ("yunit", resolution[1])]
            .map(|(key, pixels)| Some(metres(key)? / pixels?));
        VoxelSize::new(x?, y?, z, "ImageJ metadata")
    };
    Ok(Description {
        planes: count("images"),
        states_size: value("unit").is_some(),
        voxel_size: voxel_size(),
        blocks: Vec::new(),
    })
}

/// The shape that tifffile writes: a JSON object with the key `shape`, once `shape=(N, rows, columns)`.
fn shape(text: &str) -> Result<Option<Vec<Option<u64>>>, String> {
    let text = text.trim();
    let old = text
        .strip_prefix("shape=(")
        .and_then(|t| t.strip_suffix(')'));
    if let Some(axes) = old {
        let axes = axes.trim_end_matches(',').split(',');
        return Ok(Some(axes.map(|n| n.trim().parse().ok()).collect()));
    }
    if !(text.starts_with('{') && text.contains("\"shape\"")) {
        return Ok(None);
    }
    let json: serde_json::Value = serde_json::from_str(text)
        .map_err(|e| format!("its description is not the JSON it begins as: {e}"))?;
    let axes = json.get("shape").and_then(|shape| shape.as_array());
    Ok(axes.map(|axes| axes.iter().map(|n| n.as_u64()).collect()))
}

/// Of `[N, rows, columns]`, with RGB `[N, rows, columns, 3]` or `[N, 3, rows, columns]`.
fn shaped(axes: &[Option<u64>], layout: &PageLayout) -> Result<Description, String> {
    let format = layout.format;
    let product = |axes: &[Option<u64>]| {
        axes.iter()
            .try_fold(1_u64, |n, axis| n.checked_mul((*axis)?))
    };
    let plane = product(&[format.width, format.height, format.channels].map(|n| Some(n as u64)));
    // Axes before those of a plane: channels or frames beside slices are no series.
    let series = (0..axes.len())
        .rev()
        .find(|&at| product(&axes[at..]) == plane);
    let before = &axes[..series.unwrap_or(0)];
    let many = before.iter().filter(|axis| **axis != Some(1)).count();
    match (product(axes), plane) {
        _ if many > 1 => Err(format!(
            "its description declares a shape of {many} axes beside those of a plane of {format}; one series of planes is accepted: save channels and frames apart"
        )),
        (Some(total), Some(plane)) if total > 0 && total % plane == 0 => Ok(Description {
            planes: Some(total / plane),
            ..Description::default()
        }),
        _ => Err(format!(
            "its description declares a shape that is no number of planes of {format}"
        )),
    }
}
