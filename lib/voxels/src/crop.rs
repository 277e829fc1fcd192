//! The part of a stack that is kept.

use std::ops::Range;
use std::str::FromStr;

use crate::Error;
use crate::sample::PageFormat;

/// A box of voxels to keep, half open: `x0:x1,y0:y1,z0:z1`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Crop([Range<usize>; 3]);

impl Crop {
    /// The whole of a stack of `[nx, ny, nz]` voxels.
    pub fn whole(dims: [usize; 3]) -> Self {
        Self(dims.map(|n| 0..n))
    }

    /// Ranges of voxels along x, y, z.
    pub fn ranges(&self) -> &[Range<usize>; 3] {
        &self.0
    }

    /// Numbers of voxels kept along x, y, z.
    pub fn dims(&self) -> [usize; 3] {
        [0, 1, 2].map(|axis| self.0[axis].len())
    }

    /// The cropped rows of a page, bottom of the index range first.
    pub(crate) fn rows<'a>(
        &self,
        format: PageFormat,
        page: &'a [u8],
    ) -> impl Iterator<Item = &'a [u8]> + use<'a> {
        let [x, y, _] = self.0.clone();
        let pixel = format.pixel_bytes();
        page.chunks_exact(format.width * pixel)
            .skip(y.start)
            .take(y.len())
            .map(move |row| &row[x.start * pixel..x.end * pixel])
    }

    /// Refuses a box that reaches out of a stack of `[nx, ny, nz]` voxels.
    pub(crate) fn check(&self, dims: [usize; 3]) -> Result<(), Error> {
        for ((Range { start, end }, n), axis) in self.0.iter().zip(dims).zip(["x", "y", "z"]) {
            if *end > n {
                return Err(Error::Usage(format!(
                    "the crop {start}:{end} along {axis} reaches out of the stack, which has {n} voxels there"
                )));
            }
        }
        Ok(())
    }
}

impl FromStr for Crop {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let range = |part: &str| {
            let (start, end) = part.split_once(':')?;
            let range = start.trim().parse().ok()?..end.trim().parse().ok()?;
            (!range.is_empty()).then_some(range)
        };
        let ranges: Option<Vec<_>> = text.split(',').map(range).collect();
        let crop = ranges.and_then(|ranges| ranges.try_into().ok()).map(Self);
        crop.ok_or_else(|| {
            format!(
                "'{text}' is not a crop; accepted is x0:x1,y0:y1,z0:z1 in voxels, the first kept and the last not"
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crops_are_three_half_open_ranges() {
        let crop: Crop = "0:10,5:7,3:4".parse().unwrap();
        assert_eq!(crop.dims(), [10, 2, 1]);
        assert!(crop.check([10, 7, 4]).is_ok());
        let said = crop.check([10, 6, 4]).unwrap_err().to_string();
        assert!(said.contains("along y"), "{said}");
        for bad in [
            "",
            "0:10",
            "0:10,0:10",
            "0:10,3:3,0:1",
            "0:1,4:2,0:1",
            "a:1,0:1,0:1",
        ] {
            assert!(bad.parse::<Crop>().is_err(), "{bad}");
        }
    }
}
