//! Pairwise matching and the Galerkin product over aggregates.

use rayon::prelude::*;

use crate::SolveError;
use crate::csr::Csr;
use crate::vector::{CHUNK, Work, for_each};

/// Marks a row that belongs to no aggregate: it has no neighbours and the smoother solves it.
const NONE: u32 = u32::MAX;
/// Passes of pairwise matching per level: aggregates of eight (Notay 2010, as the next).
const PASSES: usize = 3;
/// A pair is formed only along a coupling at least this fraction of the row's strongest.
const STRONG: f64 = 0.25;

/// The coarse row of every fine row, and the fine rows of every coarse row.
pub(super) struct Aggregation {
    coarse_of: Vec<u32>,
    member_start: Vec<u32>,
    members: Vec<u32>,
}

impl Aggregation {
    fn new(coarse_of: Vec<u32>, n_coarse: usize) -> Self {
        let mut member_start = vec![0u32; n_coarse + 1];
        for &coarse in coarse_of.iter().filter(|&&coarse| coarse != NONE) {
            member_start[coarse as usize + 1] += 1;
        }
        for i in 0..n_coarse {
            member_start[i + 1] += member_start[i];
        }
        let mut next = member_start.clone();
        let mut members = vec![0u32; member_start[n_coarse] as usize];
        for (fine, &coarse) in coarse_of.iter().enumerate() {
            if coarse != NONE {
                let slot = &mut next[coarse as usize];
                members[*slot as usize] = fine as u32;
                *slot += 1;
            }
        }
        Self {
            coarse_of,
            member_start,
            members,
        }
    }

    pub(super) fn n_coarse(&self) -> usize {
        self.member_start.len() - 1
    }

    fn members(&self, coarse: usize) -> &[u32] {
        &self.members[self.member_start[coarse] as usize..self.member_start[coarse + 1] as usize]
    }

    /// `coarse = P^T fine`: sums over aggregates.
    pub(super) fn restrict(&self, fine: &[Work], coarse: &mut [Work]) {
        for_each(coarse, |row, out| {
            *out = (self.members(row).iter())
                .map(|&row| fine[row as usize])
                .sum();
        });
    }

    /// `fine += factor P coarse`.
    pub(super) fn add_prolonged(&self, factor: Work, coarse: &[Work], fine: &mut [Work]) {
        for_each(fine, |row, out| {
            if let Some(coarse) = coarse.get(self.coarse_of[row] as usize) {
                *out += factor * coarse;
            }
        });
    }

    /// `self` followed by `next` on its coarse rows.
    fn then(&self, next: &Self) -> Self {
        let of = |&middle: &u32| next.coarse_of.get(middle as usize).copied();
        let coarse_of = self
            .coarse_of
            .par_iter()
            .map(|middle| of(middle).unwrap_or(NONE));
        Self::new(coarse_of.collect(), next.n_coarse())
    }
}

/// Aggregates of about eight rows of `matrix` and the operator `P^T matrix P` on them.
pub(super) fn coarsen(matrix: &Csr<f64>) -> Result<(Aggregation, Csr<f64>), SolveError> {
    let mut aggregation = match_pairs(matrix);
    let mut coarse = galerkin(matrix, &aggregation)?;
    for _ in 1..PASSES {
        let pairs = match_pairs(&coarse);
        coarse = galerkin(&coarse, &pairs)?;
        aggregation = aggregation.then(&pairs);
    }
    Ok((aggregation, coarse))
}

/// Pairs every row with its most strongly coupled free neighbour, in the order of the rows and
/// within fixed ranges of rows, which are matched in parallel.
fn match_pairs(matrix: &Csr<f64>) -> Aggregation {
    let n = matrix.n_rows();
    let mut coarse_of = vec![NONE; n];
    let counts: Vec<u32> = (coarse_of.par_chunks_mut(CHUNK))
        .enumerate()
        .map(|(chunk, part)| match_range(matrix, chunk * CHUNK, part))
        .collect();
    let mut offset = 0;
    let offsets: Vec<u32> = (counts.iter())
        .map(|count| {
            offset += count;
            offset - count
        })
        .collect();
    (coarse_of.par_chunks_mut(CHUNK))
        .zip(offsets)
        .for_each(|(part, offset)| {
            for coarse in part.iter_mut().filter(|coarse| **coarse != NONE) {
                *coarse += offset;
            }
        });
    Aggregation::new(coarse_of, offset as usize)
}

/// Matches the rows `start..start + part.len()` among themselves; returns the number of pairs
/// and single rows, numbered from zero.
fn match_range(matrix: &Csr<f64>, start: usize, part: &mut [u32]) -> u32 {
    let mut count = 0;
    for i in 0..part.len() {
        if part[i] != NONE {
            continue;
        }
        let (columns, values) = matrix.row(start + i);
        let mut strongest = 0.0f64;
        let mut best = (0.0f64, None);
        for (&column, &value) in columns.iter().zip(values) {
            let column = column as usize;
            if column == start + i {
                continue;
            }
            strongest = strongest.max(-value);
            let local = column.wrapping_sub(start);
            if -value > best.0 && part.get(local) == Some(&NONE) {
                best = (-value, Some(local));
            }
        }
        if strongest == 0.0 {
            continue;
        }
        part[i] = count;
        if let (coupling, Some(partner)) = best
            && coupling > STRONG * strongest
        {
            part[partner] = count;
        }
        count += 1;
    }
    count
}

/// `P^T matrix P`: entries summed over the rows and columns of aggregates.
fn galerkin(matrix: &Csr<f64>, aggregation: &Aggregation) -> Result<Csr<f64>, SolveError> {
    let n = aggregation.n_coarse();
    Csr::assemble(n, n, |coarse, entries| {
        for &row in aggregation.members(coarse) {
            let (columns, values) = matrix.row(row as usize);
            for (&column, &value) in columns.iter().zip(values) {
                let target = aggregation.coarse_of[column as usize];
                if target != NONE {
                    entries.add(target as usize, value);
                }
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triples of rows coupled by 1 inside and by `weak` to the next triple: the first two rows pair up, and the third pairs
    /// with the next triple only if its coupling is a quarter or more.
    #[test]
    fn rows_join_along_a_quarter_of_the_strongest_coupling() {
        let rows = |weak: f64| {
            let matrix = Csr::assemble(6, 6, |row, entries| {
                let coupling = |low: usize| if low == 2 { weak } else { 1.0 };
                for other in [row.wrapping_sub(1), row + 1] {
                    if other < 6 {
                        entries.add(other, -coupling(row.min(other)));
                        entries.add(row, coupling(row.min(other)));
                    }
                }
            });
            match_pairs(&matrix.unwrap()).n_coarse()
        };
        assert_eq!([0.2, 0.3].map(rows), [4, 3]);
    }
}
