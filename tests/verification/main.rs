//! Cheap verification scenes through the real `mpm-run`, each within a tolerance that the
//! mistakes beside it break: scenes.txt. tests/README.md gives the reasons of the tolerances and the
//! mutations of the source that were made by hand.

#![allow(clippy::print_stdout, reason = "prints for developers")]

use studies::case_text::{PF, Viscosity};
use studies::job::{Outcome, run_one};
use studies::load_control::{self, report::sound, scenes::shapes};
use studies::method::Method;
use studies::numbers;
use studies::verification::lumen::Section;
use studies::verification::{Scene, methods, piston, scenes, slit};

macro_rules! groups {
    ($($name:ident)*) => {
        const GROUPS: &[&str] = &[$(stringify!($name)),*];
        $(#[test]
        fn $name() {
            check(stringify!($name));
        })*
    };
}

groups! {
    films channels laws_by_formula adhesives_that_cure adhesives_that_dry air_behind_liquid
    lumens_in_three_dimensions pistons_in_three_dimensions squeeze_films compression_and_sound vortices
    weight_and_momentum common_velocities sealed_lumens clamps menisci
}

/// Checks the lines under the heading of a group.
fn check(group: &str) {
    let heading = format!("[{group}]");
    let table = include_str!("scenes.txt").lines();
    let headings = table.clone().filter(|line| line.starts_with('['));
    assert!(headings.eq(GROUPS.iter().map(|name| format!("[{name}]"))));
    let lines = table.skip_while(|line| *line != heading).skip(1);
    let lines = lines.take_while(|line| !line.starts_with('['));
    let mut count = 0;
    for line in lines.filter(|line| !line.starts_with('#')) {
        let parts: Vec<&str> = line.split(" | ").collect();
        let [words, labels, what, most, mistakes @ ..] = &parts[..] else {
            panic!("not a line of the table: {line}");
        };
        let most: f64 = most.parse().unwrap();
        for method in labels.split(' ').flat_map(methods) {
            let error = |scene: &Scene| {
                let errors = errors(scene, &method, what).into_iter().map(f64::abs);
                let worst = errors.max_by(f64::total_cmp);
                let worst = worst.unwrap_or_else(|| panic!("nothing named {what}: {line}"));
                println!("{} {}: {what} {worst:.3e}", scene.name, method.label);
                worst
            };
            for mistake in mistakes.iter().flat_map(|words| words.split(' ')) {
                for mut scene in scenes(words).expect(line) {
                    make(mistake, &mut scene);
                    assert!(error(&scene) > most, "{mistake} is not noticed: {line}");
                }
            }
            for scene in scenes(words).expect(line) {
                assert!(
                    error(&scene) <= most,
                    "{} {}: {line}",
                    scene.name,
                    method.label
                );
            }
        }
        count += 1;
    }
    assert!(count > 0, "no lines under {heading}");
}

/// Makes a mistake in a scene.
fn make(mistake: &str, scene: &mut Scene) {
    let case = &mut scene.case;
    if let Some(factor) = mistake.strip_prefix("eta*") {
        let factor: f64 = factor.parse().unwrap();
        match &mut case.viscosity {
            Viscosity::Newtonian(eta) => *eta *= factor,
            Viscosity::Table(rows) => rows.iter_mut().for_each(|[_, eta]| *eta *= factor),
            // A body force as much lower does the same.
            Viscosity::Law(_) => case.gravity[0] /= factor,
        }
    } else if let Some(wall) = mistake.strip_prefix("lift") {
        let wall: usize = wall.parse().unwrap();
        case.bodies[wall].min[1] += 0.5 * case.cell;
    } else {
        match mistake {
            "sunk" => case.bodies[0].max[1] -= 0.25 * case.cell,
            "air" => case.air = Some("pressure = \"1.5e5 Pa\"\n".into()),
            "roof" => {
                case.bodies.remove(1);
                let faster = |text: String| {
                    let text = text.replace("0.03 m/s", "1 m/s");
                    text.replace("0.400 us", "8 us")
                };
                case.clamp = case.clamp.take().map(faster);
            }
            other => panic!("no mistake {other}"),
        }
    }
}

/// What a run of a scene came to, which `with` may look at.
fn run<T>(scene: &Scene, method: &Method, with: impl Fn(&Outcome) -> T) -> T {
    let folder = tempfile::tempdir().unwrap();
    with(&run_one(&(scene, method.clone()), folder.path()))
}

/// Errors of the quantities whose names begin with `what`.
fn errors(scene: &Scene, method: &Method, what: &str) -> Vec<f64> {
    run(scene, method, |outcome| {
        let list = outcome.measured.as_ref();
        let list = list.unwrap_or_else(|said| panic!("{said}"));
        let of = list.iter().filter(|m| m.what.starts_with(what));
        of.map(|m| m.error).collect()
    })
}

/// What fronts in ducts and tubes take, with one voxel a cell and with two, deviates little from a straight line between 1.5 and
/// 2.5 filled diameters, over the pressure of developed flow over one.
#[test]
fn pressures_of_pistons_grow_along_straight_lines() {
    for (section, n) in [
        (Section::Square, 3),
        (Section::Square, 6),
        (Section::Round(2), 6),
        (Section::Round(1), 12),
    ] {
        let scene = piston::scene(section, n, piston::Drive::Speed(0.5));
        let columns = run(&scene, &Method::implicit(), |outcome| {
            ["time_s", "dt_s", "pressure_top_Pa"].map(|name| outcome.run.history(name).unwrap())
        });
        let [time, step, pressure] = columns;
        // Filled diameters by the speed of the piston and the areas; pressures are given of the domain's section, walls included.
        let per_second = 4.0 / section.area(n) * 0.5 / 17.4e-6;
        let unit = section.staircase_resistance(n) * PF[2] * per_second;
        let scale = (1.0 + 2.0 / f64::from(n)).powi(2) / unit;
        let rows = time.iter().zip(&step).zip(&pressure);
        let rows = rows.map(|((t, dt), p)| (per_second * (t - 0.5 * dt), p * scale));
        let rows: Vec<(f64, f64)> = rows.filter(|(at, _)| (1.5..2.5).contains(at)).collect();
        let [at_zero, slope] = numbers::line(&rows);
        let off = numbers::rms(rows.iter().map(|(x, y)| y - at_zero - slope * x));
        let name = section.name();
        println!(
            "{name} of {n} cells: deviation {off:.4} of {} steps",
            rows.len()
        );
        assert!(off < 0.05);
    }
}

/// Errors of the force at one to four filled widths over Courant numbers from 0.8 to 1 are small in the mean and deviate by little.
#[test]
fn a_piston_into_a_slit() {
    for (n, most, deviates) in [(3, [0.05, 0.13], 0.03), (6, [0.008, 0.03], 0.01)] {
        for (offset, most) in [0.0, 0.5].into_iter().zip(most) {
            let scene = slit::scene(n, [offset, 0.0]);
            let all = [1.0, 0.95, 0.9, 0.85].map(|cfl| {
                let method = Method::implicit().setting(format!("integrator.cfl={cfl}"));
                errors(&scene, &method, "piston force at")
            });
            for width in 0..4 {
                let errors = all.each_ref().map(|errors| errors[width]);
                let middle = numbers::mean(errors.into_iter());
                let deviation = numbers::rms(errors.iter().map(|error| error - middle));
                let length = width + 1;
                println!("slit-n{n}-off{offset}, L = {length} H: {middle:+.2e} +- {deviation:.1e}");
                assert!(middle.abs() < most && deviation < deviates);
            }
        }
    }
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
