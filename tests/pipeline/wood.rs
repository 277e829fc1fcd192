//! Presses of synthetic wood: what comes of its rough lumens alone.

use crate::workbench::{FINER, Workbench};

const PRESS: &str = include_str!("../../pipelines/cases/pf-implicit.toml");

/// `bond.mpts` of a synthetic specimen of so many voxels and `case.toml` with this text.
fn wood(size: &str, case: impl AsRef<[u8]>) -> Workbench {
    Workbench::with_wood(
        &format!("--adhesive pf --size {size} --slab 14.5um --seed 1"),
        case,
    )
}

/// Liquid that dries a million times as thick in the corners of cells at its walls is solved as other liquid is: those corners do not
/// make their neighbours as thick, and what drags them along is not what the solver's tolerance is relative to.
#[test]
fn liquid_that_dries_at_once_at_its_walls_is_solved() {
    let water = "[adhesive.water]\nsolids = 0.45\nuptake = \"20 um/s\"\ndiffusivity = \"1e-10 m2/s\"\n\
                 viscosity_by_solids = [[0.45, 1.0], [0.55, 100.0], [0.65, 1e6]]\n";
    let bench = wood("40x96x40", PRESS.to_owned() + water);
    sides_agree(&bench, "1e-3");
}

/// So is liquid of laws of four and nine decades, of which walls drag the thick along: to the pressures of a hundredth of the tolerance.
/// By one relative to that drag pressures are 25 and 40 % off, and sides part by 16 %.
#[test]
fn liquid_that_thins_by_decades_is_solved() {
    let newtonian = "viscosity = \"1300 cP\"";
    assert!(PRESS.contains(newtonian));
    for (size, law) in [
        (
            "24x64x24",
            "carreau_yasuda = { zero_rate = \"1e6 Pa s\", infinite_rate = \"1e-3 Pa s\", time = \"1e3 s\", index = 0.1 }",
        ),
        (
            "40x96x40",
            "herschel_bulkley = { yield_stress = \"10 kPa\", consistency = \"1 Pa s^n\", index = 0.8, regularisation_rate = \"1 1/s\" }",
        ),
    ] {
        let bench = wood(size, PRESS.replace(newtonian, law));
        let [usual, tight] = ["1e-3", "1e-5"].map(|tolerance| sides_agree(&bench, tolerance));
        // Steps after the first, of one end and length to a hundredth: steps part with the flow that sets them.
        let mut compared = 0;
        for [time, dt, usual] in usual.iter().skip(1) {
            let near = |a: f64, b: f64| (a / b - 1.0).abs() < 0.01;
            let same = |row: &&[f64; 3]| near(row[0], *time) && near(row[1], *dt);
            if let Some([_, _, tight]) = tight.iter().find(same) {
                let error = usual / tight - 1.0;
                println!("{size}: {error:+.4}");
                assert!(error.abs() < 0.03, "{size}: {usual} for {tight} Pa");
                compared += 1;
            }
        }
        assert!(compared > 3, "{size}: {compared} rows to compare");
    }
}

/// Presses too slowly for inertia to count, to this `tolerance`; asks for the same pressure on both sides in every step, and returns
/// their ends, lengths and pressures.
fn sides_agree(bench: &Workbench, tolerance: &str) -> Vec<[f64; 3]> {
    let tolerance_set = format!("integrator.tolerance={tolerance}");
    let changes = [
        "clamp.closing_speed=10 mm/s",
        "output.history_every=10 us",
        &tolerance_set,
    ];
    bench.press(tolerance, &changes, "");
    let history = bench.table(&format!("{tolerance}/history.csv"));
    let [times, lengths, bottom, top] = ["time_s", "dt_s", "pressure_bottom_Pa", "pressure_top_Pa"]
        .map(|name| history.column(name));
    for (step, (bottom, top)) in bottom.iter().zip(&top).enumerate() {
        let apart = (top / bottom - 1.0).abs();
        assert!(apart < 0.02, "row {step}: {bottom} and {top} Pa");
    }
    (0..times.len())
        .map(|i| [times[i], lengths[i], bottom[i]])
        .collect()
}

/// Cells of two voxels press adhesive as deep into wood as cells of one: what they lack behind fronts does not let tips run ahead,
/// which made it 7 % deeper.
#[test]
fn adhesive_gets_as_deep_in_cells_of_two_sizes() {
    let bench = wood("40x96x40", PRESS);
    let depths = ["", FINER].map(|cells| {
        bench.press("run", &[], &format!("{cells} --overwrite"));
        bench.measured("run/final.mpts").last("wp_um")
    });
    let error = depths[0] / depths[1] - 1.0;
    println!("weighted penetration in cells of two voxels and of one: {depths:?} um, {error:+.3}");
    assert!(error.abs() < 0.04);
}

/// Liquid that menisci alone move comes to rest, though their pressures jump from voxel to voxel: else steps stay at a millisecond.
#[test]
fn menisci_come_to_rest_in_wood() {
    let case = include_str!("../../pipelines/examples/wicking-pf.toml");
    assert!(case.contains("time = \"4 ms\""));
    let bench = wood(
        "32x64x32",
        case.replace("time = \"4 ms\"", "time = \"0.5 s\""),
    );
    bench.press("run", &[], "");
    let steps = bench.table("run/history.csv").rows.len();
    println!("{steps} steps");
    assert!(steps < 150, "{steps} steps");
}
