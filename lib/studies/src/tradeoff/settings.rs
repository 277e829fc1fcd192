//! The settings of the trade-off study: a base for each update, and what is varied about it.

use std::path::Path;

use crate::method::Method;

/// A method at a cell size.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The method.
    pub method: Method,
    /// Cells across the lumen.
    pub cells: u32,
    /// What differs from the base.
    pub varied: &'static str,
    /// Whether it also runs in the bond line, which takes longer.
    pub bond: bool,
}

/// All settings; `double` is the `mpm-run` built in double precision.
pub fn all(double: &Path) -> Vec<Setting> {
    let mut list = updates();
    list.extend(cells());
    list.extend(numerics());
    list.extend(options());
    list.extend(precision(double));
    list
}

fn setting(method: Method, cells: u32, varied: &'static str, bond: bool) -> Setting {
    Setting {
        method,
        cells,
        varied,
        bond,
    }
}

fn updates() -> Vec<Setting> {
    let mut methods = Method::updates();
    methods.push(Method::xpic(3));
    methods.push(Method::implicit());
    methods
        .into_iter()
        .map(|method| setting(method, 6, "update", true))
        .collect()
}

/// The three updates whose other settings are varied.
fn bases() -> [Method; 3] {
    [Method::flip(), Method::xpic(5), Method::apic()]
}

fn cells() -> Vec<Setting> {
    let mut list = Vec::new();
    for n in [3, 12] {
        let named = |method: Method| {
            let label = format!("{}, {n} cells", method.label);
            setting(method.called(label), n, "cell", false)
        };
        list.extend(bases().map(named));
        let implicit = named(Method::implicit());
        list.push(Setting {
            // In the bond line twelve cells are one voxel each.
            bond: n == 12,
            ..implicit
        });
    }
    let label = "implicit, 24 cells";
    list.push(setting(Method::implicit().called(label), 24, "cell", false));
    list
}

fn with(method: &Method, name: &str, keys: &[&str]) -> Method {
    let label = format!("{}, {name}", method.label);
    let keyed = keys.iter().fold(method.clone(), |m, key| m.setting(*key));
    keyed.called(label)
}

fn numerics() -> Vec<Setting> {
    let mut list = Vec::new();
    let mut add = |method: &Method, varied, name: &str, key: &str, bond| {
        list.push(setting(with(method, name, &[key]), 6, varied, bond));
    };
    for method in &bases() {
        for shape in ["bspline2", "linear"] {
            add(
                method,
                "shape",
                shape,
                &format!("grid.shape={shape}"),
                false,
            );
        }
    }
    let implicit = Method::implicit();
    for method in [&bases()[1], &bases()[2], &implicit] {
        add(
            method,
            "points",
            "3 points per direction",
            "grid.points_per_direction=3",
            false,
        );
    }
    for method in &bases()[..2] {
        for cfl in ["0.25", "0.7"] {
            add(
                method,
                "CFL",
                &format!("CFL {cfl}"),
                &format!("integrator.cfl={cfl}"),
                cfl == "0.7",
            );
        }
    }
    for cfl in ["0.125", "0.25", "1.0"] {
        add(
            &implicit,
            "CFL",
            &format!("CFL {cfl}"),
            &format!("integrator.cfl={cfl}"),
            true,
        );
    }
    for method in [&bases()[1], &implicit] {
        for modulus in ["1e8", "1e7"] {
            let key = format!("adhesive.bulk_modulus=\"{modulus} Pa\"");
            add(
                method,
                "bulk modulus",
                &format!("K {modulus} Pa"),
                &key,
                false,
            );
        }
    }
    for tolerance in ["1e-2", "1e-3", "1e-6"] {
        let key = format!("integrator.tolerance={tolerance}");
        add(
            &implicit,
            "tolerance",
            &format!("tolerance {tolerance}"),
            &key,
            true,
        );
    }
    list
}

fn options() -> Vec<Setting> {
    let mean = "integrator.pressure=cell-mean";
    let projection = "integrator.density_projection=\"0.04 cell\"";
    let separation = "contact.separation=\"0.6 cell\"";
    let mut list = Vec::new();
    for method in &bases() {
        for (name, keys, bond) in [
            ("cell-mean J", &[mean][..], false),
            ("density projection", &[projection][..], false),
            ("cell-mean J and projection", &[mean, projection][..], true),
            ("separation 0.6 cell", &[separation][..], false),
        ] {
            list.push(setting(with(method, name, keys), 6, "option", bond));
        }
    }
    list
}

fn precision(double: &Path) -> Vec<Setting> {
    bases()
        .map(|method| setting(with(&method, "f64", &[]).by(double), 6, "precision", true))
        .into()
}
