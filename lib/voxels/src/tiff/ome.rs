//! OME-TIFF: an XML document in the first page, which may tell of pages in other files too
//! (<https://docs.openmicroscopy.org/ome-model/latest/ome-tiff/specification.html>).

use std::collections::BTreeSet;

use roxmltree::Node;

use super::describe::{Block, Description, one_axis};
use super::layout::PageLayout;
use crate::voxel_size::{VoxelSize, decimal, metres_of_unit};

/// Reads a description of a file whose first page is `layout`.
pub(crate) fn describe(text: &str, layout: &PageLayout) -> Result<Description, String> {
    let xml = roxmltree::Document::parse(text)
        .map_err(|e| format!("its OME description is not valid XML: {e}"))?;
    let named = |name: &'static str| {
        let nodes = xml.descendants();
        nodes.filter(move |node| node.tag_name().name() == name)
    };
    if let Some(elsewhere) = named("BinaryOnly").next() {
        let file = elsewhere.attribute("MetadataFile");
        return Err(format!(
            "its OME description stands in '{}'; name the file that holds it, or save the pages with descriptions of their own",
            file.unwrap_or("another file")
        ));
    }
    let mut images = named("Pixels");
    let pixels = images.next().ok_or("its OME description has no Pixels")?;
    if images.next().is_some() {
        return Err("its OME description holds several images; one is accepted".into());
    }
    let format = layout.format;
    let count = |key| number(pixels, key);
    if [count("SizeX"), count("SizeY")] != [Some(format.width as u64), Some(format.height as u64)] {
        return Err(format!(
            "its OME description declares another size than {format}"
        ));
    }
    let mut planes = ["SizeC", "SizeZ", "SizeT"].map(|key| count(key).unwrap_or(1));
    if planes[0] == format.channels as u64 {
        planes[0] = 1;
    }
    one_axis(planes)?;
    let mut blocks: Vec<Block> = named("TiffData").map(block).collect();
    // Without directories they say no more than that there are pages.
    let placed = |block: &Block| block.file.is_some() || block.directory > 0;
    if !blocks.iter().any(placed) {
        blocks.clear();
    }
    Ok(Description {
        planes: planes.into_iter().max(),
        states_size: pixels.has_attribute("PhysicalSizeX"),
        voxel_size: voxel_size(pixels),
        blocks,
    })
}

fn number(node: Node, key: &str) -> Option<u64> {
    node.attribute(key)?.parse().ok()
}

fn block(data: Node) -> Block {
    let at = |key| number(data, key).unwrap_or(0);
    let uuid = data.children().find(|n| n.tag_name().name() == "UUID");
    let file = uuid.and_then(|n| n.attribute("FileName"));
    let one = data.has_attribute("IFD").then_some(1);
    // Only one of the three axes is longer than 1, so their sum is the plane.
    let [z, t, c] = ["FirstZ", "FirstT", "FirstC"].map(at);
    Block {
        plane: z.saturating_add(t).saturating_add(c),
        file: file.map(str::to_owned),
        directory: at("IFD"),
        planes: number(data, "PlaneCount").or(one),
    }
}

fn voxel_size(pixels: Node) -> Option<VoxelSize> {
    let size = |axis: &str| pixels.attribute(format!("PhysicalSize{axis}").as_str());
    let edge = |axis: &str| {
        let unit = pixels.attribute(format!("PhysicalSize{axis}Unit").as_str());
        Some(decimal(size(axis)?)? * metres_of_unit(unit.unwrap_or("um"))?)
    };
    let z = match size("Z") {
        None => None,
        Some(_) => Some(edge("Z")?),
    };
    VoxelSize::new(edge("X")?, edge("Y")?, z, "OME metadata")
}

/// The file, by its place in `files`, and the directory of each of `planes` planes; `pages` are how
/// many pages each file holds. Files without a list of them are one.
pub(crate) fn places(
    blocks: &[Block],
    planes: u64,
    files: &[String],
    pages: &[u64],
) -> Result<Vec<(usize, usize)>, String> {
    let held: u64 = pages.iter().sum();
    if planes != held {
        return Err(format!(
            "its OME description declares {planes} planes, but its files hold {held} pages"
        ));
    }
    let mut places = vec![None; planes as usize];
    for block in blocks {
        let named = |name: &String| files.binary_search(name).ok();
        let file = block.file.as_ref().and_then(named).unwrap_or(0);
        let left = pages[file].saturating_sub(block.directory);
        for k in 0..block.planes.unwrap_or(left) {
            let plane = block.plane.saturating_add(k);
            match places.get_mut(usize::try_from(plane).unwrap_or(usize::MAX)) {
                Some(place @ None) if k < left => {
                    *place = Some((file, (block.directory + k) as usize));
                }
                _ => {
                    return Err(format!(
                        "its OME description puts a page at plane {plane}, which is none or has one"
                    ));
                }
            }
        }
    }
    let places = (places.into_iter().enumerate()).map(|(plane, place)| {
        place.ok_or_else(|| format!("its OME description has no page for plane {plane}"))
    });
    let places: Vec<(usize, usize)> = places.collect::<Result<_, _>>()?;
    match places.iter().collect::<BTreeSet<_>>().len() < places.len() {
        true => Err("its OME description puts a page at two planes".into()),
        false => Ok(places),
    }
}
