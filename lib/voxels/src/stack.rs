//! A stack of any format, page by page.

mod memory;

use std::fs::File;
use std::path::{Path, PathBuf};

use particle_file::limits;

use crate::colours::Colours;
use crate::images::ImagePages;
use crate::raw::RawVolume;
use crate::sample::PageFormat;
use crate::series::Series;
use crate::source::{Source, quoted};
use crate::tiff::TiffPages;
use crate::voxel_size::VoxelSize;
use crate::{
    Dims, Error, RawType, folder, foreign, images, mhd, nifti, npy, npz, nrrd, pixels, tiff,
};

/// A stack of label or grey images, read page by page.
///
/// The stored sample value is the label, whatever a photometric interpretation, colour map or
/// lookup table would make of it; where a value shows another colour on another page, the colour is.
#[derive(Debug)]
pub struct Stack {
    name: String,
    pages: Pages,
    /// The colours that its pages are read as, where their stored values do not all show the same.
    colours: Option<Colours>,
    voxel_size: Option<VoxelSize>,
    /// What is missing among its slices.
    gap: Option<String>,
}

#[derive(Debug)]
enum Pages {
    Tiff(TiffPages),
    Images(ImagePages),
    Raw(RawVolume),
}

/// Bytes from which a format is told.
const HEAD: usize = 512;
const NO_SLICE: &str = "it is no slice of a stack; accepted are TIFF, BMP, PNG and JPEG";
const NO_STACK: &str = "it is not a stack; accepted are TIFF, BigTIFF, .npy, .npz, .mhd, .nrrd and .nii files, folders of TIFF, BMP, PNG or JPEG slices, and with --dims and --type raw volumes";

impl Stack {
    /// Opens one multi-page TIFF, `.npy`, `.npz`, MetaImage, NRRD or NIfTI file (`-` is standard
    /// input), one folder of slices (TIFF, BMP, PNG, JPEG), or several slices, which are put in
    /// the order of their numbers.
    ///
    /// All headers are read and checked here; pixels are read by [`Stack::read_page`].
    ///
    /// # Errors
    /// A file that cannot be read, is of another kind, or whose pages do not make a stack.
    pub fn open(paths: &[PathBuf]) -> Result<Self, Error> {
        match paths {
            [] => Err(Error::Usage("no stack is given".into())),
            [path] if path.is_dir() => Self::of_slices(quoted(path), folder::slices(path)?),
            [path] => Self::of_file(path),
            slices => {
                let name = format!("{} and {} more", quoted(&slices[0]), slices.len() - 1);
                Self::of_slices(name, slices.to_vec())
            }
        }
    }

    fn of_slices(name: String, paths: Vec<PathBuf>) -> Result<Self, Error> {
        let series = Series::of(paths).map_err(|what| Error::file(&name, what))?;
        let sources = (series.slices.iter())
            .map(|path| Source::open_slice(path))
            .collect::<Result<Vec<_>, _>>()?;
        let head = match sources.first() {
            Some(first) => first.window(0, HEAD).map_err(|e| Error::io(first, e))?,
            None => Vec::new(),
        };
        let (pages, voxel_size) = if images::is_image(&head) {
            (Pages::Images(images::open(sources)?), None)
        } else if tiff::is_tiff(&head) {
            let (pages, voxel_size) = tiff::open_slices(sources)?;
            (Pages::Tiff(pages), voxel_size)
        } else {
            let first = sources.first().map_or(name.as_str(), Source::name);
            return Err(Error::file(first, NO_SLICE));
        };
        Self::new(name, pages, voxel_size, series.gap)
    }

    /// Opens a file of nothing but pixels, x fastest.
    ///
    /// # Errors
    /// A file that cannot be read or is of another size.
    pub fn open_raw(path: &Path, dims: Dims, kind: RawType) -> Result<Self, Error> {
        if path.as_os_str() == "-" {
            return Err(Error::Usage(
                "a raw volume cannot come from standard input: give the name of its file".into(),
            ));
        }
        let source = Source::open(path)?;
        let (name, len) = (source.name().to_owned(), source.len());
        let [width, height, pages] = dims.0;
        let format = PageFormat {
            width,
            height,
            sample: kind.sample,
            channels: 1,
        };
        let declared = format.page_bytes().and_then(|n| n.checked_mul(pages));
        if declared.map(|n| n as u64) != Some(len) {
            return Err(Error::Usage(format!(
                "{name}: {width} x {height} x {pages} voxels, {}, are {} bytes, but it holds {len}: check --dims and --type",
                kind.sample,
                declared.map_or("more".into(), |n| n.to_string())
            )));
        }
        let volume = RawVolume::new(vec![source], format, pages, 0, kind.big_endian)?;
        Self::new(name, Pages::Raw(volume), None, None)
    }

    fn of_file(path: &Path) -> Result<Self, Error> {
        Self::of_source(Source::open(path)?, path)
    }

    /// Opens a regular file that is open already, e.g. what a pipe was copied to; `name`
    /// stands for it in messages.
    ///
    /// # Errors
    /// As [`Stack::open`].
    pub fn of_open_file(name: &str, file: File) -> Result<Self, Error> {
        let source = Source::of_file(name.to_owned(), file).map_err(|e| Error::io(name, e))?;
        Self::of_source(source, Path::new(name))
    }

    fn of_source(source: Source, path: &Path) -> Result<Self, Error> {
        let name = source.name().to_owned();
        let head = source.window(0, HEAD).map_err(|e| Error::io(&name, e))?;
        let (pages, voxel_size) = if tiff::is_tiff(&head) {
            let (pages, voxel_size) = tiff::open(source)?;
            (Pages::Tiff(pages), voxel_size)
        } else if npy::is_npy(&head) {
            (Pages::Raw(npy::open(source)?), None)
        } else if mhd::is_mhd(&head) {
            let (volume, voxel_size) = mhd::open(source, path)?;
            (Pages::Raw(volume), voxel_size)
        } else if nrrd::is_nrrd(&head) {
            let (volume, voxel_size) = nrrd::open(source, path)?;
            (Pages::Raw(volume), voxel_size)
        } else if nifti::is_nifti(&head) || pixels::is_gzip(&head) {
            let (volume, voxel_size) = nifti::open(source)?;
            (Pages::Raw(volume), voxel_size)
        } else if npz::is_zip(&head) {
            (Pages::Raw(npz::open(source)?), None)
        } else if images::is_image(&head) {
            (Pages::Images(images::open(vec![source])?), None)
        } else {
            let known = foreign::conversion(&head);
            return Err(Error::file(name, known.unwrap_or(NO_STACK)));
        };
        Self::new(name, pages, voxel_size, None)
    }

    /// A stack that declares no more voxels than its files can be worth, and whose pages are labelled alike.
    fn new(
        name: String,
        pages: Pages,
        voxel_size: Option<VoxelSize>,
        gap: Option<String>,
    ) -> Result<Self, Error> {
        let mut stack = Self {
            name,
            pages,
            colours: None,
            voxel_size,
            gap,
        };
        stack.check_size()?;
        let shown = match &stack.pages {
            Pages::Tiff(pages) => pages.shown(),
            Pages::Images(pages) => pages.shown(),
            Pages::Raw(_) => Vec::new(),
        };
        stack.colours = Colours::of(shown, stack.format().sample).map_err(|unlike| {
            let [a, b] = unlike.map(|z| stack.page_name(z));
            let what = format!("a stored value shows another colour in {a} than in {b}, so that it is no label of the stack: save all pages with the same photometric interpretation and colour map");
            Error::file(&stack.name, what)
        })?;
        Ok(stack)
    }

    fn check_size(&self) -> Result<(), Error> {
        let dims = self.dims().map(|n| n as u64);
        let [x, y, z] = dims;
        let bytes: u64 = self.sources().iter().map(Source::len).sum();
        let most =
            (bytes.saturating_mul(limits::VOXELS_PER_BYTE)).saturating_add(limits::MADE_AT_LEAST);
        if dims.iter().any(|&n| n > limits::PER_AXIS) {
            let what = format!(
                "it declares {x} x {y} x {z} voxels, more than {} along an axis",
                limits::PER_AXIS
            );
            return Err(Error::file(&self.name, what));
        }
        if limits::volume(dims) > most {
            let what = format!(
                "it declares {x} x {y} x {z} voxels in {bytes} bytes, more than {} for each byte",
                limits::VOXELS_PER_BYTE
            );
            return Err(Error::file(&self.name, what));
        }
        Ok(())
    }

    /// Whether a file that begins with `head` is of an accepted kind.
    pub fn recognises(head: &[u8]) -> bool {
        tiff::is_tiff(head)
            || npy::is_npy(head)
            || npz::is_zip(head)
            || mhd::is_mhd(head)
            || nrrd::is_nrrd(head)
            || nifti::is_nifti(head)
            || pixels::is_gzip(head)
            || images::is_image(head)
    }

    /// The stack's name as it stands in messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Numbers of voxels along x (columns), y (rows), z (pages).
    pub fn dims(&self) -> [usize; 3] {
        let format = self.format();
        let pages = match &self.pages {
            Pages::Tiff(pages) => pages.len(),
            Pages::Images(pages) => pages.len(),
            Pages::Raw(volume) => volume.pages(),
        };
        [format.width, format.height, pages]
    }

    /// What every page shares.
    pub fn format(&self) -> PageFormat {
        let stored = match &self.pages {
            Pages::Tiff(pages) => pages.format(),
            Pages::Images(pages) => pages.format(),
            Pages::Raw(volume) => volume.format(),
        };
        let channels = if self.colours.is_some() {
            3
        } else {
            stored.channels
        };
        PageFormat { channels, ..stored }
    }

    /// Refuses numbers as labels where a number shows another colour on another page.
    pub(crate) fn check_numbers(&self) -> Result<(), Error> {
        let Some(colours) = &self.colours else {
            return Ok(());
        };
        let [a, b] = colours
            .unlike
            .map(|z| (self.page_name(z), colours.first(z)));
        Err(Error::Usage(format!(
            "{}: the values 0, 1, ... show {} in {} but {} in {}, so that no number is a label of the stack: give the colours as R:G:B in --labels",
            self.name, a.1, a.0, b.1, b.0
        )))
    }

    /// The voxel size that the metadata state, if they do.
    pub fn voxel_size(&self) -> Option<&VoxelSize> {
        self.voxel_size.as_ref()
    }

    /// A sentence about slices that seem to be missing, by the numbers in their names.
    pub fn gap(&self) -> Option<&str> {
        self.gap.as_deref()
    }

    /// Whether the compression of its pages changes values, so that labels do not survive it.
    pub(crate) fn is_lossy(&self) -> bool {
        matches!(&self.pages, Pages::Images(pages) if pages.lossy())
    }

    /// The files read, e.g. to hash them.
    pub fn sources(&self) -> &[Source] {
        match &self.pages {
            Pages::Tiff(pages) => pages.sources(),
            Pages::Images(pages) => pages.sources(),
            Pages::Raw(volume) => volume.sources(),
        }
    }

    /// Reads page `z` (from 0) into `page`: rows from y = 0, pixels from x = 0, channels
    /// interleaved, samples in native byte order.
    ///
    /// # Errors
    /// A page that does not decode to its declared size.
    pub fn read_page(&self, z: usize, page: &mut Vec<u8>) -> Result<(), Error> {
        // No reader may rely on writing every byte: the page before would show through.
        page.clear();
        match &self.pages {
            Pages::Tiff(pages) => pages.read(z, page)?,
            Pages::Images(pages) => pages.read(z, page)?,
            Pages::Raw(volume) => volume.read(z, page)?,
        }
        match &self.colours {
            Some(colours) => {
                (colours.show(z, page)).map_err(|what| Error::file(self.page_name(z), what))
            }
            None => Ok(()),
        }
    }

    /// Page `z` as it stands in messages.
    pub(crate) fn page_name(&self, z: usize) -> String {
        match &self.pages {
            Pages::Tiff(pages) => pages.page_name(z),
            Pages::Images(pages) => pages.page_name(z),
            Pages::Raw(_) => format!("{}, page {}", self.name, z + 1),
        }
    }
}
