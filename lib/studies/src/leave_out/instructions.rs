//! Instructions of two builds, which do not depend on what else the machine does.

use std::path::Path;
use std::process::Command;

/// Instructions of the steps of the full build and of the one without the feature: those of a
/// run to the later of two times (us) less those of a run to the earlier. `None` without valgrind.
pub fn count(
    programs: [&Path; 2],
    case: &Path,
    folder: &Path,
    until_us: [f64; 2],
) -> Option<[f64; 2]> {
    let steps = |program| {
        let [short, long] = until_us.map(|end| of_run(program, case, folder, end));
        Some(long? - short?)
    };
    Some([steps(programs[0])?, steps(programs[1])?])
}

fn of_run(program: &Path, case: &Path, folder: &Path, end_us: f64) -> Option<f64> {
    let output = Command::new("valgrind")
        .args(["--tool=cachegrind", "--cache-sim=no"])
        .arg("--cachegrind-out-file=/dev/null")
        .arg(program)
        .arg(case)
        .args(["--threads", "1", "--quiet", "--overwrite", "-o"])
        .arg(folder)
        .args(["--set", &format!("stop.time=\"{end_us} us\"")])
        .output()
        .ok()?;
    let said = String::from_utf8_lossy(&output.stderr);
    let line = said.lines().rev().find(|line| line.contains("refs:"))?;
    let number = line.split("refs:").nth(1)?.trim().replace(',', "");
    number.parse().ok().filter(|_| output.status.success())
}
