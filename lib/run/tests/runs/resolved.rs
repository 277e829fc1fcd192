//! `resolved.toml`: all keys with their values; used as a case file it repeats the run.

use std::fs;
use std::path::Path;

use particle_file::ParticleFile;

use crate::bench::{Bench, END, PLAIN, everything, has};

/// The results in a run folder that do not name its inputs: history and points.
fn results(folder: &Path) -> Vec<(String, String)> {
    let files = everything(folder).into_iter();
    let result = |(name, bytes): (String, Vec<u8>)| match name.rsplit_once('.')?.1 {
        "csv" => Some((name, String::from_utf8(bytes).unwrap())),
        "mpts" => {
            let file = ParticleFile::open(folder.join(&name)).unwrap();
            Some((name, format!("{:016x}", file.sum().unwrap())))
        }
        _ => None,
    };
    files.filter_map(result).collect()
}

/// Runs a case and its `resolved.toml`, compares the results and returns the text of `resolved.toml`.
fn runs_again(bench: &Bench) -> String {
    bench.ran("first", PLAIN, END);
    let resolved = fs::read_to_string(bench.path("first/resolved.toml")).unwrap();
    let again = Bench::with(&resolved);
    again.ran("first", PLAIN, END);
    let [first, second] = [bench, &again].map(|bench| results(&bench.path("first")));
    assert!(first.len() > 2 && first == second, "{resolved}");
    let text = fs::read_to_string(again.path("first/resolved.toml")).unwrap();
    let [one, other]: [toml::Table; 2] = [&resolved, &text].map(|text| text.parse().unwrap());
    assert_eq!(one, other, "nothing is left to resolve");
    resolved
}

#[test]
fn an_explicit_case_with_its_defaults_is_the_same_run() {
    let text = runs_again(&Bench::explicit());
    let lines = [
        "shape = \"gimp\" # default",
        "points_per_direction = 2 # default",
        "# cavitation_pressure: unlimited (Eq. 1)",
        "max_pressure = \"2.5 MPa\"\n",
        "pid.ki = 0.02 # default",
        "# time_limit: not used",
        "velocity_update = \"flip\" # default",
        "cfl = 0.5 # default",
        "# tolerance: not used",
        "acceleration = [\"0 m/s2\", \"0 m/s2\", \"0 m/s2\"] # default",
        "# [stop]: not given",
    ];
    has(&text, &lines);
}

#[test]
fn an_implicit_case_with_its_defaults_is_the_same_run() {
    let text = runs_again(&Bench::new("scheme = \"implicit\"", "closed", "1 us"));
    let lines = [
        "# shape: not used",
        "# pid.ki: not used",
        "stop = \"closed\"\n",
        "time_limit = \"8 us\" # default",
        "cfl = 1.0 # default",
        "tolerance = 0.001 # default",
    ];
    has(&text, &lines);
}

/// No clamp, no walls, no domain; default rows and box.
#[test]
fn a_free_drop_with_its_defaults_is_the_same_run() {
    let case = "[grid]\ncell = \"1.7 um\"\n[adhesive]\ndensity = \"1 g/cm3\"\nbulk_modulus = \"1 GPa\"\nviscosity = \"1 cP\"\n[integrator]\nscheme = \"explicit\"\n[stop]\ntime = \"0.01 us\"\n[[body]]\nmaterial = \"adhesive\"\nvelocity = [\"1 m/s\", \"0 m/s\", \"0 m/s\"]\nbox = { min = [\"0.1 um\", \"0 um\", \"0 um\"], max = [\"10.3 um\", \"7 um\", \"5 um\"] }\n[boundary]\nx = \"periodic\"\n";
    let text = runs_again(&Bench::with(case));
    let lines = [
        "domain.min = [\"0.1 um\", \"0 m\", \"0 m\"] # default",
        "history_every = \"0.01 ns\" # default",
        "# [clamp]: not given",
        "x = \"periodic\"\n",
    ];
    has(&text, &lines);
}
