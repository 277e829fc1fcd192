//! Where the stages of a press programme begin.

use std::path::Path;

use plotters::style::RGBAColor;

use crate::Error;
use crate::axes::{Axis, SMALL};
use crate::colour::faded;
use crate::drawing::{Anchor, Drawing};
use crate::frame::Frame;
use crate::known::stage_kinds;
use crate::measure;
use crate::run_end::case_beside;
use crate::table::Table;

/// A stage of the programme of a run.
#[derive(Clone, Debug)]
pub(crate) struct Stage {
    begin_s: f64,
    /// Its kind where the case of the run is known, else its number.
    name: String,
}

/// Room for their names above a frame.
pub(crate) const ROOM: f64 = 1.3 * SMALL;
const SHADE: f64 = 0.6;

impl Stage {
    /// Those of a history, in its order; none where it is of no programme.
    pub(crate) fn read(table: &Table, history: &Path) -> Result<Vec<Self>, Error> {
        if !table.has("stage") {
            return Ok(Vec::new());
        }
        let (numbers, ends) = (table.numbers("stage")?, table.numbers("time_s")?);
        let steps = table.numbers("dt_s")?;
        let kinds = stage_kinds(&case_beside(history));
        let stage = |row: usize| {
            let number = numbers[row];
            let kind = (number as usize)
                .checked_sub(1)
                .and_then(|at| kinds.get(at));
            Self {
                begin_s: ends[row] - steps[row],
                name: kind.map_or_else(|| format!("stage {number}"), String::clone),
            }
        };
        let first = |row: &usize| *row == 0 || numbers[*row] != numbers[row - 1];
        Ok((0..numbers.len()).filter(first).map(stage).collect())
    }
}

/// Draws a thin line in each frame where a stage begins, times in `unit` (s), and their names above the first where they are
/// to be `named` and there is room.
pub(crate) fn draw(
    drawing: &mut Drawing,
    stages: &[Stage],
    frames: [&Frame; 2],
    (time, unit): (&Axis, f64),
    colour: RGBAColor,
    named: bool,
) {
    let mut free = frames[0].left;
    for stage in stages {
        // The first begins at zero, which has no logarithm.
        let share = time.share(stage.begin_s / unit).max(0.0);
        let x = frames[0].left + share * frames[0].width;
        for frame in frames {
            let ends = [[x, frame.top], [x, frame.bottom()]];
            drawing.line(ends.to_vec(), faded(colour, SHADE), 1.0);
        }
        let width = measure::width(&stage.name, SMALL);
        let left = x.min(frames[0].right() - width);
        if named && left >= free {
            let at = [left, frames[0].top - 0.6 * SMALL];
            drawing.text(stage.name.clone(), at, Anchor::Left, SMALL);
            free = left + width + 0.5 * SMALL;
        }
    }
}
