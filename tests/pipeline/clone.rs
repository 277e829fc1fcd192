//! A copy of the Makefile and the pipelines with the built tools, in which `make` may be run and anything
//! changed. Left out, and said, where there is no `make`.

use std::process::{Command, Output, Stdio};

use studies::outputs;

use crate::workbench::{Workbench, root, said};

/// A key that makes every run two steps, of which the second meets wood.
const SHORT: &str = "SET=clamp.stop=4 us";

/// `make`, not told the flags of a make that runs the tests; none where it is not installed.
pub fn available() -> Option<Command> {
    let mut make = Command::new("make");
    if make.arg("--version").output().is_err() {
        println!("left out: there is no make");
        return None;
    }
    let mut make = Command::new("make");
    make.env_remove("MAKEFLAGS")
        .env_remove("MFLAGS")
        .stdin(Stdio::null());
    Some(make)
}

/// The copy; none where there is no `make`.
pub fn clone() -> Option<Workbench> {
    available()?;
    let bench = Workbench::new();
    bench.done(&format!(
        "cp -r '{0}/Makefile' '{0}/pipelines' .; mkdir -p target/release
         for tool in $(sed -n 's/^TOOLS := //p' Makefile) study; do ln -s '{1}'/$tool target/release; done",
        root().display(),
        outputs::bin_folder().display()
    ));
    Some(bench)
}

/// `make` in the copy, of one short run unless told.
pub fn command(bench: &Workbench, arguments: &[&str]) -> Command {
    let mut make = available().expect("make was there");
    make.args(["-s", "CARGO=true", "RUNS=implicit", "ERROR=no", SHORT])
        .args(arguments)
        .current_dir(bench.folder());
    make
}

pub fn make(bench: &Workbench, arguments: &[&str]) -> Output {
    command(bench, arguments).output().unwrap()
}

/// Table 2 in `out`, by make's inner goal; none where it is refused.
pub fn table(bench: &Workbench, out: &str, arguments: &[&str]) -> Option<String> {
    let goal = format!("{out}/table2.csv");
    let made = make(
        bench,
        &[arguments, &["BUILT=1", &format!("OUT={out}"), &goal]].concat(),
    );
    let (well, told) = (made.status.success(), said(&made));
    let refused = told.contains("mpm-run: ") || told.contains("build-bondline: ");
    assert!(well || refused, "{told}");
    well.then(|| bench.text(&goal))
}
