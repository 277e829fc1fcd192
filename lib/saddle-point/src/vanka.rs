//! Local coupling of velocity and pressure: every cell's momentum and volume balance at once.

use nalgebra::{Matrix6, Vector6};
use rayon::prelude::*;

use crate::csr::Csr;
use crate::system::SaddleSystem;
use crate::vector::{CHUNK, Real, Work, for_chunks};

/// Faces of a cell that are solved for with its pressure; further ones keep their velocity.
const FACES: usize = 6;
/// Part of the corrections that is taken; with the whole the sweep diverges.
const DAMPING: Work = 0.6;

/// One additive sweep over the cells, after Vanka (1986, J. Comput. Phys. 65, 138-158): for each
/// the velocities of its faces and its pressure solve `[A, -g^T; -g, -c]` exactly for the
/// residual, with A restricted to the faces, and a face takes the mean of what its cells say.
/// Velocities are scaled by `D^-1/2` as in [`Chebyshev`](crate::chebyshev::Chebyshev).
pub(crate) struct Vanka {
    cells: Vec<Cell>,
    /// Where the corrections of each face are: cell times [`FACES`] plus place; for faces of one
    /// cell twice the same.
    places: Vec<[u32; 2]>,
    corrections: Vec<[Work; FACES]>,
}

/// The inverse of one cell's system.
#[derive(Clone)]
struct Cell {
    /// Its faces; unused places hold any, without effect.
    faces: [u32; FACES],
    /// Inverse of the velocity block.
    inverse: [[Work; FACES]; FACES],
    /// That times the fluxes.
    response: [Work; FACES],
    /// 1 over compressibility and response of the fluxes together.
    softness: Work,
}

impl Vanka {
    /// Of a system with its velocities scaled by `scale`.
    pub(crate) fn new(system: &SaddleSystem, scale: &[Work]) -> Self {
        let (a, g, c) = (system.a, system.g, system.c);
        let cells = (0..g.n_rows())
            .into_par_iter()
            .with_min_len(CHUNK)
            .map(|cell| Cell::new(a, g.row(cell), c[cell], scale));
        let cells: Vec<Cell> = cells.collect();
        let mut places = vec![[u32::MAX; 2]; g.n_columns()];
        for cell in 0..g.n_rows() {
            for (slot, &face) in g.row(cell).0.iter().take(FACES).enumerate() {
                let place = &mut places[face as usize];
                let at = (cell * FACES + slot) as u32;
                *place = if place[0] == u32::MAX {
                    [at; 2]
                } else {
                    [place[0], at]
                };
            }
        }
        Self {
            corrections: vec![[0.0; FACES]; cells.len()],
            cells,
            places,
        }
    }

    /// Corrects scaled velocities and pressures by their residuals; `scale` takes velocities back.
    pub(crate) fn sweep(
        &mut self,
        residual: (&[Work], &[Work]),
        scale: &[Work],
        velocity: &mut [Work],
        pressure: &mut [Work],
    ) {
        let cells = &self.cells;
        (self.corrections.par_chunks_mut(CHUNK))
            .zip(pressure.par_chunks_mut(CHUNK))
            .enumerate()
            .for_each(|(chunk, (corrections, pressure))| {
                let first = chunk * CHUNK;
                for (i, (v, p)) in corrections.iter_mut().zip(pressure).enumerate() {
                    let (dv, dp) = cells[first + i].solve(residual.0, residual.1[first + i]);
                    *v = dv;
                    *p += DAMPING * dp;
                }
            });
        let (corrections, places) = (self.corrections.as_flattened(), &self.places);
        for_chunks(velocity, |start, part| {
            for (i, v) in part.iter_mut().enumerate() {
                let [one, other] = places[start + i].map(|place| place as usize);
                if let (Some(one), Some(other)) = (corrections.get(one), corrections.get(other)) {
                    *v += (0.5 * DAMPING) * scale[start + i] * (one + other);
                }
            }
        });
    }
}

impl Cell {
    fn new(a: &Csr<f64>, (faces, fluxes): (&[u32], &[f64]), c: f64, scale: &[Work]) -> Self {
        let count = faces.len().min(FACES);
        let faces = &faces[..count];
        let scale_of = |face: u32| f64::from(scale[face as usize]);
        let mut block = Matrix6::identity();
        let mut flux = Vector6::zeros();
        let mut of = [0; FACES];
        for (i, &face) in faces.iter().enumerate() {
            let (columns, values) = a.row(face as usize);
            for (j, other) in faces[..=i].iter().enumerate() {
                let entry = columns
                    .binary_search(other)
                    .map_or(0.0, |at| values[at] * scale_of(face) * scale_of(*other));
                (block[(i, j)], block[(j, i)]) = (entry, entry);
            }
            flux[i] = fluxes[i] * scale_of(face);
            of[i] = face;
        }
        let inverse = block.try_inverse().unwrap_or_default();
        let response = inverse * flux;
        let stiffness = c + flux.dot(&response);
        let nearest = |i: usize, x: f64| if i < count { Work::nearest(x) } else { 0.0 };
        Self {
            faces: of,
            inverse: std::array::from_fn(|i| {
                std::array::from_fn(|j| nearest(i.max(j), inverse[(i, j)]))
            }),
            response: std::array::from_fn(|i| nearest(i, response[i])),
            softness: if stiffness > 0.0 {
                Work::nearest(1.0 / stiffness)
            } else {
                0.0
            },
        }
    }

    /// Corrections of the velocities and the pressure by their residuals.
    fn solve(&self, momentum: &[Work], volume: Work) -> ([Work; FACES], Work) {
        let r = self.faces.map(|face| momentum[face as usize]);
        let mut flux = 0.0;
        let mut dv = [0.0; FACES];
        for (j, &r) in r.iter().enumerate() {
            flux += self.response[j] * r;
            for (i, dv) in dv.iter_mut().enumerate() {
                *dv += self.inverse[j][i] * r;
            }
        }
        let dp = -(volume + flux) * self.softness;
        for (dv, response) in dv.iter_mut().zip(self.response) {
            *dv += response * dp;
        }
        (dv, dp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One cell of three faces, solved alone: the sweep takes [`DAMPING`] of its solution.
    #[test]
    fn a_sweep_takes_its_part_of_what_one_cell_lacks() {
        let dense = |rows: &[&[f64]]| {
            Csr::assemble(rows.len(), rows[0].len(), |row, entries| {
                (rows[row].iter().enumerate()).for_each(|(column, &x)| entries.add(column, x));
            })
            .unwrap()
        };
        let a = dense(&[&[4.0, -1.0, 0.5], &[-1.0, 4.0, -1.0], &[0.5, -1.0, 9.0]]);
        let (g, c) = (dense(&[&[-1.0, 1.0, 0.5]]), [0.25]);
        let (ones, zeros) = ([1.0; 3], [0.0; 3]);
        let system = SaddleSystem {
            a: &a,
            g: &g,
            c: &c,
            friction: &ones,
            two_eta: &ones[..1],
            b: &zeros,
            volume_source: &zeros[..1],
        };
        let scale = [0.5, 0.5, 1.0 / 3.0];
        // What [A, -G^T; -G, -C] makes of this solution, the momentum scaled.
        let (u, p) = ([1.0, -2.0, 3.0], 4.0);
        let mut momentum = [0.0; 3];
        a.multiply(&u, &mut momentum);
        let momentum: Vec<Work> = (0..3)
            .map(|i| scale[i] * (momentum[i] - [-1.0, 1.0, 0.5][i] * p) as Work)
            .collect();
        let volume = [-(-1.0 - 2.0 + 1.5) - 0.25 * p as Work];
        let (mut v, mut q) = ([0.0; 3], [0.0]);
        Vanka::new(&system, &scale).sweep((&momentum, &volume), &scale, &mut v, &mut q);
        for (v, u) in v.iter().chain(&q).zip(u.iter().chain(&[p])) {
            assert!((f64::from(*v) - 0.6 * u).abs() < 1e-5, "{v} of {u}");
        }
    }

    /// Faces of two cells take the mean of what both say.
    #[test]
    fn a_face_of_two_cells_takes_their_mean() {
        let diagonal = |n: usize, x: f64| Csr::assemble(n, n, |i, row| row.add(i, x)).unwrap();
        let a = diagonal(3, 2.0);
        let g = Csr::assemble(2, 3, |cell, row| {
            row.add(cell, -1.0);
            row.add(cell + 1, 1.0);
        });
        let ones = [1.0; 3];
        let system = SaddleSystem {
            a: &a,
            g: &g.unwrap(),
            c: &[0.0; 2],
            friction: &ones,
            two_eta: &ones[..2],
            b: &ones,
            volume_source: &ones[..2],
        };
        let (mut v, mut q) = ([0.0; 3], [0.0; 2]);
        // The first cell swells by one: half through each of its faces.
        let scale = [0.5f32.sqrt(); 3];
        Vanka::new(&system, &scale).sweep((&[0.0; 3], &[-1.0, 0.0]), &scale, &mut v, &mut q);
        let near = |x: Work, y: Work| (x - y).abs() < 1e-6;
        assert!(near(v[0], -0.3) && near(v[1], 0.15) && v[2] == 0.0, "{v:?}");
        assert!(near(q[0], 0.6) && q[1] == 0.0, "{q:?}");
    }
}
