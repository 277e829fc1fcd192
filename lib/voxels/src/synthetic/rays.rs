use rand::RngExt;

use super::cut::WoodPoint;
use super::random::{Feature, stream};
use super::recipe::Plan;

/// Mean distance of ray columns along the ring, um: 8 to 12 rays per mm are met, because
/// vessels interrupt rays and rays end.
const SPACING: f32 = 63.0;
/// Width of a ray with its walls, um.
pub(super) const WIDTH: [f32; 2] = [11.2, 12.0];
/// Height of a ray along the fibres, um.
const HEIGHT: [f32; 2] = [100.0, 500.0];
/// Distance along the fibres between a ray and the next of its column, um.
const BETWEEN: [f32; 2] = [6.0, 20.0];
/// Wall of a ray cell against the fibres, which add their half wall, um.
const SIDE_WALL: f32 = 1.9;
/// Half of the wall between ray cells, um: with 1.45 um voxels no diagonal leaks.
const HALF_WALL: f32 = 1.3;
/// Height of a row of ray cells along l and length of a cell along r, um.
const CELL: [f32; 2] = [17.0, 75.0];
/// Radius of the pits in the end walls of ray cells and between rays and vessels, um.
const PIT_RADIUS: [f32; 2] = [2.6, 4.0];

/// Uniseriate rays: sheets normal to t, one cell wide, of limited height along l.
pub(super) struct Rays {
    columns: Vec<Column>,
}

struct Column {
    t: f32,
    half_width: f32,
    phase: f32,
    /// Low and high end along l, ascending.
    rays: Vec<[f32; 2]>,
}

/// Where a point is with respect to the ray columns.
#[derive(Clone, Copy)]
pub(super) struct Place {
    /// Which strip between two columns (for the fibres).
    pub(super) strip: usize,
    /// Position across the strip, um: rays push the fibres aside, so that this runs from 0 to
    /// the strip's width whether rays are there or not.
    pub(super) across: f32,
    /// Distance from the nearer ray or strip border; negative inside a ray.
    pub(super) clearance: f32,
    /// The nearer column.
    column: usize,
    /// Distance from the middle of that column, signed.
    offset: f32,
    /// Half width of that column's ray at this l, 0 where there is none.
    half_width: f32,
}

impl Rays {
    /// Ray columns over the given ranges of l and t, um.
    pub(super) fn place(plan: &Plan, side: usize, l: [f32; 2], t: [f32; 2]) -> Self {
        let mut random = stream(plan, side, Feature::Rays);
        let mut columns = Vec::new();
        // One column before and one after the range, so that every point is in a strip.
        let mut next = t[0] - SPACING * random.random_range(1.0..2.0);
        while next < t[1] + 2.0 * SPACING {
            let mut rays = Vec::new();
            let mut low = l[0] - random.random_range(0.0..HEIGHT[1]);
            while low < l[1] {
                let high = low + random.random_range(HEIGHT[0]..HEIGHT[1]);
                rays.push([low, high]);
                low = high + random.random_range(BETWEEN[0]..BETWEEN[1]);
            }
            columns.push(Column {
                t: next,
                half_width: 0.5 * random.random_range(WIDTH[0]..WIDTH[1]),
                phase: random.random_range(0.0..CELL[1]),
                rays,
            });
            next += SPACING * random.random_range(0.85..1.15);
        }
        Self { columns }
    }

    /// Borders along t of each strip between two columns.
    pub(super) fn strips(&self) -> impl Iterator<Item = [f32; 2]> {
        self.columns.windows(2).map(|pair| [pair[0].t, pair[1].t])
    }

    pub(super) fn locate(&self, point: WoodPoint) -> Place {
        let after = self.columns.partition_point(|column| column.t <= point.t);
        let strip = after.clamp(1, self.columns.len() - 1) - 1;
        let (below, above) = (&self.columns[strip], &self.columns[strip + 1]);
        let low_half = below.half_width_at(point.l);
        let high_half = above.half_width_at(point.l);
        let (low, high) = (below.t + low_half, above.t - high_half);
        let (to_low, to_high) = (point.t - low, high - point.t);
        let nearer_low = to_low < to_high;
        Place {
            strip,
            across: to_low / (high - low) * (above.t - below.t),
            clearance: to_low.min(to_high),
            column: if nearer_low { strip } else { strip + 1 },
            offset: point.t - if nearer_low { below.t } else { above.t },
            half_width: if nearer_low { low_half } else { high_half },
        }
    }

    /// Whether a point inside a ray is in the lumen of a ray cell or in a pit between two.
    pub(super) fn is_lumen(&self, point: WoodPoint, place: &Place) -> bool {
        if place.half_width - place.offset.abs() < SIDE_WALL {
            return false;
        }
        let row = self.offset_in_row(point.l, place);
        if 0.5 * CELL[0] - row.abs() < HALF_WALL {
            return false;
        }
        let along = point.r + self.columns[place.column].phase;
        let from_end = along - CELL[1] * (along / CELL[1]).round();
        from_end.abs() >= HALF_WALL || in_circle(row, place.offset, PIT_RADIUS[0])
    }

    /// Whether a point in a vessel's wall is in a vessel-ray pit.
    pub(super) fn pits_vessel(&self, point: WoodPoint, place: &Place) -> bool {
        place.half_width > SIDE_WALL
            && in_circle(
                self.offset_in_row(point.l, place),
                place.offset,
                PIT_RADIUS[1],
            )
    }

    fn offset_in_row(&self, l: f32, place: &Place) -> f32 {
        let along = l + self.columns[place.column].phase;
        along - CELL[0] * (along / CELL[0]).round()
    }
}

impl Column {
    /// Half width of the ray at l: a lens that tapers to both ends.
    fn half_width_at(&self, l: f32) -> f32 {
        let next = self.rays.partition_point(|ray| ray[1] < l);
        match self.rays.get(next) {
            Some(&[low, high]) if l > low => {
                let s = (2.0 * l - low - high) / (high - low);
                self.half_width * (1.0 - s.powi(8))
            }
            _ => 0.0,
        }
    }
}

fn in_circle(a: f32, b: f32, radius: f32) -> bool {
    a * a + b * b < radius * radius
}
