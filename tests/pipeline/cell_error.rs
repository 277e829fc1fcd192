//! Results carried on to cells of no size: `wp-metrics --finer`, `bond-figures table2 --errors` and
//! the band of `bond-figures pressure`.

use crate::workbench::{FINER, IMPLICIT, Workbench};

const BOTH: &str = "implicit/final.mpts --finer implicit-finer/final.mpts";

/// `implicit` and `implicit-finer`: the small press in cells of two voxels and of one.
fn pressed() -> Workbench {
    let bench = Workbench::with_bond();
    bench.press("implicit", &[IMPLICIT], "");
    bench.press("implicit-finer", &[IMPLICIT], FINER);
    bench
}

#[test]
fn a_finer_run_gives_errors_and_changes_nothing_else() {
    let bench = pressed();
    let [alone, fine] =
        ["implicit", "implicit-finer"].map(|run| bench.measured(&format!("{run}/final.mpts")));
    let both = bench.measured(BOTH);
    // The columns of before have the same numbers; the two last ones stay the last.
    for (before, now) in alone.rows.iter().zip(&both.rows) {
        let (first, last) = before.split_at(before.len() - 2);
        assert!(
            now.starts_with(first) && now.ends_with(last),
            "{before:?}\n{now:?}"
        );
    }
    for name in ["wp", "ep"] {
        let [value, error] =
            ["extrapolated", "error"].map(|what| both.column(&format!("{name}_{what}_um")));
        let [coarse, fine] = [&both, &fine].map(|table| table.column(&format!("{name}_um")));
        let [bottom, top] = [0, 1].map(|side| (fine[side] - coarse[side]).abs());
        for side in 0..3 {
            let (c, f) = (coarse[side], fine[side]);
            println!(
                "{name}: {c:.4} and {f:.4} um, so {:.4} +- {:.4}",
                value[side], error[side]
            );
            // No side is surer than both are on average, nor a total WP than the mean of its sides.
            let least = match (side, name) {
                (2, "wp") => 0.5 * error[0].hypot(error[1]),
                (2, _) => 0.0,
                _ => 0.5 * (bottom + top),
            };
            let expected = (f - c).abs().max(least);
            assert!((value[side] - (2.0 * f - c)).abs() < 1e-5);
            assert!((error[side] - expected).abs() < 1e-5);
        }
    }
    // The pressure is that of the last row of the history, on the body that the clamp drives.
    let last = bench.table("implicit/history.csv").last("pressure_top_Pa");
    let pressure = both.last("pressure_pa");
    assert!(
        (pressure / last - 1.0).abs() < 1e-5,
        "{pressure} and {last}"
    );
}

#[test]
fn table_2_and_the_pressure_figure_take_the_errors() {
    let bench = pressed();
    bench.press("flip", &["integrator.velocity_update=flip"], "");
    let text = bench.done(&format!(
        "wp-metrics -q {BOTH} -o implicit.csv
         wp-metrics -q flip/final.mpts --pressure -o flip.csv
         bond-figures table2 --run pf:flip=flip.csv --run pf:implicit=implicit.csv --errors errors.csv -o table2.csv
         bond-figures pressure --run flip=flip --run implicit=implicit --finer implicit=implicit-finer -o pressure.svg"
    ));
    let line = |name: &str| text.lines().rfind(|l| l.contains(name)).unwrap();
    assert_eq!(line(" implicit ").matches("+-").count(), 3, "{text}");
    assert_eq!(line(" flip ").split_whitespace().count(), 5, "{text}");
    // Six numbers of each of the two runs.
    assert_eq!(bench.table("errors.csv").rows.len(), 12);
    assert!(
        bench
            .table("table2.csv")
            .header
            .contains(&"note".to_owned())
    );
}

#[test]
fn what_is_no_finer_run_of_the_same_bond_is_refused() {
    let bench = pressed();
    bench.grow(
        "--adhesive pf --size 24x48x24 --slab 11.6um --seed 3",
        "other.mpts",
    );
    bench.done(&format!(
        "mpm-run -q case.toml --particles other.mpts -o other --set {IMPLICIT} {FINER} --set 'clamp.stop=0.1 us'"
    ));
    bench.press("thinner", &[IMPLICIT, "adhesive.viscosity=1 Pa s"], FINER);
    bench.press(
        "slipping",
        &[IMPLICIT, "contact.influence_length=1 um"],
        "--set grid.cell=1.45um",
    );
    let refused = "\
C --finer C | at least 2 times smaller
F --finer C | at least 2 times smaller
C --finer implicit-finer/snapshots/0000.mpts | the same state
C --finer other/final.mpts | different bonds
C --finer thinner/final.mpts | differ in [adhesive]
C --finer slipping/final.mpts | differ in [contact]
C --finer specimen.mpts | has no cell_m
specimen.mpts --pressure | has no pressure_pa
C F --finer F | needs a single file";
    let [coarse, fine] = ["implicit", "implicit-finer"].map(|run| format!("{run}/final.mpts"));
    for line in refused.lines() {
        let (files, sentence) = line.split_once(" | ").unwrap();
        let files = files.replace('C', &coarse).replace('F', &fine);
        bench.ends(2, &format!("wp-metrics -q {files}"), sentence);
    }
}

/// Half-size cells of a table's liquid under a plate that nears it through air: for an hour the viscous stress across
/// that air was left out, and the linear solver did not converge in step 2.
#[test]
fn a_finer_run_of_a_viscosity_table_is_solved() {
    let case = include_str!("../../pipelines/cases/pva-pf-implicit-frictionless.toml");
    let bench = Workbench::with_wood(
        "--adhesive pva-pf --size 24x48x24 --slab 11.6um --seed 2",
        case,
    );
    bench.press("finer", &["grid.cell=1.45 um", "clamp.time_limit=3 us"], "");
}
