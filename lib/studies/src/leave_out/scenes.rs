//! Scenes of both schemes, each with the stages that it does without.

use super::stages::{CELL_MEAN, CONTACT, FILTER, LOAD, PROJECTION, Scene, TABLE};
use crate::case_text::{Body, CaseText, Viscosity};
use crate::method::Method;
use crate::stability::scenes::PVA_PF;
use crate::verification::slit;

/// Simulated time of a run of the explicit and of the implicit scheme, s: some steps of each scene.
const END: [f64; 2] = [0.1e-6, 2e-6];

fn scene(
    name: &'static str,
    without: &'static [&'static str],
    method: Method,
    case: CaseText,
) -> Scene {
    Scene {
        name,
        without,
        method,
        case,
    }
}

/// A drop without walls and a piston that pushes liquid into a slit, by FLIP and with one option of the explicit scheme each.
pub(super) fn explicit() -> Vec<Scene> {
    let flip = || Method::named("FLIP");
    let [mean, projection] = [
        "integrator.pressure=\"cell-mean\"",
        "integrator.density_projection=\"0.01 cell\"",
    ];
    let [free, pressed] = [drop(), slit::scene(6, [0.0; 2]).case].map(|case| CaseText {
        stop: Some(END[0]),
        ..case
    });
    let drop = |name, without, method| scene(name, without, method, free.clone());
    vec![
        drop(
            "free drop",
            &[CONTACT, FILTER, CELL_MEAN, PROJECTION],
            flip(),
        ),
        scene("piston", &[FILTER, CELL_MEAN, PROJECTION], flip(), pressed),
        drop(
            "XPIC(2)",
            &[CONTACT, CELL_MEAN, PROJECTION],
            Method::named("XPIC(2)"),
        ),
        drop(
            "cell-mean pressure",
            &[CONTACT, FILTER, PROJECTION],
            flip().setting(mean),
        ),
        drop(
            "density projection",
            &[CONTACT, FILTER, CELL_MEAN],
            flip().setting(projection),
        ),
    ]
}

/// The same piston by the implicit scheme, alone and with one thing more, and the drop.
pub(super) fn implicit() -> Vec<Scene> {
    let scene = |name, without, case| scene(name, without, Method::implicit(), case);
    let [drop, piston] = [drop(), slit::scene(6, [0.0; 2]).case].map(|case| CaseText {
        stop: Some(END[1]),
        ..case
    });
    let mut held = CaseText {
        stop: None,
        clamp: Some(format!(
            "closing_speed = \"0.5 m/s\"\nmax_pressure = \"0.3 MPa\"\ntravel = \"5 um\"\ntime_limit = \"{} us\"\n",
            END[1] * 1e6
        )),
        ..piston.clone()
    };
    for body in &mut held.bodies {
        if body.name == Some("top") {
            *body = body.clone().clamped();
        }
    }
    let gravity = CaseText {
        gravity: [0.0, -9.81, 0.0],
        ..piston.clone()
    };
    let table = CaseText {
        viscosity: Viscosity::Table(PVA_PF.to_vec()),
        ..piston.clone()
    };
    vec![
        scene("piston", &[TABLE, LOAD], piston),
        scene("gravity", &[TABLE, LOAD], gravity),
        scene("viscosity table", &[LOAD], table),
        scene("pressure limit", &[TABLE], held),
        scene("free drop", &[TABLE, LOAD], drop),
    ]
}

fn drop() -> CaseText {
    let cell = slit::scene(6, [0.0; 2]).case.cell;
    let size = 20.0 * cell;
    let [low, high] = [6.0, 14.0].map(|x| x * cell);
    let liquid = Body::liquid([low, low, 0.0], [high, high, cell]);
    CaseText {
        boundary: ["open", "open", "symmetry"],
        bodies: vec![liquid.moving([0.4, 0.3, 0.0])],
        title: "A drop in free flight.".into(),
        ..CaseText::plane(cell, [size, size])
    }
}
