//! Penetration during a run, measured by `metrics`: columns of the history and the `penetration` of the summary.

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
use crate::snapshot::{displaced_wood, in_file_axes};

/// Columns of a [`BondRow`], in order.
pub(crate) const COLUMNS: &str = ",wp_bottom_um,wp_top_um,wp_total_um,ep_bottom_um,ep_top_um,ep_total_um,\
p95_depth_bottom_um,p95_depth_top_um,p95_depth_total_um,wetted_area_bottom_um2,wetted_area_top_um2,\
half_filled_depth_bottom_um,half_filled_depth_top_um,bond_line_filled,bond_line";

/// Penetration and bond line in one row of the history. Depths count from midway between the bond surfaces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BondRow {
    sides: [Penetration; 3],
    line: BondLine,
}

impl BondRow {
    /// The fields of the row, formatted as in `wp-metrics --series`.
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

/// Measures the bond of a run. Sealed voids do not change, so they are found once.
pub(crate) struct BondMeter<'a> {
    bond: &'a ParticleFile,
    normal: Axis,
    /// Material points of the liquid at the start.
    points: u64,
    sealed: Sealed,
}

/// Refuses `[output] penetration` for scenes without a bond file, and for slices: there the liquid is one cell deep but the
/// wood one voxel.
pub(crate) fn check_output(case: &Case, bonded: bool, setup: &Setup) -> Result<(), RunFailure> {
    if case.output.penetration && !(bonded && is_solid(setup)) {
        return refused(
            "[output] penetration is measured of the bond of a bond file (--particles) in three dimensions",
        );
    }
    Ok(())
}

/// The measuring of a run's bond; `None` for scenes without a bond file and for slices.
/// Errors: the case asks for penetration, but the bond cannot be measured.
pub(crate) fn bond_meter<'a>(
    case: &Case,
    bond: Option<&'a ParticleFile>,
    setup: &Setup,
) -> Result<Option<BondMeter<'a>>, RunFailure> {
    let bond = bond.filter(|_| is_solid(setup));
    match bond.map(|bond| BondMeter::new(bond, setup)) {
        Some(Err(error)) if case.output.penetration => refused(format!(
            "[output] penetration: the bond cannot be measured: {error}"
        )),
        meter => Ok(meter.and_then(Result::ok)),
    }
}

fn is_solid(setup: &Setup) -> bool {
    setup.scene.dimensions == Dimensions::Three
}

impl<'a> BondMeter<'a> {
    /// Measures the run of `setup`, whose wood comes from `bond`.
    fn new(bond: &'a ParticleFile, setup: &Setup) -> Result<Self, metrics::Error> {
        let state = State::of_file(bond)?;
        let middle = Datum::find(Reference::Mid, &state)?;
        Ok(Self {
            bond,
            normal: setup.normal,
            points: setup.liquid.points,
            sealed: Sealed::of(&state, &middle),
        })
    }

    /// Measures the current state for a row of the history; `lost` points have left through open sides.
    pub(crate) fn measure_row(
        &self,
        scheme: &dyn Scheme,
        lost: u64,
    ) -> Result<BondRow, RunFailure> {
        let mut liquid = scheme.filling();
        in_file_axes(&mut liquid, self.normal);
        let displacements = scheme.displacements();
        self.with_state(&liquid, &displacements, |state, middle| {
            self.row(state, middle, lost)
        })
    }

    /// Measures a state for the summary, with the filled fraction of the open lumens by depth. `liquid` is in the axes of the
    /// bond file; `displacements` (m) are those of the bodies.
    pub(crate) fn measure_state(
        &self,
        liquid: &LiquidState,
        displacements: &[[f64; 3]],
        lost: u64,
    ) -> Result<BondMeasures, RunFailure> {
        self.with_state(liquid, displacements, |state, middle| {
            let layers = depth_profile(state, middle, &self.sealed)?;
            let BondRow { sides, line } = self.row(state, middle, lost)?;
            Ok(BondMeasures {
                wp_m: sides.map(|side| side.wp_m).into(),
                ep_m: sides.map(|side| side.ep_m).into(),
                entered_share: sides.map(|side| side.entered_share).into(),
                mean_depth_m: sides.map(|side| side.mean_depth_m).into(),
                p95_depth_m: sides.map(|side| side.p95_depth_m).into(),
                wetted_area_m2: line.wetted_m2.into(),
                half_filled_depth_m: line.half_filled_m.into(),
                bond_line_filled: line.filled,
                bond_line: line.filling.to_string(),
                outer_face_reached: reaches_outer_face(&layers),
                filled_by_depth: FilledByDepth {
                    layer_m: state.voxel_m,
                    bottom: filled_fractions(&layers, true),
                    top: filled_fractions(&layers, false),
                },
            })
        })
    }

    fn row(&self, state: &State, middle: &Datum, lost: u64) -> Result<BondRow, metrics::Error> {
        let left = lost as f64 / self.points as f64;
        Ok(BondRow {
            sides: penetration(state, middle),
            line: bond_line(state, left, &self.sealed)?,
        })
    }

    fn with_state<T>(
        &self,
        liquid: &LiquidState,
        displacements: &[[f64; 3]],
        measure: impl FnOnce(&State, &Datum) -> Result<T, metrics::Error>,
    ) -> Result<T, RunFailure> {
        let wood = displaced_wood(self.bond, displacements, self.normal)?;
        let [bottom, top] = wood
            .each_ref()
            .map(|(block, bits)| bondline::PlacedVoxels::of_block((block, *bits)));
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
            .and_then(|middle| measure(&state, &middle))
            .map_err(|error| RunFailure::Data(format!("the bond cannot be measured: {error}")))
    }
}

/// Whether the first or the last layer holds adhesive.
fn reaches_outer_face(layers: &[DepthLayer]) -> bool {
    let outer = [layers.first(), layers.last()].into_iter().flatten();
    outer.into_iter().any(|layer| layer.adhesive_fraction > 0.0)
}

/// Filled fractions of the open lumens on one side, from the middle to the last layer with adhesive.
fn filled_fractions(layers: &[DepthLayer], below: bool) -> Vec<f64> {
    let side = layers.iter().filter(|l| (l.depth_m < 0.0) == below);
    let mut shares: Vec<f64> = side.map(|l| l.filled_open_fraction).collect();
    if below {
        shares.reverse();
    }
    let end = shares.iter().rposition(|share| *share > 0.0);
    shares.truncate(end.map_or(0, |last| last + 1));
    shares
}

/// A quantity on each side of the bond and in total.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct BySide {
    /// Low-coordinate side.
    pub bottom: f64,
    /// High-coordinate side.
    pub top: f64,
    /// Both sides together.
    pub total: f64,
}

impl From<[f64; 3]> for BySide {
    fn from([bottom, top, total]: [f64; 3]) -> Self {
        Self { bottom, top, total }
    }
}

/// Penetration and bond line at the end of a run. Depths count from midway between the bond surfaces. `wp-metrics --series`
/// measures the same in a state file.
#[derive(Clone, Debug, Serialize)]
pub struct BondMeasures {
    /// Weighted penetration (WP, Eq. 6), m.
    pub wp_m: BySide,
    /// Effective penetration (EP), m.
    pub ep_m: BySide,
    /// Volume of the adhesive beyond the bond surface of the adherend over that of all adhesive.
    pub entered_share: BySide,
    /// Mean depth of that adhesive below the surface, m; null if none has entered.
    pub mean_depth_m: BySide,
    /// Depth above which 95 % of the adhesive lies, m.
    pub p95_depth_m: BySide,
    /// Area of wood that adhesive wets, m2.
    pub wetted_area_m2: BySide,
    /// Depth to which the open lumens are at least half full, m; `total` is the smaller of the two sides.
    pub half_filled_depth_m: BySide,
    /// Mean filled fraction of the void between the bond surfaces and within two voxels of them.
    pub bond_line_filled: f64,
    /// `filled`, `starved` or `squeezed-out`.
    pub bond_line: String,
    /// Whether adhesive reached an outer face of the specimen. The specimen is then too small, and the depths are cut short.
    pub outer_face_reached: bool,
    /// Filled fraction of the open lumens by layer, from the middle to the deepest adhesive.
    pub filled_by_depth: FilledByDepth,
}

/// Filled fraction of the open lumens by layer.
#[derive(Clone, Debug, Serialize)]
pub struct FilledByDepth {
    /// Thickness of a layer, m.
    pub layer_m: f64,
    /// Low-coordinate side, from the middle outwards; null for layers without open lumens.
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
        assert!(!reaches_outer_face(&layers([0.0, 0.5, 1.0, 0.0])));
        assert!(reaches_outer_face(&layers([0.0, 0.5, 1.0, 1e-3])));
        assert!(reaches_outer_face(&layers([1e-3, 0.5, 1.0, 0.0])));
        assert!(!reaches_outer_face(&[]));
    }
}
