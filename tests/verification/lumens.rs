//! Liquid pressed into slits and drawn into passages.

use studies::method::Method;
use studies::verification::lumen::Section;
use studies::verification::{jurin, slit, wicking};

use crate::runs::Run;

/// Errors of the force at one to four filled widths over Courant numbers from 0.8 to 1 are this in the mean and deviate by that.
fn slit_within(n: u32, runs: u32, most: f64, deviates: f64) {
    for offset in [0.0, 0.5] {
        let errors_at = |i: u32| {
            let cfl = 1.0 - 0.2 * f64::from(i) / f64::from(runs);
            let method = Method::implicit().setting(format!("integrator.cfl={cfl}"));
            let scene = || slit::scene(n, [offset, 0.0]);
            Run(&scene, method).errors(&scene(), "piston force at")
        };
        let all: Vec<Vec<f64>> = (0..runs).map(errors_at).collect();
        for width in 0..4 {
            let mean = |of: &dyn Fn(f64) -> f64| {
                all.iter().map(|errors| of(errors[width])).sum::<f64>() / f64::from(runs)
            };
            let middle = mean(&|e| e);
            let deviation = mean(&|e| (e - middle).powi(2)).sqrt();
            println!(
                "slit-n{n}-off{offset}, L = {} H: {middle:+.2e} +- {deviation:.1e}",
                width + 1
            );
            assert!(middle.abs() < most && deviation < deviates);
        }
    }
}

#[test]
fn a_piston_into_a_slit() {
    slit_within(3, 4, 0.1, 0.03);
    slit_within(6, 4, 0.055, 0.01);
}

#[test]
#[ignore = "a minute; prints the numbers of forty Courant numbers and of twelve cells"]
fn a_piston_into_a_slit_by_forty_courant_numbers() {
    for (n, runs) in [(3, 40), (6, 40), (12, 6)] {
        slit_within(n, runs, f64::INFINITY, f64::INFINITY);
    }
}

/// How far off the length is of which liquid is drawn into a slit or a passage of a section whose contact lines resist by `k` Ca.
fn drawn(section: Option<Section>, n: u32, degrees: f64, k: f64, cfl: f64) -> f64 {
    let scene = match section {
        None => wicking::slit_scene(n, [0.0; 2], degrees, k),
        Some(section) => wicking::tube_scene(section, n, 3.0, degrees, k),
    };
    let method = Method::implicit().setting(format!("integrator.cfl={cfl}"));
    let method = method.setting(format!("adhesive.dynamic_angle={k}"));
    Run(&|| unreachable!(), method).error(&scene, "L at the end")
}

const SQUARE: Option<Section> = Some(Section::Square);
const ROUND: Option<Section> = Some(Section::Round(2));

/// Contact lines that resist add a length to that of developed flow.
#[test]
fn liquid_is_drawn_into_slits_and_tubes() {
    for (section, n, degrees, k) in [
        (None, 6, 0.0, 0.0),
        (None, 6, 60.0, 0.0),
        (None, 3, 60.0, 0.0),
        (SQUARE, 6, 0.0, 0.0),
        (ROUND, 6, 0.0, 0.0),
        (None, 6, 0.0, 5.0),
        (None, 6, 0.0, 90.0),
        (SQUARE, 6, 0.0, 90.0),
        (ROUND, 6, 0.0, 20.0),
        (ROUND, 6, 0.0, 90.0),
    ] {
        assert!(drawn(section, n, degrees, k, 1.0) < 0.03);
    }
}

#[test]
#[ignore = "prints the numbers of other widths and steps"]
fn liquid_is_drawn_into_other_passages() {
    let slits = [4, 12].map(|n| (None, n));
    let others = [(SQUARE, 3), (SQUARE, 4), (ROUND, 4), (ROUND, 12)];
    for (section, n) in slits.into_iter().chain(others) {
        drawn(section, n, 0.0, 0.0, 1.0);
    }
    for cfl in [0.5, 0.25] {
        drawn(None, 6, 0.0, 0.0, cfl);
    }
}

#[test]
fn liquid_rises_between_plates() {
    for (n, degrees) in [(6, 0.0), (6, 60.0), (6, 120.0), (12, 0.0)] {
        let scene = || jurin::scene(n, 0.0, degrees);
        Run(&scene, Method::implicit()).within(0.05, "height");
    }
}
