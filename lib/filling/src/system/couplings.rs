//! Coupling of the unknowns to the velocities of the bodies: the volume that moving bodies displace,
//! the momentum that they drag, and the forces on them.
//!
//! Kept apart from the matrices so that another speed of the clamp within a step needs no new
//! assembly.

use rayon::prelude::*;

use super::edges::Edges;
use super::fluxes::Areas;
use super::terms::Velocity;
use super::{CHUNK, Operator, air};

/// Rows of (column, coefficient), one per unknown.
#[derive(Clone, Debug, Default)]
pub(super) struct Rows {
    start: Vec<u32>,
    entries: Vec<(u32, f64)>,
}

impl Rows {
    /// How many.
    pub(super) fn len(&self) -> usize {
        self.start.len().saturating_sub(1)
    }

    /// Appends a row.
    pub(super) fn push(&mut self, row: &[(u32, f64)]) {
        self.entries.extend(row);
        self.start.push(self.entries.len() as u32);
    }

    pub(super) fn of(&self, row: usize) -> &[(u32, f64)] {
        &self.entries[self.start[row] as usize..self.start[row + 1] as usize]
    }

    /// Sum over a row of coefficient times the bodies' velocity; columns are 3 body + axis.
    fn times(&self, row: usize, bodies: &[[f64; 3]]) -> f64 {
        let velocity = |component: u32| bodies[component as usize / 3][component as usize % 3];
        self.of(row).iter().map(|&(c, a)| a * velocity(c)).sum()
    }
}

/// Adds to the entry of a column.
fn add(row: &mut Vec<(u32, f64)>, column: usize, value: f64) {
    let column = column as u32;
    match row.iter_mut().find(|entry| entry.0 == column) {
        Some(entry) => entry.1 += value,
        None => row.push((column, value)),
    }
}

/// The part of the step's energy that depends on the bodies' velocities U:
/// u D U + U B U/2 of viscosity and friction, and p F U of the fluxes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Couplings {
    /// D: one row per face unknown.
    drag: Rows,
    /// F: one row per pressure unknown.
    flux: Rows,
    /// B, (3 bodies) x (3 bodies).
    between: Vec<f64>,
}

impl Couplings {
    pub(super) fn new(operator: &Operator, edges: &Edges, bodies: usize, flux: &Rows) -> Self {
        let n = 3 * bodies;
        let drag = gather(operator.dofs.faces.len(), n * n, |face, row, between| {
            operator.terms::<true>(edges, face, |term| {
                let own = term.weight * term.coefficient(face);
                for &(velocity, c) in term.parts() {
                    if let Velocity::Body(component) = velocity {
                        add(row, component as usize, own * c);
                    }
                }
                if term.owner() != Some(face as u32) {
                    return;
                }
                for &(a, ca) in term.parts() {
                    for &(b, cb) in term.parts() {
                        if let (Velocity::Body(a), Velocity::Body(b)) = (a, b) {
                            between[a as usize * n + b as usize] += term.weight * ca * cb;
                        }
                    }
                }
            });
        });
        let faces = operator.dofs.faces.len() as u32;
        let (flux, _) = gather(flux.len(), 0, |cell, row, _| {
            let body = |&(column, area): &(u32, f64)| Some((column.checked_sub(faces)?, area));
            row.extend(flux.of(cell).iter().filter_map(body));
        });
        Self {
            drag: drag.0,
            flux,
            between: drag.1,
        }
    }

    /// Momentum that bodies moving at `bodies` drag into a face unknown.
    pub(super) fn dragged(&self, face: usize, bodies: &[[f64; 3]]) -> f64 {
        -self.drag.times(face, bodies)
    }

    /// Volume that they displace in a pressure unknown.
    pub(super) fn displaced(&self, cell: usize, bodies: &[[f64; 3]]) -> f64 {
        -self.flux.times(cell, bodies)
    }

    /// Forces of the liquid on the bodies, and twice the energy u D U + U B U/2.
    pub(super) fn forces(&self, bodies: &[[f64; 3]], u: &[f64], p: &[f64]) -> (Vec<[f64; 3]>, f64) {
        let flat: Vec<f64> = bodies.iter().flatten().copied().collect();
        let n = flat.len();
        let mut force: Vec<f64> = (0..n)
            .map(|a| {
                -(0..n)
                    .map(|b| self.between[a * n + b] * flat[b])
                    .sum::<f64>()
            })
            .collect();
        let resting: f64 = force.iter().zip(&flat).map(|(f, v)| -f * v).sum();
        let sum_up = |rows: &Rows, values: &[f64], sign: f64, total: &mut Vec<f64>| {
            let parts: Vec<Vec<f64>> = (values.par_chunks(CHUNK).enumerate())
                .map(|(chunk, values)| {
                    let mut sum = vec![0.0; n];
                    for (i, x) in values.iter().enumerate() {
                        for &(component, a) in rows.of(chunk * CHUNK + i) {
                            sum[component as usize] += sign * a * x;
                        }
                    }
                    sum
                })
                .collect();
            for part in parts {
                for (total, part) in total.iter_mut().zip(part) {
                    *total += part;
                }
            }
        };
        let mut drag = vec![0.0; n];
        sum_up(&self.drag, u, -1.0, &mut drag);
        let dragging: f64 = drag.iter().zip(&flat).map(|(f, v)| -f * v).sum();
        for (force, drag) in force.iter_mut().zip(&drag) {
            *force += drag;
        }
        sum_up(&self.flux, p, 1.0, &mut force);
        let (forces, _) = force.as_chunks::<3>();
        (forces.to_vec(), resting + 2.0 * dragging)
    }
}

/// The fluxes of all pressure unknowns, cells and then pockets of air: columns are the face unknowns and, after them, the
/// bodies' components.
pub(super) fn fluxes(operator: &Operator, areas: &Areas) -> Rows {
    let faces = operator.dofs.faces.len();
    let (mut rows, _) = gather(operator.dofs.cells.len(), 0, |cell, row, _| {
        operator.flux(areas, cell, |velocity, area| match velocity {
            Velocity::Face(face) => add(row, face as usize, area),
            Velocity::Body(component) => add(row, faces + component as usize, area),
            Velocity::Still => {}
        });
    });
    air::append(operator, areas, &mut rows);
    rows
}

/// Ends of the rows of a chunk, their entries, and its sums.
type Chunk = (Vec<u32>, Vec<(u32, f64)>, Vec<f64>);

/// Rows of unknowns `0..len` and a sum of `sums` numbers, both by `fill(row, entries, sum)`.
fn gather(
    len: usize,
    sums: usize,
    fill: impl Fn(usize, &mut Vec<(u32, f64)>, &mut [f64]) + Sync,
) -> (Rows, Vec<f64>) {
    let chunks: Vec<Chunk> = (0..len.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let (mut ends, mut entries) = (Vec::with_capacity(CHUNK), Vec::new());
            let mut sum = vec![0.0; sums];
            let mut row = Vec::new();
            for i in chunk * CHUNK..len.min((chunk + 1) * CHUNK) {
                fill(i, &mut row, &mut sum);
                entries.append(&mut row);
                ends.push(entries.len() as u32);
            }
            (ends, entries, sum)
        })
        .collect();
    let mut rows = Rows {
        start: vec![0],
        entries: Vec::new(),
    };
    let mut total = vec![0.0; sums];
    for (ends, entries, sum) in chunks {
        let before = rows.entries.len() as u32;
        rows.start.extend(ends.iter().map(|end| before + end));
        rows.entries.extend(entries);
        for (total, part) in total.iter_mut().zip(sum) {
            *total += part;
        }
    }
    (rows, total)
}
