//! Flows with modes that decay far more slowly than the width of their channels suggests: the linear solver must allow for them.

use crate::workbench::Workbench;

/// Adhesive that dries to a thousand times its viscosity in a press of five minutes.
#[test]
fn a_press_that_dries_its_adhesive_is_solved() {
    let wood = "--adhesive pf --size 40x96x40 --slab 14.5um --seed 1";
    let bench = Workbench::with_wood(wood, include_str!("../dries.toml"));
    let most = most_iterations(&bench);
    assert!(most < 70.0, "{most}");
}

/// A liquid that thins over seven decades, in cells of one voxel. Without the wider interval of the preconditioner a step takes
/// 399 iterations, and some are not solved.
#[test]
fn a_press_of_a_strongly_thinning_liquid_is_solved() {
    let case = r#"
[grid]
cell = "1 voxel"
[adhesive]
density = "1.2 g/cm3"
bulk_modulus = "1 GPa"
[adhesive.cross]
zero_rate = "1e5 Pa s"
infinite_rate = "0.01 Pa s"
time = "1 s"
exponent = 1.0
[contact]
law = "partial-slip"
influence_length = "14.5 nm"
[clamp]
closing_speed = "1 m/s"
max_pressure = "2.5 MPa"
stop = "closed"
time_limit = "5 us"
[integrator]
scheme = "implicit"
"#;
    let wood = "--adhesive pf --size 24x56x24 --slab 14.5um --seed 1";
    let most = most_iterations(&Workbench::with_wood(wood, case));
    assert!(most < 330.0, "{most}");
}

/// Presses, and returns the most iterations of a step.
fn most_iterations(bench: &Workbench) -> f64 {
    bench.press("run", &[], "");
    let each = bench.table("run/history.csv").column("solver_iterations");
    let most = each.iter().fold(0.0, |a: f64, b| a.max(*b));
    println!("at most {most} iterations in a step");
    most
}

/// A plate presses liquid along channels of one cell without friction, which are at right angles to the gap.
#[test]
fn narrow_channels_without_friction_are_solved() {
    let mut case = r#"
[grid]
cell = "2 um"
dimensions = 2
domain = { min = ["0 um", "0 um", "0 um"], max = ["80 um", "60 um", "2 um"] }
[adhesive]
density = "1.2 g/cm3"
bulk_modulus = "1 GPa"
viscosity = "1.3 Pa s"
[contact]
law = "frictionless"
[clamp]
closing_speed = "1 mm/s"
max_pressure = "2.5 MPa"
stop = "5 ms"
[integrator]
scheme = "implicit"
[boundary]
x = "open"
"#
    .to_owned();
    let mut add = |material: &str, [x0, x1, y0, y1]: [u32; 4]| {
        case += &format!(
            "[[body]]\n{material}\nbox = {{ min = [\"{x0} um\", \"{y0} um\", \"0 um\"], max = [\"{x1} um\", \"{y1} um\", \"2 um\"] }}\n"
        );
    };
    let (bottom, liquid) = (
        "material = \"rigid\"\nname = \"bottom\"",
        "material = \"adhesive\"",
    );
    add(bottom, [0, 80, 0, 4]);
    for x in (0..80).step_by(4) {
        add(bottom, [x, x + 2, 4, 44]);
        add(liquid, [x + 2, x + 4, 4, 44]);
    }
    add(
        "material = \"rigid\"\nname = \"top\"\nvelocity = \"clamp\"",
        [0, 80, 52, 56],
    );
    add(liquid, [0, 80, 44, 52]);
    let bench = Workbench::new();
    bench.write("case.toml", case);
    bench.done("mpm-run -q case.toml -o run");
}
