//! Viscosity laws and a table in a channel, against quadrature of the profile.

use super::{LUMEN, Measured, Scene, channel, mean_against};
use crate::Result;
use crate::case_text::{CaseText, PF, Viscosity};
use crate::numbers::last;
use crate::outputs::Run;

/// A law with its own formula, not the code's.
#[derive(Clone, Copy, Debug)]
pub struct Law {
    /// Beginning of names.
    pub name: &'static str,
    /// Its key and value in a case file.
    key: &'static str,
    /// Viscosity (Pa s) of a shear rate (1/s) as the law has it, without its regularisation.
    eta: fn(f64) -> f64,
    /// Stress below which it does not flow, Pa.
    yields: f64,
    /// Body force per mass, m/s2: shear rates up to 3e4 1/s at the walls.
    force: f64,
    /// Above all shear rates, 1/s.
    fastest: f64,
}

/// A table, linear in the logarithm of the shear rate: the stress grows with the rate everywhere, so that the profile is one.
pub const TABLE: Law = Law {
    name: "table",
    key: "viscosity_table = [\n  [\"100 1/s\", \"20 Pa s\"],\n  [\"100000 1/s\", \"5 Pa s\"],\n]",
    eta: |rate| 20.0 - 15.0 * ((rate / 1e2).log10() / 3.0).clamp(0.0, 1.0),
    yields: 0.0,
    force: 2.2e7,
    fastest: 1e6,
};

const FORMULA: Law = Law {
    force: 8e6,
    fastest: 1e7,
    ..TABLE
};

/// The laws by formula, thinning tenfold and more over the channel.
pub const LAWS: [Law; 5] = [
    Law {
        name: "law-power0.5",
        key: "power_law = { consistency = \"500 Pa s^n\", index = 0.5, rates = [\"1 1/s\", \"1e6 1/s\"] }",
        eta: |rate| 500.0 * rate.powf(-0.5),
        ..FORMULA
    },
    Law {
        name: "law-power0.3",
        key: "power_law = { consistency = \"3000 Pa s^n\", index = 0.3, rates = [\"1 1/s\", \"1e6 1/s\"] }",
        eta: |rate| 3000.0 * rate.powf(-0.7),
        ..FORMULA
    },
    Law {
        name: "law-cross",
        key: "cross = { zero_rate = \"50 Pa s\", infinite_rate = \"0.5 Pa s\", time = \"1 ms\", exponent = 0.8 }",
        eta: |rate| 0.5 + 49.5 / (1.0 + (1e-3 * rate).powf(0.8)),
        ..FORMULA
    },
    Law {
        name: "law-carreau",
        key: "carreau_yasuda = { zero_rate = \"50 Pa s\", infinite_rate = \"0.5 Pa s\", time = \"1 ms\", index = 0.4 }",
        eta: |rate| 0.5 + 49.5 * (1.0 + (1e-3 * rate).powi(2)).powf(-0.3),
        ..FORMULA
    },
    Law {
        name: "law-herschel",
        key: "herschel_bulkley = { yield_stress = \"40000 Pa\", consistency = \"250 Pa s^n\", index = 0.5, regularisation_rate = \"3 1/s\" }",
        eta: |rate| 40e3 / rate + 250.0 * rate.powf(-0.5),
        yields: 40e3,
        ..FORMULA
    },
];

/// A channel of `n` cells, its lower wall `offset` cells off the nodes.
pub fn scene(law: Law, n: u32, offset: f64, until: f64) -> Scene {
    let title = format!(
        "Channel of {n} cells, {}, walls {offset} cell off the nodes.\nAgainst quadrature of the profile.",
        law.name
    );
    let case = CaseText {
        title,
        viscosity: Viscosity::Law(law.key.into()),
        gravity: [law.force, 0.0, 0.0],
        ..channel::scene(n, offset, None, until).case
    };
    let low = case.bodies[0].max[1];
    let name = format!("{}-n{n}-off{offset}", law.name);
    Scene::new(name, "quadrature of the profile", case, move |run| {
        let exact = channel_of(law.eta, law.fastest, LUMEN, law.force, PF[0]);
        let mut list = vec![mean_against(run, low, exact)?];
        if law.yields > 0.0 {
            // Half the thickness of what does not yield.
            let half = law.yields / (PF[0] * law.force);
            list.push(plug(run, low, half, LUMEN / f64::from(n))?);
        }
        Ok(list)
    })
}

/// How far velocities differ in the plug, `half` (m) about the middle of the channel, in those of its `cell`s (m) that share
/// nothing with what yields, over the velocity there.
fn plug(run: &Run, low: f64, half: f64, cell: f64) -> Result<Measured> {
    let (mut slowest, mut fastest) = (f64::INFINITY, 0.0_f64);
    for p in run.points()? {
        let middle = ((p.at[1] / cell).floor() + 0.5) * cell;
        if (middle - low - 0.5 * LUMEN).abs() + 0.5 * cell <= half {
            slowest = slowest.min(p.velocity[0]);
            fastest = fastest.max(p.velocity[0]);
        }
    }
    match fastest {
        0.0 => Err("there is no plug".into()),
        _ => Ok(Measured::absolute(
            "motion within the plug",
            1.0 - slowest / fastest,
        )),
    }
}

/// Velocity over the distance from one of two plates `h` apart under a body force `g` per mass for a
/// viscosity that depends on the shear rate, `eta(rate)`, with a stress that grows with the rate up to
/// `fastest` (1/s): quadrature of the rate over the half gap, linear between its places.
fn channel_of(
    eta: impl Fn(f64) -> f64,
    fastest: f64,
    h: f64,
    g: f64,
    rho: f64,
) -> impl Fn(f64) -> f64 {
    const PARTS: usize = 4000;
    let step = 0.5 * h / PARTS as f64;
    let rate = |from_middle: f64| last(fastest, |rate| eta(rate) * rate < rho * g * from_middle);
    let mut velocity = vec![0.0];
    for i in 0..PARTS {
        let before = velocity[i];
        velocity.push(before + step * rate(0.5 * h - (i as f64 + 0.5) * step));
    }
    move |y: f64| {
        let place = (y.min(h - y) / step).clamp(0.0, PARTS as f64);
        let i = (place as usize).min(PARTS - 1);
        velocity[i] + (place - i as f64) * (velocity[i + 1] - velocity[i])
    }
}

#[test]
fn quadrature_of_a_newtonian_channel_is_the_parabola() {
    let found = channel_of(|_| 2.0, 1e3, 1.0, 3.0, 5.0);
    for y in [0.1, 0.3333, 0.5, 0.9] {
        let exact = 5.0 * 3.0 / (2.0 * 2.0) * y * (1.0 - y);
        assert!((found(y) / exact - 1.0).abs() < 1e-6, "{y}");
    }
}
