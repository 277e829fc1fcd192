//! Overfull blocks of cells: liquid in excess of the volume there.

use physics::{Dimensions, LiquidState, Scene};

/// Edge of the blocks in which liquid is counted, cells. Single cells are too small: by chance, material points fill some
/// to 150 %.
const BLOCK_CELLS: f64 = 2.0;
/// Fraction of a block's volume up to which it is not overfull.
const FULL_FRACTION: f64 = 1.5;

/// Fraction of the liquid's volume in excess of [`FULL_FRACTION`] in its block. Wood in a block is ignored.
pub(crate) fn crowded_fraction(scene: &Scene, liquid: &LiquidState) -> f64 {
    let grid = &scene.grid;
    let edge = BLOCK_CELLS * grid.cell_m;
    let count: [usize; 3] = grid.cells.map(|n| (n as f64 / BLOCK_CELLS).ceil() as usize);
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
    let beyond: f64 = filled
        .iter()
        .map(|v| (v - FULL_FRACTION * room).max(0.0))
        .sum();
    // One cell of excess is chance where there is little liquid.
    let beyond = (beyond - grid.cell_m.powi(3)).max(0.0);
    if whole > 0.0 { beyond / whole } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One block of two cells a side: the first cell of excess does not count.
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
            crowded_fraction(&scene, &liquid)
        };
        assert_eq!(filled(1.5 + 0.9 / room), 0.0);
        for times in [2.0, 4.0] {
            let beyond = ((times - 1.5) * room - 1.0) / (times * room);
            let found = filled(times);
            assert!((found - beyond).abs() < 1e-6, "{found} {beyond}");
        }
    }
}
