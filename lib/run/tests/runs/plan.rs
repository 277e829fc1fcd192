//! The plan of a run against numbers worked out by hand.

use crate::bench::{Bench, has};
use crate::fall;

/// A slab of adhesive of 12 x 6 x 8 um on a floor, under a plate that the clamp drives.
pub const CASE: &str = r#"
[grid]
cell = "2 um"
domain = { min = ["0 um", "0 um", "0 um"], max = ["20 um", "30 um", "8 um"] }
[adhesive]
density = "1.2 g/cm3"
bulk_modulus = "1 GPa"
viscosity = "300 cP"
[contact]
law = "partial-slip"
influence_length = "0.01 cell"
[[body]]
material = "adhesive"
box = { min = ["4 um", "4 um", "0 um"], max = ["16 um", "10 um", "8 um"] }
[[body]]
material = "rigid"
box = { min = ["0 um", "0 um", "0 um"], max = ["20 um", "4 um", "8 um"] }
[[body]]
material = "rigid"
box = { min = ["0 um", "10 um", "0 um"], max = ["20 um", "14 um", "8 um"] }
velocity = "clamp"
name = "top"
[boundary]
x = "open"
[clamp]
closing_speed = "2 m/s"
max_pressure = "2.5 MPa"
travel = "3 um"
stop = "closed"
[integrator]
scheme = "explicit"
velocity_update = "xpic"
order = 5
"#;

/// The plan of [`CASE`] after replacements, or the sentence that refuses it.
pub fn plan(replaced: &[(&str, &str)], changes: &[&str]) -> Result<String, String> {
    let text = replaced.iter().fold(CASE.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    });
    Bench::with(&text).plan(changes).map_err(|e| e.to_string())
}

/// Asserts that the plan has lines that begin with `lines`; returns the plan.
#[track_caller]
fn says(replaced: &[(&str, &str)], changes: &[&str], lines: &[&str]) -> String {
    let plan = format!("\n{}", plan(replaced, changes).unwrap());
    for line in lines {
        has(&plan, &[&format!("\n{line}")]);
    }
    plan
}

/// Asserts that the plan leaves out `parts`, besides those that every run leaves out.
#[track_caller]
fn leaves_out(bench: &Bench, changes: &[&str], parts: &[&str]) {
    const ALWAYS: [&str; 5] = [
        "wood deformation adherends are rigid",
        "trapped air voids are empty",
        "cure the viscosity does not change",
        "loss of water the adhesive keeps",
        "capillary pressure 10.0 kPa",
    ];
    let plan = bench.plan(changes).unwrap();
    let (_, left_out) = plan.split_once("left out\n").unwrap();
    let lines = left_out.lines();
    let lines: Vec<_> = (lines.filter(|line| !line.starts_with("sound waves Mach"))).collect();
    let all = [parts, &ALWAYS].concat();
    assert_eq!(lines.len(), all.len(), "{lines:?}");
    for (line, part) in lines.iter().zip(all) {
        assert!(line.starts_with(part), "{line}: {part}");
    }
}

pub const IMPLICIT: [(&str, &str); 2] = [("\"explicit\"", "\"implicit\""), FILTER];

const FILTER: (&str, &str) = ("velocity_update = \"xpic\"\norder = 5\n", "");
const CLAMP: &str = "[clamp]\nclosing_speed = \"2 m/s\"\nmax_pressure = \"2.5 MPa\"\ntravel = \"3 um\"\nstop = \"closed\"";
const TABLE: (&str, &str) = (
    "viscosity = \"300 cP\"",
    "viscosity_table = [[\"1 1/s\", \"1 Pa s\"], [\"1e6 1/s\", \"0.1 Pa s\"]]",
);
const GRAVITY: &str = "gravity.acceleration=[\"0 m/s2\", \"-9.81 m/s2\", \"0 m/s2\"]";

#[test]
fn a_pressed_slab_by_the_explicit_scheme() {
    let lines = [
        "grid 10 x 15 x 4 cells of 2.0000 um, 3D",
        // Eight points per cell of 8 um3.
        "liquid 576 material points, 5.7600e-16 m3",
        "1200 kg/m3, K 1.000e9 Pa, viscosity 0.3 Pa s",
        "rigid body wall: 1 voxels, at rest",
        "rigid body top: 1 voxels, driven by the clamp",
        "walls partial slip, influence length 2.0000e-8 m (k = 5.000e7 1/m)",
        "sides x open, y symmetry, z symmetry",
        "clamp 2 m/s, at most 2.5000 MPa",
        // Twice the time at full speed.
        "end closed after 3.00 um of travel, at 3.0000e-6 s at the latest",
        // cell / (c + v) and rho cell^2 / (8 eta), half of it by the Courant number.
        "limits acoustic 2.186e-9 s, viscous 2.000e-9 s; the step is 0.5 (Courant number)",
        "time step 1.0000e-9 s, set by viscous",
        "lumen of 17.4 um 8.7 cells across",
        "measured with 12 cells across that lumen",
        "capillary pressure 10.0 kPa in a six-cell lumen, 0.40 % of the pressure limit",
    ];
    let said = says(&[], &[], &lines);
    assert!(!said.contains("not the paper's"), "{said}");
}

#[test]
fn the_same_by_the_implicit_scheme_and_by_others() {
    let lines = [
        // sqrt(K / rho) = 912.9 m/s.
        "sound waves Mach 2.2e-3",
        // A cell at the speed of the plate.
        "time step 1.0000e-6 s, set by advective",
        // One and a half cells of travel, 1.8 times.
        "steps about 3",
        // 310 unknowns, 600 cells, 576 points and the process.
        "memory 10 MB",
        "unknowns 3.10e2 velocities and pressures in 7.20e1 liquid cells",
    ];
    says(&IMPLICIT, &[], &lines);
    let coarser = [
        "grid.cell=2.9 um",
        "integrator.cfl=0.25",
        "grid.domain.max=[\"29 um\", \"29 um\", \"8.7 um\"]",
    ];
    let lines = [
        "grid 10 x 10 x 3 cells of 2.9000 um, 3D",
        "lumen of 17.4 um 6.0 cells across",
        "measured with 6 cells across that lumen",
        "with the default Courant number",
    ];
    says(&[], &coarser, &lines);
    // Boxes on cell faces, with cells of 17.4/4 um.
    let coarser = [
        "grid.cell=4 um",
        "grid.domain.max=[\"20 um\", \"32 um\", \"8 um\"]",
    ];
    let wp = "WP about 1.0 % (a small bond line), about 1.4 % (from two cell sizes, worst bond of the quick specimens)";
    says(&IMPLICIT, &coarser, &[wp]);
    let default = says(&[], &["integrator.cfl=0.5"], &[]);
    assert!(!default.contains("with the default"), "{default}");
    let not = "pressure, flow not measured with this update";
    says(&[], &["integrator.order=19"], &[not]);
}

#[test]
fn departures_from_the_paper_are_named() {
    let changes = [
        "integrator.pressure=cell-mean",
        "integrator.density_projection=0.04 cell",
        "contact.separation=1.6 um",
        "grid.points_per_direction=3",
        "output.snapshots=4",
    ];
    let lines = [
        // 27 points per cell, 2/3 um apart: 18 x 9 x 12.
        "liquid 1944 material points, 5.7600e-16 m3",
        "pressure from the mean J of each cell, not the paper's",
        "density projection after every 0.04 cell of motion, not the paper's",
        "contact separation 0.8 cell, not the shape function's own",
        "with the default contact separation, points per direction",
    ];
    says(&[], &changes, &lines);
}

#[test]
fn what_a_scene_does_without_is_left_out_and_no_more() {
    let drop = [
        "wall contact the scene has no rigid body",
        "wall friction the scene has no rigid body",
        "viscosity table Newtonian liquid, 0.1 Pa s",
        "body force gravity is zero",
        "clamp control no [clamp]",
        "load control no [clamp]",
        "mirror images",
        "periodic images no periodic side",
    ];
    let of_update = [
        "velocity filter only xpic and fmpm",
        "affine velocity field only points of apic",
        "cell-mean pressure each point has its own",
        "density projection no density_projection",
    ];
    let bench = Bench::with(&fall::CASE.replace("SCHEME", "explicit"));
    let free = [
        "boundary={ x = \"open\", y = \"open\", z = \"open\" }",
        "gravity.acceleration=[\"0 m/s2\", \"0 m/s2\", \"0 m/s2\"]",
        "integrator.scheme=explicit",
    ];
    leaves_out(&bench, &free, &[&drop[..], &of_update].concat());
    let of_implicit = [
        "PID no pressure limit",
        "shear rate computed only for written states",
    ];
    let implicit = [free[0], free[1], "integrator.scheme=implicit"];
    leaves_out(&bench, &implicit, &[&drop[..], &of_implicit].concat());
    let flat = ["grid.dimensions=2", "integrator.scheme=implicit"];
    let plan = bench.plan(&flat).unwrap();
    assert!(plan.contains("\nthird dimension plane strain"), "{plan}");

    // A bond line with all optional parts, by either scheme.
    let bench = Bench::with(&CASE.replace(TABLE.0, TABLE.1).replace(FILTER.0, ""));
    let all = [
        "boundary={ x = \"periodic\", y = \"open\" }",
        GRAVITY,
        "clamp.pid={ kp = 0.0, ki = 0.02, kd = 0.0 }",
    ];
    let explicit = [
        "integrator.velocity_update=xpic",
        "integrator.order=5",
        "integrator.pressure=cell-mean",
        "integrator.density_projection=0.04 cell",
    ];
    leaves_out(&bench, &[&all[..], &explicit].concat(), &of_update[1..2]);
    let implicit = ["integrator.scheme=implicit"];
    leaves_out(&bench, &[&all[..], &implicit].concat(), &of_implicit[1..]);
    let air = "air={ pressure = \"101.325 kPa\" }";
    let leaks = |time| format!("air={{ pressure = \"101.325 kPa\", leak_time = \"{time}\" }}");
    let [soon, late] = [leaks("1 ns"), leaks("1000 s")];
    let side = |z| format!("boundary={{ x = \"open\", z = \"{z}\" }}");
    let [open, mirror] = [side("open"), side("symmetry")];
    let closed = "beyond the sides the sides of the specimen trap air";
    for (changes, doubted) in [
        (["boundary={ z = \"periodic\" }", air], true),
        ([open.as_str(), air], false),
        ([mirror.as_str(), air], true),
        (["boundary={ z = \"periodic\" }", soon.as_str()], false),
        (["boundary={ z = \"periodic\" }", late.as_str()], true),
    ] {
        let plan = bench.plan(&[&changes[..], &implicit].concat()).unwrap();
        assert_eq!(plan.contains(closed), doubted, "{plan}");
    }
}

#[test]
fn walls_bodies_and_ends_of_every_kind() {
    let law = "\"partial-slip\"\ninfluence_length = \"0.01 cell\"";
    let frictionless = [
        "walls frictionless",
        "wall friction frictionless walls (k = 0)",
    ];
    says(&[(law, "\"frictionless\"")], &[], &frictionless);
    says(&[(law, "\"stick\"")], &[], &["walls stick"]);
    let slip = "walls partial slip, influence length 5.0000e-8 m (k = 2.000e7 1/m)";
    says(&[], &["contact.influence_length=50 nm"], &[slip]);
    // Bodies with the same name and motion are one body.
    let one_wall = ("velocity = \"clamp\"\nname = \"top\"\n", "");
    let free = (CLAMP, "[stop]\ntime = \"0.7 us\"");
    let open = ("x = \"open\"", "x = \"periodic\"");
    let lines = [
        "rigid body wall: 2 voxels, at rest",
        "sides x periodic, y symmetry, z symmetry",
        "end at 7.0000e-7 s",
        "1200 kg/m3, K 1.000e9 Pa, viscosity table, 1 Pa s at rest, 0.1 Pa s at 1e6 1/s",
    ];
    says(&[one_wall, free, open, TABLE], &[GRAVITY], &lines);
    let low = "box = { min = [\"0 um\", \"10 um\"";
    let velocity = format!("velocity = [\"1 m/s\", \"-0.5 m/s\", \"0 m/s\"]\n{low}");
    let lines = [
        "rigid body wall: 1 voxels, at rest",
        "rigid body wall: 1 voxels, moves at (1, -0.5, 0) m/s",
    ];
    says(&[one_wall, free, (low, &velocity)], &[], &lines);
    says(&[], &["clamp.stop=0.4 us"], &["end at 4.0000e-7 s"]);
    let limited = "end closed after 3.00 um of travel, at 2.0000e-6 s at the latest";
    says(&[], &["clamp.time_limit=2 us"], &[limited]);
    let unlimited = [
        "clamp 2 m/s, no pressure limit",
        "load control constant closing speed",
    ];
    says(&[("max_pressure = \"2.5 MPa\"\n", "")], &[], &unlimited);
    says(
        &[("2.5 MPa", "10 Pa")],
        &[],
        &["clamp 2 m/s, at most 10 Pa\n"],
    );
}

/// Four points per cell in plane strain. Touching boxes of liquid do not overlap.
#[test]
fn liquid_is_counted_in_plane_strain_and_side_by_side() {
    // 12 x 6 um and one cell of 2 um deep.
    let lines = [
        "grid 10 x 15 x 1 cells of 2.0000 um, plane strain",
        "liquid 72 material points, 1.4400e-16 m3",
    ];
    says(&[], &["grid.dimensions=2"], &lines);
    let more = "[[body]]\nmaterial = \"adhesive\"\nbox = { min = [\"4 um\", \"20 um\", \"0 um\"], max = [\"16 um\", \"24 um\", \"8 um\"] }\n[[body]]\nmaterial = \"adhesive\"\nbox = { min = [\"4 um\", \"24 um\", \"0 um\"], max = [\"16 um\", \"26 um\", \"8 um\"] }\n[boundary]";
    // 12 x 6 x 8 um, 12 x 4 x 8 um and 12 x 2 x 8 um, a point for each um3.
    let line = "liquid 1152 material points, 1.1520e-15 m3";
    says(&[("[boundary]", more)], &[], &[line]);
}
