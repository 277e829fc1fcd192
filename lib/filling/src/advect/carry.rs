//! What the particles take from the grid after a step.

use physics::{ShearRate, TAIT_C, Tait};
use rayon::prelude::*;

use super::Flow;
use crate::particles::Particles;
use crate::window::Window;

/// Sets the particles' velocities to those of the field where they are (PIC). Its numerical
/// viscosity, a fraction of h^2/dt, is below 2 % of eta/rho = 1e-3 m2/s at the paper's scales.
pub fn set_velocities(particles: &mut Particles, flow: &Flow) {
    (particles.velocity.par_iter_mut())
        .zip(&particles.position)
        .with_min_len(1 << 12)
        .for_each(|(v, &x)| *v = flow.velocity(x).map(|v| v as f32));
}

/// Sets the particles' volume changes by `tait` from the pressure (Pa) of their cell of the
/// window, not below `lowest` (Pa) nor below half the tension at which `tait` has no volume;
/// cells without liquid have pressure 0.
pub fn set_volume_changes(
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
        .for_each(|(j, &x)| {
            let cell = window.local(x).map(|s| s as usize);
            let p = pressure
                .get(window.index(cell))
                .map_or(0.0, |&p| f64::from(p));
            *j = tait.volume_change(p.max(lowest)) as f32;
        });
}

/// Shear rate f |dev D| (1/s) at each particle, f by `convention`, for cells of `cell_m`.
pub fn shear_rates(
    particles: &Particles,
    flow: &Flow,
    convention: ShearRate,
    cell_m: f64,
) -> Vec<f32> {
    let scale = convention.factor() / cell_m;
    (particles.position.par_iter())
        .with_min_len(1 << 12)
        .map(|&x| {
            let gradient = flow.gradient(x).map(|c| c.gradient);
            (scale * deviator_norm(&gradient)) as f32
        })
        .collect()
}

/// |dev D| of a velocity gradient, D its symmetric part.
pub(crate) fn deviator_norm(gradient: &[[f64; 3]; 3]) -> f64 {
    let mean = (gradient[0][0] + gradient[1][1] + gradient[2][2]) / 3.0;
    let mut sum = 0.0;
    for (i, row) in gradient.iter().enumerate() {
        for (j, &a) in row.iter().enumerate() {
            let d = 0.5 * (a + gradient[j][i]) - if i == j { mean } else { 0.0 };
            sum += d * d;
        }
    }
    sum.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn simple_shear_by_both_conventions() {
        let norm = deviator_norm(&[[0.0, 3.0, 0.0], [0.0; 3], [0.0; 3]]);
        assert!((norm * ShearRate::Rheometer.factor() - 3.0).abs() < 1e-12);
        assert!((norm * ShearRate::Paper.factor() - 3.0 * 2_f64.sqrt()).abs() < 1e-12);
        let dilation = deviator_norm(&[[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]]);
        assert!(dilation < 1e-12);
    }
}
