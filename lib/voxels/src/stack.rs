//! A stack of any format, page by page.

mod memory;

use std::fs::File;
use std::path::{Path, PathBuf};

use particle_file::limits;

use crate::images::ImagePages;
use crate::raw::RawVolume;
use crate::sample::PageFormat;
use crate::source::{Source, quoted};
use crate::tiff::TiffPages;
use crate::voxel_size::VoxelSize;
use crate::{
    Dims, Error, RawType, folder, foreign, images, mhd, nifti, npy, npz, nrrd, tiff, unpacked,
};

/// A stack of label or grey images, read page by page.
///
/// The stored sample value is the label, whatever a photometric interpretation, colour map or
/// lookup table would make of it.
#[derive(Debug)]
pub struct Stack {
    name: String,
    pages: Pages,
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
const NO_STACK: &str = "it is not a stack; accepted are TIFF, BigTIFF, .npy, .npz, .mhd, .nrrd and .nii files, folders of TIFF, BMP, PNG or JPEG slices, and with --dims and --type raw volumes";

impl Stack {
    /// Opens one multi-page TIFF, `.npy`, `.npz`, MetaImage, NRRD or NIfTI file (`-` is standard
    /// input), one folder of slices (TIFF, BMP, PNG, JPEG), or several slices, which are put in
    /// natural order.
    ///
    /// All headers are read and checked here; pixels are read by [`Stack::read_page`].
    ///
    /// # Errors
    /// A file that cannot be read, is of another kind, or whose pages do not make a stack.
    pub fn open(paths: &[PathBuf]) -> Result<Self, Error> {
        match paths {
            [] => Err(Error::Usage("no stack is given".into())),
            [path] if path.is_dir() => Self::of_slices(quoted(path), &folder::slices(path)?),
            [path] => Self::of_file(path),
            slices => {
                let mut slices = slices.to_vec();
                folder::sort_naturally(&mut slices);
                let name = format!("{} and {} more", quoted(&slices[0]), slices.len() - 1);
                Self::of_slices(name, &slices)
            }
        }
    }

    fn of_slices(name: String, paths: &[PathBuf]) -> Result<Self, Error> {
        let sources = paths
            .iter()
            .map(|path| Source::open_slice(path))
            .collect::<Result<Vec<_>, _>>()?;
        let head = match sources.first() {
            Some(first) => first.window(0, HEAD).map_err(|e| Error::io(first, e))?,
            None => Vec::new(),
        };
        let (pages, voxel_size) = if images::is_image(&head) {
            (Pages::Images(images::open(sources)?), None)
        } else {
            let (pages, voxel_size) = tiff::open_slices(sources)?;
            (Pages::Tiff(pages), voxel_size)
        };
        Self {
            name,
            pages,
            voxel_size,
            gap: folder::gap(paths),
        }
        .within_limits()
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
        Self {
            name,
            pages: Pages::Raw(volume),
            voxel_size: None,
            gap: None,
        }
        .within_limits()
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
        } else if nifti::is_nifti(&head) || unpacked::is_gzip(&head) {
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
        Self {
            name,
            pages,
            voxel_size,
            gap: None,
        }
        .within_limits()
    }

    /// Refuses a stack that declares more voxels than its files can be worth.
    fn within_limits(self) -> Result<Self, Error> {
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
            return Err(Error::file(self.name, what));
        }
        if limits::volume(dims) > most {
            let what = format!(
                "it declares {x} x {y} x {z} voxels in {bytes} bytes, more than {} for each byte",
                limits::VOXELS_PER_BYTE
            );
            return Err(Error::file(self.name, what));
        }
        Ok(self)
    }

    /// Whether a file that begins with `head` is of an accepted kind.
    pub fn recognises(head: &[u8]) -> bool {
        tiff::is_tiff(head)
            || npy::is_npy(head)
            || npz::is_zip(head)
            || mhd::is_mhd(head)
            || nrrd::is_nrrd(head)
            || nifti::is_nifti(head)
            || unpacked::is_gzip(head)
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
        match &self.pages {
            Pages::Tiff(pages) => pages.format(),
            Pages::Images(pages) => pages.format(),
            Pages::Raw(volume) => volume.format(),
        }
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
        match &self.pages {
            Pages::Tiff(pages) => pages.read(z, page),
            Pages::Images(pages) => pages.read(z, page),
            Pages::Raw(volume) => volume.read(z, page),
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
