//! Noise of grey values taken out by a median filter.

use std::io::{BufWriter, IntoInnerError, Write};

use particle_file::temporary_file;
use rayon::prelude::*;

use crate::lattice::around;
use crate::raw::Raw;
use crate::sample::PageFormat;
use crate::{Crop, Error, Stack};

/// Pages as large as its own, in bytes and as numbers, that are held for one page.
const WINDOW: u64 = 3 * (1 + size_of::<f64>() as u64);

impl Stack {
    /// The voxels of `crop` as a stack of its own in a temporary file: each has the median of itself and its neighbours at
    /// faces, edges and corners (Tukey 1977). Edges of phases stay; what is one voxel thin may go. `on_page` follows each page.
    ///
    /// # Errors
    /// A page that cannot be read, pixels that are not one finite number, a crop that reaches out, too little memory or room.
    pub fn denoised(&self, crop: &Crop, on_page: impl Fn()) -> Result<Self, Error> {
        crop.check(self.dims())?;
        self.check_grey()?;
        self.fits(self.reading_bytes().saturating_mul(WINDOW))?;
        let [nx, ny, nz] = crop.dims();
        let raw = Raw {
            format: PageFormat::new([nx, ny], self.format().sample, 1),
            pages: nz,
            offset: 0,
            big_endian: cfg!(target_endian = "big"),
        };
        let failed = |e| Error::io(self.name(), e);
        let bytes = raw.format.volume_bytes(nz).unwrap_or(u64::MAX);
        let mut out = BufWriter::new(temporary_file(bytes).map_err(failed)?);
        let pages: Vec<usize> = (0..nz).collect();
        for some in pages.chunks(rayon::current_num_threads()) {
            let medians = some.par_iter().map(|&z| self.medians(crop, z));
            for page in medians.collect::<Result<Vec<_>, _>>()? {
                out.write_all(&page).map_err(failed)?;
                on_page();
            }
        }
        let file = out.into_inner().map_err(IntoInnerError::into_error);
        let source = self.sources()[0].with_content(file.map_err(failed)?)?;
        let volume = raw.volume(vec![source], None)?;
        Self::new(self.name().to_owned(), volume, None)
    }

    /// The bytes of page `z` of `crop` after the filter.
    fn medians(&self, crop: &Crop, z: usize) -> Result<Vec<u8>, Error> {
        let (format, [nx, ny, nz]) = (self.format(), crop.dims());
        let pages = z.saturating_sub(1)..(z + 2).min(nz);
        let read = pages.clone().map(|z| {
            let mut page = Vec::new();
            self.read_page(crop.ranges()[2].start + z, &mut page)?;
            Ok(crop.rows(format, &page).collect::<Vec<_>>().concat())
        });
        let bytes = read.collect::<Result<Vec<Vec<u8>>, Error>>()?.concat();
        let values: Vec<f64> = format.values(&bytes).collect();
        let size = format.sample.bytes();
        let mut medians = Vec::with_capacity(nx * ny * size);
        let mut near = Vec::new();
        for (x, y) in (0..ny).flat_map(|y| (0..nx).map(move |x| (x, y))) {
            let place = |[x, y, z]: [usize; 3]| (z * ny + y) * nx + x;
            let own = [x, y, z - pages.start];
            let value = values[place(own)];
            if !value.is_finite() {
                let at = [0, 1, 2].map(|axis| crop.ranges()[axis].start + [x, y, z][axis]);
                let page = self.page_name(at[2]);
                return Err(Error::Usage(format!(
                    "{page}: the pixel at column {}, row {} holds {value}, and that is no grey value: leave it out by --crop",
                    at[0], at[1]
                )));
            }
            near.clear();
            near.extend(around(own, [nx, ny, pages.len()]).map(place));
            let middle = near.len() / 2;
            let (_, median, _) =
                near.select_nth_unstable_by(middle, |a, b| values[*a].total_cmp(&values[*b]));
            medians.extend_from_slice(&bytes[*median * size..][..size]);
        }
        Ok(medians)
    }
}
