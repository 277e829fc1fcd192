//! Flow through a simple cubic array of spheres made of voxels of half a cell, driven by a body
//! force along an axis of the array; a quarter of the period is computed, mirrored at two planes.

use std::f64::consts::PI;

use super::{Measured, Scene, mean_velocity};
use crate::Result;
use crate::case_text::{CaseText, PF};
use crate::voxels::Voxels;

/// Period of the array, m.
const PERIOD: f64 = 23.2e-6;

/// Volume fraction c of the spheres and factor K of the drag 6 pi eta a K U on one of them, U the
/// mean velocity over the whole period: Sangani & Acrivos 1982 (Int. J. Multiphase Flow 8, 343)
/// and Zick & Homsy 1982 (J. Fluid Mech. 115, 13), their Table 2.
pub(super) const DRAG: [(f64, f64); 5] = [
    (0.064, 2.810),
    (0.125, 4.292),
    (0.216, 7.442),
    (0.343, 15.4),
    (0.45, 28.1),
];

/// Radius of the spheres over the period.
fn radius(fraction: f64) -> f64 {
    (0.75 * fraction / PI).cbrt()
}

/// An array of `n` cells a period, by its row of [`DRAG`].
pub(super) fn scene(n: u32, (fraction, drag): (f64, f64)) -> Scene {
    let cell = PERIOD / f64::from(n);
    let voxels = quarter(n, fraction);
    let porosity = voxels.porosity();
    let darcy = PERIOD.powi(2) / (6.0 * PI * radius(fraction) * drag);
    // Momentum is gained in rho k/eta, pressure in the time that its liquid takes to flow in.
    let [rho, modulus, eta] = PF;
    let gain = rho * darcy / eta + eta / modulus * PERIOD.powi(2) / (10.0 * darcy);
    let until = 12.0 * gain;
    // The liquid moves by a tenth of a cell: the points stay where they fill the voids evenly.
    let g = 0.1 * cell / until * eta * porosity / (rho * darcy);
    let case = CaseText {
        title: format!(
            "Simple cubic array of spheres, volume fraction {fraction}, {n} cells a period, a quarter of it.\nAgainst the drag 6 pi eta a K U, K = {drag} (Sangani & Acrivos 1982), and the same voxels refined."
        ),
        gravity: [g, 0.0, 0.0],
        boundary: ["periodic", "symmetry", "symmetry"],
        stop: Some(until),
        voxels: Some(voxels),
        history_every: until / 20.0,
        ..CaseText::new(cell, 3, [PERIOD, 0.5 * PERIOD, 0.5 * PERIOD])
    };
    let name = format!("spheres-n{n}-{fraction}");
    let against = "Sangani & Acrivos 1982; lattice Boltzmann";
    Scene::new(name, against, case, move |run| {
        let found = porosity * mean_velocity(run, rho * g)? * eta / (rho * g);
        let same = converged(n, fraction)? * darcy;
        Ok(vec![
            Measured::relative("permeability", found, darcy),
            Measured::relative("permeability, same voxels", found, same),
        ])
    })
}

/// A quarter of the period around the axis of the flow through a sphere, with voxels of half a cell.
fn quarter(n: u32, fraction: f64) -> Voxels {
    let voxels = 2 * n as usize;
    let radius = radius(fraction) * voxels as f64;
    let wood = move |x: usize, y: usize, z: usize| {
        let along = x as f64 + 0.5 - 0.5 * voxels as f64;
        let across = (y as f64 + 0.5).hypot(z as f64 + 0.5);
        along.hypot(across) < radius
    };
    let half = voxels / 2;
    Voxels::new(PERIOD / voxels as f64, [voxels, half, half], wood)
}

/// Permeability of the voxels with each split ever more finely, over that of spheres.
fn converged(n: u32, fraction: f64) -> Result<f64> {
    let table = include_str!("../../reference/spheres.csv");
    let row = format!("{},{fraction},", 2 * n);
    let rest = table.lines().find_map(|line| line.strip_prefix(&row));
    let found = rest.and_then(|rest| rest.split(',').next()?.parse().ok());
    Ok(found.ok_or_else(|| format!("lib/studies/reference/spheres.csv has no row {row}"))?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn voxels_fill_the_fraction_and_every_array_has_a_reference() {
        for (fraction, _) in DRAG {
            let voxels = 1.0 - quarter(24, fraction).porosity();
            let off = voxels / fraction - 1.0;
            assert!(off.abs() < 0.03, "{fraction}: {voxels}");
            for n in [8, 16, 24] {
                let same = converged(n, fraction).unwrap();
                assert!((0.7..1.3).contains(&same), "{n} {fraction}: {same}");
            }
        }
    }
}
