//! Runs killed or told to stop several times in a row, each time somewhere else.

use std::os::unix::process::ExitStatusExt;

use super::Row;
use super::faults::{self, Fault, Point};
use super::place::Place;
use crate::Result;
use crate::method::Scheme;
use crate::study::said;

/// Faults before a run is let go to its end.
const FAULTS: usize = 6;

const MORE: [&str; 1] = ["--resume"];

/// `count` runs of each scheme, named by their seeds.
///
/// # Errors
/// What keeps the trials from being made.
pub fn rows(count: u64, mut tell: impl FnMut(&Row)) -> Result<Vec<Row>> {
    let seeds: Vec<u64> = (0..count).collect();
    let of_scheme = |scheme| {
        let whole = Place::new(scheme)?;
        let points = faults::points(&whole, &MORE, &[])?;
        let (series, fault) = ("run interrupted six times", "kill or stop");
        let row = Row::new(series, scheme, fault, &seeds, |&seed| {
            let place = Place::new(scheme)?;
            interrupted(&place, &points, seed)?;
            place.ends_like(&whole, &MORE)
        });
        tell(&row);
        Ok(row)
    };
    Scheme::ALL.into_iter().map(of_scheme).collect()
}

fn interrupted(place: &Place, points: &[(Point, String)], seed: u64) -> Result<()> {
    let mut random = seed;
    for _ in 0..FAULTS {
        // Knuth's linear congruential generator; its high bits are good enough to choose points.
        random = (random.wrapping_mul(6_364_136_223_846_793_005))
            .wrapping_add(1_442_695_040_888_963_407);
        let (point, _) = &points[(random >> 33) as usize % points.len()];
        let fault = match random >> 32 & 1 {
            0 => Fault::Kill,
            _ => Fault::Terminate,
        };
        let output = faults::run(place, &MORE, &[(point, fault)])?;
        let status = output.status;
        match (status.code(), status.signal()) {
            // SIGTERM kills a process that has only begun.
            (Some(0 | 75), _) | (None, Some(9 | 15)) => {}
            _ => return Err(format!("{point}: {status:?}, {}", said(&output)).into()),
        }
    }
    Ok(())
}
