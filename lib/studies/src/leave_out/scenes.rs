//! Scenes of both schemes, each with the stages that it does without: scenes.txt.

use super::stages::Scene;
use crate::case_text::{Body, CaseText, Viscosity};
use crate::lines::{self, Values};
use crate::method::Scheme;
use crate::stability::scenes::PVA_PF;
use crate::verification;

/// Those of a scheme.
pub(super) fn of(scheme: Scheme) -> Vec<Scene> {
    lines::read(include_str!("scenes.txt"), |line| {
        let parts: Vec<&str> = line.split(" | ").collect();
        let [own, name, words, method, without] = parts[..] else {
            return None;
        };
        if own != scheme.name() {
            return Some(Vec::new());
        }
        let values = &Values::all(words)[0];
        let mut case = match values.name {
            "drop" => drop(values.number("stop")?),
            _ => verification::scenes(words)?.pop()?.case,
        };
        match name {
            "gravity" => case.gravity = [0.0, -9.81, 0.0],
            "viscosity table" => case.viscosity = Viscosity::Table(PVA_PF.to_vec()),
            "pressure limit" => held(&mut case),
            _ => {}
        }
        Some(vec![Scene {
            name,
            without: without.split(", ").collect(),
            method: verification::methods(method).pop()?,
            case,
        }])
    })
}

/// Has the piston of a slit driven by a clamp at a pressure limit.
fn held(case: &mut CaseText) {
    let stop = case.stop.take().unwrap_or_default() * 1e6;
    case.clamp = Some(format!(
        "closing_speed = \"0.5 m/s\"\nmax_pressure = \"0.3 MPa\"\ntravel = \"5 um\"\ntime_limit = \"{stop} us\"\n"
    ));
    for body in &mut case.bodies {
        if body.name == Some("top") {
            *body = body.clone().clamped();
        }
    }
}

/// A drop without walls, for a time (s).
fn drop(stop: f64) -> CaseText {
    let cell = 2.9e-6;
    let size = 20.0 * cell;
    let [low, high] = [6.0, 14.0].map(|x| x * cell);
    let liquid = Body::liquid([low, low, 0.0], [high, high, cell]);
    CaseText {
        boundary: ["open", "open", "symmetry"],
        bodies: vec![liquid.moving([0.4, 0.3, 0.0])],
        title: "A drop in free flight.".into(),
        stop: Some(stop),
        ..CaseText::plane(cell, [size, size])
    }
}
