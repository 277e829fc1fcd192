//! The walls that a face sees along its tangents.

use super::tangents;
use crate::geometry::{Column, Lattice};

/// Distances to walls are exact to this.
pub(super) const TOUCH: f64 = 1e-6;

/// What a face sees along its tangents; the second one sees nothing in plane strain.
pub(super) fn see(lattice: &Lattice, axis: usize, index: usize) -> [Seen; 2] {
    let cell = lattice.window.coordinates(index);
    tangents(axis).map(|t| {
        let mut seen = Seen::default();
        if t >= lattice.window.domain.axes || lattice.clear(axis, cell, t) {
            return seen;
        }
        for column in 0..lattice.column_count() {
            seen.add(&lattice.column(axis, cell, t, column));
        }
        seen
    })
}

pub(super) struct Seen {
    /// Nearest walls below and above.
    pub(super) nearest: Column,
    /// Open columns.
    columns: u8,
    /// Whether they reach to walls at different distances.
    pub(super) uneven: bool,
    /// Bit 0: the control volume reaches beyond the face's edge above, bit 1: below.
    pub(super) reaches: u8,
}

impl Default for Seen {
    fn default() -> Self {
        Self {
            nearest: Column::FREE,
            columns: 0,
            uneven: false,
            reaches: 0,
        }
    }
}

/// How far a control volume reaches below and above the face's centre in a column.
pub(super) fn extent(column: &Column) -> [f64; 2] {
    [0, 1].map(|side| {
        if column.touches(side) {
            column.distance[side]
        } else {
            0.5
        }
    })
}

impl Seen {
    fn add(&mut self, column: &Column) {
        if column.blocked() {
            return;
        }
        for side in 0..2 {
            let distance = column.distance[side];
            let differs = (extent(&self.nearest)[side] - extent(column)[side]).abs() > TOUCH;
            self.uneven |= differs && self.columns != 0;
            if distance < self.nearest.distance[side] {
                self.nearest.distance[side] = distance;
                self.nearest.body[side] = column.body[side];
            }
            if column.touches(side) && distance > 0.5 + TOUCH {
                self.reaches |= if side == 1 { 1 } else { 2 };
            }
        }
        self.columns += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wall of body 3 above at these distances, one column each.
    fn seen(above: &[f64]) -> Seen {
        let mut seen = Seen::default();
        for &distance in above {
            let mut column = Column::FREE;
            (column.distance[1], column.body[1]) = (distance, 3);
            seen.add(&column);
        }
        seen
    }

    #[test]
    fn the_nearest_wall_counts_and_one_of_two_distances_is_uneven() {
        let one = seen(&[0.3]);
        assert!(!one.uneven, "one column is as far as itself");
        assert_eq!((one.nearest.distance[1], one.nearest.body[1]), (0.3, 3));
        assert!(!seen(&[0.3, 0.3]).uneven);
        let two = seen(&[0.8, 0.3, 0.7]);
        assert!(two.uneven && two.nearest.distance[1] == 0.3);
        assert_eq!(
            two.reaches, 1,
            "columns of 0.7 and 0.8 go beyond the edge above"
        );
        assert_eq!(seen(&[0.3, 0.5]).reaches, 0);
        // What rounding makes of one wall is even.
        assert!(!seen(&[0.6, 0.6 + 0.75e-6]).uneven && seen(&[0.6, 0.6 + 1.5e-6]).uneven);
        // Beyond a cell a wall is not near: the control volume ends half a cell away.
        assert!(!seen(&[1.5, 2.5]).uneven && seen(&[1.5]).reaches == 0);
    }

    #[test]
    fn a_column_that_is_solid_at_the_centre_shows_nothing() {
        let mut seen = seen(&[0.3]);
        seen.add(&Column {
            distance: [0.0; 2],
            body: [1; 2],
        });
        assert!(!seen.uneven && seen.columns == 1 && seen.nearest.body[1] == 3);
    }
}
