//! Steady flows against closed forms; run with `--nocapture` to see the errors.

mod bodies;
mod channels;
mod flow;
mod menisci;
#[path = "../../../tests/common/staircase.rs"]
mod staircase;

use super::{Scales, WidthRule};

impl Scales {
    /// Inertia alone, and walls that liquid sticks to.
    pub(crate) fn plain() -> Self {
        Self {
            inertia: 1.0,
            compressibility: 0.0,
            gravity: [0.0; 3],
            adhesion: 0.0,
            holding: 0.0,
            cell_per_step: 0.0,
            slow: 0.0,
            influence_length: 0.0,
            width: WidthRule::Normal,
        }
    }
}
