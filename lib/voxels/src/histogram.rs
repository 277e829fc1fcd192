//! How often each grey value stands in a stack.

use std::collections::BTreeMap;
use std::ops::Range;

use rayon::prelude::*;

use crate::sample::{PageFormat, Sample};
use crate::{Crop, Error, Stack};

/// Grey values that are told apart.
const MOST: usize = 1 << 16;
/// Share of the voxels that an end of the grey values needs to count: fewer are hot or dark pixels.
pub(crate) const FEW: f64 = 0.02;

/// Voxels of each grey value of a stack. Integers of 8 and 16 bits are counted by their value, others
/// in steps of a power of ten, which are counted to where hardly any voxel is beyond.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    pub(crate) scale: Scale,
    /// Voxels of the first value, of the next ...
    pub counts: Vec<u64>,
    pub(crate) padding: Option<Padding>,
}

/// Voxels of one value that reach into rows of all pages from their ends, as around a round field
/// of view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Padding {
    pub(crate) value: f64,
    /// The place of the value in the counts.
    pub(crate) place: usize,
    pub(crate) voxels: u64,
}

/// The values that are counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    /// The first value, in steps.
    pub(crate) first: i64,
    pub(crate) values: usize,
    /// A step is ten to this power.
    pub(crate) power: i32,
    pub(crate) whole: bool,
}

impl Scale {
    /// That of a sample whose values are all counted.
    fn of(sample: Sample) -> Option<Self> {
        let (first, bits) = match sample {
            Sample::U8 => (0, 8),
            Sample::I8 => (-(1 << 7), 8),
            Sample::U16 => (0, 16),
            Sample::I16 => (-(1 << 15), 16),
            _ => return None,
        };
        Some(Self::whole(first, 1 << bits))
    }

    pub(crate) fn whole(first: i64, values: usize) -> Self {
        Self {
            first,
            values,
            power: 0,
            whole: true,
        }
    }

    /// That of the values in `range`, in the finest steps that are few enough.
    fn covering(range: Range<f64>, whole: bool) -> Self {
        let finest = (range.end - range.start) / (MOST - 2) as f64;
        let power = match finest.log10().ceil() {
            finest if finest.is_finite() => finest as i32,
            _ => 0,
        };
        let mut scale = Self {
            first: 0,
            values: MOST,
            power: power.clamp(if whole { 0 } else { -300 }, 300),
            whole,
        };
        scale.first = scale.steps(range.start).round() as i64;
        scale
    }

    fn steps(&self, value: f64) -> f64 {
        match self.power {
            0 => value,
            1.. => value / 10_f64.powi(self.power),
            _ => value * 10_f64.powi(-self.power),
        }
    }

    fn place(&self, value: f64) -> Option<usize> {
        let place = self.steps(value).round() - self.first as f64;
        (0.0 <= place && place < self.values as f64).then_some(place as usize)
    }

    pub(crate) fn value(&self, place: usize) -> f64 {
        let steps = (self.first + place as i64) as f64;
        match self.power {
            0.. => steps * 10_f64.powi(self.power),
            _ => steps / 10_f64.powi(-self.power),
        }
    }
}

impl Histogram {
    /// Counts the voxels of `crop`, page by page on all threads; what is no number is passed over.
    ///
    /// # Errors
    /// A page that cannot be read, pixels that are not one number, or a crop that reaches out of the
    /// stack.
    pub fn of(stack: &Stack, crop: &Crop) -> Result<Self, Error> {
        crop.check(stack.dims())?;
        stack.check_grey()?;
        stack.fits(stack.reading_bytes())?;
        let format = stack.format();
        let scale = match Scale::of(format.sample) {
            Some(scale) => scale,
            None => Self::scale(stack, crop)?,
        };
        let Counted { counts, corners } =
            Counted::pages(stack, crop, scale.values, |value| scale.place(value))?;
        let highest = corners.into_iter().next_back();
        let padding = highest.and_then(|(value, (pages, voxels))| {
            let value = f64::from_bits(value);
            let place = scale.place(value)?;
            (pages == crop.dims()[2]).then_some(Padding {
                value,
                place,
                voxels,
            })
        });
        Ok(Self {
            scale,
            counts,
            padding,
        })
    }

    /// The scale that covers all but the outliers of a stack of any numbers.
    fn scale(stack: &Stack, crop: &Crop) -> Result<Scale, Error> {
        let counted = Counted::pages(stack, crop, MOST, |value| {
            value.is_finite().then(|| coarse(value))
        })?;
        let total: u64 = counted.counts.iter().sum();
        let most = (FEW * total as f64) as u64;
        let beyond = |place: &dyn Fn(usize) -> usize| {
            let mut voxels = 0;
            let passed = |i: &usize| {
                voxels += counted.counts[place(*i)];
                voxels <= most
            };
            (0..MOST).take_while(passed).count()
        };
        let (below, above) = (beyond(&|i| i), beyond(&|i| MOST - 1 - i));
        let low = of_coarse(below.min(MOST - 1));
        let high = of_coarse((MOST - above).clamp(below + 1, MOST).min(MOST - 1));
        // What is as far again is no outlier.
        let (reach, whole) = (high - low, stack.format().sample.is_whole());
        Ok(Scale::covering(low - reach..high + reach, whole))
    }

    /// The values with voxels, from the lowest to the highest found, and how many they are.
    pub fn values(&self) -> impl Iterator<Item = (f64, u64)> {
        let found = |n: &u64| *n > 0;
        let first = self.counts.iter().position(found).unwrap_or(0);
        let last = self.counts.iter().rposition(found).unwrap_or(0);
        (first..=last).map(|place| (self.scale.value(place), self.counts[place]))
    }
}

/// The place of a number among all, to a part in 128 of it: the first bits of a float are in order.
fn coarse(value: f64) -> usize {
    let bits = (value as f32).to_bits();
    let ordered = match bits >> 31 {
        0 => bits | 1 << 31,
        _ => !bits,
    };
    (ordered >> 16) as usize
}

/// The least number at a place.
fn of_coarse(place: usize) -> f64 {
    let ordered = (place as u32) << 16;
    let bits = match ordered >> 31 {
        0 => !ordered,
        _ => ordered & !(1 << 31),
    };
    let value = f32::from_bits(bits);
    f64::from(value.clamp(f32::MIN, f32::MAX))
}

struct Counted {
    counts: Vec<u64>,
    /// By the bits of a value: pages with it at all corners, and voxels that stand in rows from
    /// there on.
    corners: BTreeMap<u64, (usize, u64)>,
}

impl Counted {
    /// Counts the pages of `crop` at the places of their values.
    fn pages(
        stack: &Stack,
        crop: &Crop,
        places: usize,
        place: impl Fn(f64) -> Option<usize> + Sync,
    ) -> Result<Self, Error> {
        let none = || Self {
            counts: vec![0; places],
            corners: BTreeMap::new(),
        };
        let format = stack.format();
        (crop.ranges()[2].clone().into_par_iter())
            .try_fold(none, |mut counted, z| {
                let mut page = Vec::new();
                stack.read_page(z, &mut page)?;
                let rows: Vec<&[u8]> = crop.rows(format, &page).collect();
                for value in rows.iter().flat_map(|row| format.values(row)) {
                    if let Some(place) = place(value) {
                        counted.counts[place] += 1;
                    }
                }
                if let Some((value, voxels)) = corners(format, &rows) {
                    counted.add(value, (1, voxels));
                }
                Ok::<_, Error>(counted)
            })
            .try_reduce(none, |mut a, b| {
                a.counts.iter_mut().zip(b.counts).for_each(|(a, b)| *a += b);
                for (value, corner) in b.corners {
                    a.add(value, corner);
                }
                Ok(a)
            })
    }

    fn add(&mut self, value: u64, corner: (usize, u64)) {
        let sum = self.corners.entry(value).or_default();
        *sum = (sum.0 + corner.0, sum.1 + corner.1);
    }
}

/// The bits of the value at all four corners of a page, and the voxels of it from which each row
/// begins and with which it ends.
fn corners(format: PageFormat, rows: &[&[u8]]) -> Option<(u64, u64)> {
    let ends = [rows.first()?, rows.last()?].map(|row| {
        let mut row = format.values(row);
        let first = row.next();
        [first, row.last().or(first)]
    });
    let value = ends[0][0]?;
    if ends.into_iter().flatten().any(|end| end != Some(value)) {
        return None;
    }
    let same = |v: &f64| *v == value;
    let bytes = format.sample.bytes();
    let padded = rows.iter().map(|row| {
        let before = format.values(row).take_while(same).count();
        let behind = row[before * bytes..].rchunks_exact(bytes);
        let behind = behind.map(|pixel| format.sample.value(pixel));
        before + behind.take_while(same).count()
    });
    Some((value.to_bits(), padded.sum::<usize>() as u64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coarse_histogram_bins_are_in_numerical_order() {
        let numbers = [
            -1e30, -2.0, -1.0, -1e-30, 0.0, 1e-30, 0.5, 1.0, 70_000.0, 1e38,
        ];
        let places = numbers.map(coarse);
        assert!(places.is_sorted_by(|a, b| a < b), "{places:?}");
        for (number, place) in numbers.into_iter().zip(places) {
            let [low, high] = [place, place + 1].map(of_coarse);
            assert!(low <= number && number <= high, "{low} {number} {high}");
        }
    }

    #[test]
    fn scales_cover_their_range_in_steps_of_ten() {
        for (range, whole) in [
            (-0.02..0.13, false),
            (0.0..70_000.0, true),
            (-5.0..5.0, true),
            (1e9..4e9, true),
            (3.0..3.0, false),
        ] {
            let scale = Scale::covering(range.clone(), whole);
            let [low, high] = [range.start, range.end].map(|v| scale.place(v).unwrap());
            assert!(low <= 1 && (!whole || scale.power >= 0), "{range:?}");
            if range.end > range.start && scale.power != 0 {
                assert!(high > MOST / 20, "{range:?}: {high}");
            }
            assert_eq!(scale.place(scale.value(high)), Some(high), "{range:?}");
        }
        let scale = Scale::covering(0.0..0.6, false);
        assert_eq!(scale.value(scale.place(0.3).unwrap()).to_string(), "0.3");
    }
}
