//! Standing sound wave between mirrors, half a wave long: speed of sound and damping. The
//! damping of a Newtonian liquid without bulk viscosity is (4/3 eta) k^2/(2 rho).

use std::f64::consts::PI;

use super::{Measured, Scene};
use crate::Result;
use crate::case_text::{Body, CaseText, PF, Viscosity};
use crate::outputs::Run;

const CELL: f64 = 2.9e-6;
const CELLS: u32 = 32;
/// Amplitude of the velocity, m/s.
const AMPLITUDE: f64 = 0.1;

/// A wave in a liquid of viscosity `eta` (Pa s), three periods of it.
pub fn scene(eta: f64) -> Scene {
    let long = f64::from(CELLS) * CELL;
    let k = PI / long;
    let omega = k * (PF[1] / PF[0]).sqrt();
    let period = 2.0 * PI / omega;
    // One body per cell gives the velocity field.
    let cell = |i: u32| {
        let x = f64::from(i) * CELL;
        let v = AMPLITUDE * (k * (x + 0.5 * CELL)).sin();
        Body::liquid([x, 0.0, 0.0], [x + CELL, 2.0 * CELL, CELL]).moving([v, 0.0, 0.0])
    };
    let case = CaseText {
        title: format!(
            "Standing sound wave, half a wave over {CELLS} cells, {eta} Pa s.\nAgainst c^2 = K/rho and a decay of (4/3 eta) k^2/(2 rho)."
        ),
        viscosity: Viscosity::Newtonian(eta),
        stop: Some(3.2 * period),
        bodies: (0..CELLS).map(cell).collect(),
        history_every: period / 200.0,
        ..CaseText::plane(CELL, [long, 2.0 * CELL])
    };
    let decay = 4.0 / 3.0 * eta * k * k / (2.0 * PF[0]);
    let name = format!("acoustic-eta{eta}");
    Scene::new(name, "linear acoustics", case, move |run| {
        let peaks = energy_peaks(run)?;
        let (first, last) = (peaks[0], peaks[peaks.len() - 1]);
        let waves = (peaks.len() - 1) as f64 / 2.0;
        let found = waves / (last[0] - first[0]);
        let damped = 0.5 * (first[1] / last[1]).ln() / waves;
        let exact = (omega * omega - decay * decay).sqrt() / (2.0 * PI);
        Ok(vec![
            Measured::relative("frequency", found, exact),
            Measured::relative("1 + damping per period", 1.0 + damped, 1.0 + decay / exact),
        ])
    })
}

/// Time and height of the maxima, three or more, of the kinetic energy after the start, by parabolas.
fn energy_peaks(run: &Run) -> Result<Vec<[f64; 2]>> {
    let [time, energy] = run.columns(["time_s", "kinetic_energy_J"])?;
    // Higher modes ride on the wave where the start was not smooth: a maximum counts where it
    // is one over a quarter of a wave.
    let reach = 20;
    let mut peaks = Vec::new();
    for i in reach..energy.len().saturating_sub(reach) {
        let around = &energy[i - reach..=i + reach];
        if around.iter().any(|e| *e > energy[i]) {
            continue;
        }
        let (a, b, c) = (energy[i - 1], energy[i], energy[i + 1]);
        let bend = a - 2.0 * b + c;
        let shift = if bend < 0.0 {
            0.5 * (a - c) / bend
        } else {
            0.0
        };
        let step = 0.5 * (time[i + 1] - time[i - 1]);
        peaks.push([time[i] + shift * step, b - 0.25 * (a - c) * shift]);
    }
    if peaks.len() < 3 {
        return Err(format!("only {} maxima of the kinetic energy", peaks.len()).into());
    }
    Ok(peaks)
}
