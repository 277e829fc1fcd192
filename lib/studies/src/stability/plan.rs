//! Which scenes by which methods: docs/methods.md section 5.2.

use super::extremes;
use super::scenes::{Press, Scene, press, sealed_lumen};
use super::trial::Trial;
use crate::case_text::{PF, STICK, Viscosity, partial_slip};
use crate::method::Method;

/// Courant number where it is not what is varied.
const CFL: f64 = 0.5;

/// The paper's PVA-PF (Table 1).
pub(crate) const PVA_PF: [[f64; 2]; 4] = [
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
        scene: Scene,
        methods: &[Method],
    ) {
        self.add_at(CFL, varied, value, scene, methods);
    }

    /// By the usual methods.
    pub(super) fn usual(&mut self, varied: &'static str, value: impl Into<String>, scene: Scene) {
        self.add(varied, value, scene, &usual());
    }

    pub(super) fn add_at(
        &mut self,
        cfl: f64,
        varied: &'static str,
        value: impl Into<String>,
        scene: Scene,
        methods: &[Method],
    ) {
        let value = value.into();
        self.0.extend(methods.iter().map(|method| Trial {
            varied,
            value: value.clone(),
            scene: scene.clone(),
            method: method.clone(),
            cfl,
        }));
    }
}

/// All trials.
pub(super) fn trials() -> Vec<Trial> {
    let mut plan = Plan(Vec::new());
    liquids(&mut plan);
    walls_and_speeds(&mut plan);
    geometry(&mut plan);
    extremes::scenes(&mut plan);
    extremes::numerics(&mut plan);
    plan.0
}

fn liquids(plan: &mut Plan) {
    let of = |eta, modulus| press(Press::default()).of(Viscosity::Newtonian(eta), modulus);
    for eta in [1e-3, 1e-2, 0.1, 1.3, 10.0, 100.0, 1e3] {
        plan.usual("viscosity", format!("{eta} Pa s"), of(eta, PF[1]));
    }
    for modulus in [1e7, 1e8, 1e9, 1e10] {
        let (value, scene) = (format!("{modulus:e} Pa"), of(PF[2], modulus));
        plan.add("bulk modulus", value, scene, &and_cell_mean());
    }
    for (eta, modulus) in [(1e-3, 1e7), (1e-3, 1e10), (1e3, 1e7), (1e3, 1e10)] {
        let value = format!("{eta} Pa s {modulus:e} Pa");
        plan.usual("viscosity and modulus", value, of(eta, modulus));
    }
    let table = of(PF[2], PF[1]).of(Viscosity::Table(PVA_PF.to_vec()), PF[1]);
    plan.usual("viscosity table", "PVA-PF", table);
    contrasts(plan);
}

/// Laws of which the slow and the fast liquid of one scene differ by up to nine decades of viscosity.
fn contrasts(plan: &mut Plan) {
    let laws = [
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
    ];
    let laws = laws.map(|(name, key)| (name, Viscosity::Law(key.into())));
    let table = Viscosity::Table(vec![[1e-2, 1e6], [1e6, 1e-3]]);
    let table = ("table, 1e6 to 1e-3 Pa s, stress falls", table);
    for (name, viscosity) in laws.into_iter().chain([table]) {
        let scene = press(Press::default()).of(viscosity, PF[1]);
        plan.add("contrast", name, scene, &[Method::implicit()]);
    }
}

fn walls_and_speeds(plan: &mut Plan) {
    for (name, contact) in [
        ("k = 0", "law = \"frictionless\"\n".to_owned()),
        ("k = 0.01/cell", partial_slip("100 cell")),
        ("k = 1/cell", partial_slip("1 cell")),
        ("k = 100/cell", partial_slip("0.01 cell")),
        ("k = 1e6/cell", partial_slip("0.000001 cell")),
        ("k infinite", STICK.to_owned()),
    ] {
        plan.usual("wall law", name, press(Press::default()).walls(&contact));
    }
    for speed in [1e-3, 1e-2, 0.1, 1.0, 10.0] {
        for (name, limit) in [("", Some(2.5e6)), (", no pressure limit", None)] {
            let scene = press(Press {
                speed,
                limit,
                ..Press::default()
            });
            plan.usual("closing speed", format!("{speed} m/s{name}"), scene);
        }
    }
}

fn geometry(plan: &mut Plan) {
    let usual = Press::default();
    for lumen in [0.5, 1.0, 2.0, 3.0, 6.0] {
        let (value, scene) = (format!("{lumen} cells"), press(Press { lumen, ..usual }));
        plan.add("lumen width", value, scene, &and_cell_mean());
    }
    for slab in [2.0, 1.0, 0.5, 0.25] {
        let scene = press(Press {
            slab,
            travel: 0.75 * slab,
            ..usual
        });
        let value = format!("{slab} cells");
        plan.add("slab thickness", value, scene, &and_cell_mean());
    }
    plan.usual("sealed lumen", "wall of one voxel", sealed_lumen());
    let deep = press(Press {
        depth: 4,
        travel: 0.5,
        ..usual
    });
    plan.usual("dimensions", "3", deep);
}
