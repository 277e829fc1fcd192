//! Compression of a closed box of liquid by a piston: pressure against paper Eq. 1.

use super::{Measured, Scene};
use crate::case_text::{Body, CaseText, PF};
use crate::closed_forms::tait;
use crate::outputs::Run;

const CELL: f64 = 2.9e-6;
const SPEED: f64 = 0.5;

/// Column of 12 cells compressed by two per cent without wall friction.
pub fn scene() -> Scene {
    let (width, floor, height) = (4.0 * CELL, 3.0 * CELL, 12.0 * CELL);
    let piston = floor + height;
    let until = 0.02 * height / SPEED;
    let case = CaseText {
        contact: "law = \"frictionless\"\n".into(),
        stop: Some(until),
        bodies: vec![
            Body::wall([0.0; 3], [width, floor, CELL]).named("bottom"),
            Body::wall([0.0, piston, 0.0], [width, piston + 6.0 * CELL, CELL])
                .moving([0.0, -SPEED, 0.0])
                .named("top"),
            Body::liquid([0.0, floor, 0.0], [width, piston, CELL]),
        ],
        history_every: until / 20.0,
        ..CaseText::plane(
            "A piston compresses a closed column of liquid by 2 %.\nAgainst paper Eq. 1.",
            CELL,
            [width, piston + 3.0 * CELL],
        )
    };
    Scene {
        name: "tait-column".into(),
        case,
        against: "paper Eq. 1",
        measure: Box::new(move |run| {
            let (time, p) = (run.history("time_s")?, run.history("pressure_top_Pa")?);
            // Each row of the last tenth against the law at its own time: sound still rings.
            let late = time.iter().zip(&p).filter(|(t, _)| **t > 0.9 * until);
            let (mut sum, mut exact, mut rows) = (0.0, 0.0, 0.0);
            for (t, p) in late {
                sum += p;
                exact += tait(1.0 - SPEED * t / height, PF[1]);
                rows += 1.0;
            }
            Ok(vec![
                Measured::relative("piston pressure", sum / rows, exact / rows),
                Measured::absolute(
                    "rms pressure of points of their volume",
                    law_error(run, width * height * CELL)?,
                ),
            ])
        }),
    }
}

/// Root mean square over the points of their pressure over that of Eq. 1 at their own volume,
/// minus one: the law itself, without the walls. They had a volume of `begun` (m3) in all.
fn law_error(run: &Run, begun: f64) -> Result<f64, String> {
    let file = run.last()?;
    let read = |name| file.column::<f32>(name).map_err(|e| e.to_string());
    let (volume, pressure) = (read("volume")?, read("pressure")?);
    let whole = begun / volume.len() as f64;
    let square =
        |(v, p): (&f32, &f32)| (f64::from(*p) / tait(f64::from(*v) / whole, PF[1]) - 1.0).powi(2);
    let sum: f64 = volume.iter().zip(pressure).map(square).sum();
    Ok((sum / volume.len() as f64).sqrt())
}
