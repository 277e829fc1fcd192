//! Decay of a Taylor-Green vortex, one of the array between mirrors:
//! kinetic energy as exp(-4 nu k^2 t).

use std::f64::consts::PI;

use super::{Measured, Scene};
use crate::case_text::{Body, CaseText, PF, Viscosity};

const EDGE: f64 = 34.8e-6;
/// Largest speed, m/s.
const SPEED: f64 = 1.0;

/// A vortex of `n` by `n` cells in a liquid of viscosity `eta` (Pa s) over one decay time of
/// the energy. The lower the viscosity, the more shows the stiffness that the explicit scheme
/// gives to flows of constant volume (locking: it resolves div v = 0 on every point).
pub fn scene(n: u32, eta: f64) -> Scene {
    let cell = EDGE / f64::from(n);
    let k = PI / EDGE;
    let rate = 4.0 * eta / PF[0] * k * k;
    let until = 1.0 / rate;
    // One body per cell gives the velocity field.
    let one = |i: u32| {
        let (x, y) = (f64::from(i % n) * cell, f64::from(i / n) * cell);
        let (a, b) = (k * (x + 0.5 * cell), k * (y + 0.5 * cell));
        let v = [SPEED * a.sin() * b.cos(), -SPEED * a.cos() * b.sin(), 0.0];
        Body::liquid([x, y, 0.0], [x + cell, y + cell, cell]).moving(v)
    };
    let case = CaseText {
        title: format!(
            "Taylor-Green vortex of {n} x {n} cells, {eta} Pa s.\nAgainst exp(-4 nu k^2 t)."
        ),
        viscosity: Viscosity::Newtonian(eta),
        stop: Some(until),
        bodies: (0..n * n).map(one).collect(),
        history_every: until / 50.0,
        ..CaseText::plane(cell, [EDGE, EDGE])
    };
    let name = format!("vortex-n{n}-eta{eta}");
    Scene::new(name, "Taylor & Green 1937", case, move |run| {
        let [time, energy] = run.columns(["time_s", "kinetic_energy_J"])?;
        let [end, last] = run.ends(["time_s", "kinetic_energy_J"])?;
        // The start is a velocity per cell, not per point: its roughness goes first.
        let from = time.iter().position(|&t| t > 0.2 * until);
        let from = from.ok_or("the history is too short")?;
        let found = (energy[from] / last).ln() / (end - time[from]);
        Ok(vec![Measured::relative("decay rate", found, rate)])
    })
}
