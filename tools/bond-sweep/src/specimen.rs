//! Synthetic specimens of a sweep: their options, checked here, and their bond files, made by the
//! tools of the pipeline.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use cli::{Failure, InputRecord, Status};
use units::{Angle, Length};
use xxhash_rust::xxh3::xxh3_64;

/// Options of `synth-xct` as columns spell them and their values by default: the quick specimen of
/// pipelines/20-specimens.mk. One that is empty is not given.
pub const QUICK: [(&str, &str); 6] = [
    ("adhesive", "pf"),
    ("size", "40x96x40"),
    ("slab", "14.5 um"),
    ("voxel", "1.45 um"),
    ("grain_angle", ""),
    ("seed", "1"),
];

/// Why `value` is none of an option, if it is not; what depends on several options is found when
/// the specimen is grown.
pub fn check(option: &str, value: &str) -> Result<(), String> {
    let (accepted, needed) = match option {
        "adhesive" => (["pf", "pva-pf"].contains(&value), "pf or pva-pf"),
        "size" => {
            let mut edges = value.split('x').map(|n| n.parse::<u32>());
            let three = edges.clone().count() == 3 && edges.all(|n| n.is_ok_and(|n| n > 0));
            (three, "voxels along x, y and z such as 40x96x40")
        }
        "seed" => (value.parse::<u64>().is_ok(), "a whole number from 0"),
        other => {
            let found = match other {
                "grain_angle" => units::si::<Angle>(value),
                _ => units::positive::<Length>(value),
            };
            return found.map(|_| ()).map_err(|e| e.to_string());
        }
    };
    match accepted {
        true => Ok(()),
        false => Err(format!("'{value}' is not accepted: {needed} is needed")),
    }
}

/// A synthetic specimen by the values of all its options.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Recipe(pub [String; QUICK.len()]);

impl Recipe {
    /// The quick specimen with some options changed.
    pub fn quick_but(changes: &[(&str, &str)]) -> Self {
        let value = |(option, default): (&str, &str)| {
            let changed = changes.iter().find(|(name, _)| *name == option);
            changed.map_or(default, |(_, value)| value).to_owned()
        };
        Self(QUICK.map(value))
    }

    /// What tells it from all others, for this version of the tools.
    pub fn identity(&self) -> String {
        format!("{} {}", env!("CARGO_PKG_VERSION"), self.0.join("|"))
    }

    /// Its bond file, seen from the folder of the sweep.
    pub fn bond(&self) -> PathBuf {
        let name = format!("{:016x}", xxh3_64(self.identity().as_bytes()));
        Path::new("specimens").join(name).join("bond.mpts")
    }

    /// Makes its bond file below `sweep`, where there is none; an error is the exit status of the tools and what they say.
    pub fn make(&self, sweep: &Path) -> Result<(), (Status, String)> {
        let bond = sweep.join(self.bond());
        if bond.is_file() {
            return Ok(());
        }
        let folder = bond.with_file_name("");
        fs::create_dir_all(&folder).map_err(|e| {
            let said = format!("cannot make '{}': {e}", folder.display());
            (Status::Failed, said)
        })?;
        let [stack, experiment] = ["specimen.tif", "experiment.mpts"].map(|n| folder.join(n));
        let values = QUICK.iter().zip(&self.0);
        let options: Vec<String> = values
            .filter(|(_, value)| !value.is_empty())
            .flat_map(|((option, _), value)| {
                [format!("--{}", option.replace('_', "-")), value.clone()]
            })
            .collect();
        run("synth-xct", |tool| tool.args(options).arg("-o").arg(&stack))?;
        run("xct2particles", |tool| {
            tool.arg(&stack).arg("-o").arg(&experiment)
        })?;
        run("build-bondline", |tool| {
            tool.arg(&experiment).arg("-o").arg(&bond)
        })
    }
}

/// Runs a tool of the pipeline to its end: the one beside this, or the one on the path.
fn run(
    name: &str,
    arguments: impl FnOnce(&mut Command) -> &mut Command,
) -> Result<(), (Status, String)> {
    let beside = std::env::current_exe().map(|own| own.with_file_name(name));
    let mut tool = match beside {
        Ok(path) if path.is_file() => Command::new(path),
        _ => Command::new(name),
    };
    let ended = arguments(tool.arg("--quiet").stdin(Stdio::null())).output();
    let ended = ended.map_err(|e| (Status::Failed, format!("cannot start {name}: {e}")))?;
    let status = match ended.status.code() {
        Some(0) => return Ok(()),
        Some(2) => Status::Usage,
        Some(3) => Status::Data,
        _ => Status::Failed,
    };
    let said = String::from_utf8_lossy(&ended.stderr);
    Err(match said.trim() {
        "" => (status, format!("{name}: {}", ended.status)),
        said => (status, said.to_owned()),
    })
}

/// The hash of a bond file's content as it stands in plans.
pub fn content(path: &Path) -> Result<String, Failure> {
    InputRecord::of_file(path, path.display().to_string()).map(|record| record.xxh3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn specimens_are_told_apart_by_every_option() {
        let quick = Recipe::quick_but(&[]);
        assert_eq!(quick, Recipe::quick_but(&[("seed", "1")]));
        for (option, _) in QUICK {
            let other = Recipe::quick_but(&[(option, "7")]);
            assert_ne!(quick.bond(), other.bond());
        }
    }
}
