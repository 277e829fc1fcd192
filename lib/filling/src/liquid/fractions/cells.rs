//! Means over the cells.

use physics::Tait;
use rayon::prelude::*;

use super::hidden::behind_walls;
use super::{Fractions, HAT, around, collapse, sub_cells};
use crate::geometry::{Lattice, Window};
use crate::liquid::{Bins, Particles};

/// Weights of the density of a cell: its own sub-cells double, the next ones on each side
/// single. Even, so centred between the two sub-cells of the cell.
const OWN_TWICE: [f32; 4] = [1.0, 2.0, 2.0, 1.0];

/// A cell has a density when its surroundings are open by at least this part of what they are
/// in free space.
const ENOUGH_OPEN: f32 = 0.2;

/// Fills [`Fractions::density`].
pub(super) fn densities(fractions: &mut Fractions, lattice: &Lattice) {
    let (window, open) = (&lattice.window, &lattice.open);
    let Fractions {
        liquid,
        density,
        deposit,
        rows,
        ..
    } = fractions;
    // The same weights seen through the hat of the deposit.
    let mut wide = [0.0; 6];
    for (i, own) in OWN_TWICE.iter().enumerate() {
        for (j, hat) in HAT.iter().enumerate() {
            wide[i + j] += own * hat;
        }
    }
    let free: f32 = (0..window.domain.axes).map(|_| 6.0_f32).product();
    let [sx, sy, sz] = window.sub_cells();
    let lines = [(sy, 2), (sz, window.parts(2))];
    density.resize(window.len(), 1.0);
    let nx = window.cells[0];
    density
        .par_chunks_mut(nx)
        .enumerate()
        .for_each(|(row, out)| {
            out.fill(1.0);
            let cells = rows[row].clone();
            if cells.is_empty() {
                return;
            }
            let (j, k) = (row % window.cells[1], row / window.cells[1]);
            let at = [2 * j, window.parts(2) * k];
            let span = 2 * cells.start..2 * cells.end;
            let mass = collapse(deposit, sx, at, lines, span.clone(), &OWN_TWICE);
            let room = collapse(open, sx, at, lines, span.clone(), &wide);
            for i in cells {
                let room = around(&room, 2 * i, span.start, &wide);
                let room = room - empty_behind_walls(lattice, liquid, row * nx + i, &wide);
                if room > ENOUGH_OPEN * free {
                    out[i] = around(&mass, 2 * i, span.start, &OWN_TWICE) / room;
                }
            }
        });
}

/// Open volume around a cell, as its density sees it, that lies behind walls and is empty: what liquid is there counts on both
/// sides, for deposits do not tell from which side of a thin wall they came.
fn empty_behind_walls(lattice: &Lattice, liquid: &[f32], cell: usize, wide: &[f32; 6]) -> f32 {
    let window = &lattice.window;
    let mut empty = 0.0;
    behind_walls(lattice, cell, |hidden, at| {
        for (bit, sub) in sub_cells(window, hidden).enumerate() {
            let weight = |axis: usize| match axis < window.domain.axes {
                true => wide[2 * at[axis] + (bit >> axis & 1)],
                false => 1.0,
            };
            let weight: f32 = (0..3).map(weight).product();
            empty += weight * lattice.open[sub] * (1.0 - liquid[sub]);
        }
    });
    empty
}

/// Mean pressure (Pa) of the particles of each cell by `tait`, the p* of the compressibility
/// term; a cell without particles takes the mean of its face neighbours that have some, else 0.
pub(crate) fn pressures(
    particles: &Particles,
    bins: &Bins,
    window: &Window,
    tait: Tait,
    pressure: &mut Vec<f32>,
) {
    let mut own = Vec::new();
    own.par_extend((0..window.len()).into_par_iter().map(|cell| {
        let home = window.home(window.coordinates(cell));
        let range = bins.of(window.index(home));
        if range.is_empty() {
            return f32::NAN;
        }
        let n = range.len() as f64;
        // Particles that took up what they carry in one cell carry the same.
        let (mut last, mut pressure) = (f32::NAN, 0.0);
        let pressures = particles.j[range].iter().map(|&j| {
            if j != last {
                (last, pressure) = (j, tait.pressure(f64::from(j)));
            }
            pressure
        });
        (pressures.sum::<f64>() / n) as f32
    }));
    pressure.clear();
    pressure.par_extend((0..window.len()).into_par_iter().map(|cell| {
        if !own[cell].is_nan() {
            return own[cell];
        }
        let (mut sum, mut n) = (0.0, 0.0_f32);
        for axis in 0..window.domain.axes {
            let stride = window.stride(axis);
            let below = cell.checked_sub(stride).map(|c| own[c]);
            let above = own.get(cell + stride).copied();
            for p in [below, above].into_iter().flatten().filter(|p| !p.is_nan()) {
                sum += p;
                n += 1.0;
            }
        }
        if n > 0.0 { sum / n } else { 0.0 }
    }));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::tests::{domain, lattice};
    use crate::liquid::tests::at;

    /// Particles of 1 and 3 Pa in one cell and of 8 Pa in the next but one.
    #[test]
    fn cells_without_particles_take_the_mean_of_their_neighbours() {
        let lattice = lattice(domain([8, 4, 1], 2), vec![]);
        let window = &lattice.window;
        let tait = Tait { bulk_modulus: 1e6 };
        let mut particles = at(
            vec![[2.2, 1.5, 0.5], [2.8, 1.5, 0.5], [4.5, 1.5, 0.5]],
            0.25,
        );
        particles.j = [1.0, 3.0, 8.0]
            .map(|p| tait.volume_change(p) as f32)
            .to_vec();
        let mut bins = Bins::default();
        particles.sort(window, &mut bins);
        let mut pressure = Vec::new();
        pressures(&particles, &bins, window, tait, &mut pressure);
        let of = |i: usize, j: usize| {
            let cell = window
                .local([i as f64, j as f64, 0.0])
                .map(|x| x.round() as usize);
            pressure[window.index(cell)]
        };
        for (i, j, expected) in [
            (2, 1, 2.0),
            (4, 1, 8.0),
            (3, 1, 5.0),
            (1, 1, 2.0),
            (4, 2, 8.0),
            (3, 2, 0.0),
            (6, 3, 0.0),
        ] {
            assert!((of(i, j) - expected).abs() < 1e-3, "{i} {j}: {}", of(i, j));
        }
    }
}
