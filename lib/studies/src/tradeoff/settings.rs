//! The settings of the trade-off study: a base for each update, and what is varied about it.

use std::path::Path;

use crate::method::Method;

/// A method at a cell size.
#[derive(Clone, Debug)]
pub(super) struct Setting {
    pub(super) method: Method,
    /// Cells across the lumen.
    pub(super) cells: u32,
    /// What differs from the base.
    pub(super) varied: &'static str,
    /// Whether it also runs in the bond line, which takes longer.
    pub(super) bond: bool,
}

/// All settings; `double` is the `mpm-run` built in double precision.
pub(super) fn all(double: &Path) -> Vec<Setting> {
    let mut list = cells();
    let mut add = |method, varied, bond| list.push(setting(method, 6, varied, bond));
    numerics(&mut add);
    options(&mut add);
    for method in bases() {
        add(method.with("f64", &[]).by(double), "precision", true);
    }
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

/// The three updates whose other settings are varied.
fn bases() -> [Method; 3] {
    [Method::flip(), Method::xpic(5), Method::apic()]
}

/// Every update in the usual cells, and the bases in others.
fn cells() -> Vec<Setting> {
    let others = [Method::xpic(3), Method::implicit()];
    let mut list: Vec<Setting> = (Method::updates().into_iter().chain(others))
        .map(|method| setting(method, 6, "update", true))
        .collect();
    let named = |n: u32, method: Method, bond| {
        setting(method.with(&format!("{n} cells"), &[]), n, "cell", bond)
    };
    for n in [3, 12] {
        list.extend(bases().map(|method| named(n, method, false)));
        // In the bond line twelve cells are one voxel each.
        list.push(named(n, Method::implicit(), n == 12));
    }
    list.push(named(24, Method::implicit(), false));
    list
}

fn numerics(add: &mut impl FnMut(Method, &'static str, bool)) {
    let [flip, xpic, apic] = bases();
    let implicit = Method::implicit();
    for method in [&flip, &xpic, &apic] {
        for shape in ["bspline2", "linear"] {
            let key = format!("grid.shape={shape}");
            add(method.with(shape, &[&key]), "shape", false);
        }
    }
    for method in [&xpic, &apic, &implicit] {
        let key = "grid.points_per_direction=3";
        add(
            method.with("3 points per direction", &[key]),
            "points",
            false,
        );
    }
    let cfl = |method: &Method, cfl: &str| {
        method.with(&format!("CFL {cfl}"), &[&format!("integrator.cfl={cfl}")])
    };
    for method in [&flip, &xpic] {
        add(cfl(method, "0.25"), "CFL", false);
        add(cfl(method, "0.7"), "CFL", true);
    }
    for number in ["0.125", "0.25", "1.0"] {
        add(cfl(&implicit, number), "CFL", true);
    }
    for method in [&xpic, &implicit] {
        for modulus in ["1e8", "1e7"] {
            let key = format!("adhesive.bulk_modulus=\"{modulus} Pa\"");
            let named = method.with(&format!("K {modulus} Pa"), &[&key]);
            add(named, "bulk modulus", false);
        }
    }
    for tolerance in ["1e-2", "1e-3", "1e-6"] {
        let key = format!("integrator.tolerance={tolerance}");
        let named = implicit.with(&format!("tolerance {tolerance}"), &[&key]);
        add(named, "tolerance", true);
    }
}

fn options(add: &mut impl FnMut(Method, &'static str, bool)) {
    let mean = "integrator.pressure=cell-mean";
    let projection = "integrator.density_projection=\"0.04 cell\"";
    let separation = "contact.separation=\"0.6 cell\"";
    for method in &bases() {
        for (name, keys, bond) in [
            ("cell-mean J", &[mean][..], false),
            ("density projection", &[projection], false),
            ("cell-mean J and projection", &[mean, projection], true),
            ("separation 0.6 cell", &[separation], false),
        ] {
            add(method.with(name, keys), "option", bond);
        }
    }
}
