//! Cheap verification scenes through the real `mpm-run`, each within a tolerance that the
//! mistakes beside it break. tests/README.md gives the reasons of the tolerances and the
//! mutations of the source that were made by hand.

#![allow(clippy::print_stdout, reason = "prints for developers")]

mod lumens;
mod runs;

use runs::{A_QUARTER_THICKER, Mistake, Run, THICKER, lifted, short_steps, times};
use studies::case_text::PF;
use studies::load_control::{self, report::sound, scenes::shapes};
use studies::method::Method;
use studies::verification::lumen::Section;
use studies::verification::{
    Scene, acoustic, air, channel, clamp, column, couette, cure, disc, drop, duct, galilean,
    incline, laws, piston, sealed, squeeze, stefan, tait, taylor_green, water,
};

/// Methods by each of some shape functions, but APIC by the hat, which does not have it.
fn by_shapes<const N: usize>(
    shapes: [&str; N],
    methods: impl IntoIterator<Item = Method>,
) -> Vec<Method> {
    let pairs = methods
        .into_iter()
        .flat_map(|method| shapes.map(|shape| (shape, method.clone())));
    pairs
        .filter(|(shape, method)| *shape != "linear" || method.label != "APIC")
        .map(|(shape, method)| method.setting(format!("grid.shape=\"{shape}\"")))
        .collect()
}

/// Standard deviation from the straight line of least squares.
fn deviation(rows: &[(f64, f64)]) -> f64 {
    let mean = |of: &dyn Fn(f64, f64) -> f64| {
        rows.iter().map(|&(x, y)| of(x, y)).sum::<f64>() / rows.len() as f64
    };
    let (x, y) = (mean(&|x, _| x), mean(&|_, y| y));
    let slope = mean(&|a, b| (a - x) * (b - y)) / mean(&|a, _| (a - x).powi(2));
    mean(&|a, b| (b - y - slope * (a - x)).powi(2)).sqrt()
}

fn updates() -> [Method; 3] {
    ["FLIP", "XPIC(5)", "APIC"].map(Method::named)
}

#[test]
fn a_film_on_an_incline() {
    let film = || incline::scene(6, 0.0, 5e-6);
    let sunk: Mistake = |mut scene| {
        scene.case.bodies[0].max[1] -= 0.25 * scene.case.cell;
        scene
    };
    let profile = "rms profile";
    let xpic = Run(&film, Method::named("XPIC(5)"));
    xpic.notices(&[THICKER, sunk], 0.01, profile);
    xpic.within(0.001, "rms v_y");
    let implicit = Method::implicit().setting("integrator.cfl=1e-6");
    for method in [Method::named("FLIP"), implicit] {
        let run = Run(&film, method);
        run.notices(&[THICKER], 0.01, profile);
        run.within(0.01, "rms v_y");
    }
}

#[test]
fn flow_through_a_channel() {
    let what = "mean velocity";
    let moved: Mistake = |scene| lifted(scene, 1);
    for (n, offset) in [2, 3, 4, 6].into_iter().flat_map(|n| [(n, 0.0), (n, 0.5)]) {
        let scene = || channel::scene(n, offset, None, 3e-6);
        let run = Run(&scene, short_steps());
        run.notices(&[THICKER, moved], if n < 3 { 0.006 } else { 0.004 }, what);
        // Where walls stand half way in cells, the flux of faces is right and not what each has of it.
        let half_way = offset / f64::from(n);
        run.within(f64::max(0.002, 0.6 * half_way), "a point");
    }
    for (n, tolerance) in [(6, 0.02), (12, 0.007)] {
        let scene = || laws::scene(laws::TABLE, n, 0.0, 0.4e-6);
        Run(&scene, short_steps()).notices(&[THICKER], tolerance, what);
    }
    // The bulk of the explicit scheme's flow is right where its walls are: on the nodes.
    let scene = || channel::scene(6, 0.0, None, 3e-6);
    Run(&scene, Method::named("XPIC(5)")).notices(&[moved], 0.06, what);
    for method in by_shapes(["gimp", "linear"], ["FLIP", "XPIC(5)"].map(Method::named)) {
        Run(&scene, method).within(0.06, what);
    }
}

/// The slip velocity is off by five times as much as the slope of the profile.
#[test]
fn walls_that_let_liquid_slip() {
    let scene = || couette::scene(6, 0.0, 0.1, 3e-6);
    for method in ["FLIP", "XPIC(5)"].map(Method::named) {
        Run(&scene, method).within(0.1, "slip velocity");
    }
}

#[test]
fn laws_by_formula_in_a_channel() {
    for law in laws::LAWS {
        let scene = || laws::scene(law, 12, 0.0, 0.4e-6);
        let run = Run(&scene, short_steps());
        run.notices(&[THICKER], 0.02, "mean velocity");
        if law.name == "law-herschel" {
            run.within(1e-3, "motion within the plug");
        }
    }
    for (n, offset) in [6, 12, 24].into_iter().flat_map(|n| [(n, 0.0), (n, 0.5)]) {
        let scene = || laws::scene(laws::LAWS[0], n, offset, 0.4e-6);
        Run(&scene, short_steps()).within(2e-3, "mean velocity");
    }
}

#[test]
fn an_adhesive_that_cures_comes_to_rest_where_it_should() {
    for scene in [
        || cure::slit_scene(6, cure::GEL),
        || cure::tube_scene(6, cure::TABLE),
    ] {
        let run = Run(&scene, Method::implicit());
        run.notices(&[A_QUARTER_THICKER], 0.03, "L");
        run.within(1e-4, "time at which it ended");
    }
}

#[test]
fn an_adhesive_that_dries_comes_to_rest_where_it_should() {
    let (slit, tube) = (|| water::slit_scene(6), || water::tube_scene(6));
    let scenes: [(&dyn Fn() -> Scene, f64); 2] = [(&slit, 0.03), (&tube, 0.055)];
    for (scene, most) in scenes {
        let run = Run(scene, Method::implicit());
        run.notices(&[A_QUARTER_THICKER], most, "L where it stops");
        run.within(1e-9, "mass of water");
    }
}

#[test]
fn air_behind_liquid_is_compressed_and_leaks() {
    let mistakes: [Mistake; 1] = [|mut scene| {
        scene.case.air = Some("pressure = \"1.5e5 Pa\"\n".into());
        scene
    }];
    // What leaks goes on to the end: as far off as filling at constant pressure is.
    for (n, leak_time, goal) in [(6, None, 0.005), (12, None, 0.005), (6, Some(20.0), 0.02)] {
        let scene = || air::scene(n, leak_time);
        let run = Run(&scene, Method::implicit());
        let mistakes: &[Mistake] = if n == 6 { &mistakes } else { &[] };
        run.notices(mistakes, goal, "L at the end");
        run.within(0.02, "L(t) from L = d on, worst");
    }
}

#[test]
fn flow_through_lumens_in_three_dimensions() {
    let square = || duct::scene(Section::Square, 6, 2e-6);
    // By the power that the weight gives.
    let mistakes = [THICKER, |scene| lifted(scene, 0)];
    let run = Run(&square, Method::implicit());
    run.notices(&mistakes, 0.015, "mean velocity");
    let tube = || duct::scene(Section::Round(1), 6, 2e-6);
    Run(&tube, short_steps()).within(0.015, "mean velocity, same staircase");
}

/// What fronts in ducts and tubes take, with one voxel a cell and with two; its deviation from a straight line between 1.5 and
/// 2.5 filled diameters, over the pressure of developed flow over one.
#[test]
fn a_piston_into_lumens_of_more_cells() {
    for (section, n, most) in [
        (Section::Square, 3, 0.02),
        (Section::Square, 6, 0.01),
        (Section::Round(2), 6, 0.018),
        (Section::Round(1), 12, 0.01),
    ] {
        let scene = || piston::scene(section, n, piston::Drive::Speed(0.5));
        let run = Run(&scene, Method::implicit());
        run.within(most, "pressure at L = 2 d");
        let [time, step, pressure] = run.columns(["time_s", "dt_s", "pressure_top_Pa"]);
        // Filled diameters by the speed of the piston and the areas; pressures are given of the domain's section, walls included.
        let per_second = 4.0 / section.area(n) * 0.5 / 17.4e-6;
        let unit = section.staircase_resistance(n) * PF[2] * per_second;
        let scale = (1.0 + 2.0 / f64::from(n)).powi(2) / unit;
        let rows = time.iter().zip(&step).zip(&pressure);
        let rows = rows.map(|((t, dt), p)| (per_second * (t - 0.5 * dt), p * scale));
        let rows: Vec<(f64, f64)> = rows.filter(|(at, _)| (1.5..2.5).contains(at)).collect();
        let off = deviation(&rows);
        println!(
            "{} of {n} cells: deviation {off:.4} of {} steps",
            section.name(),
            rows.len()
        );
        assert!(off < 0.05);
    }
}

/// Walls half way in their cells. The growth is the difference of two pressures of a few steps each.
#[test]
fn a_piston_into_a_lumen_of_three_cells_at_any_step() {
    let scene = || piston::scene(Section::Square, 3, piston::Drive::Speed(0.5));
    for (cfl, growth, pressure) in [(1.0, 0.12, 0.02), (0.5, 0.05, 0.02), (0.1, 0.13, 0.02)] {
        let method = Method::implicit().setting(format!("integrator.cfl={cfl}"));
        let run = Run(&scene, method);
        run.within(growth, "pressure per filled diameter");
        let thinner: &[Mistake] = &[|scene| times(scene, 0.9)];
        let mistakes = if cfl == 0.5 { thinner } else { &[] };
        run.notices(mistakes, pressure, "pressure at L = 2 d");
    }
}

#[test]
fn squeeze_films() {
    let (plates, round) = (|| squeeze::scene(3, 0.5), || disc::scene(8, 2, 0.0));
    let scenes: [(&dyn Fn() -> Scene, f64); 2] = [(&plates, 0.02), (&round, 0.025)];
    for (scene, tolerance) in scenes {
        let run = Run(scene, Method::implicit().setting("integrator.cfl=0.01"));
        run.notices(&[THICKER], tolerance, "force on the top");
    }
}

/// 0.5 to 1 % of the gap with three cells, from a microsecond to minutes; a viscosity a tenth off is 1.8 % and more.
#[test]
fn a_film_closed_by_a_press_programme() {
    use stefan::Load::{Hold, Programme};
    for (load, time) in [(Hold, 1e-6), (Hold, 1e3), (Programme, 300.0)] {
        let scene = || stefan::scene(3, load, time);
        let run = Run(&scene, Method::implicit());
        run.notices(&[|scene| times(scene, 1.1)], 0.01, "gap over time");
    }
}

#[test]
fn compression_and_sound() {
    for method in Method::updates() {
        Run(&tait::scene, method).within(2e-6, "rms pressure");
    }
    // Damping by the viscosity: 4/3 eta of the deviator; all of 2 eta D would damp half as
    // much again, 3.2 % more of the wave per period.
    for method in ["FLIP", "APIC", "FMPM(5)"].map(Method::named) {
        let run = Run(&|| acoustic::scene(0.5), method);
        run.within(0.002, "frequency");
        run.notices(&[THICKER], 0.001, "1 + damping");
    }
    // A wave of 64 cells: the dispersion of lumped linear elements is (k h)^2/24 = 0.04 %.
    for method in by_shapes(["gimp", "bspline2", "linear"], updates()) {
        Run(&|| acoustic::scene(0.001), method).within(0.01, "frequency");
    }
}

#[test]
fn a_vortex_decays() {
    let vortex = || taylor_green::scene(12, 1.3);
    for method in ["FLIP", "FMPM(5)"].map(Method::named) {
        Run(&vortex, method).within(0.03, "decay rate");
    }
    Run(&vortex, Method::named("XPIC(5)")).notices(&[THICKER], 0.03, "decay rate");
    // Second order in k cell = 0.26: the weights smooth by (k cell)^2/12 = 0.6 % (hat) to 1.7 % (spline) per transfer, of which
    // the rate takes two or three; APIC damps too.
    for method in by_shapes(["gimp", "bspline2", "linear"], updates()) {
        Run(&vortex, method).within(0.1, "decay rate");
    }
}

#[test]
fn weight_and_momentum_are_kept() {
    for method in ["FLIP", "XPIC(5)"].map(Method::named) {
        let run = Run(&|| column::scene(0.0, 6e-6), method);
        run.within(1e-3, "weight").within(0.03, "rms pressure");
    }
    for method in Method::updates() {
        Run(&|| drop::scene(0.2e-6), method).within(1e-5, "momentum");
    }
}

#[test]
fn a_common_velocity_changes_nothing() {
    for law in ["stick", "partial-slip", "frictionless"] {
        let drifting = |offset| {
            let mut scene = galilean::scene(law, offset);
            scene.case.stop = Some(1e-6);
            scene
        };
        for method in Method::updates().into_iter().chain([Method::implicit()]) {
            Run(&|| drifting(0.5), method).within(1e-6, "largest drift");
        }
        Run(&|| drifting(0.0), Method::implicit()).within(1e-6, "largest drift");
    }
}

#[test]
fn sealed_lumens_do_not_leak() {
    let leaked = "points leaked";
    for voxels in [1, 2] {
        for method in ["FLIP", "XPIC(2)"].map(Method::named) {
            for offset in [0.25, 0.5] {
                let scene = || sealed::scene(voxels, offset);
                Run(&scene, method.clone()).within(0.0, leaked);
            }
        }
        let scene = || sealed::scene(voxels, 0.5);
        Run(&scene, Method::implicit()).within(0.0, leaked);
    }
    // A roof that is not there is noticed.
    let open: Mistake = |mut scene| {
        scene.case.bodies.remove(1);
        let faster = |text: String| {
            text.replace("0.03 m/s", "1 m/s")
                .replace("0.400 us", "8 us")
        };
        scene.case.clamp = scene.case.clamp.map(faster);
        scene
    };
    let scene = || sealed::scene(2, 0.5);
    Run(&scene, Method::implicit()).notices(&[open], 0.0, leaked);
}

#[test]
fn the_clamp_keeps_its_limit_and_stops_when_closed() {
    let clamp = || clamp::scene(3.0);
    let run = Run(&clamp, Method::implicit());
    run.within(0.01, "overshoot").within(0.01, "worst error");
    run.within(0.0, "speed outside").within(1e-9, "travel");
}

/// At 0.1 MPa a step once went 1.44 cells at a Courant number of 0.5, and the run "closed" a tenth
/// into its time; at 0.03 MPa and 6 Pa s the solver was asked for the speed of a plate in the air.
#[test]
fn a_clamp_at_its_limit_keeps_the_courant_number() {
    let folder = tempfile::tempdir().unwrap();
    let film_under_air = shapes()[1];
    let rows = [(1e5, 1.3), (3e5, 1.3), (3e4, 6.0)].map(|(pressure, viscosity)| {
        load_control::row(film_under_air, pressure, viscosity, folder.path()).unwrap()
    });
    for row in &rows {
        let [usual, small] = &row.courses;
        println!(
            "{} Pa, {} Pa s: clamp {:.3} of the Courant number, closed after {:.4e} and {:.4e} s, gap off by {:.3}",
            row.pressure, row.viscosity, usual.clamp, usual.closed_s, small.closed_s, row.thickness
        );
    }
    assert!(sound(&rows));
    let [low, high] = [&rows[0], &rows[1]].map(|row| row.courses[0].closed_s);
    // Three times the pressure, a third of the time.
    assert!((low / high / 3.0 - 1.0).abs() < 0.2);
}
