//! The surface of a set of voxels, as triangles.

use particle_file::BitGrid;

use crate::lattice::{Voxel, around, set_voxels, voxels};

/// A closed surface of triangles, which are seen counter-clockwise from outside.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    /// Corners, in voxels from the low corner of the lattice.
    pub vertices: Vec<[f32; 3]>,
    /// Three vertices each.
    pub triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// The surface of the voxels of `body`, by surface nets (Gibson 1998): a vertex in each cube of eight
    /// voxel centres that it passes, at the mean of its places on the cube's edges, and a
    /// quadrilateral around each edge that it passes.
    ///
    /// Between a voxel and its neighbour it passes where the mean of own (1 or 0) and all around among those of
    /// `room`, which holds the body, is one half: on a plane side midway, rounded at corners. A
    /// voxel of the body has more than one half and any other less, so that none is lost and none
    /// added.
    pub fn of(body: &BitGrid, room: &BitGrid) -> Self {
        let field = Field::new(body, room);
        let mut surface = Self::default();
        let vertex_of = surface.add_vertices(&field);
        surface.add_triangles(&field, &vertex_of);
        surface
    }

    /// Puts a vertex into each cube that the surface passes; their numbers, as the cubes lie.
    fn add_vertices(&mut self, field: &Field) -> Vec<u32> {
        let mut vertex_of = vec![u32::MAX; field.share.len()];
        for cube in field.cubes() {
            let corner = |c: usize| {
                let at: Voxel = std::array::from_fn(|a| cube[a] + (c >> a & 1));
                (at, field.share[field.index(at)] - 0.5)
            };
            let (mut sum, mut count) = ([0.0_f32; 3], 0.0);
            for (low, axis) in (0..8).flat_map(|c| (0..3).map(move |a| (c, a))) {
                if low >> axis & 1 == 1 {
                    continue;
                }
                let ((at, from), (_, to)) = (corner(low), corner(low | 1 << axis));
                if (from > 0.0) != (to > 0.0) {
                    for a in 0..3 {
                        sum[a] += at[a] as f32;
                    }
                    sum[axis] += from / (from - to);
                    count += 1.0;
                }
            }
            if count > 0.0 {
                vertex_of[field.index(cube)] = self.vertices.len() as u32;
                // The field begins one voxel outside, and its places are centres.
                self.vertices.push(sum.map(|s| s / count - 0.5));
            }
        }
        vertex_of
    }

    /// Joins the vertices around each edge between two voxel centres that the surface passes.
    fn add_triangles(&mut self, field: &Field, vertex_of: &[u32]) {
        for at in field.cubes() {
            for axis in 0..3 {
                let mut next = at;
                next[axis] += 1;
                let [inside, beyond] = [at, next].map(|s| field.share[field.index(s)] > 0.5);
                if inside == beyond {
                    continue;
                }
                let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                let corner = |back: [usize; 2]| {
                    let mut cube = at;
                    cube[u] -= back[0];
                    cube[v] -= back[1];
                    vertex_of[field.index(cube)]
                };
                let [a, b, c, d] = [[1, 1], [0, 1], [0, 0], [1, 0]].map(corner);
                self.triangles.extend(match inside {
                    true => [[a, b, c], [a, c, d]],
                    false => [[c, b, a], [d, c, a]],
                });
            }
        }
    }
}

/// What the surface is a level of, at voxel centres and a layer of zeros around them.
struct Field {
    dims: Voxel,
    share: Vec<f32>,
}

impl Field {
    fn new(body: &BitGrid, room: &BitGrid) -> Self {
        let dims = body.dims().map(|n| n + 2);
        let mut field = Self {
            dims,
            share: vec![0.0; dims.iter().product()],
        };
        let own = |[x, y, z]: Voxel| f32::from(u8::from(body.get(x, y, z)));
        for voxel in set_voxels(room.view()) {
            let beside = around(voxel, body.dims()).filter(|&[x, y, z]| room.get(x, y, z));
            let (within, count) = beside.fold((0.0, 0.0), |(sum, n), v| (sum + own(v), n + 1.0));
            let at = field.index(voxel.map(|i| i + 1));
            field.share[at] = 0.5 * (own(voxel) + within / count);
        }
        field
    }

    /// The cubes between centres, by their low corners.
    fn cubes(&self) -> impl Iterator<Item = Voxel> + use<> {
        voxels(self.dims.map(|n| n - 1))
    }

    fn index(&self, [x, y, z]: Voxel) -> usize {
        (z * self.dims[1] + y) * self.dims[0] + x
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    fn surface_of(dims: Voxel, inside: impl Fn(usize, usize, usize) -> bool + Sync) -> Surface {
        let room = BitGrid::from_fn(dims, |_, _, _| true);
        Surface::of(&BitGrid::from_fn(dims, inside), &room)
    }

    /// Six times the signed volume of the tetrahedra below the triangles.
    fn volume(surface: &Surface) -> f64 {
        let corner = |i: u32| surface.vertices[i as usize].map(f64::from);
        let six = |[a, b, c]: [u32; 3]| {
            let [a, b, c] = [a, b, c].map(corner);
            a[0] * (b[1] * c[2] - b[2] * c[1])
                + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0])
        };
        surface.triangles.iter().map(|&t| six(t)).sum::<f64>() / 6.0
    }

    /// Every edge belongs to as many triangles one way as the other: nothing is open.
    fn is_closed(surface: &Surface) -> bool {
        let mut edges = BTreeMap::new();
        for &[a, b, c] in &surface.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let balance = edges.entry((from.min(to), from.max(to))).or_insert(0);
                *balance += if from < to { 1 } else { -1 };
            }
        }
        edges.values().all(|&balance| balance == 0)
    }

    #[test]
    fn a_ball_is_closed_and_keeps_its_volume() {
        let inside = |x: usize, y: usize, z: usize| {
            let r2: f64 = [x, y, z].iter().map(|&i| (i as f64 - 9.5).powi(2)).sum();
            r2 < 64.0
        };
        let ball = surface_of([20, 20, 20], inside);
        let voxels = BitGrid::from_fn([20, 20, 20], inside).count() as f64;
        assert!(is_closed(&ball));
        let off = volume(&ball) / voxels - 1.0;
        assert!(off.abs() < 0.03, "{off}");
    }

    #[test]
    fn plane_sides_lie_on_the_faces_of_voxels_and_single_voxels_stay() {
        let slab = surface_of([12, 9, 12], |_, y, _| (3..6).contains(&y));
        let middle = |v: &&[f32; 3]| (3.0..9.0).contains(&v[0]) && (3.0..9.0).contains(&v[2]);
        let heights: Vec<f32> = slab.vertices.iter().filter(middle).map(|v| v[1]).collect();
        let on_face = |y: &f32| (y - 3.0).abs() < 1e-6 || (y - 6.0).abs() < 1e-6;
        assert!(heights.iter().all(on_face));
        assert!(heights.len() > 70 && is_closed(&slab));
        let one = surface_of([3, 3, 3], |x, y, z| [x, y, z] == [0, 1, 1]);
        assert!(is_closed(&one) && volume(&one) > 0.0 && one.triangles.len() == 12);
        assert!(surface_of([3, 3, 3], |_, _, _| false).triangles.is_empty());
    }

    /// Liquid is not drawn into the wall it lies on.
    #[test]
    fn a_body_ends_at_its_room() {
        let room = BitGrid::from_fn([8, 8, 8], |_, y, _| y >= 3);
        let body = BitGrid::from_fn([8, 8, 8], |_, y, _| (3..5).contains(&y));
        let surface = Surface::of(&body, &room);
        let lowest = surface.vertices.iter().map(|v| v[1]).fold(8.0, f32::min);
        assert!((2.999..3.2).contains(&lowest), "{lowest}");
    }
}
