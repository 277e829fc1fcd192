//! Which scenes by which methods: docs/methods.md section 5.2.

use super::scenes::{Press, Scene, chamber, free_drop, press, sealed_lumen, splash, torn};
use super::trial::Trial;
use crate::case_text::{PF, STICK, Viscosity};
use crate::method::{Method, Scheme};

/// Courant number where it is not what is varied.
const CFL: f64 = 0.5;

/// The paper's PVA-PF (Table 1).
pub const PVA_PF: [[f64; 2]; 4] = [
    [1.0, 210.0],
    [6.30957, 87.0],
    [39.8107, 1.7],
    [501.187, 1.0],
];

/// Methods that every value is tried with.
fn usual() -> Vec<Method> {
    vec![
        Method::flip(),
        Method::xpic(5),
        Method::apic(),
        Method::implicit(),
    ]
}

/// The usual methods, and APIC with the pressure of the cell's mean, which does not lock.
fn and_cell_mean() -> Vec<Method> {
    let mean = Method::apic().setting("integrator.pressure=cell-mean");
    let mut list = usual();
    list.push(mean.called("APIC, cell mean"));
    list
}

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

struct Plan(Vec<Trial>);

impl Plan {
    fn add(
        &mut self,
        varied: &'static str,
        value: impl Into<String>,
        scene: &Scene,
        methods: &[Method],
    ) {
        self.add_at(CFL, varied, value, scene, methods);
    }

    fn add_at(
        &mut self,
        cfl: f64,
        varied: &'static str,
        value: impl Into<String>,
        scene: &Scene,
        methods: &[Method],
    ) {
        let value = value.into();
        for method in methods {
            self.0.push(Trial {
                varied,
                value: value.clone(),
                scene: scene.clone(),
                method: method.clone(),
                cfl,
            });
        }
    }
}

/// All trials.
pub fn trials() -> Vec<Trial> {
    let mut plan = Plan(Vec::new());
    liquids(&mut plan);
    walls_and_speeds(&mut plan);
    geometry(&mut plan);
    extremes(&mut plan);
    numerics(&mut plan);
    plan.0
}

fn liquids(plan: &mut Plan) {
    let base = press(Press::default());
    for eta in [1e-3, 1e-2, 0.1, 1.3, 10.0, 100.0, 1e3] {
        let scene = base.clone().of(Viscosity::Newtonian(eta), PF[1]);
        plan.add("viscosity", format!("{eta} Pa s"), &scene, &usual());
    }
    for modulus in [1e7, 1e8, 1e9, 1e10] {
        let scene = base.clone().of(Viscosity::Newtonian(PF[2]), modulus);
        plan.add(
            "bulk modulus",
            format!("{modulus:e} Pa"),
            &scene,
            &and_cell_mean(),
        );
    }
    for (eta, modulus) in [(1e-3, 1e7), (1e-3, 1e10), (1e3, 1e7), (1e3, 1e10)] {
        let scene = base.clone().of(Viscosity::Newtonian(eta), modulus);
        plan.add(
            "viscosity and modulus",
            format!("{eta} Pa s {modulus:e} Pa"),
            &scene,
            &usual(),
        );
    }
    let table = base.of(Viscosity::Table(PVA_PF.to_vec()), PF[1]);
    plan.add("viscosity table", "PVA-PF", &table, &usual());
    contrasts(plan);
}

/// Laws of which the slow and the fast liquid of one scene differ by up to nine decades of viscosity.
fn contrasts(plan: &mut Plan) {
    for (name, key) in [
        (
            "Carreau-Yasuda, 1e6 to 1e-3 Pa s",
            "carreau_yasuda = { zero_rate = \"1e6 Pa s\", infinite_rate = \"1e-3 Pa s\", time = \"1e3 s\", index = 0.1 }",
        ),
        (
            "Cross, 1e6 to 1e-3 Pa s",
            "cross = { zero_rate = \"1e6 Pa s\", infinite_rate = \"1e-3 Pa s\", time = \"1e3 s\", exponent = 1.0 }",
        ),
        (
            "Herschel-Bulkley, 1e6 Pa s at rest, 1e-3 Pa s",
            "herschel_bulkley = { yield_stress = \"1e4 Pa\", consistency = \"1e-3 Pa s^n\", index = 1.0, regularisation_rate = \"0.01 1/s\" }",
        ),
        (
            "power law, n = 0.1, 1e6 to 1e-3 Pa s",
            "power_law = { consistency = \"1e4 Pa s^n\", index = 0.1, rates = [\"6e-3 1/s\", \"6e7 1/s\"] }",
        ),
    ] {
        let scene = press(Press::default()).of(Viscosity::Law(key.into()), PF[1]);
        plan.add("contrast", name, &scene, &[Method::implicit()]);
    }
    let rows = vec![[1e-2, 1e6], [1e6, 1e-3]];
    let falling = press(Press::default()).of(Viscosity::Table(rows), PF[1]);
    plan.add(
        "contrast",
        "table, 1e6 to 1e-3 Pa s, stress falls",
        &falling,
        &[Method::implicit()],
    );
}

fn walls_and_speeds(plan: &mut Plan) {
    let slip =
        |cells: f64| format!("law = \"partial-slip\"\ninfluence_length = \"{cells} cell\"\n");
    for (name, contact) in [
        ("k = 0", "law = \"frictionless\"\n".to_owned()),
        ("k = 0.01/cell", slip(100.0)),
        ("k = 1/cell", slip(1.0)),
        ("k = 100/cell", slip(0.01)),
        ("k = 1e6/cell", slip(1e-6)),
        ("k infinite", STICK.to_owned()),
    ] {
        let scene = press(Press::default()).walls(&contact);
        plan.add("wall law", name, &scene, &usual());
    }
    for speed in [1e-3, 1e-2, 0.1, 1.0, 10.0] {
        for (name, limit) in [("", Some(2.5e6)), (", no pressure limit", None)] {
            let scene = press(Press {
                speed,
                limit,
                ..Press::default()
            });
            plan.add(
                "closing speed",
                format!("{speed} m/s{name}"),
                &scene,
                &usual(),
            );
        }
    }
}

fn geometry(plan: &mut Plan) {
    for lumen in [0.5, 1.0, 2.0, 3.0, 6.0] {
        let scene = press(Press {
            lumen,
            ..Press::default()
        });
        plan.add(
            "lumen width",
            format!("{lumen} cells"),
            &scene,
            &and_cell_mean(),
        );
    }
    for slab in [2.0, 1.0, 0.5, 0.25] {
        let scene = press(Press {
            slab,
            travel: 0.75 * slab,
            ..Press::default()
        });
        plan.add(
            "slab thickness",
            format!("{slab} cells"),
            &scene,
            &and_cell_mean(),
        );
    }
    plan.add(
        "sealed lumen",
        "wall of one voxel",
        &sealed_lumen(),
        &usual(),
    );
    let deep = press(Press {
        depth: 4,
        travel: 0.5,
        ..Press::default()
    });
    plan.add("dimensions", "3", &deep, &usual());
}

fn extremes(plan: &mut Plan) {
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
fn numerics(plan: &mut Plan) {
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
