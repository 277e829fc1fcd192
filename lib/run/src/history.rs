//! `history.csv`: one row per interval, each written by one call.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::PathBuf;

use physics::{Diagnostics, Scene};
use xxhash_rust::xxh3::Xxh3Default;

use crate::bond_measures::{self, BondRow};
use crate::clock::Clock;
use crate::failure::RunFailure;
use crate::files::check_not_replaced;
use crate::folder::{HISTORY, RunFolder};
use crate::resolve::Setup;

/// Columns of every run.
const COMMON_COLUMNS: &str = "step,time_s,dt_s,closing_speed_m_s,displacement_m,gap_m,pressure_bottom_Pa,\
pressure_top_Pa,kinetic_energy_J,viscous_power_W,adhesive_volume_m3,max_speed_m_s,lost_particles,\
solver_iterations,capped_viscosity_fraction";
/// Further column for a curing liquid: the factor of its viscosity.
const CURE_COLUMN: &str = ",viscosity_factor";
/// Further columns for a liquid that loses water: its mean solids content, and the water in the walls.
const WATER_COLUMNS: &str = ",solids_content,water_in_walls_m3";

/// Further column for a press programme: the number of the step's stage.
const STAGE_COLUMN: &str = ",stage";

/// Length and hash of a history.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Extent {
    /// Length, bytes.
    pub(crate) bytes: u64,
    /// XXH3-64 of these bytes.
    pub(crate) hash: u64,
}

/// An open `history.csv`.
pub(crate) struct History {
    file: File,
    path: PathBuf,
    bytes: u64,
    hash: Xxh3Default,
}

impl History {
    /// Starts the history of a run of `scene` in `folder`, with the columns of the bond if `bonded`.
    pub(crate) fn create(
        folder: &RunFolder,
        scene: &Scene,
        bonded: bool,
    ) -> Result<Self, RunFailure> {
        let more = [
            (scene.liquid.cure.is_some(), CURE_COLUMN),
            (scene.liquid.water.is_some(), WATER_COLUMNS),
            (!scene.programme.is_empty(), STAGE_COLUMN),
            (bonded, bond_measures::COLUMNS),
        ];
        let more = more.map(|(has, columns)| if has { columns } else { "" });
        let header = format!("{COMMON_COLUMNS}{}\n", more.concat());
        folder.write_text(HISTORY, &header)?;
        let path = folder.path_of(HISTORY);
        let open = File::options().append(true).open(&path);
        let mut hash = Xxh3Default::new();
        hash.update(header.as_bytes());
        Ok(Self {
            file: open.map_err(RunFailure::write(&path))?,
            path,
            bytes: header.len() as u64,
            hash,
        })
    }

    /// Continues the history from a checkpoint and cuts off whatever was written after it.
    /// Errors: the history does not begin as it was at the checkpoint (exit 3); a failed write.
    pub(crate) fn resume(folder: &RunFolder, extent: Extent) -> Result<Self, RunFailure> {
        let path = folder.path_of(HISTORY);
        let unusable = |why: &str| {
            RunFailure::Data(format!(
                "'{}' {why}, so the run cannot be continued; use --overwrite to start anew",
                path.display()
            ))
        };
        let mut file = match File::options().read(true).append(true).open(&path) {
            Err(e) if e.kind() == io::ErrorKind::NotFound => return Err(unusable("is missing")),
            opened => opened.map_err(RunFailure::write(&path))?,
        };
        let (bytes, hash) =
            hash_start(&mut file, extent.bytes).map_err(RunFailure::write(&path))?;
        if (bytes, hash.digest()) != (extent.bytes, extent.hash) {
            return Err(unusable("is not what it was at the last checkpoint"));
        }
        let cut = (file.set_len(bytes)).and_then(|()| file.seek(SeekFrom::Start(bytes)));
        cut.map_err(RunFailure::write(&path))?;
        Ok(Self {
            file,
            path,
            bytes,
            hash,
        })
    }

    /// Syncs all rows to the disk.
    /// Errors: the file and the system's reason; also if the file was removed or replaced meanwhile.
    pub(crate) fn sync(&self) -> Result<Extent, RunFailure> {
        let sync = || {
            self.file.sync_data()?;
            check_not_replaced(&self.file, &self.path)
        };
        sync().map_err(RunFailure::write(&self.path))?;
        Ok(Extent {
            bytes: self.bytes,
            hash: self.hash.digest(),
        })
    }

    /// Appends a row; `stage` of a press programme counts from 1. The gap of a run without a clamp stays empty.
    pub(crate) fn row(
        &mut self,
        setup: &Setup,
        clock: &Clock,
        diagnostics: &Diagnostics,
        stage: Option<usize>,
        bond: Option<BondRow>,
    ) -> Result<(), RunFailure> {
        let last = &clock.last_step;
        let gap = setup.initial_gap_m.map(|gap| gap - clock.travel_m);
        let gap = gap.map_or(String::new(), |gap| format!("{gap:.9e}"));
        let mut row = format!(
            "{},{:.9e},{:.6e},{:.9e},{:.9e},{gap},{:.6e},{:.6e},{:.6e},{:.6e},{:.9e},{:.6e},{},{},{:.4e}",
            clock.step,
            clock.time_s,
            last.dt_s,
            last.closing_speed,
            last.travel_m,
            last.pressure_bottom + 0.0, // no -0
            last.pressure_top + 0.0,
            diagnostics.kinetic_energy,
            diagnostics.viscous_power,
            diagnostics.volume,
            diagnostics.max_speed,
            last.lost,
            last.iterations,
            diagnostics.capped_fraction,
        );
        let cure = setup.scene.liquid.cure.as_ref();
        row.extend(cure.map(|cure| format!(",{:.9e}", cure.factor(clock.time_s))));
        row.extend((diagnostics.water).map(|w| format!(",{:.9e},{:.9e}", w.solids, w.in_walls_m3)));
        row.extend(stage.map(|stage| format!(",{stage}")));
        row.extend(bond.map(|bond| bond.fields()));
        row.push('\n');
        self.file.write_all(row.as_bytes()).map_err(|error| {
            // Remove the partial row of a full disk; if that fails, --resume cuts it off.
            let _ = self.file.set_len(self.bytes);
            RunFailure::write(&self.path)(error)
        })?;
        self.bytes += row.len() as u64;
        self.hash.update(row.as_bytes());
        Ok(())
    }
}

/// Total WP (m) at `time_s` from the text of a history; `None` without such a row or column.
pub(crate) fn wp_at(text: &str, time_s: f64) -> Option<f64> {
    let mut rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let columns = rows.next()?;
    let place = |name| columns.iter().position(|column| *column == name);
    let [time, wp] = [place("time_s")?, place("wp_total_um")?];
    let number = |row: &[&str], at: usize| row.get(at)?.parse::<f64>().ok();
    // Times in rows have ten digits.
    let mut then =
        rows.filter(|row| number(row, time).is_some_and(|t| (t - time_s).abs() <= 1e-9 * time_s));
    Some(1e-6 * number(&then.next()?, wp)?)
}

/// Hashes the first `bytes` of a file, or all of it if it is shorter. Returns the number of bytes and the hash.
fn hash_start(file: &mut File, bytes: u64) -> io::Result<(u64, Xxh3Default)> {
    let mut hash = Xxh3Default::new();
    let mut start = BufReader::with_capacity(1 << 16, file.take(bytes));
    let read = io::copy(&mut start, &mut hash)?;
    Ok((read, hash))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::folder::tests::test_folder;
    use crate::verdict::tests::setup;

    fn create(folder: &RunFolder) -> History {
        History::create(folder, &setup().scene, false).unwrap()
    }

    fn add(history: &mut History, steps: &[u64]) {
        for &step in steps {
            let clock = Clock {
                step,
                ..Clock::default()
            };
            let row = history.row(&setup(), &clock, &Diagnostics::default(), None, None);
            row.unwrap();
        }
    }

    #[test]
    fn every_column_is_documented() {
        let document = include_str!("../../../docs/run-folder.md");
        for columns in [COMMON_COLUMNS, CURE_COLUMN, WATER_COLUMNS, STAGE_COLUMN] {
            for column in columns.split(',').filter(|column| !column.is_empty()) {
                assert!(document.contains(&format!("`{column}`")), "{column}");
            }
        }
    }

    /// A last row cut off in its first field could be taken for the row of an earlier step.
    #[test]
    fn resuming_drops_rows_after_the_checkpoint_and_parts_of_rows() {
        let (_place, folder) = test_folder();
        let path = folder.path_of(HISTORY);
        let mut history = create(&folder);
        add(&mut history, &[1, 12]);
        let extent = history.sync().unwrap();
        let kept = fs::read(&path).unwrap();
        add(&mut history, &[13, 14]);
        for torn in ["", "1", "12", "12,1.0"] {
            let text = fs::read_to_string(&path).unwrap() + torn;
            fs::write(&path, text).unwrap();
            let mut resumed = History::resume(&folder, extent).unwrap();
            assert_eq!(fs::read(&path).unwrap(), kept);
            add(&mut resumed, &[13]);
        }
        let text = fs::read_to_string(&path).unwrap();
        let rows: Vec<Vec<&str>> = (text.lines().map(|l| l.split(',').collect())).collect();
        let steps: Vec<_> = rows.iter().map(|row| row[0]).collect();
        assert_eq!(steps, ["step", "1", "12", "13"]);
        assert!(rows.iter().all(|row| row.len() == rows[0].len()), "{text}");
    }

    #[test]
    fn a_history_that_was_changed_is_not_continued() {
        let (_place, folder) = test_folder();
        let mut history = create(&folder);
        add(&mut history, &[1, 2]);
        let extent = history.sync().unwrap();
        let whole = fs::read(folder.path_of(HISTORY)).unwrap();
        let mut garbled = whole.clone();
        garbled[200] = 0xff;
        for bytes in [&garbled[..], &whole[..whole.len() - 1], b""] {
            fs::write(folder.path_of(HISTORY), bytes).unwrap();
            let said = History::resume(&folder, extent).err().unwrap().to_string();
            assert!(said.contains("not what it was"), "{said}");
        }
        fs::remove_file(folder.path_of(HISTORY)).unwrap();
        let said = History::resume(&folder, extent).err().unwrap().to_string();
        assert!(said.contains("is missing"), "{said}");
        // A run must not end well without its history.
        let said = history.sync().unwrap_err().to_string();
        assert!(said.contains("it was removed"), "{said}");
    }
}
