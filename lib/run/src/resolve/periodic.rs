//! Boxes of bodies in a domain with periodic sides.

use physics::{Boundary, Dimensions, GridBox};

use super::Corners;
use crate::failure::{RunFailure, refused};

/// Rounding of a length, cells.
const ROUNDING: f64 = 1e-6;

/// Refuses a domain from `min` to `max` (m) whose length between periodic sides is no whole number of cells.
pub(super) fn check_whole_cells(
    grid: &GridBox,
    (min, max): Corners,
    boundary: [Boundary; 3],
) -> Result<(), RunFailure> {
    for (a, name) in ["x", "y", "z"].into_iter().enumerate() {
        let cells = (max[a] - min[a]) / grid.cell_m;
        if boundary[a] == Boundary::Periodic && (cells - grid.cells[a] as f64).abs() > ROUNDING {
            return refused(format!(
                "the domain is {cells:.3} cells long along {name}, whose sides are periodic: a whole number is needed, choose another [grid] domain or cell"
            ));
        }
    }
    Ok(())
}

/// The parts of a box and its periodic images that lie within the domain: a part beyond a periodic side enters at the
/// opposite one. A box as long as the period fills it.
pub(super) fn parts_inside(
    box_m: Corners,
    grid: &GridBox,
    boundary: [Boundary; 3],
    dimensions: Dimensions,
) -> Vec<Corners> {
    let (min, max) = (grid.min_m, grid.max_m());
    let hair = ROUNDING * grid.cell_m;
    let mut parts = vec![box_m];
    for a in (0..dimensions.axes()).filter(|&a| boundary[a] == Boundary::Periodic) {
        let period = max[a] - min[a];
        parts = (parts.into_iter())
            .flat_map(|(low, high)| {
                let part = |from: f64, to: f64| {
                    let (mut low, mut high) = (low, high);
                    (low[a], high[a]) = (from, to);
                    (low, high)
                };
                let length = high[a] - low[a];
                if length >= period - hair {
                    return vec![part(min[a], max[a])];
                }
                let shift = period * ((low[a] + hair - min[a]) / period).floor();
                let (from, to) = ((low[a] - shift).max(min[a]), high[a] - shift);
                match to > max[a] + hair {
                    true => vec![part(from, max[a]), part(min[a], to - period)],
                    false => vec![part(from, to.min(max[a]))],
                }
            })
            .collect();
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(low: f64, high: f64) -> Vec<[f64; 2]> {
        let grid = GridBox {
            cell_m: 1.0,
            min_m: [2.0, 0.0, 0.0],
            cells: [12, 20, 1],
        };
        let boundary = [Boundary::Periodic, Boundary::Open, Boundary::Symmetry];
        let box_m = ([low, -3.0, 0.0], [high, 40.0, 1.0]);
        (parts_inside(box_m, &grid, boundary, Dimensions::Two).iter())
            .inspect(|(low, high)| assert_eq!([low[1], high[1]], [-3.0, 40.0]))
            .map(|(low, high)| [low[0], high[0]])
            .collect()
    }

    #[test]
    fn what_of_a_box_is_beyond_a_periodic_side_comes_in_at_the_other() {
        assert_eq!(parts(3.0, 9.0), [[3.0, 9.0]]);
        assert_eq!(parts(11.0, 17.0), [[11.0, 14.0], [2.0, 5.0]]);
        assert_eq!(parts(-1.0, 5.0), [[11.0, 14.0], [2.0, 5.0]]);
        for periods in [-36.0, -12.0, 12.0, 1200.0] {
            assert_eq!(parts(3.0 + periods, 9.0 + periods), [[3.0, 9.0]]);
            assert_eq!(parts(8.0 + periods, 14.0 + periods), [[8.0, 14.0]]);
        }
        for wide in [(2.0, 14.0), (-1.0, 11.0), (-50.0, 70.0), (2.0, 13.9999999)] {
            assert_eq!(parts(wide.0, wide.1), [[2.0, 14.0]]);
        }
        // Rounding beyond a side makes no part of a ten millionth of a cell.
        assert_eq!(parts(8.0, 14.0000001), [[8.0, 14.0]]);
        assert_eq!(parts(1.9999999, 5.0), [[2.0, 5.0]]);
    }
}
