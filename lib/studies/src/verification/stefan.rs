//! A film between plates pressed by a given load: Stefan's closing film, from microseconds to minutes.

use super::squeeze::plates;
use super::{Measured, Scene};
use crate::case_text::{Body, CaseText, Viscosity};
use crate::numbers::worst;

/// Small and thin enough for the liquid's inertia to be over long before a microsecond is, at pressures
/// that do not compress it.
const CELL: f64 = 0.1e-6;
const VISCOSITY: f64 = 0.02;
const BULK_MODULUS: f64 = 1e10;
/// Half-length of the film over the gap at the start.
const ASPECT: f64 = 8.0;
/// Above the speed that the largest load gives, m/s.
const SPEED: f64 = 20.0;
/// Gap at the end over that at the start.
const END: f64 = 0.5;

/// What presses.
#[derive(Clone, Copy, Debug)]
pub enum Load {
    /// A constant pressure.
    Hold,
    /// A ramp for a third of the time, a hold, a ramp down, and a release for as long again.
    Programme,
}

impl Load {
    /// The stages for a largest pressure (Pa) over a time (s).
    fn stages(self, pressure: f64, time: f64) -> String {
        let stage = |kind: &str, to: f64, time: f64| {
            format!(
                "[[clamp.stage]]\nkind = \"{kind}\"\nspeed = \"{SPEED} m/s\"\npressure = \"{to} Pa\"\ntime = \"{time} s\"\n"
            )
        };
        let third = time / 3.0;
        match self {
            Self::Hold => stage("hold", pressure, time),
            Self::Programme => [
                stage("ramp", pressure, third),
                stage("hold", pressure, third),
                stage("ramp", 0.1 * pressure, third),
                format!("[[clamp.stage]]\nkind = \"release\"\ntime = \"{time} s\"\n"),
            ]
            .concat(),
        }
    }

    /// The integral of the pressure over its largest value and the time at a moment, both in parts of
    /// the time.
    fn impulse(self, at: f64) -> f64 {
        let at = at.min(1.0);
        match self {
            Self::Hold => at,
            Self::Programme => {
                let up = at.min(1.0 / 3.0);
                let level = (at - 1.0 / 3.0).clamp(0.0, 1.0 / 3.0);
                let down = (at - 2.0 / 3.0).max(0.0);
                1.5 * up * up + level + down * (1.0 - 0.5 * 0.9 * 3.0 * down)
            }
        }
    }
}

/// A gap of `n` cells that `load` closes to half within `time` (s).
pub fn scene(n: u32, load: Load, time: f64) -> Scene {
    let gap = f64::from(n) * CELL;
    let half_length = ASPECT * gap;
    let low = 2.0 * CELL;
    let (right, top) = (half_length / END + 8.0 * CELL, low + gap + 3.0 * CELL);
    let scale = 4.0 * VISCOSITY * (half_length * gap).powi(3) / 5.0;
    let force = (END.powi(-5) - 1.0) * gap.powi(-5) * scale / (load.impulse(1.0) * time);
    let (travel, stages) = (0.9 * gap * 1e6, load.stages(force / right, time));
    let case = CaseText {
        title: format!(
            "A film of {n} cells that a load closes to half within {time:e} s ({load:?}).\nAgainst h^-5 = h0^-5 + 5/(4 eta a0^3 h0^3) times the integral of the force."
        ),
        viscosity: Viscosity::Newtonian(VISCOSITY),
        bulk_modulus: BULK_MODULUS,
        clamp: Some(format!("travel = \"{travel} um\"\n{stages}")),
        bodies: plates([right, CELL], [low, low + gap, top + gap], Body::clamped)
            .chain([Body::liquid(
                [0.0, low, 0.0],
                [half_length, low + gap, CELL],
            )])
            .collect(),
        // A row for every step.
        history_every: 1e-15,
        ..CaseText::plane(CELL, [right, top])
    };
    let kind = match load {
        Load::Hold => "hold",
        Load::Programme => "programme",
    };
    let name = format!("stefan-n{n}-{kind}-{time:e}s");
    Scene::new(name, "lubrication theory", case, move |run| {
        let [times, travel] = run.columns(["time_s", "displacement_m"])?;
        let [end, way] = run.ends(["time_s", "displacement_m"])?;
        let exact = |t: f64| {
            let impulse = force * time * load.impulse(t / time);
            // Half of the film keeps its volume, so that h^-5 grows with the impulse per length (Stefan 1874).
            let grown = 1.25 * impulse / (VISCOSITY * (half_length * gap).powi(3));
            (gap.powi(-5) + grown).powf(-0.2)
        };
        let rows = times.iter().zip(&travel);
        let off = worst(rows.map(|(&t, &way)| (gap - way) / exact(t) - 1.0));
        Ok(vec![
            Measured::absolute("gap over time, relative", off.unwrap_or(f64::NAN)),
            Measured::relative("gap at the end", gap - way, exact(end)),
        ])
    })
}
