//! The plan of a run against numbers worked out by hand.

use crate::bench::Bench;

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
    let request = Bench::with(&text).read(changes);
    let plan = request.and_then(|request| request.explain());
    plan.map_err(|e| e.to_string())
}

#[track_caller]
fn assert_says(plan: &str, lines: &[&str]) {
    let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    let said: Vec<String> = plan.lines().map(words).collect();
    for line in lines {
        let found = said.iter().any(|said| said.starts_with(&words(line)));
        assert!(found, "'{line}' is not in\n{plan}");
    }
}

pub const IMPLICIT: [(&str, &str); 2] = [
    ("\"explicit\"", "\"implicit\""),
    ("velocity_update = \"xpic\"\norder = 5\n", ""),
];

#[test]
fn a_pressed_slab_by_the_explicit_scheme() {
    let said = plan(&[], &[]).unwrap();
    assert_says(
        &said,
        &[
            "grid 10 x 15 x 4 cells of 2.0000 um, 3D",
            // Eight points a cell of 8 um3.
            "liquid 576 material points, 5.7600e-16 m3",
            "1200 kg/m3, K 1.000e9 Pa, viscosity 0.3 Pa s",
            "rigid body wall: 1 voxels, at rest",
            "rigid body top: 1 voxels, driven by the clamp",
            "walls partial slip, influence length 2.0000e-8 m (k = 5.000e7 1/m)",
            "sides x open, y symmetry, z symmetry",
            "clamp 2 m/s, at most 2.5000 MPa",
            // Twice the time at full speed.
            "end closed after 3.00 um of travel, at the latest at 3.0000e-6 s",
            // cell / (c + v) and rho cell^2 / (8 eta), half of it by the Courant number.
            "limits acoustic 2.186e-9 s, viscous 2.000e-9 s; the Courant number 0.5",
            "time step 1.0000e-9 s, set by viscous",
            "lumens of 17.4 um, not this specimen's: 8.7 cells across",
            "measured with 12 cells across the lumen",
            "viscosity table Newtonian liquid, 0.3 Pa s",
            "body force gravity is zero",
            "periodic images no periodic side",
            "capillary pressure 10.0 kPa in a six-cell lumen, 0.40 % of the pressure limit",
        ],
    );
    for absent in [
        "third dimension",
        "wall friction",
        "load control",
        "velocity filter",
        "shear rate of points",
        "sound waves",
        "not the paper's",
    ] {
        assert!(!said.contains(absent), "{absent} in\n{said}");
    }
}

#[test]
fn the_same_by_the_implicit_scheme_and_by_plain_flip() {
    assert_says(
        &plan(&IMPLICIT, &[]).unwrap(),
        &[
            // sqrt(K / rho) = 912.9 m/s.
            "sound waves Mach 2.2e-3",
            // A cell at the speed of the plate.
            "time step 1.0000e-6 s, set by advective",
            // One and a half cells of travel, 1.8 times.
            "steps about 3",
            // 310 unknowns, 600 cells, 576 points and the process.
            "memory 10 MB",
            "unknowns 3.10e2 velocities and pressures in 7.20e1 liquid cells",
            "shear rate between snapshots known where a state is written",
        ],
    );
    let flip = [("velocity_update = \"xpic\"\norder = 5\n", "")];
    assert_says(
        &plan(&flip, &[]).unwrap(),
        &["velocity filter only xpic and fmpm"],
    );
    let said = plan(
        &[],
        &[
            "grid.cell=2.9 um",
            "integrator.cfl=0.25",
            "grid.domain.max=[\"29 um\", \"29 um\", \"8.7 um\"]",
        ],
    );
    assert_says(
        &said.unwrap(),
        &[
            "grid 10 x 10 x 3 cells of 2.9000 um, 3D",
            "lumens of 17.4 um, not this specimen's: 6.0 cells across",
            "measured with 6 cells across the lumen",
            "and the default Courant number",
        ],
    );
    let default = plan(&[], &["integrator.cfl=0.5"]).unwrap();
    assert!(!default.contains("and the default"), "{default}");
    assert_says(
        &plan(&[], &["integrator.order=19"]).unwrap(),
        &["pressure, flow not measured with this update"],
    );
}

#[test]
fn departures_from_the_paper_are_named() {
    let said = plan(
        &[],
        &[
            "integrator.pressure=cell-mean",
            "integrator.density_projection=0.04 cell",
            "contact.separation=1.6 um",
            "grid.points_per_direction=3",
            "output.snapshots=4",
        ],
    );
    let said = said.unwrap();
    assert_says(
        &said,
        &[
            // 27 points a cell, at 2/3 um: 18 x 9 x 12.
            "liquid 1944 material points, 5.7600e-16 m3",
            "pressure from the mean J of each cell, not the paper's",
            "density projection after every 0.04 cell of motion, not the paper's",
            "contact separation 0.8 cell, not the shape function's own",
            "and the default contact separation, points per direction",
        ],
    );
    for absent in [
        "cell-mean pressure",
        "density projection ",
        "no density_projection",
    ] {
        assert!(
            !said.split("left out").nth(1).unwrap().contains(absent),
            "{said}"
        );
    }
}

#[test]
fn plane_strain_is_one_layer_of_cells() {
    let said = plan(&[], &["grid.dimensions=2"]).unwrap();
    assert_says(
        &said,
        &[
            "grid 10 x 15 x 1 cells of 2.0000 um, plane strain",
            // Four points a cell, 12 x 6 um and one cell of 2 um deep.
            "liquid 72 material points, 1.4400e-16 m3",
            "third dimension plane strain",
        ],
    );
}

#[test]
fn walls_bodies_and_ends_of_every_kind() {
    let frictionless = [(
        "\"partial-slip\"\ninfluence_length = \"0.01 cell\"",
        "\"frictionless\"",
    )];
    assert_says(
        &plan(&frictionless, &[]).unwrap(),
        &[
            "walls frictionless",
            "wall friction frictionless walls (k = 0)",
        ],
    );
    let stick = [(
        "\"partial-slip\"\ninfluence_length = \"0.01 cell\"",
        "\"stick\"",
    )];
    assert_says(&plan(&stick, &[]).unwrap(), &["walls stick"]);
    assert_says(
        &plan(&[], &["contact.influence_length=50 nm"]).unwrap(),
        &["walls partial slip, influence length 5.0000e-8 m (k = 2.000e7 1/m)"],
    );
    // A body of the name and motion of another is part of it.
    let one_wall = [("velocity = \"clamp\"\nname = \"top\"\n", "")];
    let free = [
        one_wall[0],
        (
            "[clamp]\nclosing_speed = \"2 m/s\"\nmax_pressure = \"2.5 MPa\"\ntravel = \"3 um\"\nstop = \"closed\"",
            "[stop]\ntime = \"0.7 us\"\n[gravity]\nacceleration = [\"0 m/s2\", \"-9.81 m/s2\", \"0 m/s2\"]",
        ),
        ("x = \"open\"", "x = \"periodic\""),
        (
            "viscosity = \"300 cP\"",
            "viscosity_table = [[\"1 1/s\", \"1 Pa s\"], [\"1e6 1/s\", \"0.1 Pa s\"]]",
        ),
    ];
    let said = plan(&free, &[]).unwrap();
    assert_says(
        &said,
        &[
            "rigid body wall: 2 voxels, at rest",
            "sides x periodic, y symmetry, z symmetry",
            "end at 7.0000e-7 s",
            "1200 kg/m3, K 1.000e9 Pa, viscosity table, 1 Pa s at rest, 0.1 Pa s at 1e6 1/s",
            "clamp control no [clamp]",
        ],
    );
    for absent in ["body force", "periodic images", "viscosity table  "] {
        assert!(!said.contains(absent), "{absent} in\n{said}");
    }
    let moving = [
        free[0],
        free[1],
        (
            "box = { min = [\"0 um\", \"10 um\"",
            "velocity = [\"1 m/s\", \"-0.5 m/s\", \"0 m/s\"]\nbox = { min = [\"0 um\", \"10 um\"",
        ),
    ];
    assert_says(
        &plan(&moving, &[]).unwrap(),
        &[
            "rigid body wall: 1 voxels, at rest",
            "rigid body wall: 1 voxels, moves at (1, -0.5, 0) m/s",
        ],
    );
}

#[test]
fn ends_of_a_clamp() {
    assert_says(
        &plan(&[], &["clamp.stop=0.4 us"]).unwrap(),
        &["end at 4.0000e-7 s"],
    );
    assert_says(
        &plan(&[], &["clamp.time_limit=2 us"]).unwrap(),
        &["end closed after 3.00 um of travel, at the latest at 2.0000e-6 s"],
    );
    let unlimited = [("max_pressure = \"2.5 MPa\"\n", "")];
    assert_says(
        &plan(&unlimited, &[]).unwrap(),
        &[
            "clamp 2 m/s, no pressure limit",
            "load control constant closing speed",
        ],
    );
}

/// Boxes that touch share a face, which is no place.
#[test]
fn liquid_bodies_apart_and_side_by_side_add_up() {
    let more = "[[body]]\nmaterial = \"adhesive\"\nbox = { min = [\"4 um\", \"20 um\", \"0 um\"], max = [\"16 um\", \"24 um\", \"8 um\"] }\n[[body]]\nmaterial = \"adhesive\"\nbox = { min = [\"4 um\", \"24 um\", \"0 um\"], max = [\"16 um\", \"26 um\", \"8 um\"] }\n[boundary]";
    // 12 x 6 x 8 um, 12 x 4 x 8 um and 12 x 2 x 8 um, a point for each um3.
    let said = plan(&[("[boundary]", more)], &[]).unwrap();
    assert_says(&said, &["liquid 1152 material points, 1.1520e-15 m3"]);
}
