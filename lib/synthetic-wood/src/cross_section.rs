//! Lumens of vessels in the plane across the fibres: how much they cover, which are near.

use super::cut::Cut;
use super::recipe::Plan;

/// By how much the vessels' share of the cross-section may exceed that of their species.
const TOLERANCE: f32 = 0.02;
/// Wall of a vessel, um; fibres add their half wall outside it.
pub(crate) const WALL: f32 = 2.5;
/// How far outside a vessel its distance is still needed (fibre walls), um.
pub(crate) const REACH: f32 = 8.0;

/// A lumen across the fibres, um.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle {
    pub(crate) r: f32,
    pub(crate) t: f32,
    pub(crate) radius: f32,
}

impl Circle {
    /// Distance from its line, negative inside.
    pub(crate) fn outside(&self, r: f32, t: f32) -> f32 {
        let (dr, dt) = (r - self.r, t - self.t);
        (dr * dr + dt * dt).sqrt() - self.radius
    }

    fn covers(&self, point: &Point) -> bool {
        self.outside(point.r, point.t) < WALL
    }
}

/// Sample points over the cross-section: which share do vessels cover, in all and in the box.
pub(crate) struct Cover {
    points: Vec<Point>,
}

struct Point {
    r: f32,
    t: f32,
    in_box: bool,
    covered: bool,
}

const POINT_SPACING: f32 = 8.0;

impl Cover {
    pub(crate) fn new(plan: &Plan, cut: &Cut, side: usize, bounds: [[f32; 2]; 2]) -> Self {
        let [low, high] = plan.half_box(side);
        let along = |[low, high]: [f32; 2]| {
            let count = ((high - low) / POINT_SPACING) as usize;
            (0..count).map(move |i| low + (i as f32 + 0.5) * POINT_SPACING)
        };
        let point = |(r, t)| {
            let place = cut.crossing(r, t);
            let in_box = (0..2).all(|i| (low[i]..high[i]).contains(&place[i]));
            Point {
                r,
                t,
                in_box,
                covered: false,
            }
        };
        let pairs = along(bounds[0]).flat_map(|r| along(bounds[1]).map(move |t| (r, t)));
        Self {
            points: pairs.map(point).collect(),
        }
    }

    pub(crate) fn add(&mut self, circle: &Circle) {
        (self.points.iter_mut()).for_each(|point| point.covered |= circle.covers(point));
    }

    pub(crate) fn in_box(&self) -> f32 {
        let (all, covered, _) = self.count(true, &[]);
        covered as f32 / all.max(1) as f32
    }

    /// Whether the shares in and around the box stay below `share` with one more group: a
    /// small box is as much vessel as the opened ones make it, not more.
    pub(crate) fn has_room(&self, group: &[Circle], share: f32) -> bool {
        [true, false].into_iter().all(|in_box| {
            let (all, covered, newly) = self.count(in_box, group);
            newly == 0 || (covered + newly) as f32 <= (share + TOLERANCE) * all as f32
        })
    }

    /// Points in the box or around it, those covered, and those a group would newly cover.
    fn count(&self, in_box: bool, group: &[Circle]) -> (usize, usize, usize) {
        let points = self.points.iter().filter(|point| point.in_box == in_box);
        points.fold((0, 0, 0), |(all, covered, newly), point| {
            let new = !point.covered && group.iter().any(|circle| circle.covers(point));
            let [old, new] = [point.covered, new].map(usize::from);
            (all + 1, covered + old, newly + new)
        })
    }
}

/// Circles near a place, from square bins over the cross-section.
pub(crate) struct Bins {
    origin: [f32; 2],
    columns: usize,
    bins: Vec<Vec<u16>>,
}

const BIN: f32 = 40.0;

impl Bins {
    pub(crate) fn new(members: impl Iterator<Item = Circle>, bounds: [[f32; 2]; 2]) -> Self {
        let count = bounds.map(|[low, high]| ((high - low) / BIN).ceil().max(1.0) as usize);
        let origin = bounds.map(|[low, _]| low);
        let mut bins = vec![Vec::new(); count[0] * count[1]];
        for (index, circle) in members.enumerate() {
            let reach = circle.radius + WALL + REACH;
            let span = |centre: f32, axis: usize| {
                let bin = |s: f32| ((s - origin[axis]) / BIN).max(0.0) as usize;
                bin(centre - reach)..(bin(centre + reach) + 1).min(count[axis])
            };
            for i in span(circle.r, 0) {
                for j in span(circle.t, 1) {
                    bins[i * count[1] + j].push(index as u16);
                }
            }
        }
        Self {
            origin,
            columns: count[1],
            bins,
        }
    }

    pub(crate) fn near(&self, r: f32, t: f32) -> &[u16] {
        let i = ((r - self.origin[0]) / BIN).max(0.0) as usize;
        let j = ((t - self.origin[1]) / BIN).max(0.0) as usize;
        let bin = self.bins.get(i * self.columns + j.min(self.columns - 1));
        bin.map_or(&[], Vec::as_slice)
    }
}
