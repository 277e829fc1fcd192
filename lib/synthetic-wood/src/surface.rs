//! The rough face of an adherend.

use rand::RngExt;

use super::random::{Feature, stream};
use super::recipe::Plan;

/// The rough face of an adherend: how far its wood stays back from the bond plane.
///
/// Veneer faces are rough by tens of um. The face is a sum of plane waves with random
/// direction and phase whose amplitude grows with wavelength, scaled so that the highest
/// asperity comes within one voxel of the bond plane and the mean recess is the plan's.
/// Both faces stay on their side of the plane, so the adherends can be drawn apart.
pub(crate) struct Face {
    columns: usize,
    recess: Vec<f32>,
}

const WAVES: usize = 24;
/// Wavelengths of the roughness, um.
const WAVELENGTHS: [f32; 2] = [25.0, 160.0];

impl Face {
    pub(crate) fn new(plan: &Plan, side: usize) -> Self {
        let mut random = stream(plan, side, Feature::Face);
        let waves: Vec<[f32; 4]> = (0..WAVES)
            .map(|_| {
                let wavelength = random.random_range(WAVELENGTHS[0]..WAVELENGTHS[1]);
                let direction = random.random_range(0.0..std::f32::consts::TAU);
                let number = std::f32::consts::TAU / wavelength;
                let phase = random.random_range(0.0..std::f32::consts::TAU);
                let (sin, cos) = direction.sin_cos();
                [number * cos, number * sin, phase, wavelength.sqrt()]
            })
            .collect();
        let [columns, _, pages] = plan.size;
        let mut recess: Vec<f32> = (0..columns * pages)
            .map(|i| {
                let [x, _, z] = plan.centre([i % columns, 0, i / columns]);
                waves
                    .iter()
                    .map(|[kx, kz, phase, size]| size * (kx * x + kz * z + phase).cos())
                    .sum()
            })
            .collect();
        let lowest = recess.iter().copied().fold(f32::INFINITY, f32::min);
        let mean = recess.iter().map(|h| f64::from(h - lowest)).sum::<f64>() / recess.len() as f64;
        let scale = (plan.mean_recess() - plan.voxel) / mean as f32;
        for height in &mut recess {
            *height = plan.voxel + scale * (*height - lowest);
        }
        Self { columns, recess }
    }

    /// Distance of the wood from the bond plane above or below this place, um.
    pub(crate) fn recess(&self, column: usize, page: usize) -> f32 {
        self.recess[page * self.columns + column]
    }
}
