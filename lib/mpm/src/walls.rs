//! Rigid bodies as the nodes see them: the integrals of the shape function, its slope and its
//! first moment over the solid voxels near a node.
//!
//! The shape function is a product over the axes, so the integrals are sums over layers of
//! voxels along y of (lateral sum of the layer) x (integral along y). Lateral sums are kept, and
//! a body that moves along y, as the clamp does, costs a few products per node and step.
//! For uniform GIMP the hat is integrated: its mean over a voxel is the GIMP weight of a
//! material point of that voxel, so the sums equal those of the paper's rigid points.

mod block;
mod integrals;

use std::ops::Range;

use rayon::prelude::*;

use crate::lanes::Lanes8;
use crate::lattice::{EDGE, block_index};
use crate::real::Real;
pub(crate) use block::BlockShape;
pub(crate) use integrals::Integrator;
use integrals::Slice;

/// How far (cells) a body may move along y before lateral sums are looked for again: tuned for speed, part of no result.
const MARGIN: f64 = 0.5;

/// Lateral sums of one voxel block for the nodes of one block of nodes.
#[derive(Clone, Debug)]
struct Columns {
    /// Index of the voxel block in its body.
    part: usize,
    first_layer: usize,
    layers: usize,
    /// Column (z * 4 + x), layer: sums of w w, g_x w_z, w_x g_z, m_x w_z, w_x m_z.
    sums: Vec<[Real; 5]>,
}

/// Integrals along y over the voxels of a displaced body for rows of nodes, which all blocks of these rows share.
#[derive(Default)]
pub(crate) struct Rows {
    /// Displacement (cells).
    shift: [f64; 3],
    nodes: Range<i32>,
    /// Of each part of the body, by row: which layer, and the factors of its lateral sums.
    factors: Vec<Vec<Vec<(usize, Lanes8)>>>,
}

impl Rows {
    pub(crate) fn new(
        parts: &[BlockShape],
        shift: [f64; 3],
        nodes: Range<i32>,
        integrator: &Integrator,
    ) -> Self {
        let factors = |Slice { index, w, g, m }| (index, Lanes8([w, w, g, w, w, m, w, 0.0]));
        let row = |part, y| {
            let slices = integrator.slices(part, 1, y, shift[1], 0.0);
            slices.into_iter().map(factors).collect()
        };
        let rows = |part| {
            nodes
                .clone()
                .into_par_iter()
                .map(|y| row(part, y))
                .collect()
        };
        Self {
            shift,
            factors: parts.iter().map(rows).collect(),
            nodes,
        }
    }

    /// Whether they are those of this displacement and of all these nodes.
    pub(crate) fn are_of(&self, shift: [f64; 3], nodes: &Range<i32>) -> bool {
        self.shift == shift && self.nodes == *nodes
    }
}

/// A body near a block of nodes.
#[derive(Clone, Debug)]
pub(crate) struct NearBody {
    columns: Vec<Columns>,
    /// Displacement (cells) for which the columns were looked for.
    built_at: [f64; 3],
    /// Displacement for which the values hold.
    values_at: [f64; 3],
    /// Per node: volume, its gradient (3), its first moment (3), in cells.
    pub(crate) values: Vec<Lanes8>,
    /// Bit i: node i may feel the body before it is looked for again.
    pub(crate) near: u64,
}

impl NearBody {
    /// The body displaced by `shift` cells, seen by the block of nodes at `origin`.
    pub(crate) fn new(
        parts: &[BlockShape],
        origin: [i32; 3],
        shift: [f64; 3],
        integrator: &Integrator,
    ) -> Self {
        let mut near = 0;
        let columns: Vec<Columns> = (parts.iter().enumerate())
            .filter_map(|(part, block)| columns(part, block, origin, shift, integrator, &mut near))
            .collect();
        let n = match columns[..] {
            [] => 0,
            _ => integrator.lattice.block_len(),
        };
        Self {
            columns,
            built_at: shift,
            values_at: [f64::NAN; 3],
            values: vec![Lanes8::ZERO; n],
            near,
        }
    }

    /// Whether the body has left the place its lateral sums were made for.
    pub(crate) fn is_stale(&self, shift: [f64; 3]) -> bool {
        shift[0] != self.built_at[0]
            || shift[2] != self.built_at[2]
            || (shift[1] - self.built_at[1]).abs() > MARGIN
    }

    /// Brings the nodal values to the displacement of `rows`, for good where the body never moves: its lateral sums
    /// are then let go.
    pub(crate) fn update(&mut self, rows: &Rows, origin: [i32; 3], moves: bool) {
        if self.columns.is_empty() || self.values_at == rows.shift {
            return;
        }
        self.values_at = rows.shift;
        self.values.fill(Lanes8::ZERO);
        let first = (origin[1] - rows.nodes.start) as usize;
        for columns in &self.columns {
            let rows = &rows.factors[columns.part][first..][..EDGE];
            for (column, sums) in columns.sums.chunks_exact(columns.layers).enumerate() {
                let (x, z) = (column % EDGE, column / EDGE);
                for (y, row) in rows.iter().enumerate() {
                    let value = &mut self.values[(z * EDGE + y) * EDGE + x];
                    for (index, factors) in row {
                        let layer = index.wrapping_sub(columns.first_layer);
                        if let Some(&[w, gx, gz, mx, mz]) = sums.get(layer) {
                            let lateral = Lanes8([w, gx, w, gz, mx, w, mz, 0.0]);
                            *value = value.plus::<false>(factors.times::<false>(lateral));
                        }
                    }
                }
            }
        }
        if !moves {
            self.columns = Vec::new();
        }
    }
}

/// Lateral sums for the layers within reach, or `None` when nothing solid is there.
fn columns(
    part: usize,
    block: &BlockShape,
    origin: [i32; 3],
    shift: [f64; 3],
    integrator: &Integrator,
    near: &mut u64,
) -> Option<Columns> {
    let along = |axis: usize, node: usize, margin: f64| {
        integrator.slices(block, axis, origin[axis] + node as i32, shift[axis], margin)
    };
    let y: Vec<Vec<Slice>> = (0..EDGE).map(|i| along(1, i, MARGIN)).collect();
    let first_layer = y.iter().flatten().map(|s| s.index).min()?;
    let layers = y.iter().flatten().map(|s| s.index).max()? + 1 - first_layer;
    let x: Vec<Vec<Slice>> = (0..EDGE).map(|i| along(0, i, 0.0)).collect();
    let depth = integrator.lattice.block_len() / (EDGE * EDGE);
    let z: Vec<Vec<Slice>> = (0..depth).map(|i| along(2, i, 0.0)).collect();
    let mut sums = vec![[0.0; 5]; EDGE * depth * layers];
    let mut any = false;
    for (column, sums) in sums.chunks_exact_mut(layers).enumerate() {
        let (xs, zs) = (&x[column % EDGE], &z[column / EDGE]);
        for (layer, sum) in sums.iter_mut().enumerate() {
            for zs in zs {
                for xs in xs {
                    if block.solid.solid(xs.index, first_layer + layer, zs.index) {
                        let add = [
                            xs.w * zs.w,
                            xs.g * zs.w,
                            xs.w * zs.g,
                            xs.m * zs.w,
                            xs.w * zs.m,
                        ];
                        for (s, a) in sum.iter_mut().zip(add) {
                            *s += a;
                        }
                    }
                }
            }
        }
        for (node, slices) in y.iter().enumerate() {
            if slices.iter().any(|s| sums[s.index - first_layer][0] > 0.0) {
                let (cx, cz) = ((column % EDGE) as i32, (column / EDGE) as i32);
                *near |= 1 << block_index([cx, node as i32, cz]);
                any = true;
            }
        }
    }
    any.then_some(Columns {
        part,
        first_layer,
        layers,
        sums,
    })
}

#[cfg(test)]
mod tests {
    use physics::{Boundary, VoxelBlock};

    use super::*;
    use crate::lattice::Lattice;
    use crate::settings::ShapeFunction;

    /// Of the hat function times position over a voxel of half a cell around `x` cells from the node:
    /// Simpson's rule is exact on either side of the node.
    fn moment(x: f64) -> f64 {
        let part = |from: f64| {
            let (low, high) = ((x - 0.25).max(from), (x + 0.25).min(from + 1.0));
            let of = |x: f64| x * (1.0 - x.abs());
            (high - low).max(0.0) / 6.0 * (of(low) + 4.0 * of(0.5 * (low + high)) + of(high))
        };
        part(-1.0) + part(0.0)
    }

    /// Sums over the material points of the voxels, half a cell each, with GIMP weights: volume, its
    /// gradient, its first moment about the node.
    fn rigid_points(block: &BlockShape, shift: [f64; 3], node: [i32; 3]) -> [f64; 7] {
        let mut sum = [0.0; 7];
        let dims = block.solid.dims();
        for k in 0..dims[2] {
            for j in 0..dims[1] {
                for i in 0..dims[0] {
                    if !block.solid.solid(i, j, k) {
                        continue;
                    }
                    let x = [0, 1, 2].map(|a| {
                        block.origin[a] + shift[a] + ([i, j, k][a] as f64 + 0.5) * block.voxel[a]
                    });
                    let nearest = x.map(f64::round);
                    let d = [0, 1, 2].map(|a| Lanes8([(x[a] - nearest[a]) as Real; 8]));
                    let sides = ShapeFunction::Gimp.sides::<3, false>(&d);
                    let offset = [0, 1, 2].map(|a| f64::from(node[a]) - nearest[a] + 1.0);
                    if offset.iter().any(|o| !(0.0..=2.0).contains(o)) {
                        continue;
                    }
                    let pick = |of: usize, a: usize| {
                        let [lower, upper] = sides[a][of].map(|x| f64::from(x.0[0]));
                        let all = if of == 0 { 1.0 } else { 0.0 };
                        [lower, all - lower - upper, upper][offset[a] as usize]
                    };
                    let (w, g) = (|a: usize| pick(0, a), |a: usize| pick(1, a));
                    let v = 0.125;
                    sum[0] += v * w(0) * w(1) * w(2);
                    sum[1] += v * g(0) * w(1) * w(2);
                    sum[2] += v * w(0) * g(1) * w(2);
                    sum[3] += v * w(0) * w(1) * g(2);
                    for a in 0..3 {
                        let beside = w((a + 1) % 3) * w((a + 2) % 3);
                        sum[4 + a] += 0.25 * beside * moment(x[a] - f64::from(node[a]));
                    }
                }
            }
        }
        sum
    }

    #[test]
    fn integrals_are_the_sums_over_the_papers_rigid_points() {
        let block = BlockShape {
            origin: [2.2, 3.0, 1.7],
            voxel: [0.5; 3],
            solid: VoxelBlock::from_fn([0.0; 3], [1.0; 3], [12, 14, 10], |i, j, k| {
                (i * 5 + j * 3 + k * 7) % 4 < 2
            }),
        };
        let integrator = Integrator::new(&Lattice::cube(20, Boundary::Open), ShapeFunction::Gimp);
        let parts = [block];
        let origin = [4, 4, 4];
        let mut near = NearBody::new(&parts, origin, [0.0; 3], &integrator);
        let rows = |shift| Rows::new(&parts, shift, 4..8, &integrator);
        let mut worst = 0.0_f64;
        for dy in [0.0, -0.13, -0.37, -0.49] {
            let shift = [0.0, dy, 0.0];
            assert!(!near.is_stale(shift));
            near.update(&rows(shift), origin, true);
            for i in 0..64 {
                let local = crate::lattice::block_node(i);
                let node = [0, 1, 2].map(|a| origin[a] + local[a]);
                let expected = rigid_points(&parts[0], shift, node);
                for (a, e) in expected.iter().enumerate() {
                    worst = worst.max((f64::from(near.values[i].0[a]) - e).abs());
                }
            }
        }
        let moved = near.values.clone();
        let mut fixed = NearBody::new(&parts, origin, near.values_at, &integrator);
        for _ in 0..2 {
            fixed.update(&rows(near.values_at), origin, false);
            assert!(fixed.columns.is_empty() && fixed.values.len() == moved.len());
        }
        println!("largest difference of volume, gradient and moment: {worst:e}");
        assert!(worst < 3e-6);
        assert!(near.is_stale([0.0, -0.6, 0.0]) && near.is_stale([0.1, 0.0, 0.0]));
    }
}
