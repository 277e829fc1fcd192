//! State of a press over time, as `metrics` measures it: columns of the history and a part of the summary.

use metrics::{
    Adhesive, BondLine, Datum, DepthLayer, Penetration, Reference, Sealed, State, Wood, bond_line,
    depth_profile, penetration,
};
use particle_file::ParticleFile;
use physics::{Dimensions, LiquidState, Scheme};
use serde::Serialize;
use units::Axis;

use crate::case::Case;
use crate::failure::{RunFailure, refused};
use crate::resolve::Setup;
use crate::snapshot::{in_file_axes, wood_now};

/// The columns of a [`Moment`], in order.
pub(crate) const COLUMNS: &str = ",wp_bottom_um,wp_top_um,wp_total_um,ep_bottom_um,ep_top_um,ep_total_um,\
p95_depth_bottom_um,p95_depth_top_um,p95_depth_total_um,wetted_area_bottom_um2,wetted_area_top_um2,\
half_filled_depth_bottom_um,half_filled_depth_top_um,bond_line_filled,bond_line";

/// A bond at one moment, measured from midway between the bond surfaces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment {
    sides: [Penetration; 3],
    line: BondLine,
}

impl Moment {
    /// Its fields of a row of the history, as `wp-metrics --series` writes them.
    pub(crate) fn fields(&self) -> String {
        let um = |metres: f64| format!(",{:.6}", 1e6 * metres);
        let um2 = |area: f64| format!(",{:.4}", 1e12 * area);
        let of_sides = |what: fn(&Penetration) -> f64| self.sides.iter().map(what).map(um);
        let [wetted, half] = [&self.line.wetted_m2[..2], &self.line.half_filled_m[..2]];
        let lengths = of_sides(|side| side.wp_m)
            .chain(of_sides(|side| side.ep_m))
            .chain(of_sides(|side| side.p95_depth_m));
        let areas = wetted.iter().copied().map(um2);
        let all = lengths.chain(areas).chain(half.iter().copied().map(um));
        let line = format!(",{:.6},{}", self.line.filled, self.line.filling);
        all.chain([line]).collect()
    }
}

/// Looks at the bond of a run; what stays the same of it is worked out once.
pub(crate) struct Watch<'a> {
    bond: &'a ParticleFile,
    normal: Axis,
    /// Points of its liquid.
    points: u64,
    sealed: Sealed,
}

/// Refuses a case that asks for what its scene cannot tell: without a bond there is nothing to measure, and in a
/// slice the liquid is as deep as a cell and the wood as a voxel.
pub(crate) fn check(case: &Case, bonded: bool, setup: &Setup) -> Result<(), RunFailure> {
    if case.output.penetration && !(bonded && is_solid(setup)) {
        return refused(
            "[output] penetration is measured of the bond of a bond file (--particles) in three dimensions",
        );
    }
    Ok(())
}

/// Who measures the bond of a run, where [`check`] lets it be asked for.
/// Errors: a bond that cannot be measured although the case asks for it.
pub(crate) fn watch<'a>(
    case: &Case,
    bond: Option<&'a ParticleFile>,
    setup: &Setup,
) -> Result<Option<Watch<'a>>, RunFailure> {
    let bond = bond.filter(|_| is_solid(setup));
    match bond.map(|bond| Watch::on(bond, setup)) {
        Some(Err(error)) if case.output.penetration => refused(format!(
            "[output] penetration: the bond cannot be measured: {error}"
        )),
        watch => Ok(watch.and_then(Result::ok)),
    }
}

fn is_solid(setup: &Setup) -> bool {
    setup.scene.dimensions == Dimensions::Three
}

impl<'a> Watch<'a> {
    /// A watch on the run of `setup`, whose wood is that of `bond`.
    fn on(bond: &'a ParticleFile, setup: &Setup) -> Result<Self, metrics::Error> {
        let state = State::of_file(bond)?;
        let middle = Datum::find(Reference::Mid, &state)?;
        Ok(Self {
            bond,
            normal: setup.normal,
            points: setup.liquid.points,
            sealed: Sealed::of(&state, &middle),
        })
    }

    /// What the bond has come to, `lost` points of which left through open sides.
    pub(crate) fn look(&self, scheme: &dyn Scheme, lost: u64) -> Result<Moment, RunFailure> {
        let mut liquid = scheme.filling();
        in_file_axes(&mut liquid, self.normal);
        let displacements = scheme.displacements();
        self.measure(&liquid, &displacements, |state, middle| {
            self.moment(state, middle, lost)
        })
    }

    /// The same of `liquid`, in the axes of the bond file, and bodies so displaced (m), with the filled share of the
    /// open lumens by depth.
    pub(crate) fn look_closely(
        &self,
        liquid: &LiquidState,
        displacements: &[[f64; 3]],
        lost: u64,
    ) -> Result<Answers, RunFailure> {
        self.measure(liquid, displacements, |state, middle| {
            let layers = depth_profile(state, middle, &self.sealed)?;
            let Moment { sides, line } = self.moment(state, middle, lost)?;
            Ok(Answers {
                wp_m: sides.map(|side| side.wp_m).into(),
                ep_m: sides.map(|side| side.ep_m).into(),
                p95_depth_m: sides.map(|side| side.p95_depth_m).into(),
                wetted_area_m2: line.wetted_m2.into(),
                half_filled_depth_m: line.half_filled_m.into(),
                bond_line_filled: line.filled,
                bond_line: line.filling.to_string(),
                outer_face_reached: at_an_outer_face(&layers),
                filled_by_depth: FilledByDepth {
                    layer_m: state.voxel_m,
                    bottom: shares(&layers, true),
                    top: shares(&layers, false),
                },
            })
        })
    }

    fn moment(&self, state: &State, middle: &Datum, lost: u64) -> Result<Moment, metrics::Error> {
        let left = lost as f64 / self.points as f64;
        Ok(Moment {
            sides: penetration(state, middle),
            line: bond_line(state, left, &self.sealed)?,
        })
    }

    fn measure<T>(
        &self,
        liquid: &LiquidState,
        displacements: &[[f64; 3]],
        what: impl FnOnce(&State, &Datum) -> Result<T, metrics::Error>,
    ) -> Result<T, RunFailure> {
        let wood = wood_now(self.bond, displacements, self.normal)?;
        let [bottom, top] = wood
            .each_ref()
            .map(|(block, bits)| bondline::Placed::of_block((block, *bits)));
        let header = self.bond.header();
        let state = State {
            normal: self.normal,
            voxel_m: header.voxel_m,
            box_min_m: header.box_min_m,
            box_max_m: header.box_max_m,
            wood: Wood::Parted { bottom, top },
            adhesive: Adhesive::Points {
                position: &liquid.position,
                volume: &liquid.volume,
            },
        };
        let middle = Datum::find(Reference::Mid, &state);
        middle
            .and_then(|middle| what(&state, &middle))
            .map_err(|error| RunFailure::Data(format!("the bond cannot be measured: {error}")))
    }
}

/// Whether there is adhesive in the first or last layer.
fn at_an_outer_face(layers: &[DepthLayer]) -> bool {
    let outer = [layers.first(), layers.last()].into_iter().flatten();
    outer.into_iter().any(|layer| layer.adhesive_fraction > 0.0)
}

/// The filled shares of the open lumens on one side, from the middle to the last layer with adhesive.
fn shares(layers: &[DepthLayer], below: bool) -> Vec<f64> {
    let side = layers.iter().filter(|l| (l.depth_m < 0.0) == below);
    let mut shares: Vec<f64> = side.map(|l| l.filled_open_fraction).collect();
    if below {
        shares.reverse();
    }
    let end = shares.iter().rposition(|share| *share > 0.0);
    shares.truncate(end.map_or(0, |last| last + 1));
    shares
}

/// A quantity of both sides and of all.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Sides {
    /// Low-coordinate side.
    pub bottom: f64,
    /// High-coordinate side.
    pub top: f64,
    /// Both together.
    pub total: f64,
}

impl From<[f64; 3]> for Sides {
    fn from([bottom, top, total]: [f64; 3]) -> Self {
        Self { bottom, top, total }
    }
}

/// What a press has come to; depths are measured from midway between the bond surfaces. `wp-metrics --series` tells
/// the same of a state.
#[derive(Clone, Debug, Serialize)]
pub struct Answers {
    /// Weighted penetration (WP, Eq. 6), m.
    pub wp_m: Sides,
    /// Effective penetration (EP), m.
    pub ep_m: Sides,
    /// Depth that 95 % of the adhesive does not exceed, m.
    pub p95_depth_m: Sides,
    /// Area of wood that adhesive wets, m2.
    pub wetted_area_m2: Sides,
    /// Depth to which the open lumens are at least half full, m; the less of both sides in total.
    pub half_filled_depth_m: Sides,
    /// Mean filled share of the room between the bond surfaces and two voxels beside them.
    pub bond_line_filled: f64,
    /// `filled`, `starved` or `squeezed-out`.
    pub bond_line: String,
    /// Whether adhesive got to an outer face of the specimen: its depths are then those of a piece too small for them.
    pub outer_face_reached: bool,
    /// Filled share of the open lumens in layers from the middle on, as deep as there is adhesive.
    pub filled_by_depth: FilledByDepth,
}

/// The filled share of open lumens in layers.
#[derive(Clone, Debug, Serialize)]
pub struct FilledByDepth {
    /// Thickness of a layer, m.
    pub layer_m: f64,
    /// Low-coordinate side, from the middle on; null where a layer has no open lumens.
    pub bottom: Vec<f64>,
    /// High-coordinate side.
    pub top: Vec<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn adhesive_in_the_last_layer_is_at_the_outer_face() {
        let layers = |fractions: [f64; 4]| {
            fractions.map(|adhesive_fraction| DepthLayer {
                depth_m: 0.0,
                adhesive_fraction,
                filled_void_fraction: f64::NAN,
                filled_open_fraction: f64::NAN,
            })
        };
        assert!(!at_an_outer_face(&layers([0.0, 0.5, 1.0, 0.0])));
        assert!(at_an_outer_face(&layers([0.0, 0.5, 1.0, 1e-3])));
        assert!(at_an_outer_face(&layers([1e-3, 0.5, 1.0, 0.0])));
        assert!(!at_an_outer_face(&[]));
    }
}
