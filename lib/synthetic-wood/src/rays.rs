//! Rays of wood and their pits.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::cut::WoodPoint;
use super::random::{Feature, stream};
use super::recipe::Plan;
use super::species::{RayKind, RayTraits};

/// Wall of a ray cell against the fibres, which add their half wall, um.
const SIDE_WALL: f32 = 1.9;
/// Half of the wall between ray cells, um: with 1.45 um voxels no diagonal leaks.
const HALF_WALL: f32 = 1.3;
/// Radius of the pits in the end walls of ray cells and between rays and vessels, um.
const PIT_RADIUS: [f32; 2] = [2.6, 4.0];

/// Rays: sheets normal to t, one or more cells wide, of limited height along l.
pub(crate) struct Rays {
    traits: &'static RayTraits,
    columns: Vec<Column>,
}

struct Column {
    t: f32,
    /// Of a ray of one cell.
    half_width: f32,
    /// What more cells add to it: fibres keep out of that along the whole column.
    more: f32,
    phase: f32,
    /// Low and high end along l, ascending.
    rays: Vec<[f32; 2]>,
}

/// Where a point is with respect to the ray columns.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    /// Which strip between two columns (for the fibres).
    pub(crate) strip: usize,
    /// Position across the strip, um: rays push the fibres aside, so that this runs from 0 to
    /// the strip's width whether rays are there or not.
    pub(crate) across: f32,
    /// Distance from the nearer ray or strip border; negative inside a ray.
    pub(crate) clearance: f32,
    column: usize,
    /// Distance from the middle of that column, signed.
    offset: f32,
    /// Half width of that column's ray at this l, 0 where there is none.
    half_width: f32,
}

impl Rays {
    /// Ray columns over the given ranges of l and t, um.
    pub(crate) fn place(plan: &Plan, side: usize, l: [f32; 2], t: [f32; 2]) -> Self {
        let mut random = stream(plan, side, Feature::Rays);
        let traits = &plan.timber.rays;
        let (spacing, width) = (traits.spacing, traits.width);
        let mut columns = Vec::new();
        // One column before and one after the range, so that every point is in a strip.
        let mut next = t[0] - spacing * random.random_range(1.0..2.0);
        while next < t[1] + 2.0 * spacing {
            let (kind, more) = kind(traits, &mut random);
            let (height, between) = (kind.height, kind.between);
            let mut rays = Vec::new();
            let mut low = l[0] - random.random_range(0.0..height[1]);
            while low < l[1] {
                let high = low + random.random_range(height[0]..height[1]);
                rays.push([low, high]);
                low = high + random.random_range(between[0]..between[1]);
            }
            next += more;
            columns.push(Column {
                t: next,
                half_width: 0.5 * random.random_range(width[0]..width[1]),
                more,
                phase: random.random_range(0.0..traits.cell[1]),
                rays,
            });
            next += more;
            next += spacing * random.random_range(0.85..1.15);
        }
        Self { traits, columns }
    }

    /// Borders along t of each strip between two columns.
    pub(crate) fn strips(&self) -> impl Iterator<Item = [f32; 2]> {
        self.columns
            .windows(2)
            .map(|pair| strip(&pair[0], &pair[1]))
    }

    pub(crate) fn locate(&self, point: WoodPoint) -> Place {
        let after = self.columns.partition_point(|column| column.t <= point.t);
        let strip = after.clamp(1, self.columns.len() - 1) - 1;
        let (below, above) = (&self.columns[strip], &self.columns[strip + 1]);
        let low_half = below.half_width_at(point.l);
        let high_half = above.half_width_at(point.l);
        let (low, high) = (below.t + low_half, above.t - high_half);
        let [from, to] = self::strip(below, above);
        let (to_low, to_high) = (point.t - low, high - point.t);
        let nearer_low = to_low < to_high;
        Place {
            strip,
            across: to_low / (high - low) * (to - from),
            clearance: to_low.min(to_high),
            column: if nearer_low { strip } else { strip + 1 },
            offset: point.t - if nearer_low { below.t } else { above.t },
            half_width: if nearer_low { low_half } else { high_half },
        }
    }

    /// Whether a point inside a ray is in the lumen of a ray cell or in a pit between two.
    pub(crate) fn is_lumen(&self, point: WoodPoint, place: &Place) -> bool {
        if place.half_width - place.offset.abs() < SIDE_WALL {
            return false;
        }
        let Some([row, across]) = self.in_cell(point.l, place) else {
            return false;
        };
        if 0.5 * self.traits.cell[0] - row.abs() < HALF_WALL {
            return false;
        }
        let length = self.traits.cell[1];
        let along = point.r + self.columns[place.column].phase;
        let from_end = along - length * (along / length).round();
        from_end.abs() >= HALF_WALL || in_circle(row, across, PIT_RADIUS[0])
    }

    pub(crate) fn pits_vessel(&self, point: WoodPoint, place: &Place) -> bool {
        let in_pit = |[row, across]: [f32; 2]| in_circle(row, across, PIT_RADIUS[1]);
        place.half_width > SIDE_WALL && self.in_cell(point.l, place).is_some_and(in_pit)
    }

    /// Signed distances along l and across the ray from the middle of the ray cell that a point
    /// inside a ray is in; `None` in the wall between two cells across. Cells side by side are
    /// staggered by half their height.
    fn in_cell(&self, l: f32, place: &Place) -> Option<[f32; 2]> {
        let column = &self.columns[place.column];
        let [height, _] = self.traits.cell;
        let row = |along: f32| along - height * (along / height).round();
        let along = l + column.phase;
        if column.more <= 0.0 {
            return Some([row(along), place.offset]);
        }
        let width = 2.0 * place.half_width;
        let cells = ((width - self.traits.width[0]) / self.traits.more).round() + 1.0;
        let cells = cells.max(1.0);
        let cell = width / cells;
        let index = ((place.offset + place.half_width) / cell).floor();
        let across = place.offset + place.half_width - cell * (index + 0.5);
        let to_side = place.half_width - place.offset.abs();
        let between = 0.5 * cell - across.abs();
        let parted = between < HALF_WALL && to_side > 2.0 * HALF_WALL && cells > 1.0;
        (!parted).then(|| [row(along + 0.5 * height * (index % 2.0)), across])
    }
}

impl Column {
    /// Half width of the ray at l: a lens that tapers to both ends.
    fn half_width_at(&self, l: f32) -> f32 {
        let next = self.rays.partition_point(|ray| ray[1] < l);
        match self.rays.get(next) {
            Some(&[low, high]) if l > low => {
                let s = (2.0 * l - low - high) / (high - low);
                (self.half_width + self.more) * (1.0 - s.powi(8))
            }
            _ => 0.0,
        }
    }
}

/// Where the fibres between two columns are, along t.
fn strip(below: &Column, above: &Column) -> [f32; 2] {
    [below.t + below.more, above.t - above.more]
}

/// What a column is, and by how much its rays are wider than one cell, to each side. A species
/// of one kind takes no random numbers for it.
fn kind(traits: &'static RayTraits, random: &mut ChaCha8Rng) -> (&'static RayKind, f32) {
    let kind = match &traits.kinds[..] {
        [one] => one,
        kinds => {
            let chance: f32 = random.random();
            let drawn = kinds.iter().find(|kind| chance < kind.chance);
            drawn.unwrap_or(&kinds[0])
        }
    };
    let [least, most] = kind.cells;
    let cells = match least < most {
        true => random.random_range(least..most + 1),
        false => least,
    };
    (kind, 0.5 * (cells - 1) as f32 * traits.more)
}

fn in_circle(a: f32, b: f32, radius: f32) -> bool {
    a * a + b * b < radius * radius
}
