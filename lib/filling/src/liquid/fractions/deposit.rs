//! From particles to the lattice: volumes to sub-cells, velocities to faces.
//!
//! Both add up in slabs of cell layers along z. A slab also writes the layers next to it, so
//! the even slabs go first, side by side, and then the odd ones: every sum has a fixed order,
//! whatever the number of threads.

use rayon::prelude::*;

use crate::geometry::Window;
use crate::liquid::{Bins, Particles};

/// Layers of cells in a slab.
const SLAB: usize = 4;

/// Runs `work(cell layers, first output layer, output from that layer on)` for all layers of
/// cells but the outermost; `parts` output layers belong to a cell layer, and a cell layer
/// writes to its own and to one more on each side.
fn by_slabs<T: Send>(
    window: &Window,
    parts: usize,
    layer: usize,
    out: &mut [T],
    work: impl Fn(std::ops::Range<usize>, usize, &mut [T]) + Sync,
) {
    let end = window.cells[2] - 1;
    for odd in [0, 1] {
        let first = 1 + odd * SLAB;
        let skip = ((parts * first - 1) * layer).min(out.len());
        out[skip..]
            .par_chunks_mut(2 * SLAB * parts * layer)
            .enumerate()
            .for_each(|(slab, out)| {
                let low = first + 2 * SLAB * slab;
                let cells = low..(low + SLAB).min(end);
                if !cells.is_empty() {
                    work(cells, parts * low - 1, out);
                }
            });
    }
}

/// Deposits the current volumes V J with a hat of half-width half a cell on sub-cells:
/// `deposit[s]` is the deposited volume over the volume of a sub-cell.
pub(super) fn volumes(particles: &Particles, bins: &Bins, window: &Window, deposit: &mut Vec<f32>) {
    deposit.clear();
    deposit.resize(window.sub_len(), 0.0);
    let per_cell = window.sub_per_cell() as f32;
    let layer = window.sub_stride(2);
    let row = window.sub_stride(1);
    let flat = window.parts(2) == 1;
    let spread = |p: usize, first: usize, out: &mut [f32]| {
        let at = window.local(particles.position[p]);
        let weight = particles.volume[p] * (1.0 + particles.j[p]) * per_cell;
        let (i, wx) = hat(2.0 * at[0] - 0.5);
        let (j, wy) = hat(2.0 * at[1] - 0.5);
        let (k, wz) = if flat {
            (0, [1.0, 0.0])
        } else {
            hat(2.0 * at[2] - 0.5)
        };
        let planes = if flat { 1 } else { 2 };
        for (c, &wz) in wz.iter().take(planes).enumerate() {
            for (b, &wy) in wy.iter().enumerate() {
                let start = (k + c - first) * layer + (j + b) * row + i;
                for (out, wx) in out[start..start + 2].iter_mut().zip(wx) {
                    *out += wx * wy * wz * weight;
                }
            }
        }
    };
    if flat {
        (0..particles.len()).for_each(|p| spread(p, 0, deposit));
    } else {
        let cells = window.stride(2);
        by_slabs(window, 2, layer, deposit, |layers, first, out| {
            let slab = bins.of_range(layers.start * cells..layers.end * cells);
            slab.for_each(|p| spread(p, first, out));
        });
    }
    let sub_cells = window.sub_cells();
    for axis in 0..window.domain.axes {
        join_images(window, axis, 2, sub_cells, deposit, |a, b| a + b);
    }
}

/// Volume-weighted mean velocity (m/s) of the particles around each face along `axis`, with
/// the hat of half-width one cell (PIC transfer); 0 where there is no particle.
pub(crate) fn velocities(
    particles: &Particles,
    bins: &Bins,
    window: &Window,
    axis: usize,
    velocity: &mut Vec<f32>,
) {
    let mut sums = vec![[0.0_f32; 2]; window.len()];
    let shift = |a: usize| if a == axis { 0.0 } else { 0.5 };
    let flat = window.parts(2) == 1;
    let (row, layer) = (window.stride(1), window.stride(2));
    let spread = |p: usize, first: usize, out: &mut [[f32; 2]]| {
        let at = window.local(particles.position[p]);
        let (volume, velocity) = (particles.volume[p], particles.velocity[p][axis]);
        let (i, wx) = hat(at[0] - shift(0));
        let (j, wy) = hat(at[1] - shift(1));
        let (k, wz) = if flat {
            (0, [1.0, 0.0])
        } else {
            hat(at[2] - shift(2))
        };
        let planes = if flat { 1 } else { 2 };
        for (c, &wz) in wz.iter().take(planes).enumerate() {
            for (b, &wy) in wy.iter().enumerate() {
                let start = (k + c - first) * layer + (j + b) * row + i;
                for ([sum, total], wx) in out[start..start + 2].iter_mut().zip(wx) {
                    let weight = wx * wy * wz * volume;
                    *sum += weight * velocity;
                    *total += weight;
                }
            }
        }
    };
    if flat {
        (0..particles.len()).for_each(|p| spread(p, 0, &mut sums));
    } else {
        by_slabs(window, 1, layer, &mut sums, |layers, first, out| {
            let slab = bins.of_range(layers.start * layer..layers.end * layer);
            slab.for_each(|p| spread(p, first, out));
        });
    }
    for a in 0..window.domain.axes {
        join_images(window, a, 1, window.cells, &mut sums, |a, b| {
            [a[0] + b[0], a[1] + b[1]]
        });
    }
    velocity.clear();
    velocity.par_extend(sums.par_iter().map(
        |&[sum, weight]| {
            if weight > 0.0 { sum / weight } else { 0.0 }
        },
    ));
}

/// Lower of the two lattice points around `x`, which is not negative, and the hat's weights at both.
#[inline]
fn hat(x: f64) -> (usize, [f32; 2]) {
    let low = x as usize;
    let high = (x - low as f64) as f32;
    (low, [1.0 - high, high])
}

/// Across a periodic `axis`: adds what lies in the images to their home, then copies it back.
fn join_images<T: Copy>(
    window: &Window,
    axis: usize,
    parts: usize,
    dims: [usize; 3],
    values: &mut [T],
    add: impl Fn(T, T) -> T,
) {
    if !window.domain.periodic(axis) {
        return;
    }
    let period = parts * window.domain.cells[axis];
    let stride: usize = dims[..axis].iter().product();
    let outer: usize = dims[axis + 1..].iter().product();
    let n = dims[axis];
    for o in 0..outer {
        for inner in 0..stride {
            let at = |s: usize| (o * n + s) * stride + inner;
            for s in period..n {
                values[at(s % period)] = add(values[at(s % period)], values[at(s)]);
            }
            for s in period..n {
                values[at(s)] = values[at(s % period)];
            }
        }
    }
}
