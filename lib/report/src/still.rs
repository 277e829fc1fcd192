//! The picture of a scene for those who run no scripts: what the viewer shows first, drawn here.

use voxels::Surface;

use crate::Error;
use crate::mesh::normals;
use crate::scene::Scene;

/// Where the viewer stands, about the vertical and above the horizontal; `viewer.js` begins there too.
const AZIMUTH: f32 = 0.6;
const ELEVATION: f32 = 0.45;
const WIDTH: usize = 800;
const HEIGHT: usize = 720;
/// Pixels of the drawing along a pixel of the picture.
const FINER: usize = 2;
/// The part of the box that is left of the wood, from the back.
const KEPT: f32 = 0.5;

const PAPER: [f32; 3] = [255.0; 3];
const ADHESIVE: Paint = Paint {
    outside: [230.0, 150.0, 20.0],
    inside: [170.0, 105.0, 5.0],
    nearer: 0.1,
};
const WOOD: Paint = Paint {
    outside: [190.0, 180.0, 168.0],
    inside: [128.0, 112.0, 96.0],
    nearer: 0.0,
};

/// How a surface is drawn.
struct Paint {
    outside: [f32; 3],
    /// Where it is cut open.
    inside: [f32; 3],
    /// Voxels by which it is drawn nearer: where liquid lies on wood, the liquid is seen.
    nearer: f32,
}

/// The picture as PNG.
pub(crate) fn png(scene: &Scene) -> Result<Vec<u8>, Error> {
    let mut canvas = Canvas::new(scene.edges);
    canvas.draw(&scene.wood, &WOOD, KEPT * scene.edges[2]);
    canvas.draw(&scene.adhesive, &ADHESIVE, f32::INFINITY);
    let failed = |e: png::EncodingError| Error(format!("cannot draw a picture: {e}"));
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, WIDTH as u32, HEIGHT as u32);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(&canvas.picture()).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

/// Colours, and how near what they show is, seen in parallel projection.
struct Canvas {
    /// To the right, up and towards the viewer.
    view: [[f32; 3]; 3],
    centre: [f32; 3],
    /// Pixels a voxel.
    scale: f32,
    near: Vec<f32>,
    colour: Vec<[f32; 3]>,
}

impl Canvas {
    fn new(edges: [f32; 3]) -> Self {
        let ((sa, ca), (se, ce)) = (AZIMUTH.sin_cos(), ELEVATION.sin_cos());
        let view = [
            [ca, 0.0, -sa],
            [-sa * se, ce, -ca * se],
            [sa * ce, se, ca * ce],
        ];
        // The projection of the box is the sum of those of its edges.
        let extent = |row: [f32; 3]| (0..3).map(|a| row[a].abs() * edges[a]).sum::<f32>();
        let fits = |row, pixels: usize| 0.96 * (pixels * FINER) as f32 / extent(row);
        let pixels = WIDTH * HEIGHT * FINER * FINER;
        Self {
            view,
            centre: edges.map(|e| 0.5 * e),
            scale: fits(view[0], WIDTH).min(fits(view[1], HEIGHT)),
            near: vec![f32::NEG_INFINITY; pixels],
            colour: vec![PAPER; pixels],
        }
    }

    /// Where a place is seen, in pixels, and how near.
    fn seen(&self, place: [f32; 3]) -> [f32; 3] {
        let along = |row: [f32; 3]| {
            (0..3)
                .map(|a| row[a] * (place[a] - self.centre[a]))
                .sum::<f32>()
                * self.scale
        };
        let [right, up, near] = self.view.map(along);
        [
            0.5 * (WIDTH * FINER) as f32 + right,
            0.5 * (HEIGHT * FINER) as f32 - up,
            near,
        ]
    }

    /// Draws what of a surface is behind `cut` (voxels from the back); its inside in one colour.
    fn draw(&mut self, surface: &Surface, paint: &Paint, cut: f32) {
        let seen: Vec<[f32; 3]> = (surface.vertices.iter())
            .map(|&vertex| {
                let [x, y, near] = self.seen(vertex);
                [x, y, near + paint.nearer * self.scale]
            })
            .collect();
        let facing = |n: [f32; 3]| (0..3).map(|a| n[a] * self.view[2][a]).sum::<f32>();
        let light: Vec<f32> = normals(surface).into_iter().map(facing).collect();
        for triangle in &surface.triangles {
            let corners = triangle.map(|i| i as usize);
            let depth = corners.map(|i| surface.vertices[i][2]);
            if depth.iter().all(|&z| z > cut) {
                continue;
            }
            self.fill(corners.map(|i| seen[i]), |weights, front| {
                let mean = |of: [f32; 3]| (0..3).map(|i| weights[i] * of[i]).sum::<f32>();
                if mean(depth) > cut {
                    return None;
                }
                let bright = 0.35 + 0.65 * mean(corners.map(|i| light[i])).abs();
                Some(if front {
                    paint.outside.map(|c| c * bright)
                } else {
                    paint.inside
                })
            });
        }
    }

    /// Asks for the colour of each pixel of a triangle that is nearer than what is there.
    fn fill(
        &mut self,
        [a, b, c]: [[f32; 3]; 3],
        colour: impl Fn([f32; 3], bool) -> Option<[f32; 3]>,
    ) {
        let cross = |p: [f32; 3], q: [f32; 3], x: f32, y: f32| {
            (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])
        };
        let area = cross(a, b, c[0], c[1]);
        if area == 0.0 {
            return;
        }
        let range = |i: usize, end: usize| {
            let low = a[i].min(b[i]).min(c[i]).floor().max(0.0) as usize;
            low..(a[i].max(b[i]).max(c[i]).ceil().max(0.0) as usize).min(end)
        };
        for row in range(1, HEIGHT * FINER) {
            for column in range(0, WIDTH * FINER) {
                let (x, y) = (column as f32 + 0.5, row as f32 + 0.5);
                let weights = [(b, c), (c, a), (a, b)].map(|(p, q)| cross(p, q, x, y) / area);
                let near = weights[0] * a[2] + weights[1] * b[2] + weights[2] * c[2];
                let at = row * WIDTH * FINER + column;
                if weights.iter().any(|&w| w < 0.0) || near <= self.near[at] {
                    continue;
                }
                // Rows go down: seen from outside the corners go round clockwise.
                if let Some(colour) = colour(weights, area < 0.0) {
                    (self.near[at], self.colour[at]) = (near, colour);
                }
            }
        }
    }

    /// The mean colours of the picture's pixels.
    fn picture(&self) -> Vec<u8> {
        let mut out = Vec::with_capacity(3 * WIDTH * HEIGHT);
        for row in 0..HEIGHT {
            for column in 0..WIDTH {
                for channel in 0..3 {
                    let parts = (0..FINER * FINER).map(|part| {
                        let (i, j) = (column * FINER + part % FINER, row * FINER + part / FINER);
                        self.colour[j * WIDTH * FINER + i][channel]
                    });
                    out.push((parts.sum::<f32>() / (FINER * FINER) as f32) as u8);
                }
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use particle_file::BitGrid;

    use super::*;

    /// A wall in the nearer half is cut away from before the liquid; one behind it is not, and is hidden.
    #[test]
    fn the_nearer_half_of_the_wood_is_cut_away() {
        let room = BitGrid::from_fn([9, 9, 9], |_, _, _| true);
        let slab = |from: usize| {
            let body = BitGrid::from_fn([9, 9, 9], |_, _, z| (from..from + 2).contains(&z));
            Surface::of(&body, &room)
        };
        let orange = |canvas: &Canvas| canvas.colour.iter().filter(|c| c[0] > 2.0 * c[2]).count();
        let seen = |wood: usize, adhesive: usize| {
            let mut canvas = Canvas::new([9.0; 3]);
            canvas.draw(&slab(wood), &WOOD, 4.5);
            canvas.draw(&slab(adhesive), &ADHESIVE, f32::INFINITY);
            orange(&canvas)
        };
        let alone = seen(6, 3);
        assert!(alone > WIDTH * HEIGHT * FINER * FINER / 10, "{alone}");
        let behind = seen(2, 0);
        assert!(behind < alone / 2, "{behind} of {alone}");
    }
}
