//! A copy of the Makefile and the pipelines with the built tools, in which `make` may be run and anything
//! changed.

use std::process::{Command, Output, Stdio};

use studies::outputs;

use crate::workbench::{Workbench, root, said};

/// A key that makes every run two steps, of which the second meets wood.
const SHORT: &str = "SET=clamp.stop=4 us";

/// `make`, not told the flags of a make that runs the tests.
pub fn gnu_make() -> Command {
    let mut make = Command::new("make");
    make.env_remove("MAKEFLAGS")
        .env_remove("MFLAGS")
        .stdin(Stdio::null());
    make
}

/// The copy.
pub fn clone() -> Workbench {
    let bench = Workbench::new();
    bench.done(&format!(
        "cp -r '{0}/Makefile' '{0}/pipelines' .; mkdir -p target/release
         for tool in $(sed -n 's/^TOOLS := //p' Makefile) study; do ln -s '{1}'/$tool target/release; done",
        root().display(),
        outputs::bin_folder().display()
    ));
    bench
}

/// `make` in the copy, of one short run unless told.
pub fn command(bench: &Workbench, arguments: &[&str]) -> Command {
    let mut make = gnu_make();
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
