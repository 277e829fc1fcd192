//! Agreement of a state with an experiment.

use bondline::PlacedVoxels;
use particle_file::BitGrid;
use voxels::VolumeFractions;

use crate::{Adhesive, Datum, Error, Map, Reference, Side, State, Wood};

/// Agreement of a state with an experiment on the same wood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// Which side.
    pub side: Side,
    /// Dice coefficient of the adhesive voxels, 2 |A and B| / (|A| + |B|), 0 to 1; NaN when
    /// both are empty.
    pub dice: f64,
    /// Pearson correlation of the WP maps over the columns with adhesive in both; NaN for fewer than two columns or a constant
    /// map.
    pub map_correlation: f64,
}

/// Dice coefficient of the wood of a specimen that was segmented twice, at least.
const SAME_WOOD: f64 = 0.9;

/// Compares a state with the experiment that its wood comes from.
///
/// Each side is compared in the frame of its adherend: liquid on the top side is moved back with the top adherend by the
/// remaining gap, so that a lumen is compared with itself even if the bond did not close. Liquid that then lies beyond the
/// experiment's bond plane, i.e. the film between parted adherends, is left out of the overlap. Maps contain all liquid,
/// each about its own mid-plane. A bond trimmed to whole cells is compared over its own width.
///
/// # Errors
/// States with different voxels or other wood, and the errors of [`Datum::find`].
pub fn compare(state: &State, experiment: &State) -> Result<[Agreement; 3], Error> {
    let (Wood::Whole(wood), Adhesive::Voxels(adhesive)) = (experiment.wood, experiment.adhesive)
    else {
        return Err(Error::Usage(
            "the file to compare with is not a specimen: wood and adhesive voxels of one stack are needed".into(),
        ));
    };
    same_voxels(state, experiment)?;
    let agreement = wood_dice(state, wood);
    if agreement < SAME_WOOD {
        return Err(Error::Usage(format!(
            "its wood is not that of the experiment: their Dice coefficient is {agreement:.3}, below {SAME_WOOD}"
        )));
    }
    let ours = Datum::find(Reference::Mid, state)?;
    let theirs = Datum::find(Reference::Mid, experiment)?;
    let [bottom, top] = [Side::Bottom, Side::Top]
        .map(|side| overlap(state, &ours, [wood, adhesive], &theirs, side));
    let total = [bottom[0] + top[0], bottom[1] + top[1]];
    Ok(Side::ALL.map(|side| {
        let [common, sizes] = [bottom, top, total][side as usize];
        let maps = [(state, &ours), (experiment, &theirs)];
        let [a, b] = maps.map(|(state, datum)| Map::new(state, datum, side));
        Agreement {
            side,
            dice: 2.0 * common as f64 / sizes as f64,
            map_correlation: correlation(&a, &b),
        }
    }))
}

fn same_voxels(state: &State, experiment: &State) -> Result<(), Error> {
    let (ours, theirs) = (state.across(), experiment.across());
    let same = |a: f64, b: f64| (a - b).abs() < 1e-3 * experiment.voxel_m;
    let fits = state.normal == experiment.normal
        && same(1e3 * state.voxel_m, 1e3 * experiment.voxel_m)
        && (0..2).all(|a| same(ours.min_m[a], theirs.min_m[a]))
        && (0..2).all(|a| match state.wood {
            Wood::Parted { .. } => ours.columns[a] <= theirs.columns[a],
            _ => ours.columns[a] == theirs.columns[a],
        })
        && layers(state) == layers(experiment);
    if fits {
        return Ok(());
    }
    let describe = |s: &State| {
        let across = s.across();
        format!(
            "{} layers along {} of {:?} voxels of {:.4} um",
            layers(s),
            s.normal,
            across.columns,
            1e6 * s.voxel_m
        )
    };
    Err(Error::Usage(format!(
        "it has {} but the experiment {}: the specimen that the bond was built from, or one of the same shape, is needed",
        describe(state),
        describe(experiment)
    )))
}

/// Dice coefficient of the wood of a state, its adherends put back together, and of a specimen, over the width of the state.
fn wood_dice(state: &State, specimen: PlacedVoxels) -> f64 {
    let (n, dims) = (state.normal.index(), specimen.bits.dims());
    let (mut common, mut ours, mut begin, mut reach) = (0_u64, 0_u64, 0, dims);
    for block in state.wood_blocks() {
        block.bits.for_each(|mut at| {
            at[n] += begin;
            ours += 1;
            let inside = (0..3).all(|a| at[a] < dims[a]);
            common += u64::from(inside && specimen.bits.get(at[0], at[1], at[2]));
        });
        begin += block.bits.dims()[n];
        reach = std::array::from_fn(|a| {
            if a == n {
                dims[a]
            } else {
                block.bits.dims()[a]
            }
        });
    }
    let mut theirs = 0_u64;
    let within = |at: [usize; 3]| (0..3).all(|a| at[a] < reach[a]);
    (specimen.bits).for_each(|at| theirs += u64::from(within(at)));
    2.0 * common as f64 / (ours + theirs) as f64
}

/// Layers of voxels along the normal, both adherends together.
fn layers(state: &State) -> usize {
    let n = state.normal.index();
    state.wood_blocks().map(|wood| wood.bits.dims()[n]).sum()
}

/// Number of voxels with adhesive on `side` in both, in the frame of the adherend, and the sum of the numbers in each.
fn overlap(
    state: &State,
    ours: &Datum,
    [wood, adhesive]: [PlacedVoxels; 2],
    theirs: &Datum,
    side: Side,
) -> [u64; 2] {
    let (n, voxel) = (state.normal.index(), adhesive.voxel_m);
    let height = theirs.plane_m(Side::Total) - adhesive.origin_m[n];
    let plane = (height / voxel + 1e-6).floor() as usize;
    let is_on = |layer: usize| (layer < plane) == (side == Side::Bottom);
    let across = state.across();
    let mut reach = adhesive.bits.dims();
    for (axis, columns) in across.axes.into_iter().zip(across.columns) {
        let within = &mut reach[axis.index()];
        *within = columns.min(*within);
    }
    // Distance of the adherend from its place in the experiment, m.
    let parted = match (side, state.wood) {
        (Side::Top, Wood::Parted { bottom, top }) => top.origin_m[n] - bottom.max_m()[n],
        _ => 0.0,
    };
    let open = BitGrid::from_fn(reach, |x, y, z| {
        is_on([x, y, z][n]) && !wood.bits.get(x, y, z)
    });
    let mut fractions = VolumeFractions::new(open);
    state.for_each_parcel(|mut point, v| {
        if side.share(ours.depth(point, voxel).0) == 0.0 {
            return;
        }
        point[n] -= parted;
        let place: [f64; 3] = std::array::from_fn(|a| (point[a] - adhesive.origin_m[a]) / voxel);
        if is_on(place[n].max(0.0) as usize) {
            fractions.add(place, v / voxel.powi(3));
        }
    });
    let ours = fractions.fullest();
    let theirs = BitGrid::from_fn(reach, |x, y, z| {
        is_on([x, y, z][n]) && adhesive.bits.get(x, y, z)
    });
    let words = ours.words().iter().zip(theirs.words());
    let common = words.map(|(a, b)| u64::from((a & b).count_ones())).sum();
    [common, ours.count() + theirs.count()]
}

/// Pearson correlation of two maps over the columns of the first with adhesive in both.
fn correlation(a: &Map, b: &Map) -> f64 {
    let [columns, rows] = a.across.columns;
    let width = b.across.columns[0];
    let pairs: Vec<(f64, f64)> = (0..columns * rows)
        .filter_map(|c| Some((a.wp_m(c)?, b.wp_m(c / columns * width + c % columns)?)))
        .collect();
    let n = pairs.len() as f64;
    let mean_a = pairs.iter().map(|p| p.0).sum::<f64>() / n;
    let mean_b = pairs.iter().map(|p| p.1).sum::<f64>() / n;
    let sum = |f: fn(f64, f64) -> f64| -> f64 {
        let deviations = pairs.iter().map(|p| f(p.0 - mean_a, p.1 - mean_b));
        deviations.sum()
    };
    let (aa, bb) = (sum(|x, _| x * x), sum(|_, y| y * y));
    // Single-precision positions make a constant map vary by 1e-6 voxels.
    let constant = n * (1e-4 * a.across.width_m).powi(2);
    if aa > constant && bb > constant {
        sum(|x, y| x * y) / (aa * bb).sqrt()
    } else {
        f64::NAN
    }
}
