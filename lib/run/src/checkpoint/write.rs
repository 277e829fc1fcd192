//! Writing a checkpoint.

use particle_file::{Draft, Header, Kind};
use physics::{Array, Saving};

use super::*;
use crate::failure::RunFailure;

/// Writes the run folder's checkpoint, replacing the one before. What it counts on, history and
/// snapshots, must be on the disk by then.
pub(crate) fn write(
    folder: &RunFolder,
    origin: &Origin,
    Checkpoint {
        clock,
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
    header.set_attribute(LOST, clock.last.lost);
    header.set_attribute(ITERATIONS, clock.last.iterations);
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
