//! The built tools, and reading what the real `mpm-run` wrote.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use particle_file::ParticleFile;
use serde_json::Value;

use crate::Result;
use crate::study::printed;

/// A finished run.
pub struct Run {
    /// Its folder.
    pub folder: PathBuf,
}

/// The folder of the built tools: where this program itself was built.
pub fn bin_folder() -> PathBuf {
    let here = std::env::current_exe().unwrap_or_default();
    let folder = here.ancestors().find(|p| p.join("mpm-run").is_file());
    folder.map_or_else(|| PathBuf::from("target/release"), Path::to_path_buf)
}

/// A built tool.
pub(crate) fn tool(name: &str) -> Command {
    Command::new(bin_folder().join(name))
}

/// Writes the bond file of synthetic wood with voxels of 1.45 um and PF: so many voxels along x, y and z, and the thickness of the adhesive.
pub(crate) fn synthetic_bond(path: &Path, voxels: &str, slab: &str) -> Result<()> {
    let wood = format!(
        "synth-xct -q --adhesive pf --voxel 1.45um --seed 1 --size {voxels} --slab '{slab}' -o - | xct2particles -q - -o -"
    );
    bond(path, &wood, "")
}

/// Writes the bond file of the particle file that a pipe of tools prints, by options of `build-bondline`.
pub(crate) fn bond(path: &Path, wood: &str, options: &str) -> Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let (bin, bond) = (bin_folder(), path.display());
    let pipe = format!(
        "set -o pipefail; PATH=\"{}:$PATH\"; {wood} | build-bondline -q - {options} -o '{bond}'",
        bin.display()
    );
    printed(Command::new("bash").args(["-c", &pipe]))?;
    Ok(())
}

/// A material point of a state: place (m), velocity (m/s), volume (m3) and pressure (Pa).
pub(crate) struct Point {
    pub(crate) at: [f64; 3],
    pub(crate) velocity: [f64; 3],
    pub(crate) volume: f64,
    pub(crate) pressure: f64,
}

/// The material points of a state.
pub(crate) fn points(state: &ParticleFile) -> Result<Vec<Point>> {
    let (places, velocities) = (state.vectors("position")?, state.vectors("velocity")?);
    let (volumes, pressures) = (
        state.column::<f32>("volume")?,
        state.column::<f32>("pressure")?,
    );
    let point = |i: usize| Point {
        at: places[i].map(f64::from),
        velocity: velocities[i].map(f64::from),
        volume: f64::from(volumes[i]),
        pressure: f64::from(pressures[i]),
    };
    Ok((0..places.len()).map(point).collect())
}

/// The value under a key at any depth.
fn found<'a>(value: &'a Value, key: &str) -> Option<&'a Value> {
    match value {
        Value::Object(map) => (map.get(key)).or_else(|| map.values().find_map(|v| found(v, key))),
        Value::Array(list) => list.iter().find_map(|v| found(v, key)),
        _ => None,
    }
}

impl Run {
    /// A column of `history.csv`.
    pub fn history(&self, column: &str) -> Result<Vec<f64>> {
        let path = self.folder.join("history.csv");
        let mut reader = csv::Reader::from_path(&path)?;
        let at = reader.headers()?.iter().position(|name| name == column);
        let at = at.ok_or_else(|| format!("{} has no column {column}", path.display()))?;
        let number = |row: Result<csv::StringRecord, csv::Error>| {
            let number = row?.get(at).unwrap_or("").parse::<f64>();
            Ok(number.map_err(|e| format!("{column}: {e}"))?)
        };
        reader.records().map(number).collect()
    }

    /// Lines of `history.csv` as far as it is written.
    pub(crate) fn rows(&self) -> usize {
        let text = std::fs::read_to_string(self.folder.join("history.csv"));
        text.map_or(0, |text| text.lines().count())
    }

    /// Columns of `history.csv`.
    pub(crate) fn columns<const N: usize>(&self, names: [&str; N]) -> Result<[Vec<f64>; N]> {
        let mut columns = [const { Vec::new() }; N];
        for (column, name) in columns.iter_mut().zip(names) {
            *column = self.history(name)?;
        }
        Ok(columns)
    }

    /// The last values of columns of `history.csv`.
    pub(crate) fn ends<const N: usize>(&self, names: [&str; N]) -> Result<[f64; N]> {
        let columns = self.columns(names)?;
        if columns.iter().any(Vec::is_empty) {
            return Err("the history is empty".into());
        }
        Ok(columns.map(|column| column[column.len() - 1]))
    }

    /// The last state.
    pub(crate) fn last(&self) -> Result<ParticleFile> {
        Ok(ParticleFile::open(self.folder.join("final.mpts"))?)
    }

    /// The material points of the last state.
    pub(crate) fn points(&self) -> Result<Vec<Point>> {
        points(&self.last()?)
    }

    /// The states written on the way, in order, and the last.
    pub(crate) fn states(&self) -> Result<Vec<ParticleFile>> {
        let numbered = (0..).map(|number| self.folder.join(format!("snapshots/{number:04}.mpts")));
        let written = numbered.take_while(|path| path.is_file());
        let states = written.map(|path| Ok(ParticleFile::open(path)?));
        states.chain([self.last()]).collect()
    }

    /// The value of `summary.json` under a key at any depth.
    pub(crate) fn summary_value(&self, key: &str) -> Option<Value> {
        let text = std::fs::read_to_string(self.folder.join("summary.json")).ok()?;
        found(&serde_json::from_str(&text).ok()?, key).cloned()
    }

    /// A number of `summary.json`, by its key at any depth.
    pub fn summary(&self, key: &str) -> Option<f64> {
        self.summary_value(key)?.as_f64()
    }

    /// CPU time, s; NaN where the run did not end.
    pub(crate) fn cpu_s(&self) -> f64 {
        self.summary("cpu_s").unwrap_or(f64::NAN)
    }

    /// WP of the last state about the bond plane: bottom, top and total, um.
    pub(crate) fn weighted_penetration(&self) -> Result<[f64; 3]> {
        let state = self.folder.join("final.mpts");
        let table = printed(tool("wp-metrics").arg("--quiet").arg(state))?;
        let mut rows = csv::Reader::from_reader(table.as_bytes());
        let rows = rows.deserialize().filter_map(Result::ok);
        let rows: Vec<HashMap<String, String>> = rows.collect();
        let of = |side: &str| {
            let row = rows
                .iter()
                .find(|row| row.get("side").is_some_and(|of| of == side));
            let number = row.and_then(|row| row.get("wp_um")?.parse().ok());
            number.ok_or_else(|| format!("wp-metrics printed no {side}"))
        };
        Ok([of("bottom")?, of("top")?, of("total")?])
    }
}
