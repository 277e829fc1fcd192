//! Rows of cells normal to the bond: those of the body below, those of the gap, those of the body above.

/// Which part of the grid a row is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RowKind {
    Below,
    Gap,
    Above,
}

/// Numbers of rows, from low y up, and the height of the gap. Rows of the parts below and above are a cell high; those of
/// the gap share its height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rows {
    pub(crate) below: usize,
    pub(crate) gap: usize,
    pub(crate) above: usize,
    /// Height of the gap, cells.
    pub(crate) height: f64,
}

/// Part of a cell, or of the liquid's water, that rounding may move in a run: far more than it does, far less than steps do.
pub(crate) const DRIFT: f64 = 1e-6;

impl Rows {
    /// Rows of a gap of `height` cells: as few as are no higher than a cell.
    pub(crate) fn of_gap(below: usize, above: usize, height: f64) -> Self {
        let gap = (height - DRIFT).ceil().max(0.0) as usize;
        Self {
            below,
            gap,
            above,
            height,
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.below + self.gap + self.above
    }

    pub(crate) fn kind(&self, row: usize) -> RowKind {
        if row < self.below {
            RowKind::Below
        } else if row < self.below + self.gap {
            RowKind::Gap
        } else {
            RowKind::Above
        }
    }

    /// Height of a row, cells.
    pub(crate) fn height_of(&self, row: usize) -> f64 {
        match self.kind(row) {
            RowKind::Gap => self.height / self.gap as f64,
            _ => 1.0,
        }
    }

    /// The low side of a row above the low side of the gap, cells.
    pub(crate) fn low(&self, row: usize) -> f64 {
        let from_gap = row as f64 - self.below as f64;
        match self.kind(row) {
            RowKind::Below => from_gap,
            RowKind::Gap => from_gap * self.height / self.gap as f64,
            RowKind::Above => from_gap - self.gap as f64 + self.height,
        }
    }

    /// Part of the closing speed by which the low side of a row moves against the body below: 0 there, 1 at the body above.
    pub(crate) fn closing_share(&self, row: usize) -> f64 {
        match self.kind(row) {
            RowKind::Below => 0.0,
            RowKind::Gap => (row - self.below) as f64 / self.gap as f64,
            RowKind::Above => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_the_gap_share_its_height() {
        let rows = Rows::of_gap(3, 2, 2.5);
        assert_eq!((rows.gap, rows.len()), (3, 8));
        let low: Vec<f64> = (0..8).map(|row| rows.low(row)).collect();
        let third = 2.5 / 3.0;
        assert_eq!(low, [-3.0, -2.0, -1.0, 0.0, third, 2.0 * third, 2.5, 3.5]);
        assert_eq!(rows.height_of(4), third);
        assert_eq!(
            [2, 3, 5, 6].map(|row| rows.closing_share(row)),
            [0.0, 0.0, 2.0 / 3.0, 1.0]
        );
        assert_eq!(Rows::of_gap(3, 2, 3.0 + 1e-9).gap, 3);
        assert_eq!(Rows::of_gap(3, 2, 0.0).gap, 0);
    }
}
