//! Surfaces as the page holds them: coordinates of 16 bits, packed, in Base64.

use std::io::Write;

use figures::base64;
use flate2::Compression;
use flate2::write::GzEncoder;
use voxels::Surface;

/// A surface for the viewer: number of vertices and triangles (u32 each), then coordinates as u16
/// of the box's edges and numbers of vertices as u32, each as difference from the one three before,
/// and all low bytes before the next higher ones, which packs best; little-endian, gzip, Base64.
/// `edges` are the box's, in the unit of the vertices. `viewer.js` reads it.
pub(crate) fn packed(surface: &Surface, edges: [f32; 3]) -> String {
    let counts = [surface.vertices.len(), surface.triangles.len()];
    let mut bytes: Vec<u8> = (counts.iter().flat_map(|&n| (n as u32).to_le_bytes())).collect();
    let steps = |vertex: &[f32; 3]| {
        std::array::from_fn(|a| {
            (vertex[a] / edges[a] * f32::from(u16::MAX)).clamp(0.0, f32::from(u16::MAX)) as u32
        })
    };
    let places: Vec<[u32; 3]> = surface.vertices.iter().map(steps).collect();
    push_planes(&mut bytes, &places, 2);
    push_planes(&mut bytes, &surface.triangles, 4);
    let mut gzip = GzEncoder::new(Vec::new(), Compression::best());
    // Writing to memory cannot fail.
    let _ = gzip.write_all(&bytes);
    base64(&gzip.finish().unwrap_or_default())
}

fn push_planes(out: &mut Vec<u8>, rows: &[[u32; 3]], width: usize) {
    let mut last = [0_u32; 3];
    let mut differences = Vec::with_capacity(3 * rows.len());
    for row in rows {
        for (value, last) in row.iter().zip(&mut last) {
            differences.push(value.wrapping_sub(*last).to_le_bytes());
            *last = *value;
        }
    }
    for plane in 0..width {
        out.extend(differences.iter().map(|bytes| bytes[plane]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_hold_differences_that_add_up_to_the_rows() {
        let rows = [[3_u32, 70_000, 0], [2, 70_001, u32::MAX], [9, 5, 1]];
        let mut bytes = Vec::new();
        push_planes(&mut bytes, &rows, 4);
        let bytes = &bytes;
        let value =
            |i: usize| (0..4).map(move |plane| u32::from(bytes[9 * plane + i]) << (8 * plane));
        let mut sums = [0_u32; 3];
        for (i, row) in rows.iter().enumerate() {
            for (a, sum) in sums.iter_mut().enumerate() {
                *sum = sum.wrapping_add(value(3 * i + a).sum());
            }
            assert_eq!(sums, *row);
        }
    }
}
