//! Bodies beside and beyond periodic sides.

use crate::bench::{Bench, END, PLAIN, body, case, has};

/// A post under liquid under a clamp. The low side of the post is at `low` um in a domain `wide` um wide.
fn press(wide: i32, low: i32) -> Bench {
    let tables = r#"[contact]
law = "stick"
[clamp]
closing_speed = "1 m/s"
travel = "0.2 um"
[integrator]
scheme = "implicit"
[boundary]
x = "periodic"
"#;
    let bodies = [
        body(
            "rigid",
            "name = \"top\"\nvelocity = \"clamp\"",
            [0, 8, 12, 10],
        ),
        body("adhesive", "", [0, 6, 12, 8]),
        body("rigid", "name = \"bottom\"", [low, 0, low + 6, 6]),
    ];
    let tables = tables.to_owned() + &bodies.concat();
    Bench::with(&case("1 um", Some([0, 0, wide, 10]), &tables))
}

/// Boxes across and beyond a periodic side give the same result as inside the domain.
#[test]
fn a_box_is_the_same_wherever_it_lies_along_a_periodic_axis() {
    for scheme in ["integrator.scheme=implicit", "integrator.scheme=explicit"] {
        let pressure = |low: i32| {
            let ended = press(12, low).run("run", PLAIN, END, &[scheme]);
            ended.unwrap().unwrap().final_pressure_pa
        };
        let middle = pressure(3);
        for low in [9, 15, -9] {
            let off = pressure(low) / middle - 1.0;
            assert!(off.abs() < 1e-3, "{scheme}, {low}: {off}");
        }
    }
}

#[test]
fn a_period_is_a_whole_number_of_cells() {
    let said = press(12, 3).refusal(&["grid.domain.max.0=11.5 um"]);
    has(
        &said,
        &["11.500 cells long along x, whose sides are periodic"],
    );
}

/// Liquid between a floor and a sliding lid, sheared at 10 m/s over 4 um, while the lid moves over several periods.
#[test]
fn a_lid_drags_liquid_however_many_periods_it_has_gone() {
    let tables = r#"[contact]
law = "stick"
[stop]
time = "1.2 us"
[integrator]
scheme = "explicit"
[boundary]
x = "periodic"
y = "open"
"#;
    let lid = "name = \"lid\"\nvelocity = [\"10 m/s\", \"0 m/s\", \"0 m/s\"]";
    let bodies = [
        body("rigid", "name = \"floor\"", [0, 0, 4, 2]),
        body("rigid", lid, [0, 6, 4, 8]),
        body("adhesive", "", [0, 2, 4, 6]),
    ];
    let tables = tables.to_owned() + &bodies.concat();
    let bench = Bench::with(&case("1 um", Some([0, 0, 4, 8]), &tables));
    // 1.3 Pa s (10 m/s / 4 um)^2 over 4 x 4 x 1 um.
    let expected = 1.3 * (10.0_f64 / 4e-6).powi(2) * 16e-18;
    for scheme in ["explicit", "implicit"] {
        let change = format!("integrator.scheme={scheme}");
        let mode = crate::bench::OVERWRITE;
        bench.run("run", mode, END, &[&change]).unwrap();
        let power = *bench.numbers("viscous_power_W").last().unwrap();
        let off = power / expected - 1.0;
        assert!(off.abs() < 0.25, "{scheme}: {power} for {expected}");
    }
}
