//! Checkpoints: the state from which a run continues with the same bits.

mod read;

use particle_file::{Draft, Header, IDENTITY, Kind, Provenance};
use physics::{Array, Choice, Saved, Saving};

use crate::case::SchemeName;
use crate::clock::Clock;
use crate::courant::Courant;
use crate::failure::RunFailure;
use crate::folder::{CHECKPOINT, RunFolder};
use crate::history::Extent;

pub(crate) use read::read;

/// Version of the layout of a run's own data in a checkpoint; raise it with any change.
const RUN_FORMAT: u32 = 1;

/// Identity of a run and its build; a checkpoint must match it.
#[derive(Debug)]
pub(crate) struct Origin {
    /// Hashes of the case without its Courant number and of the bond file.
    pub(crate) identity: String,
    /// Version of the checkpoint's layout, from [`format`].
    pub(crate) format: String,
    /// The tool and its version.
    pub(crate) by: Provenance,
}

/// Version of the layout of a scheme's checkpoints in this build. Raise the number with any change of the arrays that the
/// scheme saves, or of their meaning.
pub(crate) fn format(scheme: SchemeName) -> String {
    let number = match scheme {
        SchemeName::Explicit => 1,
        SchemeName::Implicit => 3,
    };
    format!("{} {number}, run {RUN_FORMAT}", scheme.name())
}

// Attributes of a checkpoint's header.
const FORMAT: &str = "checkpoint_format";
const SNAPSHOTS: &str = "snapshots";
const ROW_MISSING: &str = "row_missing";
const HISTORY_BYTES: &str = "history_bytes";
const HISTORY_HASH: &str = "history_hash";
const LOST: &str = "lost";
const ITERATIONS: &str = "iterations";

/// Content of a checkpoint. `S` is the state of the scheme: as read, or as the pieces to be written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Checkpoint<S = Saved> {
    /// Progress of the run.
    pub(crate) clock: Clock,
    /// Courant numbers and the steps from which they held.
    pub(crate) courant: Vec<Courant>,
    /// Length and hash of the history.
    pub(crate) history: Extent,
    /// State of the scheme.
    pub(crate) saved: S,
}

/// The numbers of a clock in a checkpoint: its own, and those of its last step.
fn numbers(clock: &mut Clock) -> ([&mut f64; 4], [&mut f64; 5]) {
    let own = [
        &mut clock.time_s,
        &mut clock.travel_m,
        &mut clock.next_history_s,
        &mut clock.next_snapshot_s,
    ];
    let last = &mut clock.last_step;
    let of_step = [
        &mut last.dt_s,
        &mut last.closing_speed,
        &mut last.travel_m,
        &mut last.pressure_bottom,
        &mut last.pressure_top,
    ];
    (own, of_step)
}

/// Writes the checkpoint and replaces the one before. History and snapshots must be synced to the disk first.
pub(crate) fn write(
    folder: &RunFolder,
    origin: &Origin,
    Checkpoint {
        mut clock,
        courant,
        history,
        saved,
    }: Checkpoint<Vec<(String, Saving)>>,
) -> Result<(), RunFailure> {
    let mut header = Header::new(Kind::Checkpoint, 1.0, 1, [0.0; 3], [0.0; 3]);
    (header.time_s, header.step) = (clock.time_s, clock.step);
    header.provenance.push(origin.by.clone());
    header.set_attribute(IDENTITY, &origin.identity);
    header.set_attribute(FORMAT, &origin.format);
    header.set_attribute(SNAPSHOTS, clock.snapshots);
    header.set_attribute(ROW_MISSING, clock.row_missing);
    header.set_attribute(HISTORY_BYTES, history.bytes);
    header.set_attribute(HISTORY_HASH, history.hash);
    header.set_attribute(LOST, clock.last_step.lost);
    header.set_attribute(ITERATIONS, clock.last_step.iterations);
    let (times, last) = numbers(&mut clock);
    let (times, last) = (times.map(|x| *x), last.map(|x| *x));
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

/// The end of a sentence, with the path of the last checkpoint.
pub(crate) fn where_last(folder: &RunFolder) -> String {
    let path = folder.path_of(CHECKPOINT);
    if path.exists() {
        format!(
            "; --resume continues from the last checkpoint, {}, if needed with another integrator.cfl",
            path.display()
        )
    } else {
        "; no checkpoint was written before".into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::folder::tests::{by, test_folder};

    /// The message names the builds, not a missing array.
    #[test]
    fn a_checkpoint_of_another_build_names_that_build() {
        let (place, folder) = test_folder();
        let of = |version: &str, format: &str| Origin {
            identity: "x".into(),
            format: format.into(),
            by: by(version),
        };
        let checkpoint = Checkpoint {
            clock: Clock::default(),
            courant: Vec::new(),
            history: Extent::default(),
            saved: Vec::new(),
        };
        write(&folder, &of("0.1.0", "explicit 1, run 1"), checkpoint).unwrap();
        let said = |version: &str, format: &str| {
            let found = read(place.path(), &of(version, format), &String::new);
            found.map(|_| ()).map_err(|error| match error {
                RunFailure::Usage(said) => said,
                other => panic!("{other:?}"),
            })
        };
        said("0.1.0", "explicit 1, run 1").unwrap();
        for (version, format) in [
            ("0.1.0", "explicit 2, run 1"),
            ("0.2.0", "explicit 1, run 1"),
        ] {
            let told = said(version, format).unwrap_err();
            let there = "written by mpm-run 0.1.0 in the checkpoint format 'explicit 1, run 1'";
            let here = format!("this is mpm-run {version} in the checkpoint format '{format}'");
            assert!(told.contains(there) && told.contains(&here), "{told}");
            assert!(told.contains("with the build that wrote it"), "{told}");
        }
        // A file with the case's identity that says neither its writer nor its format.
        let mut header = Header::new(Kind::Checkpoint, 1.0, 1, [0.0; 3], [0.0; 3]);
        header.set_attribute(IDENTITY, "x");
        let mut bytes = Vec::new();
        Draft::new(header).write_to(&mut bytes).unwrap();
        std::fs::write(place.path().join(CHECKPOINT), bytes).unwrap();
        let told = said("0.1.0", "explicit 1, run 1").unwrap_err();
        assert!(told.contains("with the build that wrote it"), "{told}");
    }
}
