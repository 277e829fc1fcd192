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
            self.uneven |= differs && self.columns > 0;
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
