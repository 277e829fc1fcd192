//! From particles to the lattice: how much liquid each sub-cell and cell holds, and what it
//! carries.
//!
//! The particles deposit their volume V J on sub-cells with a trilinear hat; the open
//! fractions o are what a completely filled lattice would have received, spread over the walls'
//! surface to o~ ([`HAT`]). The ratio over the 27 sub-cells around each, r = sum m / sum o~, is
//! 1 in full liquid; the liquid fraction phi = clamp(1/2 + 3 (r - 1/2), 0, 1) is sharp to one
//! sub-cell.

mod cells;
mod deposit;
mod films;
mod hidden;
mod holes;

use std::ops::Range;

use rayon::prelude::*;

use crate::geometry::{Lattice, Window};
use crate::liquid::{Bins, Particles, rolling};

pub(crate) use cells::pressures;
pub(crate) use deposit::velocities;
pub(crate) use holes::neighbours;

/// Liquid on the lattice of a window.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fractions {
    /// Liquid fraction phi of the open volume of each sub-cell, 0 to 1.
    pub(crate) liquid: Vec<f32>,
    /// Liquid fraction of the open volume of each cell, 0 to 1; 0 where nothing is open.
    pub(crate) cell: Vec<f32>,
    /// Density r of each cell, liquid deposited over what its open volume holds; 1 where too
    /// little is open to tell.
    pub(crate) density: Vec<f32>,
    /// Density that each full cell behind a front lacks; empty where none does.
    pub(crate) lack: Vec<f32>,
    /// Deposited volume per volume of a sub-cell.
    deposit: Vec<f32>,
    rows: Vec<Range<usize>>,
}

/// Spread of the open volume: o~ = o convolved with it along each axis.
///
/// Liquid at random places spreads by the hat itself, [1/8, 3/4, 1/8]; particles in layers a
/// quarter cell off the wall spread nothing into it, at any offset. Real liquid is between the
/// two. With the former, cells at walls look 2.6 % too dense at the start, and the density
/// projection presses that much out of a box of 8 cells; the mean halves it.
const HAT: [f32; 3] = [0.0625, 0.875, 0.0625];

impl Fractions {
    /// Liquid of `particles`, sorted into `bins`, on a lattice between bodies of the velocities `bodies`.
    pub(crate) fn update(
        &mut self,
        particles: &Particles,
        bins: &Bins,
        lattice: &Lattice,
        bodies: &[[f64; 3]],
    ) {
        let (window, open) = (&lattice.window, &lattice.open);
        deposit::volumes(particles, bins, window, &mut self.deposit);
        self.find_rows(bins, window);
        self.fill_sub_cells(window, open);
        self.fill_cells(window, open);
        holes::close(self, lattice, bodies);
        cells::densities(self, lattice);
        rolling::behind_fronts(self, lattice);
    }

    /// Part of the walls at a cell that its liquid touches: at the surface, too, what lacks is next to walls.
    pub(crate) fn touching(&self, cell: usize) -> f32 {
        rolling::touching(match self.cell[cell] < 1.0 {
            true => rolling::lacks(self.density[cell]),
            false => self.lack.get(cell).copied().unwrap_or_default(),
        })
    }

    /// Gives back what is needed while they are found alone.
    pub(crate) fn shrink(&mut self) {
        self.deposit = Vec::new();
    }

    /// Range of cells along x, per row of cells, that particles can reach with their hat.
    fn find_rows(&mut self, bins: &Bins, window: &Window) {
        let [nx, ny, nz] = window.cells;
        let occupied: Vec<Range<usize>> = (0..ny * nz)
            .into_par_iter()
            .map(|row| {
                let [_, j, k] = window.home([nx / 2, row % ny, row / ny]);
                let base = (k * ny + j) * nx;
                let range = bins.of_range(base..base + nx);
                if range.is_empty() {
                    return 0..0;
                }
                if window.domain.periodic(0) {
                    return 0..nx;
                }
                let first = bins.start[base..].partition_point(|&s| s <= range.start as u32);
                let last = bins.start[base..=base + nx].partition_point(|&s| s < range.end as u32);
                first.saturating_sub(2)..(last + 1).min(nx)
            })
            .collect();
        let near = |n: usize, i: usize| i.saturating_sub(1)..(i + 2).min(n);
        self.rows.clear();
        self.rows
            .par_extend((0..ny * nz).into_par_iter().map(|row| {
                let (j, k) = (row % ny, row / ny);
                let (mut start, mut end) = (nx, 0);
                for k in near(nz, k) {
                    for one in near(ny, j).map(|j| &occupied[k * ny + j]) {
                        if !one.is_empty() {
                            (start, end) = (start.min(one.start), end.max(one.end));
                        }
                    }
                }
                start.min(end)..end
            }));
    }

    fn fill_sub_cells(&mut self, window: &Window, open: &[f32]) {
        let [nx, ny, nz] = window.sub_cells();
        let Self {
            liquid,
            deposit,
            rows,
            ..
        } = self;
        liquid.resize(window.sub_len(), 0.0);
        // Box of three applied to the deposit, and to the hat for the open volume.
        let (ones, wide) = ([1.0; 3], [0.0625, 0.9375, 1.0, 0.9375, 0.0625]);
        liquid.par_chunks_mut(nx).enumerate().for_each(|(r, out)| {
            out.fill(0.0);
            let at = [r % ny, r / ny];
            let cells = &rows[at[1] / window.parts(2) * window.cells[1] + at[0] / 2];
            if cells.is_empty() {
                return;
            }
            let span = 2 * cells.start..2 * cells.end;
            let lines = [(ny, 2), (nz, window.parts(2))];
            let mass = collapse(deposit, nx, at, lines, span.clone(), &ones);
            let room = collapse(open, nx, at, lines, span.clone(), &wide);
            for (s, phi) in out.iter_mut().enumerate().take(span.end).skip(span.start) {
                let mass = around(&mass, s, span.start, &ones);
                let room = around(&room, s, span.start, &wide);
                *phi = if room > 1e-6 {
                    (0.5 + 3.0 * (mass / room - 0.5)).clamp(0.0, 1.0)
                } else {
                    0.0
                };
            }
        });
    }

    fn fill_cells(&mut self, window: &Window, open: &[f32]) {
        let Self {
            liquid, cell, rows, ..
        } = self;
        cell.resize(window.len(), 0.0);
        let nx = window.cells[0];
        cell.par_chunks_mut(nx).enumerate().for_each(|(row, out)| {
            out.fill(0.0);
            let cells = rows[row].clone();
            for (out, subs) in out[cells.clone()]
                .iter_mut()
                .zip(sub_cells_of(window, row, cells))
            {
                *out = fraction(subs, liquid, open);
            }
        });
    }
}

/// Liquid fraction of a cell's open volume.
fn fraction(subs: impl Iterator<Item = usize>, liquid: &[f32], open: &[f32]) -> f32 {
    let (mut wet, mut room) = (0.0, 0.0);
    for sub in subs {
        wet += liquid[sub] * open[sub];
        room += open[sub];
    }
    if room > 1e-6 { wet / room } else { 0.0 }
}

/// The sub-cells of a cell.
pub(crate) fn sub_cells(window: &Window, cell: usize) -> impl Iterator<Item = usize> + use<> {
    sub_cells_from(window, window.first_sub(window.coordinates(cell)))
}

/// The sub-cells of each of the `cells` of row j + ny k of the window.
fn sub_cells_of(
    window: &Window,
    row: usize,
    cells: Range<usize>,
) -> impl Iterator<Item = impl Iterator<Item = usize>> {
    let (j, k) = (row % window.cells[1], row / window.cells[1]);
    cells.map(move |i| sub_cells_from(window, window.first_sub([i, j, k])))
}

/// The sub-cells of the cell whose low one is `first`.
fn sub_cells_from(window: &Window, first: usize) -> impl Iterator<Item = usize> + use<> {
    let (row, layer, parts) = (window.sub_stride(1), window.sub_stride(2), window.parts(2));
    (0..parts).flat_map(move |c| {
        (0..2).flat_map(move |b| (0..2).map(move |a| first + c * layer + b * row + a))
    })
}

/// Margin of the rows of [`collapse`] at both ends of their span.
const MARGIN: usize = 3;
/// Sub-cells that [`collapse`] sums up together.
const BLOCK: usize = 16;

/// Weighted sum of the rows of sub-cells around row `at`, over the sub-cells of `span` and
/// [`MARGIN`] more on both sides. `lines` are the number of rows along y and z and the
/// sub-cells per cell there; an axis with one sub-cell per cell has no neighbours. The
/// weights are those of one axis; with an odd number they are centred on `at`, with an even
/// number on the border above it.
fn collapse(
    values: &[f32],
    nx: usize,
    at: [usize; 2],
    lines: [(usize, usize); 2],
    span: Range<usize>,
    weights: &[f32],
) -> Vec<f32> {
    let mut sum = vec![0.0; span.len() + 2 * MARGIN];
    let low = MARGIN.saturating_sub(span.start);
    let from = (span.start + low) - MARGIN;
    let until = (span.end + MARGIN).min(nx);
    let back = (weights.len() - 1) / 2;
    let taps = |axis: usize| {
        let (n, parts) = lines[axis];
        weights.iter().enumerate().filter_map(move |(w, &weight)| {
            if parts == 1 {
                return (w == 0).then_some((at[axis], 1.0));
            }
            let line = (at[axis] + w).checked_sub(back)?;
            (line < n).then_some((line, weight))
        })
    };
    let rows: Vec<(&[f32], f32)> = taps(1)
        .flat_map(|(k, wz)| taps(0).map(move |(j, wy)| ((k * lines[0].0 + j) * nx, wy * wz)))
        .map(|(row, weight)| (&values[row + from..row + until], weight))
        .collect();
    // A few sub-cells through all rows at a time stay in registers.
    let (blocks, rest) = sum[low..low + until - from].as_chunks_mut::<BLOCK>();
    for (b, block) in blocks.iter_mut().enumerate() {
        let mut sums = [0.0; BLOCK];
        for (row, weight) in &rows {
            for (s, v) in sums.iter_mut().zip(&row[b * BLOCK..(b + 1) * BLOCK]) {
                *s += weight * v;
            }
        }
        *block = sums;
    }
    for (row, weight) in &rows {
        for (s, v) in rest.iter_mut().zip(&row[blocks.len() * BLOCK..]) {
            *s += weight * v;
        }
    }
    sum
}

/// Weighted sum around sub-cell `s` of a row from [`collapse`] whose span begins at `start`.
#[inline]
fn around(row: &[f32], s: usize, start: usize, weights: &[f32]) -> f32 {
    let first = s - start + MARGIN - (weights.len() - 1) / 2;
    weights.iter().zip(&row[first..]).map(|(w, v)| w * v).sum()
}

#[cfg(test)]
mod tests;
