//! Fibres with their lumens and ends.

use rand::RngExt;

use super::cross_section::WALL;
use super::cut::WoodPoint;
use super::random::{Feature, stream};
use super::rays::{Place, Rays};
use super::recipe::Plan;
use super::species::FibreTraits;
use super::vessels::{VesselPart, Vessels};

/// Length of the taper at the closed ends, um.
const TAPER: f32 = 20.0;
/// Half of the wall that closes a fibre's end, um.
const END_HALF_WALL: f32 = 2.0;

/// Fibres: the Voronoi cells of jittered radial files in the strips between ray columns,
/// closed at staggered ends.
pub(crate) struct Fibres {
    traits: FibreTraits,
    strips: Vec<Strip>,
}

struct Strip {
    files: usize,
    spacing: f32,
    /// Position of the first fibre of each file.
    start: f32,
    fibres: Vec<Fibre>,
}

#[derive(Clone, Copy)]
struct Fibre {
    r: f32,
    across: f32,
    half_wall: f32,
    length: f32,
    phase: f32,
    /// False where a vessel has taken its place.
    alive: bool,
}

impl Fibres {
    pub(crate) fn place(
        plan: &Plan,
        side: usize,
        traits: FibreTraits,
        r: [f32; 2],
        rays: &Rays,
        vessels: &Vessels,
    ) -> Self {
        let mut random = stream(plan, side, Feature::Fibres);
        let FibreTraits {
            pitch,
            half_wall,
            length,
        } = traits;
        let start = r[0] - 3.0 * pitch;
        let per_file = ((r[1] - start) / pitch) as usize + 4;
        let mut strip = |[low, high]: [f32; 2]| {
            let width = high - low;
            let between_rays = width - plan.timber.rays.width[0];
            let files = (between_rays / pitch).round().max(1.0) as usize;
            let spacing = width / files as f32;
            let mut fibre = |i: usize| {
                let (file, place) = ((i % files) as f32, (i / files) as f32);
                let jitter = [0.12, 0.17].map(|size| pitch * random.random_range(-size..size));
                let across = (file + 0.5) * spacing + jitter[0];
                let r = start + pitch * (place + 0.5 * (file % 2.0)) + jitter[1];
                let length = random.random_range(length[0]..length[1]);
                Fibre {
                    r,
                    across,
                    half_wall: random.random_range(half_wall[0]..half_wall[1]),
                    length,
                    phase: random.random_range(0.0..length),
                    alive: has_room(vessels, r, low + across),
                }
            };
            Strip {
                files,
                spacing,
                start,
                fibres: (0..files * per_file).map(&mut fibre).collect(),
            }
        };
        Self {
            traits,
            strips: rays.strips().map(&mut strip).collect(),
        }
    }

    /// Radius (um) of the lumen a point is in, or `None` in a wall; `from_vessel` is the
    /// distance from the nearest vessel's outer wall.
    pub(crate) fn lumen(&self, point: WoodPoint, place: &Place, from_vessel: f32) -> Option<f32> {
        let strip = &self.strips[place.strip];
        let (fibre, to_border) = strip.nearest(self.traits.pitch, point.r, place.across)?;
        let to_wall = to_border.min(place.clearance).min(from_vessel);
        let along = point.l + fibre.phase;
        let to_end = (along - fibre.length * (along / fibre.length).round()).abs();
        let radius = 0.5 * self.traits.pitch - fibre.half_wall;
        let taper = radius * (1.0 - to_end / TAPER).max(0.0);
        let open = to_wall > fibre.half_wall + taper && to_end > END_HALF_WALL;
        open.then_some(radius)
    }
}

impl Strip {
    /// The living fibre nearest to (r, across) and the distance from the border of its
    /// Voronoi cell towards the second nearest.
    fn nearest(&self, pitch: f32, r: f32, across: f32) -> Option<(&Fibre, f32)> {
        let middle = ((r - self.start) / pitch) as usize;
        let first = middle.saturating_sub(2) * self.files;
        let last = ((middle + 3) * self.files).min(self.fibres.len());
        let mut best: Option<(f32, &Fibre)> = None;
        let mut second: Option<(f32, &Fibre)> = None;
        for fibre in self.fibres.get(first..last)?.iter().filter(|f| f.alive) {
            let (dr, da) = (r - fibre.r, across - fibre.across);
            let distance = dr * dr + da * da;
            if best.is_none_or(|(least, _)| distance < least) {
                second = best;
                best = Some((distance, fibre));
            } else if second.is_none_or(|(least, _)| distance < least) {
                second = Some((distance, fibre));
            }
        }
        let (nearest, fibre) = best?;
        let to_border = second.map_or(self.spacing, |(next, other)| {
            let (dr, da) = (other.r - fibre.r, other.across - fibre.across);
            (next - nearest) / (2.0 * (dr * dr + da * da).sqrt())
        });
        Some((fibre, to_border))
    }
}

/// Whether a fibre with its axis here keeps most of its lumen clear of the vessels.
fn has_room(vessels: &Vessels, r: f32, t: f32) -> bool {
    let axis = WoodPoint { l: 0.0, r, t };
    matches!(vessels.at(axis), VesselPart::Outside(distance) if distance > WALL)
}
