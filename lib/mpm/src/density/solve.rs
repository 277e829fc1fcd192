//! The potential of the displacement by conjugate gradients with Jacobi preconditioning; serial,
//! because it is due once in some fifty steps, and so the same for any number of threads.

use super::cells::{Cell, NONE};

/// Relative residual at which to stop: what is left is taken away by later projections.
const TOLERANCE: f64 = 0.05;
const MAX_ITERATIONS: usize = 200;
/// Added to the diagonal, cells: lets liquid closed in by walls have a potential.
const SHIFT: f64 = 1e-3;

/// Solves sum_f a_f (psi_c - psi_f) = source of every full cell; short of the tolerance the
/// potential is used as it is.
pub(super) fn potential(cells: &mut [Cell]) {
    let n = cells.len();
    let diagonal: Vec<f64> = (cells.iter())
        .map(|cell| SHIFT + cell.area.iter().flatten().sum::<f64>())
        .collect();
    let mut psi = vec![0.0; n];
    let mut residual: Vec<f64> = (cells.iter())
        .map(|cell| if cell.full { cell.source } else { 0.0 })
        .collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let precondition =
        |r: &[f64]| -> Vec<f64> { r.iter().zip(&diagonal).map(|(r, d)| r / d).collect() };
    let goal = TOLERANCE * TOLERANCE * dot(&residual, &residual);
    let mut z = precondition(&residual);
    let mut direction = z.clone();
    let mut rz = dot(&residual, &z);
    for _ in 0..MAX_ITERATIONS {
        if rz <= 0.0 || dot(&residual, &residual) <= goal {
            break;
        }
        let image = apply(cells, &diagonal, &direction);
        let step = rz / dot(&direction, &image);
        for c in 0..n {
            psi[c] += step * direction[c];
            residual[c] -= step * image[c];
        }
        z = precondition(&residual);
        let next = dot(&residual, &z);
        let keep = next / rz;
        rz = next;
        for c in 0..n {
            direction[c] = z[c] + keep * direction[c];
        }
    }
    for (cell, psi) in cells.iter_mut().zip(psi) {
        cell.psi = psi;
    }
}

fn apply(cells: &[Cell], diagonal: &[f64], x: &[f64]) -> Vec<f64> {
    let row = |(c, cell): (usize, &Cell)| {
        if !cell.full {
            return 0.0;
        }
        let mut sum = diagonal[c] * x[c];
        for a in 0..3 {
            for side in 0..2 {
                let next = cell.next[a][side];
                if next != NONE {
                    sum -= cell.area[a][side] * x[next as usize];
                }
            }
        }
        sum
    };
    cells.iter().enumerate().map(row).collect()
}
