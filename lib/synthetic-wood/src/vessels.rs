//! Vessels in groups with their pits.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::cross_section::{Bins, Circle, Cover, REACH, WALL};
use super::cut::{Cut, WoodPoint};
use super::random::{Feature, stream};
use super::recipe::{AdhesiveSystem, Plan};
use super::species::VesselTraits;

/// Half of the wall that the vessels of a radial multiple share, um.
const SHARED_HALF_WALL: f32 = 2.0;
/// Least wood between two groups, um.
const BETWEEN: f32 = 5.0;
/// Spacing of the members of a multiple over the sum of their radii: below one, so that the
/// shared wall is flat as in real radial multiples.
const FLATTENED: f32 = 0.88;
/// Length of vessel elements, um; a rim at each end is what a simple perforation leaves.
const ELEMENT: [f32; 2] = [300.0, 600.0];
/// Thickness of the perforation rim along the vessel and its width over the radius, um and 1.
const RIM: [f32; 2] = [3.5, 0.16];
/// Lumen diameter of the isolated tube of the PF specimen, um.
const TUBE: f32 = 96.0;

/// One vessel: a tube along l.
#[derive(Clone, Debug)]
pub(crate) struct Vessel {
    pub(crate) lumen: Circle,
    element: f32,
    phase: f32,
    pit_radius: f32,
    /// Without pits: the isolated tube.
    pub(crate) sealed: bool,
}

/// What a point is with respect to the vessels.
pub(crate) enum VesselPart<'a> {
    /// In the lumen of a vessel.
    Lumen(&'a Vessel),
    /// In a pit between two vessels.
    Pit,
    /// In the wall of a vessel.
    Wall(&'a Vessel),
    /// Outside all vessels, this far (um, at most `REACH`) from the nearest outer wall.
    Outside(f32),
}

/// The vessels of one adherend.
pub(crate) struct Vessels {
    members: Vec<Vessel>,
    bins: Bins,
}

impl Vessels {
    /// Places vessels over the rectangle `bounds` (r and t, um): in a bonded specimen first one
    /// that the bond face opens along the box, then (PF, bottom) the isolated tube; then random
    /// groups until the share is reached.
    pub(crate) fn place(plan: &Plan, cut: &Cut, side: usize, bounds: [[f32; 2]; 2]) -> Self {
        let mut members = Vec::new();
        let Some(traits) = &plan.timber.vessels else {
            return Self::of(members, bounds);
        };
        let mut random = stream(plan, side, Feature::Vessels);
        if plan.adhesive.is_some() {
            members.push(opened(plan, traits, cut, side, &mut random));
            members.extend(isolated(plan, traits, cut, side, &mut random));
        }
        let [r, t] = bounds;
        let mut cover = Cover::new(plan, cut, side, bounds);
        members
            .iter()
            .for_each(|vessel: &Vessel| cover.add(&vessel.lumen));
        // Random sequential placement jams near this share; the bound ends hopeless tries.
        for _ in 0..20_000 {
            if cover.in_box() >= traits.share {
                break;
            }
            let start = [
                random.random_range(r[0]..r[1]),
                random.random_range(t[0]..t[1]),
            ];
            let group = group(traits, start, &mut random);
            let clear = |a: &Vessel| members.iter().all(|b| a.clear_of(b));
            let lumens: Vec<Circle> = group.iter().map(|vessel| vessel.lumen).collect();
            if group.iter().all(clear) && cover.has_room(&lumens, traits.share) {
                lumens.iter().for_each(|lumen| cover.add(lumen));
                members.extend(group);
            }
        }
        Self::of(members, bounds)
    }

    fn of(members: Vec<Vessel>, bounds: [[f32; 2]; 2]) -> Self {
        let bins = Bins::new(members.iter().map(|vessel| vessel.lumen), bounds);
        Self { members, bins }
    }

    pub(crate) fn at(&self, point: WoodPoint) -> VesselPart<'_> {
        let mut nearest = (f32::INFINITY, None);
        let mut second = f32::INFINITY;
        for &index in self.bins.near(point.r, point.t) {
            let vessel = &self.members[index as usize];
            let outside = vessel.lumen.outside(point.r, point.t);
            if outside < nearest.0 {
                second = nearest.0;
                nearest = (outside, Some(vessel));
            } else {
                second = second.min(outside);
            }
        }
        match nearest {
            (outside, Some(vessel)) if outside < WALL => vessel.part(point, outside, second),
            (outside, _) => VesselPart::Outside((outside - WALL).min(REACH)),
        }
    }
}

impl Vessel {
    fn new(traits: &VesselTraits, r: f32, t: f32, radius: f32, random: &mut ChaCha8Rng) -> Self {
        let element = random.random_range(ELEMENT[0]..ELEMENT[1]);
        Self {
            lumen: Circle { r, t, radius },
            element,
            phase: random.random_range(0.0..element),
            pit_radius: 0.5 * random.random_range(traits.pit[0]..traits.pit[1]),
            sealed: false,
        }
    }

    fn clear_of(&self, other: &Self) -> bool {
        let Circle { r, t, radius } = other.lumen;
        self.lumen.outside(r, t) - radius > 2.0 * WALL + BETWEEN
    }

    /// Which part of this vessel a point is in that is nearer to it than to any other;
    /// `outside` and `second` are the distances from its lumen and from the next vessel's.
    fn part(&self, point: WoodPoint, outside: f32, second: f32) -> VesselPart<'_> {
        let to_shared_wall = 0.5 * (second - outside);
        if outside >= 0.0 || self.in_rim(point.l, outside) {
            VesselPart::Wall(self)
        } else if to_shared_wall >= SHARED_HALF_WALL {
            VesselPart::Lumen(self)
        } else if self.in_pit(point) {
            VesselPart::Pit
        } else {
            VesselPart::Wall(self)
        }
    }

    /// Whether (l, t) is in a pit of the shared wall, which is normal to r.
    fn in_pit(&self, point: WoodPoint) -> bool {
        let pitch = 2.0 * self.pit_radius + 8.0;
        let from_centre = |s: f32| s - pitch * (s / pitch).round();
        let (l, t) = (from_centre(point.l), from_centre(point.t - self.lumen.t));
        l * l + t * t < self.pit_radius * self.pit_radius
    }

    fn in_rim(&self, l: f32, outside: f32) -> bool {
        let along = l + self.phase;
        let to_end = along - self.element * (along / self.element).round();
        2.0 * to_end.abs() < RIM[0] && outside > -RIM[1] * self.lumen.radius
    }
}

/// A solitary vessel or a radial multiple starting at `[r, t]`.
fn group(traits: &VesselTraits, start: [f32; 2], random: &mut ChaCha8Rng) -> Vec<Vessel> {
    let chance: f32 = random.random();
    let more = traits.groups.iter().filter(|&&bound| chance >= bound);
    let count = 1 + more.count();
    let mut r = start[0];
    let mut last = 0.0;
    (0..count)
        .map(|i| {
            let radius = 0.5 * random.random_range(traits.diameter[0]..traits.diameter[1]);
            if i > 0 {
                r += FLATTENED * (last + radius);
            }
            last = radius;
            let t = start[1] + random.random_range(-0.1..0.1) * radius;
            Vessel::new(traits, r, t, radius, random)
        })
        .collect()
}

/// A vessel that the face cuts open along the box: small boxes must have one on both sides
/// for penetration to mean anything. It reaches into the box from the side, by at most 0.3
/// of the width, so that fibres are most of a small face and its void stays of the
/// slab's size; the two adherends' vessels are at opposite sides.
fn opened(
    plan: &Plan,
    traits: &VesselTraits,
    cut: &Cut,
    side: usize,
    random: &mut ChaCha8Rng,
) -> Vessel {
    let half_width = 0.5 * plan.edges()[0];
    let radius = 0.5 * traits.diameter[0] * random.random_range(1.0..1.1);
    let depth = plan.mean_recess() + random.random_range(0.2..0.45) * radius;
    let reach = (0.6 * half_width).min(2.0 * radius) * random.random_range(0.85..1.0);
    let x = half_width - reach + radius;
    let centre = match side {
        0 => cut.locate([x, -depth, 0.0]),
        _ => cut.locate([-x, depth, 0.0]),
    };
    Vessel::new(traits, centre.r, centre.t, radius, random)
}

/// The isolated tube of the PF specimen: in the bottom adherend, wholly behind the face along
/// the box, and at most a third of the adhesive. Small boxes have no room for it.
fn isolated(
    plan: &Plan,
    traits: &VesselTraits,
    cut: &Cut,
    side: usize,
    random: &mut ChaCha8Rng,
) -> Option<Vessel> {
    if plan.adhesive != Some(AdhesiveSystem::Pf) || side == 1 {
        return None;
    }
    let [width, height, length] = plan.edges();
    let radius = 0.5 * TUBE;
    let outer = radius + WALL + BETWEEN;
    let drift = 0.5 * length * cut.slope().abs();
    // Four mean recesses bound the deepest valley of the face.
    let nearest = 4.0 * plan.mean_recess() + outer + drift;
    let farthest = 0.5 * height - radius;
    let share = std::f32::consts::PI * radius * radius / (width * plan.slab as f32);
    if nearest >= farthest || share > 1.0 / 3.0 {
        return None;
    }
    let depth = nearest + 0.3 * (farthest - nearest);
    // Away from the opened vessel.
    let x = -0.25 * width;
    let centre = cut.locate([x, -depth, 0.0]);
    let mut tube = Vessel::new(traits, centre.r, centre.t, radius, random);
    tube.sealed = true;
    Some(tube)
}
