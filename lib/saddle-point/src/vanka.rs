//! Vanka sweep: solves the momentum and volume balance of every cell at once.

use nalgebra::{Matrix6, Vector6};
use rayon::prelude::*;

use crate::packed::{LANES, Lanes};
use crate::simd::{Kernel, dispatch};
use crate::system::SaddleSystem;
use crate::vector::{CHUNK, Real, Work, for_each};

/// Most faces of a cell that are solved for with its pressure; further ones keep their velocity.
const FACES: usize = 6;
/// Damping of the corrections. Factors from 0.4 to 0.6 perform alike, 0.8 takes 85 % more iterations, and with 1 the sweep
/// diverges.
const DAMPING: Work = 0.6;

/// Entries of a symmetric matrix over the faces of a cell.
const ENTRIES: usize = FACES * (FACES + 1) / 2;

/// One additive sweep over the cells, after Vanka (1986, J. Comput. Phys. 65, 138-158). For each cell, the velocities of its
/// faces and its pressure solve `[A, -g^T; -g, -c]` exactly for the residual, with A restricted to these faces. A face takes
/// the mean correction of its two cells. Velocities are scaled by `D^-1/2` as in
/// [`Chebyshev`](crate::chebyshev::Chebyshev).
pub(crate) struct Vanka {
    blocks: Vec<Block>,
    /// Indices of the two corrections of each face in the flattened `corrections`; twice the same for a face of one cell.
    places: Vec<[u32; 2]>,
    corrections: Vec<[Lanes<Work>; FACES]>,
}

/// The inverses of eight cells' systems.
#[derive(Clone, Default)]
struct Block {
    /// Their faces; the values of unused places have no effect.
    faces: [Lanes<u32>; FACES],
    /// Inverse of the velocity block, lower triangle by rows.
    inverse: [Lanes<Work>; ENTRIES],
    /// `inverse` times the fluxes.
    response: [Lanes<Work>; FACES],
    /// 1 / (compressibility + response of the fluxes).
    softness: Lanes<Work>,
}

impl Vanka {
    /// Computes the inverses for the cells of `system`.
    pub(crate) fn new(system: &SaddleSystem) -> Self {
        // Pockets are left to the multigrid cycle: a sweep over the cells around them cannot satisfy their balance.
        let n = system.cells();
        let blocks = (0..n.div_ceil(LANES))
            .into_par_iter()
            .with_min_len(CHUNK / LANES)
            .map(|block| {
                let mut inverses = Block::default();
                for (lane, cell) in (block * LANES..n).take(LANES).enumerate() {
                    inverses.set(lane, system, cell);
                }
                inverses
            });
        let blocks: Vec<Block> = blocks.collect();
        let mut places = vec![[u32::MAX; 2]; system.g.n_columns()];
        for cell in 0..n {
            let (block, lane) = (cell / LANES, cell % LANES);
            for (slot, &face) in system.g.row(cell).0.iter().take(FACES).enumerate() {
                let at = ((block * FACES + slot) * LANES + lane) as u32;
                let place = &mut places[face as usize];
                let first = if place[0] == u32::MAX { at } else { place[0] };
                *place = [first, at];
            }
        }
        Self {
            corrections: vec![Default::default(); blocks.len()],
            blocks,
            places,
        }
    }

    /// Corrects velocities and pressures by the residuals of momentum (scaled) and volume.
    pub(crate) fn sweep(
        &mut self,
        (momentum, volume): (&[Work], &[Work]),
        scale: &[Work],
        velocity: &mut [Work],
        pressure: &mut [Work],
    ) {
        let chunk = CHUNK / LANES;
        (self.blocks.par_chunks(chunk))
            .zip(self.corrections.par_chunks_mut(chunk))
            .zip(volume.par_chunks(CHUNK).zip(pressure.par_chunks_mut(CHUNK)))
            .for_each(|((blocks, corrections), (volume, pressure))| {
                dispatch(Solves {
                    blocks,
                    momentum,
                    volume,
                    corrections,
                    pressure,
                });
            });
        let corrections = self.corrections.as_flattened().as_flattened();
        let places = &self.places[..];
        for_each(velocity, |face, v| {
            let [one, other] = places[face].map(|place| place as usize);
            if let (Some(one), Some(other)) = (corrections.get(one), corrections.get(other)) {
                *v += (0.5 * DAMPING) * scale[face] * (one + other);
            }
        });
    }
}

/// The corrections of one chunk of cells.
struct Solves<'a> {
    blocks: &'a [Block],
    momentum: &'a [Work],
    volume: &'a [Work],
    corrections: &'a mut [[Lanes<Work>; FACES]],
    pressure: &'a mut [Work],
}

impl Kernel for Solves<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let values = (self.volume.chunks(LANES)).zip(self.pressure.chunks_mut(LANES));
        let blocks = self.blocks.iter().zip(self.corrections);
        for ((block, corrections), (volume, pressure)) in blocks.zip(values) {
            let mut left = [0.0; LANES];
            left[..volume.len()].copy_from_slice(volume);
            let dp = block.solve(self.momentum, left, corrections);
            for (p, dp) in pressure.iter_mut().zip(dp) {
                *p += DAMPING * dp;
            }
        }
    }
}

impl Block {
    /// Sets the inverse of one cell.
    fn set(&mut self, lane: usize, system: &SaddleSystem, cell: usize) {
        let (faces, fluxes) = system.g.row(cell);
        let faces = &faces[..faces.len().min(FACES)];
        let mut block = Matrix6::identity();
        let mut flux = Vector6::zeros();
        for (i, &face) in faces.iter().enumerate() {
            for (column, entry) in system.a.matrix.row(face as usize) {
                let before = faces[..i].iter();
                if let Some(j) = before.clone().position(|&other| other as usize == column) {
                    block[(i, j)] += entry;
                    block[(j, i)] += entry;
                }
            }
            flux[i] = fluxes[i] * f64::from(system.a.scale[face as usize]);
            self.faces[i][lane] = face;
        }
        let inverse = block.try_inverse().unwrap_or_default();
        let response = inverse * flux;
        for i in 0..faces.len() {
            self.response[i][lane] = Work::nearest(response[i]);
            for j in 0..=i {
                self.inverse[entry(i, j)][lane] = Work::nearest(inverse[(i, j)]);
            }
        }
        let stiffness = system.c[cell] + flux.dot(&response);
        if stiffness > 0.0 {
            self.softness[lane] = Work::nearest(1.0 / stiffness);
        }
    }

    /// Corrections of the velocities, into `dv`, and of the pressures by their residuals.
    #[inline(always)]
    fn solve(
        &self,
        momentum: &[Work],
        volume: Lanes<Work>,
        dv: &mut [Lanes<Work>; FACES],
    ) -> Lanes<Work> {
        let r: [Lanes<Work>; FACES] = std::array::from_fn(|i| {
            std::array::from_fn(|lane| momentum[self.faces[i][lane] as usize])
        });
        let mut left = volume;
        for (r, response) in r.iter().zip(&self.response) {
            for lane in 0..LANES {
                left[lane] += response[lane] * r[lane];
            }
        }
        let dp = std::array::from_fn(|lane| -left[lane] * self.softness[lane]);
        for (i, dv) in dv.iter_mut().enumerate() {
            let mut sum = [0.0; LANES];
            for (j, r) in r.iter().enumerate() {
                let inverse = &self.inverse[entry(i, j)];
                for lane in 0..LANES {
                    sum[lane] += inverse[lane] * r[lane];
                }
            }
            *dv = std::array::from_fn(|lane| sum[lane] + self.response[i][lane] * dp[lane]);
        }
        dp
    }
}

/// Index of row `i`, column `j` in the triangle of a symmetric matrix.
#[inline(always)]
fn entry(i: usize, j: usize) -> usize {
    let (row, column) = (i.max(j), i.min(j));
    row * (row + 1) / 2 + column
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Csr, VelocityBlock};

    /// A single cell with three faces: the sweep takes the fraction [`DAMPING`] of its exact solution.
    #[test]
    fn a_sweep_takes_its_part_of_what_one_cell_lacks() {
        let rows = [[4.0, -1.0, 0.5], [-1.0, 4.0, -1.0], [0.5, -1.0, 9.0]];
        let a = VelocityBlock::assemble(3, |row, entries| {
            (rows[row].iter().enumerate()).for_each(|(column, &x)| entries.add(column, x));
        });
        let a = a.unwrap();
        let fluxes = [-1.0, 1.0, 0.5];
        let g = Csr::assemble(1, 3, |_, entries| {
            (fluxes.iter().enumerate()).for_each(|(face, &x)| entries.add(face, x));
        });
        let g = g.unwrap();
        let system = SaddleSystem {
            c: &[0.25],
            ..SaddleSystem::still(&a, &g, &[1.0; 3], &[0.0; 3])
        };
        let scale = [0.5, 0.5, 1.0 / 3.0];
        // [A, -G^T; -G, -C] times this solution, with the momentum scaled.
        let (u, p) = ([1.0, -2.0, 3.0], 4.0);
        let mut momentum = [0.0; 3];
        a.multiply(&u, &mut momentum);
        let momentum: Vec<Work> = (0..3)
            .map(|i| scale[i] * (momentum[i] - fluxes[i] * p) as Work)
            .collect();
        let volume = [-(-1.0 - 2.0 + 1.5) - 0.25 * p as Work];
        let (mut v, mut q) = ([0.0; 3], [0.0]);
        Vanka::new(&system).sweep((&momentum, &volume), &scale, &mut v, &mut q);
        for (v, u) in v.iter().chain(&q).zip(u.iter().chain(&[p])) {
            assert!((f64::from(*v) - 0.6 * u).abs() < 1e-5, "{v} of {u}");
        }
    }

    /// A face between two cells takes the mean of their corrections.
    #[test]
    fn a_face_of_two_cells_takes_their_mean() {
        let a = VelocityBlock::assemble(3, |i, row| row.add(i, 2.0)).unwrap();
        let g = Csr::assemble(2, 3, |cell, row| {
            row.add(cell, -1.0);
            row.add(cell + 1, 1.0);
        });
        let g = g.unwrap();
        let system = SaddleSystem::still(&a, &g, &[1.0; 3], &[0.0; 3]);
        let (mut v, mut q) = ([0.0; 3], [0.0; 2]);
        // The first cell expands by one, half through each of its faces.
        let scale = [0.5f32.sqrt(); 3];
        Vanka::new(&system).sweep((&[0.0; 3], &[-1.0, 0.0]), &scale, &mut v, &mut q);
        let near = |x: Work, y: Work| (x - y).abs() < 1e-6;
        assert!(near(v[0], -0.3) && near(v[1], 0.15) && v[2] == 0.0, "{v:?}");
        assert!(near(q[0], 0.6) && q[1] == 0.0, "{q:?}");
    }
}
