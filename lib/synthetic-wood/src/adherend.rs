//! One adherend: what is wood at a point, and of which tissue.

use super::cut::Cut;
use super::fibres::Fibres;
use super::rays::Rays;
use super::recipe::Plan;
use super::species::Grain;
use super::tracheids::Tracheids;
use super::vessels::{VesselPart, Vessels};

/// The tissues of the wood, in the order of their counts; tracheids count as fibres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tissue {
    Vessel,
    Fibre,
    Ray,
}

/// What the wood is at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Sample {
    /// Cell wall.
    Wall(Tissue),
    /// Lumen or pit of this radius, um.
    Lumen(Tissue, f32),
    /// Lumen of the isolated tube of the PF specimen.
    Tube,
}

impl Sample {
    pub(crate) fn tissue(&self) -> Tissue {
        match self {
            Self::Wall(tissue) | Self::Lumen(tissue, _) => *tissue,
            Self::Tube => Tissue::Vessel,
        }
    }
}

/// Voxels of one adherend by tissue: all, and open ones.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Counts {
    pub(crate) all: [u64; 3],
    pub(crate) open: [u64; 3],
}

impl Counts {
    pub(crate) fn add(&mut self, sample: &Sample) {
        let tissue = sample.tissue() as usize;
        self.all[tissue] += 1;
        self.open[tissue] += u64::from(!matches!(sample, Sample::Wall(_)));
    }
}

impl std::iter::Sum for Counts {
    fn sum<I: Iterator<Item = Self>>(counts: I) -> Self {
        let plus = |a: [u64; 3], b: [u64; 3]| [0, 1, 2].map(|tissue| a[tissue] + b[tissue]);
        counts.fold(Self::default(), |a, b| Self {
            all: plus(a.all, b.all),
            open: plus(a.open, b.open),
        })
    }
}

/// Radius of ray cells for the penetration, um.
const RAY_RADIUS: f32 = 3.5;
/// Radius of vessel pits for the penetration, um: their membranes are finer than a voxel and
/// hold the adhesive back.
const PIT_RADIUS: f32 = 1.0;
/// Margin of the anatomy around the box, um: more than the largest vessel.
const MARGIN: f32 = 110.0;

/// One piece of wood, defined everywhere in and around its half of the box.
pub(crate) struct Adherend {
    pub(crate) cut: Cut,
    pub(crate) vessels: Vessels,
    rays: Rays,
    axial: Axial,
}

/// The cells between vessels and rays.
enum Axial {
    Fibres(Fibres),
    Tracheids(Tracheids),
}

impl Adherend {
    /// The bottom and the top adherend of a plan, or its one piece of undamaged wood.
    pub(crate) fn all(plan: &Plan) -> Vec<Self> {
        let sides = if plan.adhesive.is_some() { 2 } else { 1 };
        (0..sides).map(|side| Self::grow(plan, side)).collect()
    }

    fn grow(plan: &Plan, side: usize) -> Self {
        let cut = Cut::new(plan, side);
        let bounds = cut.bounds(plan.half_box(side));
        let [l, r, t] = bounds.map(|[low, high]| [low - MARGIN, high + MARGIN]);
        let vessels = Vessels::place(plan, &cut, side, [r, t]);
        let rays = Rays::place(plan, side, l, t);
        let axial = match plan.timber.grain {
            Grain::Fibres(traits) => {
                Axial::Fibres(Fibres::place(plan, side, traits, r, &rays, &vessels))
            }
            Grain::Tracheids(traits) => {
                Axial::Tracheids(Tracheids::place(plan, side, traits, &rays))
            }
        };
        Self {
            cut,
            vessels,
            rays,
            axial,
        }
    }

    /// What the wood is at a box position (um from the middle of the bond plane).
    pub(crate) fn at(&self, position: [f32; 3]) -> Sample {
        let point = self.cut.locate(position);
        let place = self.rays.locate(point);
        match self.vessels.at(point) {
            VesselPart::Lumen(vessel) if vessel.sealed => Sample::Tube,
            VesselPart::Lumen(vessel) => Sample::Lumen(Tissue::Vessel, vessel.lumen.radius),
            VesselPart::Pit => Sample::Lumen(Tissue::Vessel, PIT_RADIUS),
            VesselPart::Wall(vessel) => {
                if !vessel.sealed && self.rays.pits_vessel(point, &place) {
                    Sample::Lumen(Tissue::Vessel, PIT_RADIUS)
                } else {
                    Sample::Wall(Tissue::Vessel)
                }
            }
            VesselPart::Outside(_) if place.clearance < 0.0 => {
                if self.rays.is_lumen(point, &place) {
                    Sample::Lumen(Tissue::Ray, RAY_RADIUS)
                } else {
                    Sample::Wall(Tissue::Ray)
                }
            }
            VesselPart::Outside(distance) => {
                let radius = match &self.axial {
                    Axial::Fibres(fibres) => fibres.lumen(point, &place, distance),
                    Axial::Tracheids(tracheids) => tracheids.lumen(point, &place),
                };
                match radius {
                    Some(radius) => Sample::Lumen(Tissue::Fibre, radius),
                    None => Sample::Wall(Tissue::Fibre),
                }
            }
        }
    }
}
