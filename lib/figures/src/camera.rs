//! Orthographic views of boxes of voxels.

use voxels::ADHESIVE;

use crate::bitmap::{SUPERSAMPLING, average};
use crate::solid::{Hit, Solids};

type Vector = [f64; 3];

/// Where a view is taken from: the bond's normal is up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Camera {
    /// Unit vectors to the right, up, and towards the viewer.
    right: Vector,
    up: Vector,
    towards: Vector,
    /// The axis that comes nearest to the viewer.
    pub(crate) front: usize,
}

const WOOD_COLOUR: Vector = [196.0, 188.0, 176.0];
const ADHESIVE_COLOUR: Vector = [236.0, 150.0, 10.0];
const EDGE: u8 = 120;
/// Direction of the light, to the right, up and towards the viewer.
const LIGHT: Vector = [-0.25, 0.62, 0.74];
/// Light from all around, and the share of the lamp.
const AMBIENT: f64 = 0.48;
const LAMP: f64 = 0.60;
/// How much corners are darker than planes.
const CORNERS: f64 = 0.9;
/// A step in distance of so many voxels has a dark line.
const STEP: f64 = 6.0;
/// Rays per pixel along an edge.
const RAYS: usize = SUPERSAMPLING;

fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

impl Camera {
    /// Turned by `turn` about the normal and raised by `tilt`, degrees. At 0 and 0 the axis
    /// before the normal points to the right and the one behind it to the viewer: x and z for y.
    pub(crate) fn new(normal: usize, turn: f64, tilt: f64) -> Self {
        // No ray runs along a face of voxels exactly.
        let [turn, tilt] = [turn + 1e-4, tilt + 1e-4].map(f64::to_radians);
        let axis =
            |i: usize| -> Vector { std::array::from_fn(|a| f64::from(u8::from(a == i % 3))) };
        let (across, up, front) = (axis(normal + 2), axis(normal), axis(normal + 1));
        let mix = |a: f64, b: f64, c: f64| -> Vector {
            std::array::from_fn(|i| a * across[i] + b * up[i] + c * front[i])
        };
        let ((st, ct), (se, ce)) = (turn.sin_cos(), tilt.sin_cos());
        Self {
            right: mix(ct, 0.0, -st),
            up: mix(-se * st, ce, -se * ct),
            towards: mix(ce * st, se, ce * ct),
            front: (normal + 1) % 3,
        }
    }

    /// Where a vector lies in the view: to the right and up.
    pub(crate) fn place(&self, vector: Vector) -> [f64; 2] {
        [dot(vector, self.right), dot(vector, self.up)]
    }

    /// Low and high corner in the view of a box between these corners.
    pub(crate) fn extent(&self, ends: [Vector; 2]) -> [[f64; 2]; 2] {
        let places = corners(ends).map(|corner| self.place(corner));
        let [mut low, mut high] = [places[0]; 2];
        for place in places {
            low = [0, 1].map(|a| low[a].min(place[a]));
            high = [0, 1].map(|a| high[a].max(place[a]));
        }
        [low, high]
    }

    /// The solids in a box between corners (voxels, from their own), so many pixels across: pixels across and
    /// down, and row by row from the top, three bytes a pixel.
    pub(crate) fn view(
        &self,
        solids: &Solids,
        ends: [Vector; 2],
        across: usize,
    ) -> ([usize; 2], Vec<u8>) {
        let [low, high] = self.extent(ends);
        let width = across.max(1) * RAYS;
        let voxel = (high[0] - low[0]) / width as f64;
        let height = (((high[1] - low[1]) / voxel).ceil() as usize)
            .max(1)
            .next_multiple_of(RAYS);
        let far = corners(ends).map(|c| dot(c, self.towards));
        let far = far.into_iter().fold(f64::NEG_INFINITY, f64::max) + 2.0;
        let mut hits = Vec::with_capacity(width * height);
        for row in 0..height {
            for column in 0..width {
                let x = low[0] + (column as f64 + 0.5) * voxel;
                let y = high[1] - (row as f64 + 0.5) * voxel;
                // Places of solids begin half a voxel before the box: at the centres outside it.
                let start = std::array::from_fn(|a| {
                    x * self.right[a] + y * self.up[a] + far * self.towards[a] + 0.5
                });
                hits.push(solids.meet(start, self.towards.map(|x| -x)));
            }
        }
        let mut pixels = self.shaded(&hits, width);
        let view = [low[0], high[1], far, voxel];
        self.edges(&mut pixels, &hits, ends, view, width);
        let size = [width / RAYS, height / RAYS];
        (size, average(pixels.as_flattened(), width))
    }

    fn shaded(&self, hits: &[Option<Hit>], width: usize) -> Vec<[u8; 3]> {
        let length = dot(LIGHT, LIGHT).sqrt();
        let light = LIGHT.map(|x| x / length);
        let light: Vector = std::array::from_fn(|a| {
            light[0] * self.right[a] + light[1] * self.up[a] + light[2] * self.towards[a]
        });
        let colour = |(i, hit): (usize, &Option<Hit>)| {
            let Some(hit) = hit else {
                return [255; 3];
            };
            let above = i.checked_sub(width);
            let before = i.checked_sub(1).filter(|_| i % width > 0);
            let step = above.into_iter().chain(before).any(|other| {
                hits[other].is_some_and(|other| (other.distance - hit.distance).abs() > STEP)
            });
            let lit = AMBIENT + LAMP * dot(hit.normal, light).max(0.0);
            let open = (1.0 - CORNERS * (hit.filled - 0.5)).clamp(0.5, 1.1);
            let shade = lit * open * if step { 0.55 } else { 1.0 };
            let base = match hit.label {
                ADHESIVE => ADHESIVE_COLOUR,
                _ => WOOD_COLOUR,
            };
            base.map(|c| (c * shade).round().clamp(0.0, 255.0) as u8)
        };
        hits.iter().enumerate().map(colour).collect()
    }

    /// The edges of the box as far as nothing stands before them.
    fn edges(
        &self,
        pixels: &mut [[u8; 3]],
        hits: &[Option<Hit>],
        ends: [Vector; 2],
        [left, top, far, voxel]: [f64; 4],
        width: usize,
    ) {
        let height = pixels.len() / width;
        let corners = corners(ends);
        let pairs = (0..8_usize).flat_map(|c| [1, 2, 4].map(|axis| (c, c | axis)));
        for (from, to) in pairs.filter(|(from, to)| from != to) {
            let [a, b] = [corners[from], corners[to]];
            let steps =
                ((0..3).map(|i| (b[i] - a[i]).abs()).fold(0.0, f64::max) / voxel * 2.0) as usize;
            for step in 0..=steps {
                let share = step as f64 / steps.max(1) as f64;
                let place: Vector = std::array::from_fn(|i| a[i] + share * (b[i] - a[i]));
                let [x, y] = self.place(place);
                let column = (((x - left) / voxel) as usize).min(width - 1);
                let row = (((top - y) / voxel).max(0.0) as usize).min(height - 1);
                let distance = far - dot(place, self.towards);
                let at = row * width + column;
                if hits[at].is_none_or(|hit| hit.distance > distance - 1.0) {
                    pixels[at] = [EDGE; 3];
                }
            }
        }
    }
}

/// All corners of a box between two.
fn corners(ends: [Vector; 2]) -> [Vector; 8] {
    std::array::from_fn(|c| std::array::from_fn(|a| ends[c >> a & 1][a]))
}

#[cfg(test)]
mod tests {
    use particle_file::{BitGrid, Block, Material};
    use voxels::LabelVolume;

    use super::*;

    const EDGE: usize = 40;

    fn solids(inside: impl Fn(f64, f64, f64) -> bool + Sync) -> Solids {
        let middle = |i: usize| i as f64 + 0.5 - 0.5 * EDGE as f64;
        let bits = BitGrid::from_fn([EDGE; 3], |x, y, z| inside(middle(x), middle(y), middle(z)));
        let block = Block::new("adhesive", Material::Adhesive, [0.0; 3], 1.0, &bits);
        Solids::new(&LabelVolume::of_block(&block, bits.view()), |_| true)
    }

    /// Area that is not white nor an edge of the box, in voxel faces, and its mean place.
    fn shown(solids: &Solids, camera: &Camera) -> (f64, [f64; 2]) {
        let edges = [[0.0; 3], [EDGE as f64; 3]];
        let (size, rgb) = camera.view(solids, edges, 200);
        let [low, high] = camera.extent(edges);
        let pixel = (high[0] - low[0]) / size[0] as f64;
        let coloured = |rgb: &[u8]| rgb[0] > rgb[2].saturating_add(40);
        let found: Vec<usize> = (rgb.chunks(3).enumerate())
            .filter(|(_, rgb)| coloured(rgb))
            .map(|(i, _)| i)
            .collect();
        let count = found.len() as f64;
        let mean = |part: &dyn Fn(usize) -> usize| {
            found.iter().map(|i| part(*i) as f64 + 0.5).sum::<f64>() / count * pixel
        };
        let place = [mean(&|i| i % size[0]), mean(&|i| i / size[0])];
        (count * pixel * pixel, place)
    }

    /// The silhouette of a ball is a disc, that of a box the sum of its faces' projections.
    #[test]
    fn silhouettes_have_their_area() {
        let ball = solids(|x, y, z| x * x + y * y + z * z < 144.0);
        let brick = solids(|x, y, z| x.abs() < 15.0 && y.abs() < 6.0 && z.abs() < 10.0);
        for (turn, tilt) in [(35.0, 25.0), (0.0, 0.0), (-70.0, 50.0), (10.0, 90.0)] {
            let camera = Camera::new(1, turn, tilt);
            let [dx, dy, dz] = camera.towards.map(f64::abs);
            let faces = 12.0 * 20.0 * dx + 30.0 * 20.0 * dy + 30.0 * 12.0 * dz;
            let disc = std::f64::consts::PI * 144.0;
            // Edges and steps of voxels are rounded: by so many voxels along the outline.
            let off = [(&ball, disc, 75.4), (&brick, faces, 124.0)]
                .map(|(solids, exact, outline)| (shown(solids, &camera).0 - exact) / outline);
            println!("turn {turn}, tilt {tilt}: outline of ball and brick off by {off:.3?} voxels");
            assert!(off.iter().all(|off| off.abs() < 0.3));
        }
    }

    #[test]
    fn up_is_the_normal_and_the_front_is_nearer() {
        for normal in [0, 1, 2] {
            let camera = Camera::new(normal, 35.0, 25.0);
            let along = |a: usize| std::array::from_fn(|b| f64::from(u8::from(a == b)));
            let [across, up] = camera.place(along(normal));
            assert!(across.abs() < 1e-9 && up > 0.9);
            assert!(dot(along(camera.front), camera.towards) > 0.5);
            // Right-handed.
            let [r, u, t] = [camera.right, camera.up, camera.towards];
            let cross = [
                r[1] * u[2] - r[2] * u[1],
                r[2] * u[0] - r[0] * u[2],
                r[0] * u[1] - r[1] * u[0],
            ];
            assert!((dot(cross, t) - 1.0).abs() < 1e-9);
        }
        // A slab near the top of the box is seen near the top of the view.
        let high = solids(|_, y, _| y > 10.0);
        let low = solids(|_, y, _| y < -10.0);
        let camera = Camera::new(1, 35.0, 25.0);
        let [high, low] = [&high, &low].map(|solids| shown(solids, &camera).1[1]);
        let apart = 25.0 * 25_f64.to_radians().cos();
        assert!((low - high - apart).abs() < 5.0, "{high} {low}");
    }

    /// One voxel, and a film of one layer, are still there.
    #[test]
    fn films_and_single_voxels_are_visible() {
        let camera = Camera::new(1, 0.0, 90.0);
        let first = |x: f64| x > 0.0 && x < 1.0;
        let film = shown(&solids(|_, y, _| first(y)), &camera).0;
        assert!((film / 1600.0 - 1.0).abs() < 0.02, "{film}");
        let one = solids(|x, y, z| first(x) && first(y) && first(z));
        let voxel = shown(&one, &camera).0;
        assert!(voxel > 0.3, "{voxel}");
    }
}
