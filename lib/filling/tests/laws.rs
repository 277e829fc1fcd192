//! Liquids that thin or yield, by formula, in a channel between plates under a body force: mean velocity
//! against quadrature. Run with `--nocapture` to see the errors.

#![allow(clippy::print_stdout, reason = "prints for developers")]

#[path = "common/plain.rs"]
mod plain;

use filling::{Implicit, Settings};
use physics::{Boundary, Law, Motion, Rheology, Scheme, StepLimit, Viscosity, VoxelBlock};

/// Width of the channel, m.
const H: f64 = 17.4e-6;
/// Body force per mass, m/s2: a stress of 83.5 kPa at the walls.
const PULL: f64 = 8e6;

/// Mean velocity (m/s) between plates by quadrature over the distance from the middle.
fn quadrature(law: Law) -> f64 {
    const PARTS: usize = 4000;
    let step = 0.5 * H / PARTS as f64;
    let rate = |stress: f64| {
        let (mut low, mut high) = (0.0, 1e9);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if law.viscosity(middle) * middle < stress {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    };
    // Flux of a half is the integral of rate times distance from the middle.
    let flux: f64 = (0..PARTS)
        .map(|i| (i as f64 + 0.5) * step)
        .map(|y| rate(1200.0 * PULL * y) * y * step)
        .sum();
    2.0 * flux / H
}

/// Error of the mean velocity with `n` cells after `steps` steps, and steps whose viscosity did not settle.
fn error(law: Law, n: usize, steps: usize) -> (f64, u64) {
    let h = H / n as f64;
    let mut scene = plain::scene(h, [4, n + 4, 1]);
    scene.boundary[0] = Boundary::Periodic;
    scene.gravity = [PULL, 0.0, 0.0];
    scene.liquid.viscosity = Viscosity::Law(law);
    let (low, high) = (2.0 * h, 2.0 * h + H);
    let wall = |from: f64, to: f64| VoxelBlock::solid_box([-h, from, 0.0], [9.0 * h, to, h]);
    let walls = vec![wall(-h, low), wall(high, high + 9.0 * h)];
    scene.bodies = vec![plain::body("walls", walls, Motion::Fixed)];
    scene.points = plain::fill([0.0, low, 0.0], [0.5 * h, 0.5 * h, h], [8, 2 * n, 1]);
    let settings = Settings {
        tolerance: 1e-4,
        ..Settings::default()
    };
    let mut scheme = Implicit::new(scene, settings).unwrap();
    for _ in 0..steps {
        let limit = StepLimit {
            time_s: 0.4e-6,
            travel_m: f64::INFINITY,
        };
        scheme.advance(limit).unwrap();
    }
    let velocity = scheme.liquid().velocity;
    let mean = velocity.iter().map(|v| f64::from(v[0])).sum::<f64>() / velocity.len() as f64;
    let counts = scheme.counts();
    let unsettled = counts.iter().find(|c| c.0.contains("settle")).unwrap().1;
    (mean / quadrature(law) - 1.0, unsettled)
}

const LAWS: [Law; 5] = [
    Law::Power {
        consistency: 500.0,
        index: 0.5,
        rates: [1.0, 1e6],
    },
    Law::Power {
        consistency: 3000.0,
        index: 0.3,
        rates: [1.0, 1e6],
    },
    Law::Cross {
        plateaus: [50.0, 0.5],
        time: 1e-3,
        exponent: 0.8,
    },
    Law::CarreauYasuda {
        plateaus: [50.0, 0.5],
        time: 1e-3,
        index: 0.4,
        transition: 2.0,
    },
    Law::HerschelBulkley {
        yield_stress: 40e3,
        consistency: 250.0,
        index: 0.5,
        regularisation: 3.0,
    },
];

#[test]
fn channels_of_twelve_cells() {
    for law in LAWS {
        let (error, unsettled) = error(law, 12, 5);
        println!("{law}: {error:+.4}, {unsettled} steps not settled");
        assert!(error.abs() < 0.01 && unsettled == 0, "{law}: {error}");
    }
}
