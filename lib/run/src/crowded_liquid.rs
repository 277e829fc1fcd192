//! Liquid that is where there is no room for it.

use physics::{Dimensions, LiquidState, Scene};

/// Edge of the blocks that liquid is counted in, cells: of single cells, material points fill some half as much
/// again by where they happen to be.
const BLOCK: f64 = 2.0;
/// Part of a block's room that the points in it may fill.
const FULL: f64 = 1.5;

/// Part of the liquid's volume that lies beyond [`FULL`] in its block, wood or not.
pub(crate) fn crowded(scene: &Scene, liquid: &LiquidState) -> f64 {
    let grid = &scene.grid;
    let edge = BLOCK * grid.cell_m;
    let count: [usize; 3] = grid.cells.map(|n| (n as f64 / BLOCK).ceil() as usize);
    let room = match scene.dimensions {
        Dimensions::Two => edge * edge * grid.cell_m,
        Dimensions::Three => edge.powi(3),
    };
    let mut filled = vec![0.0; count.iter().product()];
    for (position, &volume) in liquid.position.iter().zip(&liquid.volume) {
        let [i, j, k] = std::array::from_fn(|a| {
            let at = (f64::from(position[a]) - grid.min_m[a]) / edge;
            (at.max(0.0) as usize).min(count[a] - 1)
        });
        filled[(k * count[1] + j) * count[0] + i] += f64::from(volume);
    }
    let whole: f64 = filled.iter().sum();
    let beyond: f64 = filled.iter().map(|v| (v - FULL * room).max(0.0)).sum();
    // Of little liquid a cell more or less is chance.
    let beyond = (beyond - grid.cell_m.powi(3)).max(0.0);
    if whole > 0.0 { beyond / whole } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One block of two cells a side: a tenth more than it may hold, and a cell, is all that counts.
    #[test]
    fn what_lies_beyond_one_and_a_half_times_the_room_counts_less_a_cell() {
        // Plane strain: one cell deep.
        let scene = crate::verdict::tests::setup().scene;
        let (room, cell_m) = (4.0, scene.grid.cell_m);
        let place = scene.grid.min_m.map(|x| (x + 0.1 * cell_m) as f32);
        let filled = |times: f64| {
            let liquid = LiquidState {
                position: vec![place],
                volume: vec![(times * room * cell_m.powi(3)) as f32],
                ..LiquidState::default()
            };
            crowded(&scene, &liquid)
        };
        assert_eq!(filled(1.5 + 0.9 / room), 0.0);
        for times in [2.0, 4.0] {
            let beyond = ((times - 1.5) * room - 1.0) / (times * room);
            let found = filled(times);
            assert!((found - beyond).abs() < 1e-6, "{found} {beyond}");
        }
    }
}
