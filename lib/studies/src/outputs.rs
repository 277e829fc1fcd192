//! The built tools, and reading what the real `mpm-run` wrote.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use particle_file::ParticleFile;

use crate::study::{ended, said};

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

/// What a built tool prints.
///
/// # Errors
/// What it said where it failed, or that it could not be started.
pub fn tool(name: &str, arguments: &[&str]) -> Result<String, String> {
    let output = ended(Command::new(bin_folder().join(name)).args(arguments))?;
    match output.status.success() {
        true => Ok(String::from_utf8_lossy(&output.stdout).into_owned()),
        false => Err(said(&output)),
    }
}

impl Run {
    /// A column of `history.csv`.
    ///
    /// # Errors
    /// When it is missing or not numeric.
    pub fn history(&self, column: &str) -> Result<Vec<f64>, String> {
        let path = self.folder.join("history.csv");
        let mut reader = csv::Reader::from_path(&path).map_err(|e| e.to_string())?;
        let header = reader.headers().map_err(|e| e.to_string())?.clone();
        let index: HashMap<_, _> = header
            .iter()
            .enumerate()
            .map(|(i, n)| (n.to_owned(), i))
            .collect();
        let &i = index
            .get(column)
            .ok_or_else(|| format!("{} has no column {column}", path.display()))?;
        reader
            .records()
            .map(|row| {
                let row = row.map_err(|e| e.to_string())?;
                row.get(i)
                    .unwrap_or("")
                    .parse::<f64>()
                    .map_err(|e| format!("{column}: {e}"))
            })
            .collect()
    }

    /// Times at which the rows' viscous forces hold, s: the middles of their steps, where the implicit
    /// scheme solves its system (docs/methods.md section 3.1).
    ///
    /// # Errors
    /// When a column is missing or not numeric.
    pub fn middles(&self) -> Result<Vec<f64>, String> {
        let (ends, steps) = (self.history("time_s")?, self.history("dt_s")?);
        Ok((ends.iter().zip(&steps))
            .map(|(t, dt)| t - 0.5 * dt)
            .collect())
    }

    /// The last state.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn last(&self) -> Result<ParticleFile, String> {
        ParticleFile::open(self.folder.join("final.mpts")).map_err(|e| e.to_string())
    }

    /// The states written on the way, in order, and the last.
    ///
    /// # Errors
    /// What is wrong with a file.
    pub fn states(&self) -> Result<Vec<ParticleFile>, String> {
        let numbered = (0..).map(|number| self.folder.join(format!("snapshots/{number:04}.mpts")));
        let written = numbered.take_while(|path| path.is_file());
        let states = written.map(|path| ParticleFile::open(path).map_err(|e| e.to_string()));
        states.chain([self.last()]).collect()
    }

    /// A number of `summary.json`, by its key at any depth.
    pub fn summary(&self, key: &str) -> Option<f64> {
        let text = std::fs::read_to_string(self.folder.join("summary.json")).ok()?;
        let after = text.split(&format!("\"{key}\":")).nth(1)?;
        after
            .trim_start()
            .split([',', '\n', '}'])
            .next()?
            .trim()
            .parse()
            .ok()
    }

    /// WP of the last state about the bond plane: bottom, top and total, um.
    ///
    /// # Errors
    /// What `wp-metrics` said, or what its table lacks.
    pub fn weighted_penetration(&self) -> Result<[f64; 3], String> {
        let state = self.folder.join("final.mpts").display().to_string();
        let table = tool("wp-metrics", &["--quiet", &state])?;
        let mut rows = csv::Reader::from_reader(table.as_bytes());
        let header = rows.headers().map_err(|e| e.to_string())?.clone();
        let column = |name: &str| header.iter().position(|n| n == name);
        let (side, wp) = (column("side").unwrap_or(0), column("wp_um").unwrap_or(0));
        let rows: Vec<csv::StringRecord> = rows.records().filter_map(Result::ok).collect();
        let of = |name: &str| {
            let row = rows.iter().find(|row| row.get(side) == Some(name));
            let number = row.and_then(|row| row.get(wp)?.parse().ok());
            number.ok_or_else(|| format!("wp-metrics printed no {name}"))
        };
        Ok([of("bottom")?, of("top")?, of("total")?])
    }
}
