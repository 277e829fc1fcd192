//! Which scenes by which methods: docs/methods.md section 5.2.

use super::extremes;
use super::scenes::{Press, Scene, press, sealed_lumen};
use super::trial::Trial;
use crate::case_text::{PF, STICK, Viscosity};
use crate::method::Method;

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
pub(super) fn usual() -> Vec<Method> {
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

pub(super) struct Plan(Vec<Trial>);

impl Plan {
    pub(super) fn add(
        &mut self,
        varied: &'static str,
        value: impl Into<String>,
        scene: &Scene,
        methods: &[Method],
    ) {
        self.add_at(CFL, varied, value, scene, methods);
    }

    pub(super) fn add_at(
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
    extremes::scenes(&mut plan);
    extremes::numerics(&mut plan);
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
