//! Stiff and extreme liquids and time steps; and results that do not depend on threads or stops.

use filling::{Implicit, Settings};
use physics::{Newtonian, Scene, Scheme, StepLimit, Table, Tait, Viscosity};

use crate::{SPEED, at, run, scene};

/// Force at L = 2 H over that of lubrication theory for PF at CFL 0.5, changed by `change`.
fn force(cfl: f64, change: impl Fn(&mut Scene)) -> f64 {
    let settings = Settings {
        cfl,
        ..Settings::default()
    };
    let filled = run(3, [0.25, 0.0], settings, change);
    assert_eq!(filled.in_walls, 0);
    at(&filled.force, 2.0)
}

#[test]
fn stiff_and_extreme_cases_stay_stable() {
    let usual = force(0.5, |_| ());
    for cfl in [0.1, 1.0, 1.5] {
        let f = force(cfl, |_| ());
        println!("CFL {cfl}: force {:+.3} of that at 0.5", f / usual - 1.0);
        assert!((f / usual - 1.0).abs() < 0.15, "CFL {cfl}: {f}");
    }
    // Forces scale with the viscosity as long as inertia (1e-3 Pa s) and compression (1e3 Pa s,
    // 1e7 Pa) do not count; where they do the run must still end, with no particle in a wall.
    for (eta, bulk, tolerance) in [
        (1e-3, 1e9, f64::INFINITY),
        (10.0, 1e10, 0.1),
        (1e3, 1e10, f64::INFINITY),
        (1.3, 1e7, f64::INFINITY),
        (1.3, 1e10, 0.1),
    ] {
        let f = force(0.5, |scene| {
            scene.liquid.viscosity = Viscosity::Newtonian(Newtonian(eta));
            scene.liquid.tait = Tait { bulk_modulus: bulk };
        }) * crate::ETA
            / eta;
        println!(
            "viscosity {eta} Pa s, K {bulk:e} Pa: force {:+.3} of PF's",
            f / usual - 1.0
        );
        assert!(f.is_finite());
        assert!(
            (f / usual - 1.0).abs() < tolerance,
            "viscosity {eta}, K {bulk}: {f}"
        );
    }
}

/// At 1e4 1/s and more the table of PVA-PF is at its last value, so the flow is Newtonian.
#[test]
fn a_viscosity_table_from_rest() {
    let table = |scene: &mut Scene| {
        let at = |log: f64, eta: f64| (10_f64.powf(log), eta);
        let points = [at(0.0, 210.0), at(0.8, 87.0), at(1.6, 1.7), at(2.7, 1.0)];
        scene.liquid.viscosity = Viscosity::Table(Table::new(&points).unwrap());
    };
    let newtonian = |scene: &mut Scene| {
        scene.liquid.viscosity = Viscosity::Newtonian(Newtonian(1.0));
    };
    let ratio = force(0.5, table) / force(0.5, newtonian);
    println!("table over its last viscosity: {ratio:.4}");
    assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
}

/// Positions after `steps` steps, saved and restored into a new scheme after `stop` of them.
fn positions(threads: usize, steps: usize, stop: usize) -> Vec<[u32; 3]> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build().unwrap().install(|| {
        let new = || Implicit::new(scene(6, [0.25, 0.0]), Settings::default()).unwrap();
        let mut scheme = new();
        for step in 0..steps {
            if step == stop {
                let saved = scheme.save();
                scheme = new();
                scheme.restore(&saved).unwrap();
            }
            let limit = StepLimit {
                time_s: 1.0 / SPEED,
                travel_m: f64::INFINITY,
            };
            scheme.advance(limit).unwrap();
        }
        let liquid = scheme.liquid();
        liquid
            .position
            .iter()
            .map(|x| x.map(f32::to_bits))
            .collect()
    })
}

#[test]
fn same_bits_for_any_threads_and_after_a_restart() {
    let usual = positions(1, 6, 99);
    assert_eq!(usual, positions(3, 6, 99), "three threads");
    assert_eq!(usual, positions(2, 6, 3), "two threads and a restart");
}
