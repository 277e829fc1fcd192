//! `history.csv`: one row per interval, flushed as it is written.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};

use physics::{Diagnostics, StepReport};

/// The columns, contract first, then what the two schemes add.
const HEADER: &str = "step,time_s,dt_s,closing_speed_m_s,displacement_m,gap_m,pressure_bottom_Pa,\
pressure_top_Pa,kinetic_energy_J,viscous_power_W,adhesive_volume_m3,max_speed_m_s,lost_particles,\
solver_iterations,capped_viscosity_fraction";

/// An open `history.csv`.
pub struct History {
    file: File,
    path: PathBuf,
}

impl History {
    /// Starts a new history in `folder`.
    ///
    /// # Errors
    /// The system's reason.
    pub fn create(folder: &Path) -> io::Result<Self> {
        let path = folder.join("history.csv");
        let mut file = File::create(&path)?;
        writeln!(file, "{HEADER}")?;
        Ok(Self { file, path })
    }

    /// Continues a history after `step`: rows of later steps, which a checkpoint does not
    /// know, are dropped.
    ///
    /// # Errors
    /// The system's reason.
    pub fn resume(folder: &Path, step: u64) -> io::Result<Self> {
        let path = folder.join("history.csv");
        let mut kept = String::from(HEADER);
        kept.push('\n');
        for line in BufReader::new(File::open(&path)?).lines().skip(1) {
            let line = line?;
            let row_step = line.split(',').next().and_then(|s| s.parse::<u64>().ok());
            if row_step.is_some_and(|s| s <= step) {
                kept.push_str(&line);
                kept.push('\n');
            }
        }
        let aside = path.with_extension("csv.tmp");
        fs::write(&aside, kept)?;
        fs::rename(&aside, &path)?;
        let file = OpenOptions::new().append(true).open(&path)?;
        Ok(Self { file, path })
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Appends a row. An unknown gap (no clamp) stays empty.
    ///
    /// # Errors
    /// The system's reason.
    pub fn row(
        &mut self,
        step: u64,
        time_s: f64,
        gap_m: Option<f64>,
        report: &StepReport,
        diagnostics: &Diagnostics,
    ) -> io::Result<()> {
        let gap = gap_m.map_or(String::new(), |g| format!("{g:.9e}"));
        writeln!(
            self.file,
            "{step},{time_s:.9e},{:.6e},{:.9e},{:.9e},{gap},{:.6e},{:.6e},{:.6e},{:.6e},{:.9e},{:.6e},{},{},{:.4e}",
            report.dt_s,
            report.closing_speed,
            report.travel_m,
            report.pressure_bottom + 0.0, // no -0
            report.pressure_top + 0.0,
            diagnostics.kinetic_energy,
            diagnostics.viscous_power,
            diagnostics.volume,
            diagnostics.max_speed,
            report.lost,
            report.iterations,
            diagnostics.capped_fraction,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn resuming_drops_rows_after_the_checkpoint() {
        let folder = tempfile::tempdir().unwrap();
        let mut history = History::create(folder.path()).unwrap();
        for step in [1, 5, 9] {
            history
                .row(
                    step,
                    1e-9,
                    None,
                    &StepReport::default(),
                    &Diagnostics::default(),
                )
                .unwrap();
        }
        let mut history = History::resume(folder.path(), 5).unwrap();
        history
            .row(
                6,
                1e-9,
                Some(1e-6),
                &StepReport::default(),
                &Diagnostics::default(),
            )
            .unwrap();
        let text = fs::read_to_string(history.path()).unwrap();
        let steps: Vec<_> = text
            .lines()
            .skip(1)
            .map(|l| l.split(',').next().unwrap())
            .collect();
        assert_eq!(steps, ["1", "5", "6"]);
        let columns = text
            .lines()
            .map(|l| l.split(',').count())
            .collect::<Vec<_>>();
        assert!(columns.iter().all(|&n| n == columns[0]), "{columns:?}");
    }
}
