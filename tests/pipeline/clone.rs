//! A copy of the Makefile and the pipelines with the built tools, in which `make` may be run and anything
//! changed. Left out, and said, where there is no `make`.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use studies::outputs;

use crate::workbench::{TOOLS, Workbench, said};

/// A key that makes every run two steps, of which the second meets wood.
const SHORT: &str = "SET=clamp.stop=4 us";

/// The copy; none where there is no `make`.
pub fn clone() -> Option<Workbench> {
    if Command::new("make").arg("--version").output().is_err() {
        println!("left out: there is no make");
        return None;
    }
    let bench = Workbench::new();
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let copied = Command::new("cp")
        .args(["-r", "Makefile", "pipelines"])
        .arg(bench.folder())
        .current_dir(top)
        .status();
    assert!(copied.unwrap().success());
    fs::create_dir_all(bench.path("target/release")).unwrap();
    for tool in TOOLS.iter().chain(&["study"]) {
        let built = outputs::bin_folder().join(tool);
        symlink(built, bench.path("target/release").join(tool)).unwrap();
    }
    Some(bench)
}

/// `make` in the copy, of one short run unless told.
pub fn command(bench: &Workbench, arguments: &[&str]) -> Command {
    let mut make = Command::new("make");
    // A make that runs the tests would hand its own flags down.
    make.env_remove("MAKEFLAGS").env_remove("MFLAGS");
    make.args(["-s", "CARGO=true", "RUNS=implicit", "ERROR=no", SHORT])
        .args(arguments)
        .current_dir(bench.folder())
        .stdin(Stdio::null());
    make
}

pub fn make(bench: &Workbench, arguments: &[&str]) -> Output {
    command(bench, arguments).output().unwrap()
}

/// Table 2 in `out`, by make's inner goal; none where it is refused.
pub fn table(bench: &Workbench, out: &str, arguments: &[&str]) -> Option<String> {
    let goal = format!("{out}/table2.csv");
    let out = format!("OUT={out}");
    let made = make(bench, &[arguments, &["BUILT=1", &out, &goal]].concat());
    let told = said(&made);
    assert!(
        made.status.success() || told.contains("mpm-run: ") || told.contains("build-bondline: "),
        "{told}"
    );
    made.status
        .success()
        .then(|| String::from_utf8(bench.read(&goal)).unwrap())
}
