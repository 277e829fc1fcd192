//! Tables of runs: that bad ones are refused before one starts, and that kills change no byte of the
//! results.

use crate::workbench::{IMPLICIT, Workbench};

const PLAN: &str = "bond-sweep plan -q table.csv --case case.toml -o";

/// A bench with the table of a sweep on its bond, its case by the implicit scheme.
fn bench(table: &str) -> Workbench {
    let bench = Workbench::with_bond();
    let case = bench.text("case.toml");
    bench.write("case.toml", case.replace("\"explicit\"", "\"implicit\""));
    bench.write("table.csv", table);
    bench
}

/// Plans a sweep; its runs.
fn planned(bench: &Workbench, folder: &str) -> Vec<String> {
    bench.done(&format!("{PLAN} {folder}"));
    let runs = bench.text(&format!("{folder}/runs.txt"));
    runs.lines().map(str::to_owned).collect()
}

/// Tables, their lines parted by ;, and two parts of the sentence about each.
const BAD: &str = "\
adhesive.viscosity;300 cP;300 | row 2, column adhesive.viscosity: | has no unit
adhesive.viskosity;300 cP | row 1, column adhesive.viskosity | unknown field
particles,adhesive.viscosity,grid.cell;bond.mpts,300 cP,2.9 um;bond.mpts,300 cP,3 um | row 2, column grid.cell: | 7.733 cells
particles,integrator.scheme,integrator.pressure;bond.mpts,implicit,;bond.mpts,implicit,cell-mean | row 2 | column integrator.pressure:
particles,specimen.seed;bond.mpts,1 | row 1, column specimen.seed | leave one of them empty
particles;specimen.mpts | row 1, column particles | holds a specimen
particles;absent.mpts | row 1, column particles | absent.mpts
specimen.seed;1;-1 | row 2, column specimen.seed: | '-1' is not accepted: a whole number from 0
specimen.adhesive;glue | row 1, column specimen.adhesive: | pf or pva-pf
specimen.size;40x0x40 | row 1, column specimen.size: | 40x96x40
specimen.slab;14.5 | row 1, column specimen.slab: | no unit
specimen.grain_angle;5 um | row 1, column specimen.grain_angle: | angle
specimen.voxel;-1 um | row 1, column specimen.voxel: | greater than zero
specimen.colour;1 | 'specimen.colour' | there are adhesive, size
a.b,a.b;1,2 | two columns 'a.b' | table.csv
a.b\tc.d;1 | is not a column | separated by commas
a.b,c.d;1,2;1 | row 2 has 1 cells | in quotes
a.b,c.d;,;, | no row | below its header
a.b | no row | below its header
specimen.size;8x8x8 | row 1: its specimen: | synth-xct:
case;absent | row 1 | absent.toml
viscosity;1 | 'viscosity' | is not a column";

#[test]
fn a_bad_cell_is_named_before_any_run_starts() {
    let bench = bench("");
    for line in BAD.lines() {
        let [table, place, words] = line.split(" | ").collect::<Vec<_>>()[..] else {
            panic!("{line}");
        };
        bench.write("table.csv", table.replace(';', "\n") + "\n");
        let told = bench.ends(2, &format!("{PLAN} sweep"), place);
        assert!(told.contains(words), "{words} is not in {told}");
        assert!(!bench.path("sweep/runs.txt").exists(), "{table}");
    }
    bench.write("table.csv", "particles\nbond.mpts\n");
    bench.write("runs.txt", "mine");
    bench.ends(2, &format!("{PLAN} ."), "does not belong to a sweep");
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
    bench.done(
        "for run in $(cat whole/runs.txt); do bond-sweep run -q --threads 1 whole $run; done
         bond-sweep collect -q whole -o whole.csv --cost cost.csv",
    );
    check_rows(&bench);

    let again = planned(&bench, "killed");
    assert_eq!(again, runs, "runs are called the same everywhere");
    bench.ends(
        75,
        "bond-sweep collect killed -o killed.csv",
        "5 of 5 rows have no result yet",
    );
    for (i, run) in runs.iter().enumerate() {
        let line = format!("bond-sweep run -q --threads 1 killed {run}");
        for (k, signal) in ["TERM", "KILL", "TERM"].into_iter().enumerate() {
            let after = 0.04 + 0.09 * (k + i) as f64;
            let output = bench.shell(&format!(
                "timeout --preserve-status -s {signal} {after} {line}"
            ));
            let code = output.status.code();
            assert!(matches!(code, Some(0 | 75 | 137 | 143) | None), "{code:?}");
        }
        bench.done(&line);
    }
    bench.done("bond-sweep collect -q killed -o killed.csv");
    assert_eq!(bench.text("killed.csv"), bench.text("whole.csv"));

    bench.done("bond-figures response whole.csv -o r.svg");
    let drawn = bench.text("r.svg");
    assert!(
        drawn.contains("5 runs, 1 of them without a result"),
        "{drawn}"
    );
    // A bond file that changes under a plan is not what its rows say.
    bench.write("bond.mpts", bench.read("specimen.mpts"));
    let run = &runs[0];
    let line = format!("rm killed/runs/{run}/row.csv; bond-sweep run killed {run}");
    bench.ends(2, &line, "plan again");
}

/// Holds the collected rows of [`TABLE`] against one another and a measurement.
fn check_rows(bench: &Workbench) {
    let whole = bench.table("whole.csv");
    let names = "row,particles,adhesive.viscosity_cP,integrator.scheme,clamp.max_pressure_MPa,clamp.closing_speed_m/s,status,said,end,wp_bottom_um";
    assert!(
        whole.header.join(",").starts_with(names),
        "{:?}",
        whole.header
    );
    let rows = &whole.rows;
    assert_eq!(
        rows[0][1..7],
        ["bond.mpts", "300", "implicit", "2.5", "10", "sound"]
    );
    assert_eq!(rows[0][1..], rows[2][1..], "the same run");
    assert_eq!(rows[0][1..], rows[1][1..], "in other words");
    assert_ne!(rows[1][9..], rows[3][9..], "the explicit scheme");
    let failed = &rows[4];
    let status = failed[6].as_str();
    assert!(["failed", "not sound"].contains(&status), "{failed:?}");
    assert!(!failed[7].is_empty(), "{failed:?}");
    assert!(
        failed.iter().rev().take(12).all(String::is_empty),
        "{failed:?}"
    );
    // The numbers are those of wp-metrics.
    bench.press("alone", &[IMPLICIT], "");
    let measured = bench.measured("alone/final.mpts");
    assert_eq!(rows[0][11], measured.rows[2][4], "{measured:?}");
}

/// The figure failed, and `make sweep` with it, though all was done.
#[test]
fn a_sweep_of_one_row_has_a_figure_and_rows_of_commas_are_none() {
    let bench = bench("particles,adhesive.viscosity\nbond.mpts,300 cP\n,\n,\n");
    let [run] = planned(&bench, "one").try_into().unwrap();
    bench.done(&format!(
        "bond-sweep run -q one {run}; bond-sweep collect -q one -o one.csv
         bond-figures response one.csv --result wp_um -o one.svg"
    ));
    let drawn = bench.text("one.svg");
    for wanted in ["\n1 run; bars: error due to the cell size\n", "\nrow\n"] {
        assert!(drawn.contains(wanted), "{wanted}: {drawn}");
    }
}

/// Inputs of a sweep were replaced by its results; a table of the same name took the place of another's runs.
#[test]
fn a_sweep_keeps_its_table_and_is_of_one_table() {
    let bench = bench("particles,clamp.stop\nbond.mpts,0.05 us\n");
    let [run] = planned(&bench, "s").try_into().unwrap();
    bench.done(&format!("bond-sweep run -q s {run}"));
    let (collect, input) = ("bond-sweep collect s -o", "is an input");
    for kept in ["table.csv", "case.toml", "bond.mpts", "s/plan.json"] {
        let before = bench.read(kept);
        bench.ends(2, &format!("{collect} {kept}"), input);
        bench.ends(2, &format!("{collect} a.csv --cost {kept}"), input);
        assert!(bench.read(kept) == before, "{kept}");
    }
    let plan = bench.read("s/plan.json");
    bench.done("mkdir b; cp bond.mpts table.csv b; echo bond.mpts,0.1 us >>b/table.csv");
    let other = "bond-sweep plan -q b/table.csv --case case.toml -o s";
    bench.ends(2, other, "'s' holds the sweep of '");
    assert!(bench.read("s/plan.json") == plan);
    let own = format!("bond-sweep plan table.csv --case s/runs/{run}/case.toml -o s");
    bench.ends(2, &own, "would be replaced by a file of the sweep");
    // Rows added, the folder moved with its table, the table renamed.
    bench.done(&format!(
        "echo bond.mpts,0.1 us >>table.csv; {PLAN} s; mkdir c; mv s c; cp case.toml bond.mpts c; mv table.csv c
         cd c; bond-sweep plan -q table.csv --case case.toml -o s; mv table.csv t.csv
         bond-sweep plan -q t.csv --case case.toml -o s"
    ));
}

/// A pipe was a file called `-`.
#[test]
fn cases_tables_and_what_a_page_shows_may_come_from_a_pipe() {
    let bench = bench("particles,clamp.stop\nbond.mpts,0.05 us\n");
    let runs = planned(&bench, "s");
    bench.done(
        "cat table.csv | bond-sweep plan -q - --case case.toml -o p; cmp s/runs.txt p/runs.txt
         cat case.toml | bond-sweep plan -q table.csv --case - -o q; cmp s/runs.txt q/runs.txt
         bond-sweep plan -q - --case case.toml -o p <table.csv
         for name in case.toml -; do cat case.toml | mpm-run -q $name --particles bond.mpts -o r$name; done
         mpm-run -q case.toml --particles - -o b <bond.mpts
         cmp r-/history.csv rcase.toml/history.csv; cmp r-/history.csv b/history.csv
         wp-metrics -q r-/final.mpts -o wp.csv; bond-figures pressure --run r- -o p.png -o p.svg",
    );
    assert_eq!(runs.len(), 1);
    let page = |what: &str, file: &str| {
        let [named, piped] = [("", file), (&*format!("cat {file} | "), "-")].map(|(pipe, name)| {
            let line = format!("{pipe}bond-report --{what} x={name} -o page.html");
            bench.done(&line);
            let record = bench.text("page.html.provenance.json");
            let hash = record.split("\"xxh3\": ").nth(1).map(str::to_owned);
            let body = bench.text("page.html");
            let shown = body.split("<h2").nth(1).map(str::to_owned);
            assert!(hash.is_some(), "{record}");
            (hash, shown)
        });
        assert_eq!(named, piped, "{what}");
    };
    for (what, file) in [
        ("table", "wp.csv"),
        ("experiment", "wp.csv"),
        ("picture", "p.png"),
        ("picture", "p.svg"),
        ("state", "r-/final.mpts"),
    ] {
        page(what, file);
    }
    for line in [
        "bond-report --table a=- --picture b=- -o O",
        "bond-sweep plan - --case - -o O",
        "mpm-run - --particles - -o O",
        "bond-figures map --map - --map - -o O.svg",
    ] {
        bench.ends(2, line, "'-' can be read only once");
    }
}

/// A specimen that finds no room was a fault of the table.
#[test]
fn a_plan_that_cannot_be_written_ends_with_1() {
    let bench = bench("specimen.seed,clamp.stop\n7,0.05 us\n");
    let full = format!("prlimit --fsize=4096 {PLAN} full");
    bench.ends(1, &full, "row 1: its specimen: synth-xct: cannot write");
    bench.write("file", "");
    bench.ends(
        1,
        &format!("{PLAN} file/s"),
        "row 1: its specimen: cannot make",
    );
    bench.done(&format!("{PLAN} full"));
}
