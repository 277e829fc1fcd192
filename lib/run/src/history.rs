//! `history.csv`: one row per interval, each written at once.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::PathBuf;

use physics::{Diagnostics, Scene};
use xxhash_rust::xxh3::Xxh3Default;

use crate::bond_measures::{self, Moment};
use crate::clock::Clock;
use crate::failure::RunFailure;
use crate::files::is_still;
use crate::folder::{HISTORY, RunFolder};
use crate::resolve::Setup;

/// The columns, contract first, then what the two schemes add.
const HEADER: &str = "step,time_s,dt_s,closing_speed_m_s,displacement_m,gap_m,pressure_bottom_Pa,\
pressure_top_Pa,kinetic_energy_J,viscous_power_W,adhesive_volume_m3,max_speed_m_s,lost_particles,\
solver_iterations,capped_viscosity_fraction";
/// What follows of a liquid that cures: its factor of the viscosity at the row's time.
const CURED: &str = ",viscosity_factor";
/// What follows of a liquid that loses water: its mean solids content, and the water in the walls.
const WET: &str = ",solids_content,water_in_walls_m3";

/// What a press programme adds: the number of the stage that the step was of.
const STAGE: &str = ",stage";

/// How far a history went, and what it then held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Extent {
    /// Length, bytes.
    pub(crate) bytes: u64,
    /// XXH3-64 of them.
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
    /// Starts the history of a run of `scene` in `folder`, with the columns of its bond where that is `watched`.
    pub(crate) fn create(
        folder: &RunFolder,
        scene: &Scene,
        watched: bool,
    ) -> Result<Self, RunFailure> {
        let more = [
            (scene.liquid.cure.is_some(), CURED),
            (scene.liquid.water.is_some(), WET),
            (!scene.programme.is_empty(), STAGE),
            (watched, bond_measures::COLUMNS),
        ];
        let more = more.map(|(has, columns)| if has { columns } else { "" });
        let header = format!("{HEADER}{}\n", more.concat());
        folder.write_text(HISTORY, &header)?;
        let path = folder.place(HISTORY);
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

    /// Continues a history from where a checkpoint left it. What came after, whole rows or a
    /// part of one, is cut off.
    /// Errors: a history that no longer begins as the checkpoint left it (exit 3); a failed write.
    pub(crate) fn resume(folder: &RunFolder, extent: Extent) -> Result<Self, RunFailure> {
        let path = folder.place(HISTORY);
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

    /// Brings all rows to the disk and says how far they go.
    /// Errors: the file and the system's reason; also where the rows went into a file that is no longer there.
    pub(crate) fn sync(&self) -> Result<Extent, RunFailure> {
        let sync = || {
            self.file.sync_data()?;
            is_still(&self.file, &self.path)
        };
        sync().map_err(RunFailure::write(&self.path))?;
        Ok(Extent {
            bytes: self.bytes,
            hash: self.hash.digest(),
        })
    }

    /// Appends a row of the run of `setup`, of a stage of its press programme (from 1), and what the press has come to. The gap
    /// of a run without a clamp stays empty.
    pub(crate) fn row(
        &mut self,
        setup: &Setup,
        clock: &Clock,
        diagnostics: &Diagnostics,
        stage: Option<usize>,
        moment: Option<Moment>,
    ) -> Result<(), RunFailure> {
        let last = &clock.last;
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
        row.extend(moment.map(|moment| moment.fields()));
        row.push('\n');
        self.file.write_all(row.as_bytes()).map_err(|error| {
            // Part of a row on a full disk is of no use; if it stays, --resume cuts it off.
            let _ = self.file.set_len(self.bytes);
            RunFailure::write(&self.path)(error)
        })?;
        self.bytes += row.len() as u64;
        self.hash.update(row.as_bytes());
        Ok(())
    }
}

/// Total WP (m) at `time_s`, where a history of this text has a row then that tells it.
pub(crate) fn wp_at(text: &str, time_s: f64) -> Option<f64> {
    let mut rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let columns = rows.next()?;
    let place = |name| columns.iter().position(|column| *column == name);
    let [time, wp] = [place("time_s")?, place("wp_total_um")?];
    let number = |row: &[&str], at: usize| row.get(at)?.parse::<f64>().ok();
    // A row has ten digits of its time.
    let mut then =
        rows.filter(|row| number(row, time).is_some_and(|t| (t - time_s).abs() <= 1e-9 * time_s));
    Some(1e-6 * number(&then.next()?, wp)?)
}

/// Hashes the first `bytes` of a file, or all of it if it is shorter; how many there were.
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
    use crate::folder::tests::held;
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

    /// The last row, cut off in the middle, was kept as a row of an earlier step before.
    #[test]
    fn resuming_drops_rows_after_the_checkpoint_and_parts_of_rows() {
        let (_place, folder) = held();
        let path = folder.place(HISTORY);
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

    /// Bytes that are no text were said to be a failed write before.
    #[test]
    fn a_history_that_was_changed_is_not_continued() {
        let (_place, folder) = held();
        let mut history = create(&folder);
        add(&mut history, &[1, 2]);
        let extent = history.sync().unwrap();
        let whole = fs::read(folder.place(HISTORY)).unwrap();
        let mut garbled = whole.clone();
        garbled[200] = 0xff;
        for bytes in [&garbled[..], &whole[..whole.len() - 1], b""] {
            fs::write(folder.place(HISTORY), bytes).unwrap();
            let said = History::resume(&folder, extent).err().unwrap().to_string();
            assert!(said.contains("not what it was"), "{said}");
        }
        fs::remove_file(folder.place(HISTORY)).unwrap();
        let said = History::resume(&folder, extent).err().unwrap().to_string();
        assert!(said.contains("is missing"), "{said}");
        // 314e630 went on and ended well, without a history.
        let said = history.sync().unwrap_err().to_string();
        assert!(said.contains("it was removed"), "{said}");
    }
}
