//! `make verify`: every verification scene by every scheme and update that applies, against
//! its closed form or reference; writes case files and a CSV.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use studies::outputs;
use studies::verification::{Scene, channel, couette, incline, slit, squeeze, tait, washburn};

/// A way to run a scene: label and the lines of `[integrator]`.
struct Method {
    label: &'static str,
    lines: &'static str,
}

const XPIC: Method = Method {
    label: "explicit XPIC(5)",
    lines: "scheme = \"explicit\"\nvelocity_update = \"xpic\"\norder = 5\n",
};
const FLIP: Method = Method {
    label: "explicit FLIP",
    lines: "scheme = \"explicit\"\nvelocity_update = \"flip\"\n",
};
const APIC: Method = Method {
    label: "explicit APIC",
    lines: "scheme = \"explicit\"\nvelocity_update = \"apic\"\n",
};
const IMPLICIT: Method = Method {
    label: "implicit",
    lines: "scheme = \"implicit\"\ntolerance = 1e-4\n",
};

/// Short steps, where the compression itself is looked at.
const FINE: Method = Method {
    label: "implicit CFL 0.05",
    lines: "scheme = \"implicit\"\ntolerance = 1e-4\ncfl = 0.05\n",
};

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [cases, results, only @ ..] = words.as_slice() else {
        eprintln!("usage: verify CASE_FOLDER RESULT_FOLDER [NAME_PART...]");
        return ExitCode::from(2);
    };
    match study(Path::new(cases), Path::new(results), only) {
        Ok(failed) => ExitCode::from(u8::from(failed > 0)),
        Err(said) => {
            eprintln!("verify: {said}");
            ExitCode::FAILURE
        }
    }
}

/// Scenes with the methods that apply to each.
fn plan() -> Vec<(Scene, Vec<&'static Method>)> {
    let mut list: Vec<(Scene, Vec<&Method>)> = Vec::new();
    let offsets = [0.0, 0.25, 0.5, 0.75];
    for offset in offsets {
        list.push((
            incline::scene(6, offset, 20e-6),
            vec![&FLIP, &XPIC, &IMPLICIT],
        ));
    }
    for n in [3, 6, 12] {
        for offset in offsets.into_iter().chain([0.95]) {
            list.push((
                channel::scene(n, offset, None, 3e-6),
                vec![&XPIC, &IMPLICIT],
            ));
        }
    }
    list.push((
        channel::scene(6, 0.25, Some(0.1), 3e-6),
        vec![&XPIC, &IMPLICIT],
    ));
    for offset in offsets {
        list.push((
            couette::scene(6, offset, 0.1, 3e-6),
            vec![&FLIP, &XPIC, &IMPLICIT],
        ));
    }
    for n in [3, 6, 12] {
        for offset in [[0.0, 0.0], [0.25, 0.0], [0.5, 0.0], [0.0, 0.5]] {
            let explicit = n == 6 && offset[0] < 0.4;
            let methods = if explicit {
                vec![&FLIP, &XPIC, &APIC, &IMPLICIT]
            } else {
                vec![&IMPLICIT]
            };
            list.push((slit::scene(n, offset), methods));
        }
    }
    for n in [3, 6, 12] {
        for offset in [0.0, 0.25, 0.5] {
            list.push((washburn::scene(n, offset), vec![&IMPLICIT]));
        }
    }
    for n in [2, 3, 6] {
        for offset in offsets {
            let methods = if n == 6 {
                vec![&XPIC, &IMPLICIT]
            } else {
                vec![&IMPLICIT]
            };
            list.push((squeeze::scene(n, offset), methods));
        }
    }
    list.push((tait::scene(), vec![&FLIP, &XPIC, &FINE]));
    list
}

/// Runs everything whose name contains one of `only`; returns how many runs failed.
fn study(cases: &Path, results: &Path, only: &[String]) -> Result<usize, String> {
    let out = PathBuf::from("out/verify");
    for folder in [cases, results, &out] {
        std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    }
    let mut csv = String::from("case,method,against,quantity,value,reference,error,steps,wall_s\n");
    let mut failed = 0;
    for (scene, methods) in plan() {
        if !only.is_empty() && !only.iter().any(|part| scene.name.contains(part.as_str())) {
            continue;
        }
        for method in methods {
            let name = format!(
                "{}-{}",
                scene.name,
                method.label.replace(['(', ')'], "").replace(' ', "-")
            );
            let case = cases.join(format!("{name}.toml"));
            std::fs::write(&case, scene.case.text(method.lines)).map_err(|e| e.to_string())?;
            let measured = outputs::run(&case, &out.join(&name), &[])
                .and_then(|run| Ok(((scene.measure)(&run)?, run)));
            match measured {
                Ok((list, run)) => {
                    for m in list {
                        println!(
                            "{:<28} {:<18} {:<34} {:+.4}",
                            scene.name, method.label, m.what, m.error
                        );
                        let _ = writeln!(
                            csv,
                            "{},{},{},{},{:.6e},{:.6e},{:.6e},{},{:.2}",
                            scene.name,
                            method.label,
                            scene.against,
                            m.what,
                            m.value,
                            m.reference,
                            m.error,
                            run.summary("steps").unwrap_or(f64::NAN),
                            run.wall_s
                        );
                    }
                }
                Err(said) => {
                    failed += 1;
                    println!("{:<28} {:<18} FAILED: {said}", scene.name, method.label);
                    let _ = writeln!(
                        csv,
                        "{},{},{},failed,,,,,",
                        scene.name, method.label, scene.against
                    );
                }
            }
        }
    }
    let path = results.join("verification.csv");
    std::fs::write(&path, csv).map_err(|e| format!("{}: {e}", path.display()))?;
    Ok(failed)
}
