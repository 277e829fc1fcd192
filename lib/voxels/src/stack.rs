//! A stack of any format, page by page.

use std::fs::File;
use std::path::{Path, PathBuf};

use particle_file::limits;

use crate::colours;
use crate::kind::{HEAD, Kind};
use crate::raw::Raw;
use crate::sample::PageFormat;
use crate::series::Series;
use crate::source::{Source, quoted};
use crate::volume::Volume;
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
    volume: Volume,
    /// Two pages on which a stored value shows two colours, where there are such: pages are read as colours.
    unlike: Option<[usize; 2]>,
    /// What is missing among its slices.
    gap: Option<String>,
}

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
            [path] => Self::of_source(Source::open(path)?),
            slices => {
                let name = format!("{} and {} more", quoted(&slices[0]), slices.len() - 1);
                Self::of_slices(name, slices.to_vec())
            }
        }
    }

    fn of_slices(name: String, paths: Vec<PathBuf>) -> Result<Self, Error> {
        let series = Series::of(paths).map_err(|what| Error::file(&name, what))?;
        let slices = series.slices.iter().map(|path| Source::open_slice(path));
        let sources = slices.collect::<Result<Vec<_>, _>>()?;
        let first = &sources[0];
        let head = first.window(0, HEAD).map_err(|e| Error::io(first, e))?;
        let volume = match Kind::of(&head) {
            Some(Kind::Tiff) => tiff::open_slices(sources)?,
            Some(kind) if kind.is_image() => images::open(sources)?,
            _ => return Err(Error::file(first, NO_SLICE)),
        };
        Self::new(name, volume, series.gap)
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
        let [width, height, pages] = dims.0;
        let raw = Raw {
            format: PageFormat::new([width, height], kind.sample, 1),
            pages,
            offset: 0,
            big_endian: kind.big_endian,
        };
        let checked = raw.check(&source);
        checked.map_err(|e| Error::Usage(format!("{e}; check --dims and --type")))?;
        let name = source.to_string();
        Self::new(name, raw.volume(vec![source], None)?, None)
    }

    /// Opens a regular file that is open already, e.g. what a pipe was copied to; `name`
    /// stands for it in messages.
    ///
    /// # Errors
    /// As [`Stack::open`].
    pub fn of_open_file(name: &str, file: File) -> Result<Self, Error> {
        Self::of_source(Source::of_file(name.into(), name.into(), file)?)
    }

    fn of_source(source: Source) -> Result<Self, Error> {
        let name = source.to_string();
        let head = source.window(0, HEAD).map_err(|e| Error::io(&name, e))?;
        let volume = match Kind::of(&head) {
            Some(Kind::Tiff) => tiff::open(source)?,
            Some(Kind::Npy) => npy::open(source, None)?,
            Some(Kind::Npz) => npz::open(source)?,
            Some(Kind::MetaImage) => pixels::open(source, mhd::parse)?,
            Some(Kind::Nrrd) => pixels::open(source, nrrd::parse)?,
            Some(Kind::Nifti) => nifti::open(source)?,
            Some(Kind::Bmp | Kind::Png | Kind::Jpeg) => images::open(vec![source])?,
            None => {
                let known = foreign::conversion(&head);
                let what = known.map_or(NO_STACK.into(), |known| format!("it is {known}"));
                return Err(Error::file(name, what));
            }
        };
        Self::new(name, volume, None)
    }

    /// A stack that declares no more voxels than its files can be worth, and whose pages are labelled alike.
    pub(crate) fn new(name: String, volume: Volume, gap: Option<String>) -> Result<Self, Error> {
        let mut stack = Self {
            name,
            volume,
            unlike: None,
            gap,
        };
        stack.check_size()?;
        stack.unlike = colours::unlike(&stack.volume.shown, stack.format().sample).map_err(|unlike| {
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
        let most = bytes.saturating_mul(limits::VOXELS_PER_BYTE);
        let more = if dims.iter().any(|&n| n > limits::PER_AXIS) {
            format!(", more than {} along an axis", limits::PER_AXIS)
        } else if limits::volume(dims) > most.saturating_add(limits::MADE_AT_LEAST) {
            let most = limits::VOXELS_PER_BYTE;
            format!(" in {bytes} bytes, more than {most} for each byte")
        } else {
            return Ok(());
        };
        let what = format!("it declares {x} x {y} x {z} voxels{more}");
        Err(Error::file(&self.name, what))
    }

    /// Whether a file that begins with `head` is of an accepted kind.
    pub fn recognises(head: &[u8]) -> bool {
        Kind::of(head).is_some()
    }

    /// The stack's name as it stands in messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Numbers of voxels along x (columns), y (rows), z (pages).
    pub fn dims(&self) -> [usize; 3] {
        let Volume { format, pages, .. } = self.volume;
        [format.width, format.height, pages]
    }

    /// What every page shares.
    pub fn format(&self) -> PageFormat {
        let mut format = self.volume.format;
        if self.unlike.is_some() {
            format.channels = 3;
        }
        format
    }

    /// Refuses numbers as labels where a number shows another colour on another page.
    pub(crate) fn check_numbers(&self) -> Result<(), Error> {
        let Some(unlike) = self.unlike else {
            return Ok(());
        };
        let first = |z: usize| self.volume.shown[z].first();
        let [a, b] = unlike.map(|z| format!("{} in {}", first(z), self.page_name(z)));
        Err(Error::Usage(format!(
            "{}: the values 0, 1, ... show {a} but {b}, so that no number is a label of the stack: give the colours as R:G:B in --labels",
            self.name
        )))
    }

    /// Refuses to take grey values of pixels that are not one number.
    pub(crate) fn check_grey(&self) -> Result<(), Error> {
        self.check_numbers()?;
        match self.format().channels {
            1 => Ok(()),
            _ => Err(Error::Usage(format!(
                "{}: grey values are asked for but its pixels are R:G:B; give R:G:B labels instead",
                self.name
            ))),
        }
    }

    /// The voxel size that the metadata state, if they do.
    pub fn voxel_size(&self) -> Option<&VoxelSize> {
        self.volume.voxel_size.as_ref()
    }

    /// A sentence about slices that seem to be missing, by the numbers in their names.
    pub fn gap(&self) -> Option<&str> {
        self.gap.as_deref()
    }

    /// Whether the compression of its pages changes values, so that labels do not survive it.
    pub(crate) fn is_lossy(&self) -> bool {
        self.volume.lossy
    }

    /// The files read, e.g. to hash them.
    pub fn sources(&self) -> &[Source] {
        &self.volume.sources
    }

    /// Reads page `z` (from 0) into `page`: rows from y = 0, pixels from x = 0, channels
    /// interleaved, samples in native byte order.
    ///
    /// # Errors
    /// A page that does not decode to its declared size.
    pub fn read_page(&self, z: usize, page: &mut Vec<u8>) -> Result<(), Error> {
        // No reader may rely on writing every byte: the page before would show through.
        page.clear();
        let volume = &self.volume;
        if z >= volume.pages {
            return Err(Error::Usage(format!("there is no page {}", z + 1)));
        }
        volume.pixels.read(volume, z, page)?;
        if self.unlike.is_some() {
            let shown = volume.shown[z].in_place_of(page);
            *page = shown.map_err(|what| Error::file(self.page_name(z), what))?;
        }
        Ok(())
    }

    /// Page `z` as it stands in messages.
    pub(crate) fn page_name(&self, z: usize) -> String {
        let Volume { sources, pages, .. } = &self.volume;
        match self.volume.source_of.get(z) {
            Some(&file) => format!("{}, page {} of {pages}", sources[file], z + 1),
            None => format!("{}, page {}", self.name, z + 1),
        }
    }

    /// Memory that the threads take at most to read pages: each page, and what it is decoded from.
    pub(crate) fn reading_bytes(&self) -> u64 {
        let page = self.format().volume_bytes(self.volume.copies);
        let threads = rayon::current_num_threads().min(self.volume.pages);
        page.unwrap_or(u64::MAX).saturating_mul(threads as u64)
    }

    /// Refuses a stack of which `bytes` would be made that are not to be had here.
    pub(crate) fn fits(&self, bytes: u64) -> Result<(), Error> {
        machine::shortage(bytes).map_or(Ok(()), |short| {
            let [x, y, z] = self.dims();
            let what = format!(
                "reading its {x} x {y} x {z} voxels needs {short}: keep less of it by xct2particles --crop, or take fewer --threads or a larger machine"
            );
            Err(Error::file(&self.name, what))
        })
    }
}
