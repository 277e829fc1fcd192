//! What the noise of grey values does to penetration.

use std::fmt;

use bondline::{PlacedVoxels, Specimen};
use units::Axis;
use voxels::{Crop, Grey, Histogram, Phases, Segmented, Stack, segment};

use crate::{Datum, Reference, State, penetration};

/// Share of the voxels in doubt from which phases overlap: their bell curves are then closer than 4 standard deviations.
const OVERLAP: f64 = 0.05;

/// Thresholds of grey values moved down and up by the noise, and what that changes.
pub struct GreyDoubt {
    noise: f64,
    /// Share of the voxels that change their phase.
    share: f64,
    /// [`measure`] of each segmentation; why there is none.
    measures: Result<Vec<Vec<f64>>, String>,
}

impl GreyDoubt {
    /// Segments `crop` with the thresholds of `grey`, lower ones and higher ones, passes each through `prepare`, and measures
    /// EP and WP (um) across `normal`, with voxels of `edge_m`; without adhesive, the share of void. None where no voxel is in
    /// doubt.
    ///
    /// # Errors
    /// A page that cannot be read.
    pub fn of(
        stack: &Stack,
        crop: &Crop,
        grey: &Grey,
        (edge_m, normal): (f64, Axis),
        prepare: impl Fn(&mut Segmented) -> Result<(), String>,
    ) -> Result<Option<Self>, voxels::Error> {
        let histogram = Histogram::of(stack, crop)?;
        let noise = histogram.noise(grey);
        let share = histogram.in_doubt(grey, noise);
        if share == 0.0 {
            return Ok(None);
        }
        let mut measures = Vec::new();
        for by in [0.0, -noise, noise] {
            let mut segmented = segment(stack, &Phases::Grey(grey.moved(by)), crop, || ())?;
            let prepared = prepare(&mut segmented);
            measures.push(prepared.and_then(|()| measure(&segmented, edge_m, normal)));
        }
        Ok(Some(Self {
            noise,
            share,
            measures: measures.into_iter().collect(),
        }))
    }

    /// Whether so many voxels are in doubt that the phases overlap.
    pub fn overlaps(&self) -> bool {
        self.share >= OVERLAP
    }
}

impl fmt::Display for GreyDoubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { noise, share, .. } = self;
        let percent = 100.0 * share;
        write!(
            f,
            "{percent:.1} % of the voxels are in doubt, within the noise (a standard deviation of {noise:.3}) of a threshold; with thresholds moved by it "
        )?;
        let measures = match &self.measures {
            Ok(measures) => measures,
            Err(why) => return write!(f, "nothing can be measured: {why}"),
        };
        let names = [&["the share of void"][..], &["EP (um)", "WP (um)"]];
        for (i, name) in names[measures[0].len() - 1].iter().enumerate() {
            let of_all = || measures.iter().filter_map(|all| all.get(i).copied());
            let (low, high) = (
                of_all().fold(f64::INFINITY, f64::min),
                of_all().fold(0.0, f64::max),
            );
            write!(
                f,
                "{}{name} is {low:.2} to {high:.2}",
                if i > 0 { ", " } else { "" }
            )?;
        }
        Ok(())
    }
}

/// EP and WP (um) of a specimen; without adhesive, the share of void.
fn measure(segmented: &Segmented, edge_m: f64, normal: Axis) -> Result<Vec<f64>, String> {
    let [wood, adhesive] = [&segmented.wood, &segmented.adhesive];
    if adhesive.count() == 0 {
        let voxels: usize = wood.dims().iter().product();
        return Ok(vec![1.0 - wood.count() as f64 / voxels as f64]);
    }
    let [wood, adhesive] =
        [wood, adhesive].map(|bits| PlacedVoxels::at_origin(bits.view(), edge_m));
    let specimen = Specimen::new(wood, adhesive).map_err(|why| why.to_string())?;
    let state = State::of_specimen(&specimen, normal);
    let datum = Datum::find(Reference::Mid, &state).map_err(|why| why.to_string())?;
    let [.., total] = penetration(&state, &datum);
    Ok([total.ep_m, total.wp_m].map(|metres| 1e6 * metres).to_vec())
}
