//! Tables of runs: what is refused before the first one starts, and that kills change no byte of the
//! results.

use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use crate::workbench::{Workbench, said};

/// A bench with the table of a sweep on its bond, its case by the implicit scheme.
fn bench(table: &str) -> Workbench {
    let bench = Workbench::with_bond();
    let case = String::from_utf8(bench.read("case.toml")).unwrap();
    bench.write("case.toml", case.replace("\"explicit\"", "\"implicit\""));
    bench.write("table.csv", table);
    bench
}

fn planned(bench: &Workbench, folder: &str) -> Vec<String> {
    bench.done(
        "bond-sweep",
        &[
            "plan",
            "-q",
            "table.csv",
            "--case",
            "case.toml",
            "-o",
            folder,
        ],
    );
    let runs = String::from_utf8(bench.read(&format!("{folder}/runs.txt"))).unwrap();
    runs.lines().map(str::to_owned).collect()
}

#[test]
fn a_bad_cell_is_named_before_any_run_starts() {
    for (table, words) in [
        (
            "adhesive.viscosity\n300 cP\n300\n",
            &["row 2, column adhesive.viscosity: ", "with a unit"][..],
        ),
        (
            "adhesive.viskosity\n300 cP\n",
            &["row 1, column adhesive.viskosity", "unknown field"],
        ),
        // Accepted as a case, refused with the bond: the cell does not divide its sides.
        (
            "particles,adhesive.viscosity,grid.cell\nbond.mpts,300 cP,2.9 um\nbond.mpts,300 cP,3 um\n",
            &["row 2, column grid.cell: ", "7.733 cells"],
        ),
        (
            "particles,integrator.scheme,integrator.pressure\nbond.mpts,implicit,\nbond.mpts,implicit,cell-mean\n",
            &["row 2, column integrator.pressure: "],
        ),
        (
            "particles,specimen.seed\nbond.mpts,1\n",
            &["row 1, column specimen.seed", "leave one of them empty"],
        ),
        (
            "particles\nspecimen.mpts\n",
            &["row 1, column particles", "holds a specimen"],
        ),
        (
            "particles\nabsent.mpts\n",
            &["row 1, column particles", "absent.mpts"],
        ),
        (
            "specimen.seed\n1\n-1\n",
            &["row 2, column specimen.seed: '-1'"],
        ),
        (
            "specimen.size\n8x8x8\n",
            &["row 1: its specimen: synth-xct: "],
        ),
        ("case\nabsent\n", &["row 1", "absent.toml"]),
        ("viscosity\n1\n", &["'viscosity' is no column"]),
    ] {
        let bench = bench(table);
        let arguments = [
            "plan",
            "-q",
            "table.csv",
            "--case",
            "case.toml",
            "-o",
            "sweep",
        ];
        let output = bench.run("bond-sweep", &arguments);
        let told = said(&output);
        assert_eq!(output.status.code(), Some(2), "{table}: {told}");
        for word in words {
            assert!(told.contains(word), "{word} is not in {told}");
        }
        assert!(!bench.path("sweep/runs.txt").exists(), "{table}");
    }
    let bench = bench("particles\nbond.mpts\n");
    bench.write("runs.txt", "mine");
    let output = bench.run(
        "bond-sweep",
        &["plan", "table.csv", "--case", "case.toml", "-o", "."],
    );
    assert!(
        said(&output).contains("not of a sweep"),
        "{}",
        said(&output)
    );
    assert_eq!(bench.read("runs.txt"), b"mine");
}

/// Rows of both schemes: sound, the same in other words, failing.
const TABLE: &str = "\
particles,adhesive.viscosity,integrator.scheme,clamp.max_pressure,clamp.closing_speed
bond.mpts,300 cP,implicit,,
bond.mpts,3 P,implicit,2.5 MPa,10 m/s
bond.mpts,300 cP,,2.5 MPa,10 m/s
bond.mpts,300 cP,explicit,,
bond.mpts,300 cP,explicit,5 GPa,500 m/s
";

#[test]
fn killed_runs_give_the_same_table_and_failed_ones_their_reason() {
    let bench = bench(TABLE);
    let runs = planned(&bench, "whole");
    assert_eq!(runs.len(), 4, "rows 1 and 3 are one run");
    for run in &runs {
        bench.done("bond-sweep", &["run", "-q", "--threads", "1", "whole", run]);
    }
    bench.done(
        "bond-sweep",
        &[
            "collect",
            "-q",
            "whole",
            "-o",
            "whole.csv",
            "--cost",
            "cost.csv",
        ],
    );
    let whole = String::from_utf8(bench.read("whole.csv")).unwrap();
    let rows: Vec<Vec<&str>> = whole
        .lines()
        .map(|line| line.split(',').collect())
        .collect();
    assert!(whole.starts_with("row,particles,adhesive.viscosity_cP,integrator.scheme,clamp.max_pressure_MPa,clamp.closing_speed_m/s,status,said,end,wp_bottom_um"), "{whole}");
    assert_eq!(rows[1][1..6], ["bond.mpts", "300", "implicit", "2.5", "10"]);
    assert_eq!(rows[1][6], "sound");
    assert_eq!(rows[1][1..], rows[3][1..], "the same run");
    assert_eq!(rows[1][1..], rows[2][1..], "in other words");
    assert_ne!(rows[1][9..], rows[4][9..], "the explicit scheme");
    let failed = rows[5].clone();
    assert!(
        ["failed", "not sound"].contains(&failed[6]) && !failed[7].is_empty(),
        "{failed:?}"
    );
    assert!(
        failed[failed.len() - 12..]
            .iter()
            .all(|cell| cell.is_empty()),
        "{failed:?}"
    );
    // The numbers are those of wp-metrics.
    let measured = bench.done(
        "wp-metrics",
        &[
            "-q",
            &format!("whole/runs/{}/final.mpts", sound(&bench, &runs)),
        ],
    );
    let total: Vec<&str> = measured.lines().nth(3).unwrap().split(',').collect();
    assert!(
        rows[1..].iter().any(|row| row.get(11) == Some(&total[4])),
        "{measured}{whole}"
    );

    assert_eq!(
        planned(&bench, "killed"),
        runs,
        "runs are called the same everywhere"
    );
    let early = bench.run("bond-sweep", &["collect", "killed", "-o", "killed.csv"]);
    assert_eq!(early.status.code(), Some(75), "{}", said(&early));
    assert!(
        said(&early).contains("5 of 5 rows have no result yet"),
        "{}",
        said(&early)
    );
    for (i, run) in runs.iter().enumerate() {
        for (k, signal) in ["TERM", "KILL", "TERM"].into_iter().enumerate() {
            let mut child = bench
                .command(
                    "bond-sweep",
                    &["run", "-q", "--threads", "1", "killed", run],
                )
                .stderr(Stdio::null())
                .spawn()
                .unwrap();
            sleep(Duration::from_millis(40 + 90 * (k + i) as u64));
            let kill = Command::new("kill")
                .args(["-s", signal, &child.id().to_string()])
                .stderr(Stdio::null())
                .status();
            assert!(kill.is_ok());
            let ended = child.wait().unwrap().code();
            assert!(matches!(ended, Some(0 | 75) | None), "{ended:?}");
        }
        bench.done(
            "bond-sweep",
            &["run", "-q", "--threads", "1", "killed", run],
        );
    }
    bench.done(
        "bond-sweep",
        &["collect", "-q", "killed", "-o", "killed.csv"],
    );
    assert_eq!(bench.read("killed.csv"), bench.read("whole.csv"));

    let figure = bench.run("bond-figures", &["response", "whole.csv", "-o", "r.svg"]);
    assert!(figure.status.success(), "{}", said(&figure));
    let drawn = String::from_utf8(bench.read("r.svg")).unwrap();
    assert!(
        drawn.contains("5 runs, of which 1 have no result"),
        "{drawn}"
    );
    // A bond file that changes under a plan is not what its rows say.
    bench.write("bond.mpts", bench.read("specimen.mpts"));
    std::fs::remove_file(bench.path(&format!("killed/runs/{}/row.csv", runs[0]))).unwrap();
    let changed = bench.run("bond-sweep", &["run", "killed", &runs[0]]);
    assert_eq!(changed.status.code(), Some(2), "{}", said(&changed));
    assert!(said(&changed).contains("plan again"), "{}", said(&changed));
}

/// The figure failed, and `make sweep` with it, though all was done.
#[test]
fn a_sweep_of_one_row_has_a_figure_and_rows_of_commas_are_none() {
    let bench = bench("particles,adhesive.viscosity\nbond.mpts,300 cP\n,\n,\n");
    let [run] = planned(&bench, "one").try_into().unwrap();
    bench.done("bond-sweep", &["run", "-q", "one", &run]);
    bench.done("bond-sweep", &["collect", "-q", "one", "-o", "one.csv"]);
    let arguments = ["response", "one.csv", "--result", "wp_um", "-o", "one.svg"];
    let figure = bench.run("bond-figures", &arguments);
    assert!(figure.status.success(), "{}", said(&figure));
    let drawn = String::from_utf8(bench.read("one.svg")).unwrap();
    assert!(
        drawn.contains("\n1 run; bars: error by the size of the cells\n")
            && drawn.contains("\nrow\n"),
        "{drawn}"
    );
}

/// One of the runs that ended sound.
fn sound(bench: &Workbench, runs: &[String]) -> String {
    let row = |run: &&String| bench.read(&format!("whole/runs/{run}/row.csv"));
    let sound = runs
        .iter()
        .find(|run| String::from_utf8_lossy(&row(run)).contains("\nsound"));
    sound.unwrap().clone()
}
