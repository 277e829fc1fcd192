//! Runs killed or told to stop several times in a row, each time somewhere else.

use std::os::unix::process::ExitStatusExt;

use super::faults::{self, Fault, Point};
use super::scene::{Place, Scene, same};
use super::{Row, all_wrong};
use crate::Result;
use crate::study::said;

/// Faults before a run is let go to its end.
const FAULTS: usize = 6;

const MORE: [&str; 1] = ["--resume"];

/// `count` runs of each scheme.
///
/// # Errors
/// What keeps the trials from being made.
pub fn rows(count: u64, mut tell: impl FnMut(&Row)) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    for scene in Scene::ALL {
        let whole = Place::new(scene)?;
        let points = faults::points(&whole, &MORE, &[])?;
        let seeds: Vec<u64> = (0..count).collect();
        let row = Row {
            series: "run interrupted six times",
            scheme: scene.name(),
            fault: "kill or stop",
            trials: seeds.len(),
            wrong: all_wrong(&seeds, |&seed| {
                let place = Place::new(scene)?;
                let told = |said| format!("seed {seed}: {said}");
                interrupted(&place, &points, seed).map_err(told)?;
                place.done(&MORE).map_err(told)?;
                Ok(same(&whole.run_folder(), &place.run_folder()).map_err(told)?)
            }),
        };
        tell(&row);
        rows.push(row);
    }
    Ok(rows)
}

fn interrupted(place: &Place, points: &[(Point, String)], seed: u64) -> Result<()> {
    let mut random = seed;
    for _ in 0..FAULTS {
        // Knuth's linear congruential generator; its high bits are good enough to choose points.
        random = (random.wrapping_mul(6_364_136_223_846_793_005))
            .wrapping_add(1_442_695_040_888_963_407);
        let (point, _) = &points[(random >> 33) as usize % points.len()];
        let fault = if random >> 32 & 1 == 0 {
            Fault::Kill
        } else {
            Fault::Terminate
        };
        let output = faults::run(place, &MORE, &[(point, fault)])?;
        // SIGTERM kills a process that has only begun.
        let status = output.status;
        if !matches!(
            (status.code(), status.signal()),
            (Some(0 | 75), _) | (None, Some(9 | 15))
        ) {
            return Err(format!("{point}: {status:?}, {}", said(&output)).into());
        }
    }
    Ok(())
}
