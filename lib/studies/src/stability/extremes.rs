//! Scenes and settings at the edge of what a scheme can do.

use super::plan::{Plan, usual};
use super::scenes::{Press, chamber, free_drop, press, splash, torn};
use crate::case_text::{PF, Viscosity};
use crate::method::{Method, Scheme};

/// Every update of the explicit scheme.
fn updates() -> Vec<Method> {
    vec![
        Method::flip(),
        Method::pic(),
        Method::apic(),
        Method::xpic(2),
        Method::xpic(3),
        Method::xpic(5),
        Method::fmpm(2),
        Method::fmpm(3),
        Method::fmpm(5),
    ]
}

/// Liquid crushed, torn and dropped, and with next to no or any viscosity.
pub(super) fn scenes(plan: &mut Plan) {
    for j in [0.9, 0.55, 0.45] {
        for modulus in [1e7, 1e9] {
            let scene = chamber(j, 1.0).of(Viscosity::Newtonian(PF[2]), modulus);
            plan.add(
                "chamber to J",
                format!("{j}, {modulus:e} Pa"),
                &scene,
                &usual(),
            );
        }
    }
    let carrying: Vec<Method> = usual();
    let cavitating: Vec<Method> = (usual().into_iter())
        .map(|m| m.setting("adhesive.cavitation_pressure=\"0.1 MPa\""))
        .collect();
    for speed in [1.0, 30.0, 150.0] {
        plan.add(
            "torn apart",
            format!("{speed} m/s"),
            &torn(speed),
            &carrying,
        );
        plan.add(
            "torn apart",
            format!("{speed} m/s, cavitation 0.1 MPa"),
            &torn(speed),
            &cavitating,
        );
    }
    for size in [3.0, 1.0, 0.5, 0.1] {
        plan.add(
            "free drop",
            format!("{size} cells"),
            &free_drop(size),
            &usual(),
        );
        plan.add(
            "drop on floor",
            format!("{size} cells, 1 m/s"),
            &splash(size, 1.0),
            &usual(),
        );
    }
    plan.add(
        "drop on floor",
        "3 cells, 30 m/s",
        &splash(3.0, 30.0),
        &usual(),
    );
    // A point alone has no neighbours to share its velocity gradient with.
    let thin_drop = free_drop(0.5).of(Viscosity::Newtonian(1e-3), PF[1]);
    for (name, scene) in [("PF", free_drop(0.5)), ("1e-3 Pa s", thin_drop)] {
        for cfl in [0.25, 0.4, 0.5] {
            plan.add_at(
                cfl,
                "drop of one point",
                format!("{cfl}, {name}"),
                &scene,
                &updates(),
            );
        }
    }
    // Without viscosity to speak of nothing damps the noise.
    let thin = press(Press::default()).of(Viscosity::Newtonian(1e-6), PF[1]);
    plan.add("viscosity", "1e-6 Pa s", &thin, &usual());
    // A cell that sound crosses in a femtosecond.
    let rigid = press(Press::default()).of(Viscosity::Newtonian(1e9), 1e15);
    plan.add(
        "viscosity and modulus",
        "1e9 Pa s 1e15 Pa",
        &rigid,
        &usual(),
    );
}

/// Courant number, update, shape and options on the usual press and on a thin liquid, where the
/// acoustic limit binds.
pub(super) fn numerics(plan: &mut Plan) {
    let base = press(Press::default());
    let thin = base.clone().of(Viscosity::Newtonian(0.01), PF[1]);
    for (name, scene) in [("PF", &base), ("0.01 Pa s", &thin)] {
        for cfl in [0.1, 0.3, 0.5, 0.7, 0.9, 1.0, 1.2] {
            plan.add_at(
                cfl,
                "Courant number",
                format!("{cfl}, {name}"),
                scene,
                &updates(),
            );
        }
        for cfl in [0.1, 0.25, 0.5, 1.0, 1.25, 1.5, 1.6] {
            plan.add_at(
                cfl,
                "Courant number",
                format!("{cfl}, {name}"),
                scene,
                &[Method::implicit()],
            );
        }
        for shape in ["bspline2", "linear"] {
            let shaped: Vec<Method> = (updates().into_iter())
                .map(|m| m.setting(format!("grid.shape={shape}")))
                .collect();
            plan.add("shape", format!("{shape}, {name}"), scene, &shaped);
        }
        for (label, keys) in crate::options::OPTIONS {
            let with: Vec<Method> = usual()
                .into_iter()
                .filter(|m| m.scheme == Scheme::Explicit)
                .map(|m| keys.iter().fold(m, |m, key| m.setting(*key)))
                .collect();
            plan.add("option", format!("{label}, {name}"), scene, &with);
        }
    }
}
