//! Scenes of both schemes, each with the stages that it does without.

use super::stages::{CELL_MEAN, CONTACT, FILTER, LOAD, PROJECTION, Scene, TABLE};
use crate::case_text::{Body, CaseText, Viscosity};
use crate::method::Method;
use crate::stability::plan::PVA_PF;
use crate::verification::slit;

/// Simulated time of a run of the explicit and of the implicit scheme, s: some steps of each scene.
const END: [f64; 2] = [0.1e-6, 2e-6];

/// A drop without walls and a piston that pushes liquid into a slit, by FLIP and with one option of the explicit scheme each.
pub(super) fn explicit() -> Vec<Scene> {
    let scene = |name, without, method: Method, case: CaseText| {
        let case = CaseText {
            stop: Some(END[0]),
            ..case
        };
        Scene {
            name,
            without,
            method,
            case,
        }
    };
    let with = |key: &str| Method::flip().setting(format!("integrator.{key}"));
    let piston = || slit::scene(6, [0.0; 2]).case;
    vec![
        scene(
            "free drop",
            &[CONTACT, FILTER, CELL_MEAN, PROJECTION],
            Method::flip(),
            drop(),
        ),
        scene(
            "piston",
            &[FILTER, CELL_MEAN, PROJECTION],
            Method::flip(),
            piston(),
        ),
        scene(
            "XPIC(2)",
            &[CONTACT, CELL_MEAN, PROJECTION],
            Method::xpic(2),
            drop(),
        ),
        scene(
            "cell-mean pressure",
            &[CONTACT, FILTER, PROJECTION],
            with("pressure=\"cell-mean\""),
            drop(),
        ),
        scene(
            "density projection",
            &[CONTACT, FILTER, CELL_MEAN],
            with("density_projection=\"0.01 cell\""),
            drop(),
        ),
    ]
}

/// The same piston by the implicit scheme, alone and with one thing more, and the drop.
pub(super) fn implicit() -> Vec<Scene> {
    let scene = |name, without, case: CaseText| Scene {
        name,
        without,
        method: Method::implicit(),
        case,
    };
    let piston = CaseText {
        stop: Some(END[1]),
        ..slit::scene(6, [0.0; 2]).case
    };
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
    let drop = CaseText {
        stop: Some(END[1]),
        ..drop()
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
        ..CaseText::plane("A drop in free flight.", cell, [size, size])
    }
}
