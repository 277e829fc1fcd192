//! Checkpoints: all that a run needs to go on bit by bit.

use std::path::Path;

use particle_file::{Draft, Header, Kind, ParticleFile};
use physics::{Array, Saved, Saving, StepReport};

use crate::courant::Courant;
use crate::drive::RunError;
use crate::folder::{CHECKPOINT, RunFolder};
use crate::history::Extent;

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
    /// Report of the last step, which the end of a run quotes.
    pub last: StepReport,
    /// Whether that step has no row in the history.
    pub row_missing: bool,
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

/// A run as its checkpoint holds it; `S` is what is read of the scheme's state, or what writes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint<S = Saved> {
    /// Where the run is.
    pub clock: Clock,
    /// Which part of it was taken at which Courant number.
    pub courant: Vec<Courant>,
    /// How far its history went.
    pub history: Extent,
    /// State of the scheme.
    pub saved: S,
}

/// The end of a sentence that says where the last checkpoint is.
pub(crate) fn where_last(folder: &RunFolder) -> String {
    let path = folder.place(CHECKPOINT);
    if path.exists() {
        format!(
            "; --resume goes on from the last good checkpoint, {}, at another integrator.cfl if wanted",
            path.display()
        )
    } else {
        "; it came before the first checkpoint".into()
    }
}

/// Writes the run folder's checkpoint, replacing the one before. What it counts on, history and
/// snapshots, must be on the disk by then.
pub(crate) fn write(
    folder: &RunFolder,
    identity: &str,
    Checkpoint {
        clock,
        courant,
        history,
        saved,
    }: Checkpoint<Vec<(String, Saving)>>,
) -> Result<(), RunError> {
    let mut header = Header::new(Kind::Checkpoint, 1.0, 1, [0.0; 3], [0.0; 3]);
    (header.time_s, header.step) = (clock.time_s, clock.step);
    header.set_attribute("identity", identity);
    header.set_attribute("snapshots", clock.snapshots);
    header.set_attribute("row_missing", clock.row_missing);
    header.set_attribute("history_bytes", history.bytes);
    header.set_attribute("history_hash", history.hash);
    header.set_attribute("lost", clock.last.lost);
    header.set_attribute("iterations", clock.last.iterations);
    let times = [
        clock.time_s,
        clock.travel_m,
        clock.next_history_s,
        clock.next_snapshot_s,
    ];
    let last = [
        clock.last.dt_s,
        clock.last.closing_speed,
        clock.last.travel_m,
        clock.last.pressure_bottom,
        clock.last.pressure_top,
    ];
    let courant: Vec<f64> = (courant.iter())
        .flat_map(|part| [part.after_step as f64, part.cfl])
        .collect();
    let mut draft = Draft::new(header)
        .column("run.clock", 1, &times)
        .column("run.last_step", 1, &last)
        .column("run.courant", 1, &courant);
    for (name, array) in &saved {
        draft = match array {
            Saving::Whole(Array::F32(values)) => draft.column(name, 1, values),
            Saving::Whole(Array::F64(values)) => draft.column(name, 1, values),
            Saving::Whole(Array::U32(values)) => draft.column(name, 1, values),
            Saving::F32(pieces) => draft.pieces(name, 1, pieces),
            Saving::F64(pieces) => draft.pieces(name, 1, pieces),
            Saving::U32(pieces) => draft.pieces(name, 1, pieces),
        };
    }
    folder.write_whole(CHECKPOINT, |out| draft.write_to(out))
}

/// Reads the run folder's checkpoint, if there is one.
///
/// # Errors
/// A checkpoint that is corrupt or belongs to another case, particle file or version.
pub fn read(folder: &Path, identity: &str) -> Result<Option<Checkpoint>, RunError> {
    let path = folder.join(CHECKPOINT);
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
        return Err(RunError::AnotherCase(format!(
            "{}: it belongs to another case (only integrator.cfl may change), particle file or version; use --overwrite to start anew",
            path.display()
        )));
    }
    let numbers = |name| file.column::<f64>(name).map_err(|e| bad(e.to_string()));
    let earlier = |what: &str| {
        bad(format!(
            "it has no {what} as this version needs it; use --overwrite to start anew"
        ))
    };
    let &[time_s, travel_m, next_history_s, next_snapshot_s] = numbers("run.clock")? else {
        return Err(earlier("clock"));
    };
    let Ok(
        &[
            dt_s,
            closing_speed,
            last_travel_m,
            pressure_bottom,
            pressure_top,
        ],
    ) = numbers("run.last_step")
    else {
        return Err(earlier("last step"));
    };
    let clock = Clock {
        step: header.step,
        time_s,
        travel_m,
        next_history_s,
        next_snapshot_s,
        snapshots: attribute(header, "snapshots").ok_or_else(|| earlier("number of snapshots"))?,
        last: StepReport {
            dt_s,
            closing_speed,
            travel_m: last_travel_m,
            pressure_bottom,
            pressure_top,
            lost: attribute(header, "lost").ok_or_else(|| earlier("count of lost points"))?,
            iterations: attribute(header, "iterations").ok_or_else(|| earlier("iterations"))?,
        },
        row_missing: attribute(header, "row_missing").ok_or_else(|| earlier("row state"))?,
    };
    let (bytes, hash) = (
        attribute(header, "history_bytes"),
        attribute(header, "history_hash"),
    );
    let (Some(bytes), Some(hash)) = (bytes, hash) else {
        return Err(earlier("length of the history"));
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
        history: Extent { bytes, hash },
        saved: Saved(saved),
    }))
}

fn attribute<T: std::str::FromStr>(header: &Header, name: &str) -> Option<T> {
    header.attribute(name)?.parse().ok()
}

#[cfg(test)]
mod tests {
    use physics::Pieces;

    use super::*;
    use crate::folder::tests::held;

    #[test]
    fn a_checkpoint_comes_back_bit_by_bit_and_only_to_its_own_run() {
        let (place, folder) = held();
        let clock = Clock {
            step: 7,
            time_s: 0.1 + 0.2,
            travel_m: 1e-6,
            next_history_s: 0.3,
            next_snapshot_s: f64::INFINITY,
            snapshots: 3,
            last: StepReport {
                dt_s: 0.1,
                closing_speed: 1.0,
                travel_m: 1e-6,
                pressure_bottom: -0.0,
                pressure_top: 1e300,
                lost: u64::MAX,
                iterations: 7,
            },
            row_missing: true,
        };
        let saved = Saved(vec![
            ("a".into(), Array::F64(vec![1.0, -0.0, 1e-300])),
            ("b".into(), Array::F32(vec![0.1; 5])),
            ("c".into(), Array::U32(vec![4, 5])),
        ]);
        let courant = [(0, 1.0), (5, 0.3)].map(|(after_step, cfl)| Courant { after_step, cfl });
        let history = Extent {
            bytes: 1 << 60,
            hash: u64::MAX,
        };
        let whole = |array: &Array| Saving::Whole(array.clone());
        // An array in pieces is the same in the file.
        let numbers: Pieces<f32> =
            Box::new(|take| [2, 0, 3].iter().for_each(|&n| take(&[0.1; 3][..n])));
        let saving = vec![
            ("a".into(), whole(&saved.0[0].1)),
            ("b".into(), Saving::F32(numbers)),
            ("c".into(), whole(&saved.0[2].1)),
        ];
        let checkpoint = Checkpoint {
            clock,
            courant: courant.to_vec(),
            history,
            saved: saving,
        };
        assert_eq!(read(place.path(), "x").unwrap(), None);
        write(&folder, "x", checkpoint).unwrap();
        let found = read(place.path(), "x").unwrap().unwrap();
        assert_eq!((found.clock, found.courant), (clock, courant.to_vec()));
        assert_eq!((found.history, found.saved), (history, saved));
        let said = read(place.path(), "y").unwrap_err().to_string();
        assert!(said.contains("another case"), "{said}");
    }
}
