//! Effect of the noise of grey values on penetration.

use bondline::{PlacedVoxels, Specimen};
use metrics::{Datum, Reference, State, penetration};
use units::Axis;
use voxels::{Crop, Doubt, Error, Grey, Phases, Segmented, Stack, segment};

/// Measures with thresholds as they are and moved by the noise: the least and the greatest, as a sentence.
///
/// Each segmentation is `prepared` as the first was.
pub(crate) fn moved(
    (stack, crop): (&Stack, &Crop),
    (grey, doubt): (&Grey, Doubt),
    (edge_m, normal): (f64, Axis),
    prepared: impl Fn(&mut Segmented) -> Result<(), String>,
) -> Result<String, Error> {
    let mut measures = Vec::new();
    for by in [0.0, -doubt.noise, doubt.noise] {
        let mut segmented = segment(stack, &Phases::Grey(grey.moved(by)), crop, || ())?;
        let ready = prepared(&mut segmented);
        measures.push(ready.and_then(|()| measure(&segmented, edge_m, normal)));
    }
    let measures: Vec<Vec<(&str, f64)>> = match measures.into_iter().collect() {
        Ok(measures) => measures,
        Err(why) => return Ok(format!("nothing can be measured: {why}")),
    };
    let range = |(i, (name, value)): (usize, &(&str, f64))| {
        let of_all = measures.iter().filter_map(|all| all.get(i));
        let range = of_all.fold([*value; 2], |[low, high], (_, v)| {
            [low.min(*v), high.max(*v)]
        });
        format!("{name} is {:.2} to {:.2}", range[0], range[1])
    };
    let ranges: Vec<String> = measures[0].iter().enumerate().map(range).collect();
    Ok(ranges.join(", "))
}

/// EP and WP of a specimen; without adhesive, its share of void.
fn measure(
    segmented: &Segmented,
    edge_m: f64,
    normal: Axis,
) -> Result<Vec<(&'static str, f64)>, String> {
    let [wood, adhesive] = [&segmented.wood, &segmented.adhesive];
    if adhesive.count() == 0 {
        let voxels: usize = wood.dims().iter().product();
        let void = 1.0 - wood.count() as f64 / voxels as f64;
        return Ok(vec![("the share of void", void)]);
    }
    let [wood, adhesive] =
        [wood, adhesive].map(|bits| PlacedVoxels::at_origin(bits.view(), edge_m));
    let specimen = Specimen::new(wood, adhesive).map_err(|why| why.to_string())?;
    let state = State::of_specimen(&specimen, normal);
    let datum = Datum::find(Reference::Mid, &state).map_err(|why| why.to_string())?;
    let [.., total] = penetration(&state, &datum);
    let [ep, wp] = [total.ep_m, total.wp_m].map(|metres| 1e6 * metres);
    Ok(vec![("EP (um)", ep), ("WP (um)", wp)])
}
