//! TIFF and BigTIFF stacks.

mod decode;
mod describe;
mod encoding;
mod ifd;
mod layout;
mod ome;
mod write;

pub use write::TiffWriter;

use std::path::Path;
use std::sync::Arc;

use particle_file::limits;

use crate::Error;
use crate::beside::data_file;
use crate::source::Source;
use crate::volume::{Pixels, Volume};
use describe::Description;
use ifd::Container;
use layout::PageLayout;

/// Opens one file with all its pages, or the files that it tells of.
pub(crate) fn open(source: Source) -> Result<Volume, Error> {
    let (mut pages, mut description) = read_directories(&source, true)?;
    let files = description.files(&source);
    if !files.is_empty() {
        return open_set(&source, &files, description);
    }
    let stated = description.planes.filter(|n| *n > 0);
    if let Some(planes) = stated.filter(|n| *n != pages.len() as u64) {
        pages = following_planes(&source, &pages, planes)?;
    }
    in_order(vec![(source, pages)], &files, description)
}

/// Opens files of one page each, in this order unless they tell of another.
pub(crate) fn open_slices(sources: Vec<Source>) -> Result<Volume, Error> {
    let total = sources.len() as u64;
    let mut slices = Vec::with_capacity(sources.len());
    let mut sizes = Vec::new();
    for source in sources {
        let (pages, mut description) = read_directories(&source, true)?;
        let files = description.files(&source);
        if !files.is_empty() {
            let planes = description.planes;
            let set = open_set(&source, &files, description)?;
            if planes != Some(total) || files.len() as u64 != total {
                let what = format!(
                    "its OME description tells of {} files, and {total} slices are given: name one of them",
                    files.len()
                );
                return Err(Error::file(&source, what));
            }
            return Ok(set);
        }
        let one = |n: u64| n == 1 || n == total;
        if pages.len() != 1 || !description.planes.is_none_or(one) {
            let what = format!(
                "it holds {} pages; a stack of several files is made of files of one page",
                description.planes.unwrap_or(pages.len() as u64)
            );
            return Err(Error::file(source, what));
        }
        slices.push((source, pages));
        sizes.extend(description.voxel_size);
    }
    // Slices that contradict one another state no size.
    sizes.dedup();
    let description = Description {
        voxel_size: sizes.pop().filter(|_| sizes.is_empty()),
        ..Description::default()
    };
    in_order(slices, &[], description)
}

/// Opens the files beside `first` that its description tells of.
fn open_set(first: &Source, files: &[String], description: Description) -> Result<Volume, Error> {
    let mut set = Vec::with_capacity(files.len());
    for file in files {
        let path = data_file(first.path(), Path::new(file), "OME FileName");
        let source = Source::open_slice(&path.map_err(|what| Error::file(first, what))?)?;
        let (pages, _) = read_directories(&source, false)?;
        set.push((source, pages));
    }
    in_order(set, files, description)
}

/// The pages of files, which are called `names` where their description places their pages.
fn in_order(
    files: Vec<(Source, Vec<PageLayout>)>,
    names: &[String],
    description: Description,
) -> Result<Volume, Error> {
    let (sources, layouts): (Vec<_>, Vec<_>) = files.into_iter().unzip();
    let held: Vec<u64> = layouts.iter().map(|pages| pages.len() as u64).collect();
    let pages: Vec<(usize, PageLayout)> = match description.blocks.as_slice() {
        [] => (layouts.into_iter().enumerate())
            .flat_map(|(file, pages)| pages.into_iter().map(move |page| (file, page)))
            .collect(),
        blocks => (ome::places(blocks, description.planes.unwrap_or(1), names, &held))
            .map_err(|what| Error::file(&sources[0], what))?
            .into_iter()
            .map(|(file, page)| (file, layouts[file][page].clone()))
            .collect(),
    };
    let (source_of, pages): (Vec<usize>, Vec<PageLayout>) = pages.into_iter().unzip();
    are_alike(&pages).map_err(|(odd, what)| Error::page(&sources[source_of[odd]], odd, what))?;
    Ok(Volume {
        format: pages[0].format,
        pages: pages.len(),
        voxel_size: description.voxel_size,
        shown: pages.iter().map(|page| Arc::clone(&page.shown)).collect(),
        lossy: false,
        // Pages that are stored as they are read need no copy to decode.
        copies: [3, 1][usize::from(pages.iter().all(PageLayout::is_plain))],
        pixels: Box::new(pages),
        source_of,
        sources,
    })
}

/// The layouts of a file's directories and, where it is `described`, what the first says about the file.
fn read_directories(
    source: &Source,
    described: bool,
) -> Result<(Vec<PageLayout>, Description), Error> {
    let file = source.file().map_err(|e| Error::io(source, e))?;
    let tiff = Container::open(source, &file).map_err(|what| Error::file(source, what))?;
    let wrong = |(page, what)| Error::page(source, page, what);
    let directories = tiff.directories().map_err(wrong)?;
    let mut pages = Vec::new();
    for (i, directory) in directories.iter().enumerate() {
        let planes = PageLayout::read_planes(directory, source.len());
        pages.extend(planes.map_err(|what| wrong((i, what)))?);
    }
    let (Some(directory), Some(page)) = (directories.first(), pages.first()) else {
        return Err(Error::file(source, "it holds no page"));
    };
    let description = match described {
        true => describe::describe(directory, page).map_err(|what| wrong((0, what)))?,
        false => Description::default(),
    };
    if directories.len() == 1 {
        let planes = description.planes.unwrap_or(1).max(1);
        let chunks = pages.iter().flat_map(|page| &page.chunks);
        let stored = chunks.fold(0_u64, |sum, (_, bytes)| sum.saturating_add(*bytes));
        let stored = stored.saturating_mul(planes);
        nothing_behind(source, page, stored.saturating_add(directory.bytes))?;
    }
    Ok((pages, description))
}

/// Refuses a file of one directory, which describes so many bytes, with room for another plane in the others:
/// some programs write planes there that only their own tags tell of.
fn nothing_behind(source: &Source, page: &PageLayout, described: u64) -> Result<(), Error> {
    let (_, plane) = page.plane_bytes().unwrap_or_default();
    let plane = (plane * page.planes()) as u64;
    let rest = source.len().saturating_sub(described);
    if rest < plane {
        return Ok(());
    }
    let what = format!(
        "its only directory describes {described} of its bytes, and the {rest} others have room for more planes of {plane} bytes: save it with a directory for each plane"
    );
    Err(Error::file(source, what))
}

fn following_planes(
    source: &Source,
    pages: &[PageLayout],
    planes: u64,
) -> Result<Vec<PageLayout>, Error> {
    let [page] = pages else {
        let what = format!(
            "its description declares {planes} planes but it holds {} pages",
            pages.len()
        );
        return Err(Error::file(source, what));
    };
    // One more than a stack may have, which is refused as a whole.
    let planes = 0..planes.min(limits::PER_AXIS + 1) as usize;
    let plane = |k| {
        page.following_plane(k, source.len())
            .map_err(|what| Error::page(source, k, what))
    };
    planes.map(plane).collect()
}

/// The first page that is unlike the first, and a sentence.
fn are_alike(pages: &[PageLayout]) -> Result<(), (usize, String)> {
    let alike = |own: &dyn Fn(&PageLayout) -> String| {
        let first = own(&pages[0]);
        let mut owns = pages.iter().map(own).enumerate();
        let odd = owns.find(|(_, own)| *own != first);
        odd.map_or(Ok(()), |(odd, own)| {
            let what =
                format!("it is {own} but page 1 is {first}; the pages of a stack must be alike");
            Err((odd, what))
        })
    };
    alike(&|page| page.format.to_string())?;
    alike(&|page| format!("of orientation {}", page.orientation))
}

impl Pixels for Vec<PageLayout> {
    fn read(&self, volume: &Volume, z: usize, page: &mut Vec<u8>) -> Result<(), Error> {
        let source = &volume.sources[volume.source_of[z]];
        let file = source.file().map_err(|e| Error::io(source, e))?;
        decode::read(&file, &self[z], page).map_err(|what| Error::page(source, z, what))
    }
}
