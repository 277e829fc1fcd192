//! Checkpoints: all that a run needs to go on bit by bit.

use std::path::{Path, PathBuf};

use particle_file::{Draft, Header, Kind, ParticleFile};
use physics::{Array, Saved};

use crate::courant::Courant;
use crate::drive::RunError;
use crate::snapshot::write_whole;

/// Where a run is in time, and what it has written.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Clock {
    /// Steps taken.
    pub step: u64,
    /// Time, s.
    pub time_s: f64,
    /// Clamp travel, m.
    pub travel_m: f64,
    /// When the next row of the history is due, s.
    pub next_history_s: f64,
    /// When the next snapshot is due, s.
    pub next_snapshot_s: f64,
    /// Snapshots written.
    pub snapshots: u32,
}

impl Clock {
    /// Refuses what is no place in time; `header_s` is the time that the file's header says.
    fn check(&self, header_s: f64) -> Result<(), String> {
        /// Steps that a double counts one by one.
        const MOST_STEPS: u64 = 1 << 53;
        let due = |t: f64| t >= 0.0; // infinite where nothing is due
        let sound = self.time_s == header_s
            && self.travel_m.is_finite()
            && due(self.next_history_s)
            && due(self.next_snapshot_s)
            && self.step <= MOST_STEPS;
        match sound {
            true => Ok(()),
            false => Err(format!("its clock is not that of a run: {self:?}")),
        }
    }
}

/// A run as its checkpoint holds it.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// Where the run is.
    pub clock: Clock,
    /// Which part of it was taken at which Courant number.
    pub courant: Vec<Courant>,
    /// State of the scheme.
    pub saved: Saved,
}

fn path(folder: &Path) -> PathBuf {
    folder.join("checkpoint.mpts")
}

/// The end of a sentence that says where the last checkpoint is.
pub(crate) fn where_last(folder: &Path) -> String {
    if path(folder).exists() {
        format!(
            "; --resume goes on from the last good checkpoint, {}, at another integrator.cfl if wanted",
            path(folder).display()
        )
    } else {
        "; it came before the first checkpoint".into()
    }
}

/// Writes the run folder's checkpoint, replacing the one before.
pub(crate) fn write(
    folder: &Path,
    identity: &str,
    Checkpoint {
        clock,
        courant,
        saved,
    }: &Checkpoint,
) -> Result<(), RunError> {
    let mut header = Header::new(Kind::Checkpoint, 1.0, 1, [0.0; 3], [0.0; 3]);
    (header.time_s, header.step) = (clock.time_s, clock.step);
    header.set_attribute("identity", identity);
    header.set_attribute("snapshots", clock.snapshots);
    let times = [
        clock.time_s,
        clock.travel_m,
        clock.next_history_s,
        clock.next_snapshot_s,
    ];
    let courant: Vec<f64> = (courant.iter())
        .flat_map(|part| [part.after_step as f64, part.cfl])
        .collect();
    let mut draft =
        Draft::new(header)
            .column("run.clock", 1, &times)
            .column("run.courant", 1, &courant);
    for (name, array) in &saved.0 {
        draft = match array {
            Array::F32(values) => draft.column(name, 1, values),
            Array::F64(values) => draft.column(name, 1, values),
            Array::U32(values) => draft.column(name, 1, values),
        };
    }
    write_whole(&path(folder), |out| draft.write_to(out))
}

/// Removes the checkpoint of a run that has ended: nothing is left to continue.
pub(crate) fn remove(folder: &Path) -> Result<(), RunError> {
    let path = path(folder);
    match std::fs::remove_file(&path) {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => Err(RunError::write(&path)(e)),
        _ => Ok(()),
    }
}

/// Reads the run folder's checkpoint, if there is one.
///
/// # Errors
/// A checkpoint that is corrupt or belongs to another case, particle file or version.
pub fn read(folder: &Path, identity: &str) -> Result<Option<Checkpoint>, RunError> {
    let path = path(folder);
    if !path.exists() {
        return Ok(None);
    }
    let bad = |said: String| RunError::Checkpoint(format!("{}: {said}", path.display()));
    let file = ParticleFile::open(&path).map_err(|e| RunError::Checkpoint(e.to_string()))?;
    let header = file.header();
    if header.kind != Kind::Checkpoint {
        return Err(bad("it is no checkpoint".into()));
    }
    if header.attribute("identity") != Some(identity) {
        return Err(bad(
            "it belongs to another case (only integrator.cfl may change), particle file or version; use --overwrite to start anew"
                .into(),
        ));
    }
    let numbers = |name| file.column::<f64>(name).map_err(|e| bad(e.to_string()));
    let &[time_s, travel_m, next_history_s, next_snapshot_s] = numbers("run.clock")? else {
        return Err(bad("its clock does not have four entries".into()));
    };
    let snapshots = header.attribute("snapshots").and_then(|t| t.parse().ok());
    let clock = Clock {
        step: header.step,
        time_s,
        travel_m,
        next_history_s,
        next_snapshot_s,
        snapshots: snapshots.ok_or_else(|| bad("its number of snapshots is missing".into()))?,
    };
    clock.check(header.time_s).map_err(bad)?;
    let courant = (numbers("run.courant")?.as_chunks().0.iter())
        .map(|&[after, cfl]| Courant {
            after_step: after as u64,
            cfl,
        })
        .collect();
    let mut saved = Vec::new();
    for column in file.columns().filter(|c| !c.name.starts_with("run.")) {
        let array = file
            .column::<f64>(&column.name)
            .map(|v| Array::F64(v.to_vec()))
            .or_else(|_| {
                file.column::<f32>(&column.name)
                    .map(|v| Array::F32(v.to_vec()))
            })
            .or_else(|_| {
                file.column::<u32>(&column.name)
                    .map(|v| Array::U32(v.to_vec()))
            })
            .map_err(|e| bad(e.to_string()))?;
        saved.push((column.name.clone(), array));
    }
    Ok(Some(Checkpoint {
        clock,
        courant,
        saved: Saved(saved),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_checkpoint_comes_back_bit_by_bit_and_only_to_its_own_run() {
        let folder = tempfile::tempdir().unwrap();
        let clock = Clock {
            step: 7,
            time_s: 0.1 + 0.2,
            travel_m: 1e-6,
            next_history_s: 0.3,
            next_snapshot_s: f64::INFINITY,
            snapshots: 3,
        };
        let saved = Saved(vec![
            ("a".into(), Array::F64(vec![1.0, -0.0, 1e-300])),
            ("b".into(), Array::F32(vec![0.1; 5])),
            ("c".into(), Array::U32(vec![4, 5])),
        ]);
        let courant = [(0, 1.0), (5, 0.3)].map(|(after_step, cfl)| Courant { after_step, cfl });
        let checkpoint = Checkpoint {
            clock,
            courant: courant.to_vec(),
            saved,
        };
        assert_eq!(read(folder.path(), "x").unwrap(), None);
        write(folder.path(), "x", &checkpoint).unwrap();
        assert_eq!(read(folder.path(), "x").unwrap(), Some(checkpoint));
        let said = read(folder.path(), "y").unwrap_err().to_string();
        assert!(said.contains("another case"), "{said}");
    }
}
