//! Shear between neighbouring faces of the same axis, at the cell edges that they share (docs/methods.md section 3.4).

use rayon::prelude::*;

use crate::geometry::{Lattice, Mesh, others};
use crate::liquid::FaceMap;

/// An edge that a face shares with its next face along a transverse axis `t`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    /// The next face.
    pub(crate) next: u32,
    /// Correction for re-entrant edges, in cubic cells.
    factor: f32,
    /// Length of the edge, voxels; negative if the next face lies on the low side.
    shared: i8,
    /// Open heights at the edge, voxels, four bits each: of the face and of the next one along `t`, and of the two faces
    /// [`Self::across`] along the axis of the face.
    open: [u8; 2],
    t: u8,
}

/// Two open heights in one byte, to keep edges small.
fn packed([low, high]: [u8; 2]) -> u8 {
    low | high << 4
}

impl Edge {
    /// The faces normal to `t` at the edge: between the low pores of both faces, and between their high pores.
    pub(crate) fn across(&self, mesh: &Mesh, face: usize) -> [usize; 2] {
        let (mut low, mut high) = (&mesh.faces[face], &mesh.faces[self.next as usize]);
        if self.shared < 0 {
            (low, high) = (high, low);
        }
        let joined = |low: u32, high: u32| {
            let (low, high, t) = (low as usize, high as usize, self.t.into());
            // Most cells have one face along an axis.
            match mesh.faces_of(mesh.cell(low), t) {
                faces if faces.len() == 1 => faces.start,
                _ => (mesh.face_between(low, high, t))
                    .expect("an edge joins the pores on its two sides"),
            }
        };
        [joined(low.low, high.low), joined(low.high, high.high)]
    }

    /// Shear rate at the edge by the face velocities `u`.
    fn rate(&self, mesh: &Mesh, face: usize, u: &[f64]) -> f64 {
        let f = mesh.faces[face];
        let [low, high] = self.across(mesh, face).map(|face| u[face]);
        let across = (high - low) / distance_between(mesh, self.open[1], [f.low, f.high], f.axis);
        (self.slope(mesh, face, u) + across).abs()
    }

    /// Gradient along `t` of the velocity of the face at the edge, by the face velocities `u`.
    pub(super) fn slope(&self, mesh: &Mesh, face: usize, u: &[f64]) -> f64 {
        let lows = [face, self.next as usize].map(|face| mesh.faces[face].low);
        let along =
            (u[self.next as usize] - u[face]) / distance_between(mesh, self.open[0], lows, self.t);
        along * f64::from(self.shared.signum())
    }

    /// Whether the edge is on the high (`up`) or low side of the face along `t`.
    pub(super) fn is_at(&self, t: usize, up: bool) -> bool {
        usize::from(self.t) == t && (self.shared > 0) == up
    }

    /// Length of the edge, voxels.
    pub(super) fn columns(&self) -> f64 {
        f64::from(self.shared.unsigned_abs())
    }

    /// The axis along which the edge runs.
    pub(crate) fn axis(&self, mesh: &Mesh, face: usize) -> usize {
        3 - usize::from(mesh.faces[face].axis) - usize::from(self.t)
    }

    /// Sheared area over the distance between the two faces, cells, and the length of the edge, cells, negative if the next
    /// face lies on the low side.
    pub(crate) fn geometry(&self, mesh: &Mesh, face: usize) -> [f64; 2] {
        let f = mesh.faces[face];
        let (axis, along) = (usize::from(f.axis), self.axis(mesh, face));
        let edge = |pore: u32, a: usize| mesh.edge(pore as usize, a);
        let next = mesh.faces[self.next as usize].low;
        let distance = distance_between(mesh, self.open[0], [f.low, next], self.t);
        let height = 0.5 * (edge(f.low, axis) + edge(f.high, axis));
        let length = edge(f.low, along);
        let lowest = match along {
            _ if self.factor == 1.0 => 1.0,
            1 => 1.0,
            _ => mesh
                .lowest_row(f.low as usize)
                .min(mesh.lowest_row(next as usize)),
        };
        let factor = match lowest {
            1.0 => f64::from(self.factor),
            lowest => f64::from(self.factor).powf(lowest),
        };
        let shared = f64::from(self.shared) / mesh.k as f64;
        let shear = factor * shared.abs() * length * height / distance;
        [shear, shared * length]
    }
}

/// Distance along an axis between the middles of two adjacent open heights (`open`, in voxels) in two pores, cells.
fn distance_between(mesh: &Mesh, open: u8, pores: [u32; 2], axis: u8) -> f64 {
    let [low, high] = [0, 1]
        .map(|i| f64::from(open >> (4 * i) & 15) * mesh.edge(pores[i] as usize, usize::from(axis)));
    0.5 * (low + high) / mesh.k as f64
}

/// The edges of all faces of a mesh, grouped by face.
#[derive(Default)]
pub(crate) struct Edges {
    start: Vec<u32>,
    edges: Vec<Edge>,
}

impl Edges {
    /// The edges of `mesh`; faces that are unchanged by `face_map` keep their `old` ones.
    pub(crate) fn new(mesh: &Mesh, lattice: &Lattice, face_map: &FaceMap, old: &Self) -> Self {
        let mut new_face = vec![None; old.start.len()];
        for (face, old_face) in face_map.0.iter().enumerate() {
            if let Some((old_face, _)) = old_face {
                new_face[*old_face as usize] = Some(face as u32);
            }
        }
        let renumbered = |edge: &Edge| {
            let next = new_face[edge.next as usize]?;
            Some(Edge { next, ..*edge })
        };
        let clear = mesh.wall_free_cells();
        let add = |face: usize, edges: &mut Vec<Edge>| {
            let first = edges.len();
            let known = face_map.unchanged(face).is_some_and(|face| {
                let mut old = old.of(face).iter().map(renumbered);
                old.all(|edge| edge.map(|edge| edges.push(edge)).is_some())
            });
            if !known {
                edges.truncate(first);
                if mesh.is_inner(face) {
                    add_edges(edges, mesh, lattice, face, mesh.is_wall_free(face, &clear));
                }
            }
            (edges.len() - first) as u32
        };
        let lists: Vec<(Vec<u32>, Vec<Edge>)> = (0..mesh.faces.len())
            .into_par_iter()
            .fold(
                Default::default,
                |(mut counts, mut edges): (Vec<_>, Vec<_>), face| {
                    counts.push(add(face, &mut edges));
                    (counts, edges)
                },
            )
            .collect();
        let mut start = Vec::with_capacity(mesh.faces.len() + 1);
        let mut edges = Vec::with_capacity(lists.iter().map(|list| list.1.len()).sum());
        start.push(0);
        for (counts, part) in lists {
            let mut end = edges.len() as u32;
            start.extend(counts.into_iter().map(|count| {
                end += count;
                end
            }));
            edges.extend(part);
        }
        Self { start, edges }
    }

    /// Number of the first edge of a face.
    pub(crate) fn first(&self, face: usize) -> usize {
        self.start[face] as usize
    }

    /// Square of the shear rate at each edge by the face velocities `u`: that of its own shear, and the mean of all other
    /// parts in the four pores around it. `parts` are the squares in each pore: stretching, and shear about x, y, z.
    pub(crate) fn rates(&self, mesh: &Mesh, u: &[f64], parts: &[[f64; 4]]) -> Vec<f64> {
        let rates = |face: usize| {
            self.of(face).iter().map(move |edge| {
                let (own, next) = (mesh.faces[face], mesh.faces[edge.next as usize]);
                let around = edge.axis(mesh, face);
                let other = |pore: u32| {
                    let [stretching, shear @ ..] = parts[pore as usize];
                    stretching + shear.iter().sum::<f64>() - shear[around]
                };
                let others = other(own.low) + other(own.high) + other(next.low) + other(next.high);
                edge.rate(mesh, face, u).powi(2) + 0.25 * others
            })
        };
        (0..mesh.faces.len())
            .into_par_iter()
            .flat_map_iter(rates)
            .collect()
    }

    /// The edges of a face.
    pub(crate) fn of(&self, face: usize) -> &[Edge] {
        &self.edges[self.start[face] as usize..self.start[face + 1] as usize]
    }
}

/// Adds the edges of a face. Voxels of an edge between the same faces are merged if they have the same re-entrant correction.
fn add_edges(found: &mut Vec<Edge>, mesh: &Mesh, lattice: &Lattice, face: usize, clear: bool) {
    let axis = usize::from(mesh.faces[face].axis);
    let key = |edge: &Edge| (edge.next, edge.open, edge.factor.to_bits());
    for t in others(axis)
        .into_iter()
        .filter(|&t| !(lattice.flat && t == 2))
    {
        for up in [false, true] {
            if clear {
                found.extend(clear_edge(mesh, face, t, up));
                continue;
            }
            let first = found.len();
            for r in 0..mesh.k {
                let Some(edge) = edge(mesh, face, t, up, r) else {
                    continue;
                };
                match found[first..]
                    .iter_mut()
                    .find(|other| key(other) == key(&edge))
                {
                    Some(other) => other.shared += edge.shared,
                    None => found.push(edge),
                }
            }
        }
    }
}

/// The edge at one side of a face along `t` if all cells around are wholly open: one pore each, one face between two.
fn clear_edge(mesh: &Mesh, face: usize, t: usize, up: bool) -> Option<Edge> {
    let f = mesh.faces[face];
    let beside = mesh.next_cell(mesh.cell(f.low as usize), t, up)?;
    let k = mesh.k as u8;
    Some(Edge {
        next: mesh.faces_of(beside, f.axis.into()).start as u32,
        factor: 1.0,
        shared: if up { k as i8 } else { -(k as i8) },
        open: [packed([k; 2]); 2],
        t: t as u8,
    })
}

/// The edge at one side along `t` of voxel column `r` of a face.
fn edge(mesh: &Mesh, face: usize, t: usize, up: bool, r: usize) -> Option<Edge> {
    let k = mesh.k;
    let f = mesh.faces[face];
    let axis = usize::from(f.axis);
    let across = 3 - axis - t;
    let height = |face: usize, along: usize, end: usize| {
        let open = |i: usize| {
            let mut at = [0; 3];
            (at[along], at[across]) = (i, r);
            mesh.is_open(face, at)
        };
        match open(end) {
            true => (0..k).filter(|&i| open(i)).count() as u8,
            false => 0,
        }
    };
    let (near, far) = if up { (k - 1, 0) } else { (0, k - 1) };
    let own = height(face, t, near);
    if own == 0 {
        return None;
    }
    let pores = f.pores();
    let cells = pores.map(|pore| mesh.cell(pore));
    let beside = [
        mesh.next_cell(cells[0], t, up)?,
        mesh.next_cell(cells[1], t, up)?,
    ];
    let voxel = |half: usize| {
        let mut at = [0; 3];
        (at[axis], at[t], at[across]) = (if half == 0 { k - 1 } else { 0 }, far, r);
        at
    };
    let low = mesh.pore_at(beside[0], voxel(0))?;
    let high = mesh.pore_at(beside[1], voxel(1))?;
    let next = mesh.face_between(low, high, axis)?;
    let joined = |near: usize, far: usize| match up {
        true => mesh.face_between(near, far, t),
        false => mesh.face_between(far, near, t),
    };
    let (beside_low, beside_high) = (joined(pores[0], low)?, joined(pores[1], high)?);
    let own_voxel = |half: usize| {
        let mut at = voxel(half);
        at[t] = near;
        at
    };
    let reentrant =
        |half: usize| mesh.ln_reentrant_factor((cells[half], own_voxel(half)), [t, across], up);
    let factor = (0.5 * (0..2).map(reentrant).sum::<f64>()).exp();
    Some(Edge {
        next: next as u32,
        factor: factor as f32,
        shared: if up { 1 } else { -1 },
        open: [
            packed([own, height(next, t, far)]),
            packed([
                height(beside_low, axis, k - 1),
                height(beside_high, axis, 0),
            ]),
        ],
        t: t as u8,
    })
}
