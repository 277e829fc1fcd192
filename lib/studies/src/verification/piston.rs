//! A piston presses liquid from a reservoir, twice as wide as a lumen, into the lumen in three
//! dimensions, at constant speed or constant pressure; a quarter is computed. The pressure must
//! grow with the filled length L as in developed flow, p = c eta V (L + e)/d^2, with the
//! equivalent length e of piston, reservoir, mouth and moving front.

use std::f64::consts::PI;

use super::lumen::{Rectangle, Section, quarter};
use super::{LUMEN, Measured, Scene};
use crate::Result;
use crate::case_text::{Body, CaseText, PF};
use crate::numbers::{at_middle, crossing};
use crate::outputs::Run;

/// Depth of the reservoir over the diameter of the lumen.
const DEPTH: f64 = 1.5;
/// Filled length up to which a run goes, over the diameter.
const LONGEST: f64 = 2.5;

/// What moves the piston.
#[derive(Clone, Copy, Debug)]
pub enum Drive {
    /// Speed, m/s.
    Speed(f64),
    /// Pressure, Pa.
    Pressure(f64),
}

/// Bulk modulus, Pa: what the liquid gives way by then is next to nothing of what flows.
const STIFF: f64 = 1e10;
/// Equivalent length of piston, reservoir, mouth and front over the diameter in 24 cells, for one to two filled diameters:
/// steady flow behind a flat front, by the implicit scheme with 6, 12 and 24 cells 0.397, 0.396 and 0.390 for the square, 0.319,
/// 0.317 and 0.315 for a tube of 12 voxels, 0.327 for one of 24; and the front's shape, by finite elements -0.151 and
/// -0.146 (tests/references/front).
fn finest(section: Section) -> f64 {
    match section {
        Section::Square => 0.245,
        Section::Round(_) => 0.175,
    }
}

/// Pressure over eta U/r at r from the corner of a piston that liquid sticks to, as it does to the wall: Taylor's scraper. The
/// narrower cells are, the more of it is seen.
const SCRAPER: f64 = PI / (0.25 * PI * PI - 1.0);

/// The same equivalent length in `n` cells.
pub(super) fn entrance(section: Section, n: u32) -> f64 {
    // The piston's speed over that in the lumen, and its edges over its area.
    let (speed, edges) = (0.25 * section.area(n), 2.0);
    let more = SCRAPER * speed * edges * (f64::from(n) / 24.0).ln();
    finest(section) + more / section.staircase_resistance(n)
}

/// A lumen of `n` cells.
pub fn scene(section: Section, n: u32, drive: Drive) -> Scene {
    let cell = LUMEN / f64::from(n);
    let right = LUMEN + 2.0 * cell;
    let shoulder = (LONGEST + 0.7) * LUMEN;
    let piston = shoulder + DEPTH * LUMEN;
    let top = piston + 2.0 * cell;
    let shape = quarter(section, n, LUMEN, right);
    let lumen = |r: &Rectangle| {
        let (low, high) = ([r.low[0], 0.0, r.low[1]], [r.high[0], shoulder, r.high[1]]);
        Body::wall(low, high).named("bottom")
    };
    let mut bodies: Vec<Body> = shape.sides.iter().map(lumen).collect();
    bodies.push(lumen(&shape.roof));
    for [x, z] in [[LUMEN, 0.0], [0.0, LUMEN]] {
        let wall = Body::wall([x, shoulder, z], [right, top, right]);
        bodies.push(wall.named("bottom"));
    }
    let plunger = Body::wall([0.0, piston, 0.0], [LUMEN, top + 2.0 * LUMEN, LUMEN]).named("top");
    let liquid = Body::liquid([0.0, shoulder, 0.0], [LUMEN, piston, LUMEN]);
    let area = section.area(n);
    let resistance = section.staircase_resistance(n) * PF[2];
    let (word, constant, until) = match drive {
        Drive::Speed(v) => ("piston", "speed", LONGEST * area / 4.0 * LUMEN / v),
        Drive::Pressure(p) => {
            let until = 1.4 * resistance / p * (0.5 * LONGEST * LONGEST + 0.5);
            ("washburn3d", "pressure", until)
        }
    };
    let name = section.name();
    let mut case = CaseText {
        title: format!(
            "A piston at constant {constant} presses liquid into a lumen ({name}) of {n} cells, a quarter of it.\nAgainst c eta V (L + e)/d^2, c of developed flow between the same walls by finite differences."
        ),
        bulk_modulus: STIFF,
        history_every: until / 400.0,
        ..CaseText::new(cell, 3, [right, top, right])
    };
    match drive {
        Drive::Speed(v) => {
            case.stop = Some(until);
            bodies.push(plunger.moving([0.0, -v, 0.0]));
        }
        Drive::Pressure(p) => {
            case.clamp = Some(format!(
                "closing_speed = \"20 m/s\"\nmax_pressure = \"{:.6} Pa\"\nstop = \"{:.6} us\"\ntravel = \"{:.6} um\"\n",
                p * (LUMEN / right).powi(2),
                until * 1e6,
                1.2 * LUMEN * 1e6
            ));
            bodies.push(plunger.clamped());
        }
    }
    bodies.push(liquid);
    case.bodies = bodies;
    let name = format!("{word}-{name}-n{n}");
    Scene::new(name, "developed flow", case, move |run| match drive {
        Drive::Speed(v) => {
            let unit = resistance * 4.0 / area * v / LUMEN;
            pressures(run, area, v, unit, right, 2.0 + entrance(section, n))
        }
        Drive::Pressure(p) => times(run, area, resistance / p, 1.5 + entrance(section, n)),
    })
}

/// Growth of the pressure over the filled length, and the pressure itself, where that of two filled diameters is `exact`;
/// `unit` (Pa) is the pressure of developed flow over a diameter, `right` (m) the edge of the domain's cross-section,
/// which the history refers to.
fn pressures(
    run: &Run,
    area: f64,
    speed: f64,
    unit: f64,
    right: f64,
    exact: f64,
) -> Result<Vec<Measured>> {
    let pressure = run.history("pressure_top_Pa")?;
    let pressure: Vec<f64> = (pressure.iter())
        .map(|p| p * (right / LUMEN).powi(2))
        .collect();
    // What the liquid gives way by itself does not flow into the lumen.
    let filled: Vec<f64> = (run.history("time_s")?.iter().zip(&pressure))
        .map(|(t, p)| 4.0 / area * (speed * t / LUMEN - DEPTH * p / STIFF))
        .collect();
    let at = |length: f64| {
        let found = at_middle(&filled, &pressure, length - 0.25, length + 0.25);
        found.ok_or("the lumen was not filled to two diameters")
    };
    let (one, two) = (at(1.0)? / unit, at(2.0)? / unit);
    Ok(vec![
        Measured::relative("pressure per filled diameter", two - one, 1.0),
        Measured::relative("pressure at L = 2 d", two, exact),
    ])
}

/// Time in which the liquid goes on from one to two diameters, over `c eta/p` (s), where `exact` is right.
fn times(run: &Run, area: f64, unit: f64, exact: f64) -> Result<Vec<Measured>> {
    let [time, travel] = run.columns(["time_s", "displacement_m"])?;
    let when = |length: f64| {
        let found = crossing(&travel, &time, length * area / 4.0 * LUMEN);
        found.ok_or("the lumen was not filled to two diameters")
    };
    let took = (when(2.0)? - when(1.0)?) / unit;
    let what = "time from L = d to 2 d";
    Ok(vec![Measured::relative(what, took, exact)])
}
