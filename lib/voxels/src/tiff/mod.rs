//! TIFF and BigTIFF stacks.

mod decode;
mod describe;
mod encoding;
mod ifd;
mod layout;
mod write;

pub(crate) use ifd::is_tiff;
pub use write::TiffWriter;

use std::sync::Arc;

use particle_file::limits;

use crate::Error;
use crate::colours::Shown;
use crate::sample::PageFormat;
use crate::source::Source;
use crate::voxel_size::VoxelSize;
use describe::Description;
use ifd::Container;
use layout::PageLayout;

/// The pages of one TIFF file, or of a file per page.
#[derive(Debug)]
pub(crate) struct TiffPages {
    /// One file, or as many as pages.
    sources: Vec<Source>,
    /// At least one page; all have the format of the first.
    pages: Vec<PageLayout>,
}

/// Opens one file with all its pages.
pub(crate) fn open(source: Source) -> Result<(TiffPages, Option<VoxelSize>), Error> {
    let (mut pages, description) = read_directories(&source)?;
    let stated = description.planes.filter(|n| *n > 0);
    if let Some(planes) = stated.filter(|n| *n != pages.len() as u64) {
        pages = following_planes(&source, &pages, planes)?;
    }
    same_format(&pages, |_| &source)?;
    let sources = vec![source];
    Ok((TiffPages { sources, pages }, description.voxel_size))
}

/// Opens files of one page each, in this order.
pub(crate) fn open_slices(sources: Vec<Source>) -> Result<(TiffPages, Option<VoxelSize>), Error> {
    let mut pages = Vec::with_capacity(sources.len());
    let mut sizes = Vec::new();
    for source in &sources {
        let (mut page, description) = read_directories(source)?;
        if page.len() != 1
            || description
                .planes
                .is_some_and(|n| n != 1 && n != sources.len() as u64)
        {
            let what = format!(
                "it holds {} pages; a stack of several files is made of files of one page",
                description.planes.unwrap_or(page.len() as u64)
            );
            return Err(Error::file(source, what));
        }
        pages.append(&mut page);
        sizes.extend(description.voxel_size);
    }
    same_format(&pages, |i| &sources[i])?;
    // Slices that contradict one another state no size.
    sizes.dedup();
    let voxel_size = sizes.pop().filter(|_| sizes.is_empty());
    Ok((TiffPages { sources, pages }, voxel_size))
}

/// The layouts of a file's directories and what the first says about the file.
fn read_directories(source: &Source) -> Result<(Vec<PageLayout>, Description), Error> {
    let file = source.file().map_err(|e| Error::io(source, e))?;
    let tiff = Container::open(source, &file).map_err(|what| Error::file(source, what))?;
    let directories = tiff
        .directories()
        .map_err(|(page, what)| Error::page(source, page, what))?;
    let pages = directories
        .iter()
        .enumerate()
        .map(|(i, directory)| {
            PageLayout::read_planes(&tiff, directory, source.len())
                .map_err(|what| Error::page(source, i, what))
        })
        .collect::<Result<Vec<_>, _>>()?
        .concat();
    let (Some(directory), Some(page)) = (directories.first(), pages.first()) else {
        return Err(Error::file(source, "it holds no page"));
    };
    let description =
        describe::describe(&tiff, directory, page).map_err(|what| Error::page(source, 0, what))?;
    if directories.len() == 1 {
        let planes = description.planes.unwrap_or(1).max(1);
        let described = stored_bytes(&pages).saturating_mul(planes);
        let described = described.saturating_add(directory.bytes);
        nothing_behind(source, page, described)?;
    }
    Ok((pages, description))
}

fn stored_bytes(pages: &[PageLayout]) -> u64 {
    let chunks = pages.iter().flat_map(|page| &page.chunks);
    chunks.fold(0, |sum, (_, bytes)| sum.saturating_add(*bytes))
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

/// The layouts of planes that stand one after another behind a single directory.
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
    (0..planes.min(limits::PER_AXIS + 1))
        .map(|k| {
            let k = k as usize;
            page.following_plane(k, source.len())
                .map_err(|what| Error::page(source, k, what))
        })
        .collect()
}

fn same_format<'a>(
    pages: &[PageLayout],
    source: impl Fn(usize) -> &'a Source,
) -> Result<(), Error> {
    let odd = |own: &dyn Fn(&PageLayout) -> String| {
        let first = own(pages.first()?);
        let odd = pages.iter().position(|page| own(page) != first)?;
        let own = own(&pages[odd]);
        let what = format!("it is {own} but page 1 is {first}; the pages of a stack must be alike");
        Some(Error::page(source(odd), odd, what))
    };
    let format = odd(&|page| page.format.to_string());
    let turned = || odd(&|page| format!("of orientation {}", page.orientation));
    format.or_else(turned).map_or(Ok(()), Err)
}

impl TiffPages {
    pub(crate) fn len(&self) -> usize {
        self.pages.len()
    }

    /// Whether pages are read as they are stored, without a copy to decode.
    pub(crate) fn are_plain(&self) -> bool {
        self.pages.iter().all(PageLayout::is_plain)
    }

    pub(crate) fn format(&self) -> PageFormat {
        self.pages[0].format
    }

    pub(crate) fn shown(&self) -> Vec<Arc<Shown>> {
        let shown = |page: &PageLayout| Arc::clone(&page.shown);
        self.pages.iter().map(shown).collect()
    }

    pub(crate) fn sources(&self) -> &[Source] {
        &self.sources
    }

    fn source(&self, z: usize) -> &Source {
        self.sources.get(z).unwrap_or(&self.sources[0])
    }

    /// Page `z` as it stands in messages.
    pub(crate) fn page_name(&self, z: usize) -> String {
        format!("{}, page {} of {}", self.source(z), z + 1, self.len())
    }

    pub(crate) fn read(&self, z: usize, page: &mut Vec<u8>) -> Result<(), Error> {
        let Some(layout) = self.pages.get(z) else {
            return Err(Error::Usage(format!("there is no page {}", z + 1)));
        };
        let source = self.source(z);
        let file = source.file().map_err(|e| Error::io(source, e))?;
        decode::read(&file, layout, page).map_err(|what| Error::page(source, z, what))
    }
}
