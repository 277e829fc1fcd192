//! Scenes and settings at the edge of what a scheme can do.

use super::plan::{Plan, usual};
use super::scenes::{Press, chamber, free_drop, press, splash, torn};
use crate::case_text::{PF, Viscosity};
use crate::method::{Method, Scheme};

/// Every update of the explicit scheme.
fn updates() -> Vec<Method> {
    let mut list = Method::updates();
    list.insert(4, Method::xpic(3));
    list.insert(7, Method::fmpm(3));
    list
}

/// Liquid crushed, torn and dropped, and with next to no or any viscosity.
pub(super) fn scenes(plan: &mut Plan) {
    let newtonian = Viscosity::Newtonian;
    for j in [0.9, 0.55, 0.45] {
        for modulus in [1e7, 1e9] {
            let scene = chamber(j, 1.0).of(newtonian(PF[2]), modulus);
            plan.usual("chamber to J", format!("{j}, {modulus:e} Pa"), scene);
        }
    }
    let cavitating: Vec<Method> = (usual().into_iter())
        .map(|m| m.setting("adhesive.cavitation_pressure=\"0.1 MPa\""))
        .collect();
    for speed in [1.0, 30.0, 150.0] {
        let (what, scene) = ("torn apart", torn(speed));
        plan.usual(what, format!("{speed} m/s"), scene.clone());
        let value = format!("{speed} m/s, cavitation 0.1 MPa");
        plan.add(what, value, scene, &cavitating);
    }
    for size in [3.0, 1.0, 0.5, 0.1] {
        plan.usual("free drop", format!("{size} cells"), free_drop(size));
        let value = format!("{size} cells, 1 m/s");
        plan.usual("drop on floor", value, splash(size, 1.0));
    }
    plan.usual("drop on floor", "3 cells, 30 m/s", splash(3.0, 30.0));
    // A point alone has no neighbours to share its velocity gradient with.
    let thin_drop = free_drop(0.5).of(newtonian(1e-3), PF[1]);
    for (name, scene) in [("PF", free_drop(0.5)), ("1e-3 Pa s", thin_drop)] {
        for cfl in [0.25, 0.4, 0.5] {
            let value = format!("{cfl}, {name}");
            plan.add_at(cfl, "drop of one point", value, scene.clone(), &updates());
        }
    }
    // Without viscosity to speak of nothing damps the noise.
    let thin = press(Press::default()).of(newtonian(1e-6), PF[1]);
    plan.usual("viscosity", "1e-6 Pa s", thin);
    // A cell that sound crosses in a femtosecond.
    let rigid = press(Press::default()).of(newtonian(1e9), 1e15);
    plan.usual("viscosity and modulus", "1e9 Pa s 1e15 Pa", rigid);
}

/// Courant number, update, shape and options on the usual press and on a thin liquid, where the
/// acoustic limit binds.
pub(super) fn numerics(plan: &mut Plan) {
    let base = press(Press::default());
    let thin = base.clone().of(Viscosity::Newtonian(0.01), PF[1]);
    for (name, scene) in [("PF", &base), ("0.01 Pa s", &thin)] {
        for (methods, numbers) in [
            (updates(), [0.1, 0.3, 0.5, 0.7, 0.9, 1.0, 1.2]),
            (
                vec![Method::implicit()],
                [0.1, 0.25, 0.5, 1.0, 1.25, 1.5, 1.6],
            ),
        ] {
            for cfl in numbers {
                let value = format!("{cfl}, {name}");
                plan.add_at(cfl, "Courant number", value, scene.clone(), &methods);
            }
        }
        for shape in ["bspline2", "linear"] {
            let shaped: Vec<Method> = (updates().into_iter())
                .map(|m| m.setting(format!("grid.shape={shape}")))
                .collect();
            plan.add("shape", format!("{shape}, {name}"), scene.clone(), &shaped);
        }
        for (label, keys) in crate::options::OPTIONS {
            let explicit = usual().into_iter().filter(|m| m.scheme == Scheme::Explicit);
            let with: Vec<Method> = explicit
                .map(|m| keys.iter().fold(m, |m, key| m.setting(*key)))
                .collect();
            plan.add("option", format!("{label}, {name}"), scene.clone(), &with);
        }
    }
}
