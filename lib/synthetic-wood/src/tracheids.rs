//! Tracheids: rectangular cells in radial files, early to late wood within each growth ring.

use rand::RngExt;

use super::cut::WoodPoint;
use super::random::{Feature, stream};
use super::rays::{Place, Rays};
use super::recipe::Plan;
use super::species::TracheidTraits;

/// Radius of the corners of a lumen, um, where it is wide enough.
const CORNER: f32 = 5.0;
/// Length of the taper at the closed ends, um.
const TAPER: f32 = 60.0;
/// Half of the wall that closes an end, um.
const END_HALF_WALL: f32 = 2.0;
/// How far, in shares of a ring, the cells of a file are shifted against their mean place, so
/// that the rows of neighbouring files do not line up.
const SHIFT: f32 = 0.02;
/// Narrowest and widest file over the mean.
const WIDTHS: [f32; 2] = [0.7, 1.3];

/// The tracheids of one piece of wood. Bordered pits have no opening here: their membranes are
/// finer than a voxel, and in dried spruce they are mostly closed (docs/wood.md).
pub(crate) struct Tracheids {
    traits: TracheidTraits,
    /// Where a ring begins, r.
    origin: f32,
    strips: Vec<Strip>,
}

struct Strip {
    files: Vec<File>,
}

#[derive(Clone, Copy)]
struct File {
    /// Where in its strip it begins, and its width, um.
    low: f32,
    width: f32,
    /// Cells in a ring.
    cells: f32,
    shift: f32,
    /// Makes the ends of its cells.
    seed: u32,
}

impl Tracheids {
    pub(crate) fn place(plan: &Plan, side: usize, traits: TracheidTraits, rays: &Rays) -> Self {
        let mut random = stream(plan, side, Feature::Fibres);
        let origin = random.random_range(0.0..traits.ring);
        let usual = traits.ring / mean_pitch(&traits);
        let mut file = || File {
            low: 0.0,
            width: random.random_range(WIDTHS[0]..WIDTHS[1]),
            cells: (usual + random.random_range(-1.5..1.5)).round(),
            shift: random.random_range(-SHIFT..SHIFT),
            seed: random.random(),
        };
        let mut strip = |[low, high]: [f32; 2]| {
            let width = high - low;
            let count = (width / traits.tangential).round().max(1.0) as usize;
            let mut files: Vec<File> = (0..count).map(|_| file()).collect();
            let scale = width / files.iter().map(|file| file.width).sum::<f32>();
            let mut low = 0.0;
            for file in &mut files {
                (file.low, file.width) = (low, scale * file.width);
                low += file.width;
            }
            Strip { files }
        };
        Self {
            traits,
            origin,
            strips: rays.strips().map(&mut strip).collect(),
        }
    }

    /// Half of the lesser width (um) of the lumen a point is in, or `None` in a wall.
    pub(crate) fn lumen(&self, point: WoodPoint, place: &Place) -> Option<f32> {
        let strip = &self.strips[place.strip];
        let begun = strip.files.iter().rfind(|file| file.low <= place.across);
        let file = begun.or(strip.files.first())?;
        let across = place.across - file.low - 0.5 * file.width;

        let rings = (point.r - self.origin) / self.traits.ring;
        let ring = rings.floor();
        let share = rings - ring;
        let shifted = share + file.shift * (std::f32::consts::PI * share).sin();
        let (pitch, half_wall) = self.traits.at(share);
        let count = self.traits.cells_before(shifted) / self.traits.cells_before(1.0) * file.cells;
        let cell = count.floor().min(file.cells - 1.0);
        let along_file = (count - cell - 0.5) * pitch;

        let half = [0.5 * pitch - half_wall, 0.5 * file.width - half_wall];
        let radius = half[0].min(half[1]);
        let to_end = file.distance_to_end(ring, cell, point.l, self.traits.length);
        let taper = radius * (1.0 - to_end / TAPER).max(0.0);
        let inside = -rounded_box([along_file, across], half);
        let open = inside > taper && to_end > END_HALF_WALL && place.clearance > half_wall;
        open.then_some(radius)
    }
}

impl TracheidTraits {
    /// Radial pitch and half of the wall at a share of the ring.
    fn at(&self, share: f32) -> (f32, f32) {
        let [begin, end] = self.transition;
        let late = ((share - begin) / (end - begin)).clamp(0.0, 1.0);
        let between = |[a, b]: [f32; 2]| a + late * (b - a);
        (between(self.radial), between(self.half_wall))
    }

    /// Cells between the beginning of a ring and a share of it: the integral of ring/pitch.
    fn cells_before(&self, share: f32) -> f32 {
        let [begin, end] = self.transition;
        let [early, late] = self.radial;
        let rate = (late - early) / (end - begin);
        let at = |share: f32| self.at(share).0;
        let middle = share.clamp(begin, end);
        let shares = share.min(begin) / early
            + (at(middle) / early).ln() / rate
            + (share - end).max(0.0) / late;
        self.ring * shares
    }
}

fn mean_pitch(traits: &TracheidTraits) -> f32 {
    traits.ring / traits.cells_before(1.0)
}

impl File {
    /// Distance along l from the nearest end of a cell; each cell has its own ends.
    fn distance_to_end(&self, ring: f32, cell: f32, l: f32, length: f32) -> f32 {
        let key = (ring as i32 as u32).wrapping_mul(97) ^ (cell as u32).wrapping_mul(0x9E37_79B9);
        let mut mixed = self.seed ^ key;
        for _ in 0..2 {
            mixed = (mixed ^ (mixed >> 16)).wrapping_mul(0x45D9_F3B5);
        }
        let along = l / length + (mixed >> 8) as f32 / (1 << 24) as f32;
        length * (along - along.round()).abs()
    }
}

/// Signed distance of a point from a box with rounded corners around the origin, negative inside.
fn rounded_box(point: [f32; 2], half: [f32; 2]) -> f32 {
    let corner = CORNER.min(0.8 * half[0].min(half[1])).max(0.0);
    let [x, y] = [0, 1].map(|i| point[i].abs() - half[i] + corner);
    let outside = x.max(0.0).hypot(y.max(0.0));
    outside + x.max(y).min(0.0) - corner
}
