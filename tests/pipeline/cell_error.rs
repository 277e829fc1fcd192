//! Results carried on to cells of no size: `wp-metrics --finer`, `bond-figures table2 --errors` and
//! the band of `bond-figures pressure`.

use crate::workbench::{Workbench, said};

/// `implicit` and `implicit-finer`: the small press in cells of two voxels and of one.
fn pressed() -> Workbench {
    let bench = Workbench::with_bond();
    let scheme = "integrator.scheme=implicit";
    bench.pressed("implicit", &[scheme], &[]);
    let finer = [
        scheme,
        "grid.cell=1.45 um",
        "contact.influence_length=0.029 um",
    ];
    bench.pressed("implicit-finer", &finer, &[]);
    bench
}

/// Rows of a table, cells apart, and the place of a column.
fn table(text: &str) -> (Vec<Vec<String>>, impl Fn(&str) -> usize) {
    let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
    let header = cells(text.lines().next().unwrap());
    let rows = text.lines().skip(1).map(cells).collect();
    (rows, move |name: &str| {
        let found = header.iter().position(|column| column == name);
        found.unwrap_or_else(|| panic!("{name} is not in {header:?}"))
    })
}

#[test]
fn a_finer_run_gives_errors_and_changes_nothing_else() {
    let bench = pressed();
    let (coarse, fine) = ("implicit/final.mpts", "implicit-finer/final.mpts");
    let [alone, small] = [coarse, fine].map(|file| bench.done("wp-metrics", &["-q", file]));
    let both = bench.done("wp-metrics", &["-q", coarse, "--finer", fine]);
    // The columns of before are the first, with the same numbers.
    for (before, now) in alone.lines().zip(both.lines()) {
        assert!(now.starts_with(&format!("{before},")), "{before}\n{now}");
    }
    let (rows, at) = table(&both);
    let (fine_rows, fine_at) = table(&small);
    let number = |row: &[String], column: usize| row[column].parse::<f64>().unwrap();
    for (row, fine) in rows.iter().zip(&fine_rows) {
        for name in ["wp", "ep"] {
            let [c, f] = [
                number(row, at(&format!("{name}_um"))),
                number(fine, fine_at(&format!("{name}_um"))),
            ];
            let value = number(row, at(&format!("{name}_extrapolated_um")));
            let error = number(row, at(&format!("{name}_error_um")));
            println!(
                "{} {name}: {c:.4} and {f:.4} um, so {value:.4} +- {error:.4}",
                row[1]
            );
            // A total WP is no surer than the mean of its sides.
            let side = |row: usize| number(&rows[row], at("wp_error_um"));
            let least = match (row[1].as_str(), name) {
                ("total", "wp") => 0.5 * side(0).hypot(side(1)),
                _ => 0.0,
            };
            let expected = (f - c).abs().max(least);
            assert!((value - (2.0 * f - c)).abs() < 1e-5 && (error - expected).abs() < 1e-5);
        }
    }
    // The pressure is that of the last row of the history, on the body that the clamp drives.
    let text = String::from_utf8(bench.read("implicit/history.csv")).unwrap();
    let (history, column) = table(&text);
    let last = number(history.last().unwrap(), column("pressure_top_Pa"));
    let pressure = number(&rows[2], at("pressure_pa"));
    assert!(
        (pressure / last - 1.0).abs() < 1e-5,
        "{pressure} and {last}"
    );
}

#[test]
fn table_2_and_the_pressure_figure_take_the_errors() {
    let bench = pressed();
    bench.pressed("flip", &["integrator.velocity_update=flip"], &[]);
    let made = bench.shell(
        "wp-metrics -q implicit/final.mpts --finer implicit-finer/final.mpts -o implicit.csv
         wp-metrics -q flip/final.mpts --pressure -o flip.csv
         bond-figures table2 --run pf:flip=flip.csv --run pf:implicit=implicit.csv --errors errors.csv -o table2.csv
         bond-figures pressure --run flip=flip --run implicit=implicit --finer implicit=implicit-finer -o pressure.svg",
    );
    assert!(made.status.success(), "{}", said(&made));
    let text = String::from_utf8(made.stdout).unwrap();
    let line = |name: &str| text.lines().rfind(|l| l.contains(name)).unwrap().to_owned();
    assert_eq!(line(" implicit ").matches("+-").count(), 3, "{text}");
    assert_eq!(line(" flip ").matches(['+', '-']).count(), 3, "{text}");
    // Six numbers of each of the two runs.
    let errors = String::from_utf8(bench.read("errors.csv")).unwrap();
    assert_eq!(errors.lines().count(), 13, "{errors}");
    let table2 = String::from_utf8(bench.read("table2.csv")).unwrap();
    assert!(
        table2.lines().next().unwrap().contains(",note,"),
        "{table2}"
    );
}

#[test]
fn what_is_no_finer_run_of_the_same_bond_is_refused() {
    let bench = pressed();
    bench.shell("synth-xct -q --adhesive pf --size 24x48x24 --slab '11.6 um' --voxel '1.45 um' --seed 3 -o - | xct2particles -q - -o - | build-bondline -q - -o other.mpts");
    bench.done(
        "mpm-run",
        &[
            "-q",
            "case.toml",
            "--particles",
            "other.mpts",
            "-o",
            "other",
            "--set",
            "integrator.scheme=implicit",
            "--set",
            "grid.cell=1.45 um",
            "--set",
            "contact.influence_length=0.029 um",
            "--set",
            "clamp.stop=0.1 us",
        ],
    );
    let (coarse, fine) = ("implicit/final.mpts", "implicit-finer/final.mpts");
    for (arguments, words) in [
        (&[coarse, "--finer", coarse][..], "must be 2 times smaller"),
        (&[fine, "--finer", coarse], "must be 2 times smaller"),
        (
            &[coarse, "--finer", "implicit-finer/snapshots/0000.mpts"],
            "the same moment",
        ),
        (&[coarse, "--finer", "other/final.mpts"], "different bonds"),
        (
            &[coarse, "--finer", "specimen.mpts"],
            "does not say its cell_m",
        ),
        (
            &["specimen.mpts", "--pressure"],
            "does not say its pressure_pa",
        ),
        (&[coarse, fine, "--finer", fine], "belongs to one file"),
    ] {
        let output = bench.run("wp-metrics", &[&["-q"], arguments].concat());
        assert_eq!(
            output.status.code(),
            Some(2),
            "{arguments:?}: {}",
            said(&output)
        );
        assert!(
            said(&output).contains(words),
            "{arguments:?}: {}",
            said(&output)
        );
    }
}

/// Half-size cells of a table's liquid under a plate that nears it through air: for an hour the viscous stress across
/// that air was left out, and the linear solver did not converge in step 2.
#[test]
fn a_finer_run_of_a_viscosity_table_is_solved() {
    let bench = crate::quoted::bench();
    let made = bench.shell(
        "synth-xct -q --adhesive pva-pf --size 24x48x24 --slab '11.6 um' --voxel '1.45 um' --seed 2 -o - |
         xct2particles -q - -o - | build-bondline -q - -o pva.mpts
         mpm-run -q pipelines/cases/pva-pf-implicit-frictionless.toml --particles pva.mpts \\
           --set grid.cell='1.45 um' --set clamp.time_limit='3 us' -o finer",
    );
    assert!(made.status.success(), "{}", said(&made));
}
