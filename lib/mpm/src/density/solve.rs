//! The potential of the displacement by conjugate gradients with Jacobi preconditioning; serial,
//! because it is due once in some fifty steps, and so the same for any number of threads.

use super::cells::{Cell, NONE};

/// Relative residual at which to stop: what is left is taken away by later projections.
const TOLERANCE: f64 = 0.05;
/// Hardly reached: [`SHIFT`] bounds the condition number by 12 000, which takes 202 at the most.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A row of full cells between a wall and air.
    fn row(sources: &[f64]) -> Vec<Cell> {
        let cell = |(c, &source)| {
            let mut cell = Cell::default();
            (cell.full, cell.source) = (true, source);
            cell.next = [[NONE; 2]; 3];
            cell.area[0] = [if c > 0 { 1.0 } else { 0.0 }, 1.0];
            if c > 0 {
                cell.next[0][0] = c as u32 - 1;
            }
            if c + 1 < sources.len() {
                cell.next[0][1] = c as u32 + 1;
            }
            cell
        };
        sources.iter().enumerate().map(cell).collect()
    }

    /// Sources that alternate: the residual falls from 0.069 to 0.032 of them in the last step but one.
    #[test]
    fn the_potential_reduces_the_residual_to_a_twentieth() {
        let sources: Vec<f64> = (0..24).map(|c| [1.0, -1.0][c % 2]).collect();
        let mut cells = row(&sources);
        potential(&mut cells);
        let psi: Vec<f64> = cells.iter().map(|cell| cell.psi).collect();
        let square: f64 = (0..24)
            .map(|c| {
                let low = if c > 0 { psi[c] - psi[c - 1] } else { 0.0 };
                let high = psi[c] - psi.get(c + 1).unwrap_or(&0.0);
                (sources[c] - SHIFT * psi[c] - low - high).powi(2)
            })
            .sum();
        let left = (square / 24.0).sqrt();
        assert!((0.025..0.05).contains(&left), "{left}");
    }

    /// Liquid goes out of the far end of a long row: as bad a case as there is, for which 200 iterations do.
    #[test]
    fn the_longest_row_is_solved_too() {
        let mut sources = vec![0.0; 4000];
        sources[0] = 1.0;
        let mut cells = row(&sources);
        potential(&mut cells);
        let psi = |c: usize| cells[c].psi;
        let square: f64 = (1..3999)
            .map(|c| ((2.0 + SHIFT) * psi(c) - psi(c - 1) - psi(c + 1)).powi(2))
            .sum::<f64>()
            + ((1.0 + SHIFT) * psi(0) - psi(1) - 1.0).powi(2);
        println!("{}", square.sqrt());
        assert!(square.sqrt() < TOLERANCE);
    }

    #[test]
    fn closed_in_liquid_has_a_potential() {
        let mut cells = row(&[0.15]);
        cells[0].area = Default::default();
        potential(&mut cells);
        assert!((cells[0].psi - 150.0).abs() < 1e-6, "{}", cells[0].psi);
    }
}
