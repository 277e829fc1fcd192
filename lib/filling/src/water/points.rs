//! The points as holders of solids and water.

use physics::Water;

use super::Exchange;
use crate::liquid::{Bins, Particles};

/// Divides the points into solids and water as at the start; the water in all of them, cells.
pub(crate) fn fill(particles: &mut Particles, water: &Water) -> f64 {
    let ratio = water.start();
    particles.parts = (particles.volume.iter())
        .map(|&volume| {
            let solids = f64::from(volume) / (1.0 + ratio);
            [solids, solids * ratio]
        })
        .collect();
    particles.water()
}

/// The points of each cell, sorted into `bins`, give off or take up the water that leaves or enters it:
/// each by its part of what can still leave, or of what is missing from the start.
pub(crate) fn give_off(particles: &mut Particles, bins: &Bins, exchange: &Exchange, water: &Water) {
    let (start, least) = (water.start(), water.least());
    for &(cell, gained) in &exchange.gained {
        let range = bins.of(cell as usize);
        let room = |&[solids, held]: &[f64; 2]| match gained < 0.0 {
            true => (held - least * solids).max(0.0),
            false => (start * solids - held).max(0.0),
        };
        let parts = &mut particles.parts[range.clone()];
        let all: f64 = parts.iter().map(room).sum();
        let solids: f64 = parts.iter().map(|part| part[0]).sum();
        for part in parts.iter_mut() {
            let share = match all > 0.0 {
                true => room(part) / all,
                false => part[0] / solids,
            };
            part[1] += gained * share;
        }
        for point in range {
            let [solids, held] = particles.parts[point];
            particles.volume[point] = (solids + held) as f32;
        }
    }
}

impl Particles {
    /// Water in all points, cells.
    pub(crate) fn water(&self) -> f64 {
        self.parts.iter().map(|part| part[1]).sum()
    }
}
