//! What the particles take from the grid after a step.

use physics::{ShearRate, TAIT_C, Tait};
use rayon::prelude::*;

use super::flow::{Flow, Near};
use crate::geometry::Window;
use crate::liquid::Particles;

/// Sets the particles' velocities to those of the field where they are (PIC). Its numerical
/// viscosity, a fraction of h^2/dt, is below 2 % of eta/rho = 1e-3 m2/s at the paper's scales.
///
/// With face velocities in `limit`, no component goes far beyond the range of those around it and of
/// the bodies: the profile between walls exceeds its mean, and where inertia counts (lumen Reynolds
/// numbers above 1) particles that carried the excess on would gain energy in every step.
pub(crate) fn set_velocities(
    particles: &mut Particles,
    flow: &Flow,
    limit: Option<&[Vec<f32>; 3]>,
) {
    let axes = flow.window.domain.axes;
    let bodies: [[f32; 2]; 3] = std::array::from_fn(|axis| {
        (flow.bodies.iter().map(|body| body[axis] as f32))
            .fold([0.0_f32; 2], |[low, high], v| [low.min(v), high.max(v)])
    });
    (particles.velocity.par_iter_mut())
        .zip(&particles.position)
        .with_min_len(1 << 12)
        .for_each_init(Near::default, |near, (v, &x)| {
            *v = flow.velocity(x, near).map(|v| v as f32);
            let Some(value) = limit else { return };
            let (_, cell, _) = flow.place(x);
            for axis in 0..axes {
                let [low, high] = around(&flow.window, axis, cell, &value[axis], bodies[axis]);
                v[axis] = v[axis].clamp(low, high);
            }
        });
}

/// Fraction of the range of the surrounding velocities by which a particle may exceed them. The peak of
/// plane Poiseuille flow over two cells would need one half, with which liquids of low viscosity are
/// unstable again.
const PEAK: f32 = 0.125;

/// `range` widened by the known velocities of the two faces of a cell along `axis` and of those
/// beside them, and by [`PEAK`].
fn around(
    window: &Window,
    axis: usize,
    cell: [usize; 3],
    value: &[f32],
    range: [f32; 2],
) -> [f32; 2] {
    let span = |a: usize| {
        if a >= window.domain.axes {
            0..1
        } else if a == axis {
            cell[a]..(cell[a] + 2).min(window.cells[a])
        } else {
            cell[a].saturating_sub(1)..(cell[a] + 2).min(window.cells[a])
        }
    };
    let [mut low, mut high] = range;
    for k in span(2) {
        for j in span(1) {
            for i in span(0) {
                // NaN, an unknown velocity, changes neither.
                let v = value[window.index([i, j, k])];
                (low, high) = (low.min(v), high.max(v));
            }
        }
    }
    let peak = PEAK * (high - low);
    [low - peak, high + peak]
}

/// Sets the particles' volume changes by `tait` from the pressure (Pa) of their cell of the
/// window, not below `lowest` (Pa) nor below half the tension at which `tait` has no volume;
/// cells without liquid have pressure 0.
pub(crate) fn set_volume_changes(
    particles: &mut Particles,
    window: &Window,
    pressure: &[f32],
    tait: Tait,
    lowest: f64,
) {
    let lowest = lowest.max(-0.5 * TAIT_C * tait.bulk_modulus);
    (particles.j.par_iter_mut())
        .zip(&particles.position)
        .with_min_len(1 << 12)
        .for_each_init(
            || (usize::MAX, 0.0),
            |(last, change), (j, &x)| {
                let cell = window.index(window.local(x).map(|s| s as usize));
                // A logarithm a cell, not a point.
                if *last != cell {
                    let p = pressure.get(cell).map_or(0.0, |&p| f64::from(p));
                    (*last, *change) = (cell, tait.volume_change(p.max(lowest)) as f32);
                }
                *j = *change;
            },
        );
}

/// Shear rate f |dev D| (1/s) at each particle, f by `convention`, for cells of `cell_m`.
pub(crate) fn shear_rates(
    particles: &Particles,
    flow: &Flow,
    convention: ShearRate,
    cell_m: f64,
) -> Vec<f32> {
    let scale = convention.factor() / cell_m;
    (particles.position.par_iter())
        .with_min_len(1 << 12)
        .map_init(Near::default, |near, &x| {
            (scale * flow.deviator_norm(x, near)) as f32
        })
        .collect()
}
