//! Flow through a simple cubic array of spheres made of voxels of half a cell, driven by a body
//! force along an axis of the array; a quarter of the period is computed, mirrored at two planes.

use std::f64::consts::PI;

use super::{Measured, Scene, mean_velocity};
use crate::Result;
use crate::case_text::{CaseText, PF};
use crate::outputs::Run;
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
    let case = CaseText {
        title: format!(
            "Simple cubic array of spheres, volume fraction {fraction}, {n} cells a period, a quarter of it.\nAgainst the drag 6 pi eta a K U, K = {drag} (Sangani & Acrivos 1982), and the same voxels refined."
        ),
        boundary: ["periodic", "symmetry", "symmetry"],
        ..driven(voxels, cell, [PERIOD, 0.5 * PERIOD, 0.5 * PERIOD], darcy)
    };
    let g = case.gravity[0];
    let name = format!("spheres-n{n}-{fraction}");
    let against = "Sangani & Acrivos 1982; lattice Boltzmann";
    Scene::new(name, against, case, move |run| {
        let found = permeability(run, porosity, g)?;
        let same = converged(n, fraction)? * darcy;
        Ok(vec![
            Measured::relative("permeability", found, darcy),
            Measured::relative("permeability, same voxels", found, same),
        ])
    })
}

/// Voxels of a box of a `size` (m), of a permeability near `darcy` (m2), with a body force along x.
pub(super) fn driven(voxels: Voxels, cell: f64, size: [f64; 3], darcy: f64) -> CaseText {
    // Momentum is gained in rho k/eta, pressure in the time that its liquid takes to flow in.
    let [rho, modulus, eta] = PF;
    let gain = rho * darcy / eta + eta / modulus * size[0].powi(2) / (10.0 * darcy);
    let until = 12.0 * gain;
    // The liquid moves by a tenth of a cell: the points stay where they fill the voids evenly.
    let g = 0.1 * cell / until * eta * voxels.porosity() / (rho * darcy);
    CaseText {
        gravity: [g, 0.0, 0.0],
        stop: Some(until),
        voxels: Some(voxels),
        history_every: until / 20.0,
        ..CaseText::new(cell, 3, size)
    }
}

/// Permeability (m2) that a run with a body force per mass `g` (m/s2) shows.
pub(super) fn permeability(run: &Run, porosity: f64, g: f64) -> Result<f64> {
    let [rho, _, eta] = PF;
    Ok(porosity * mean_velocity(run, rho * g)? * eta / (rho * g))
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
