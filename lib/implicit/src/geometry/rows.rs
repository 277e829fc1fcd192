//! Rows of cells along the bond normal: those of the part below the gap, of the gap, and of the part above.

/// The part of the grid to which a row belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RowKind {
    Below,
    Gap,
    Above,
}

/// Row counts of the three parts and the height of the gap. Rows below and above are one cell high; those of the gap share its
/// height equally. Rows are numbered from low y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rows {
    pub(crate) below: usize,
    pub(crate) gap: usize,
    pub(crate) above: usize,
    /// Height of the gap, cells.
    pub(crate) height: f64,
}

/// Bound on accumulated rounding, in cells or as a share of the water: far above what rounding does, far below what a step
/// does.
pub(crate) const DRIFT: f64 = 1e-6;

impl Rows {
    /// Rows with a gap of `height` cells, which has the fewest rows that are no higher than a cell.
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

    /// y of the low side of a row, cells from the low side of the gap.
    pub(crate) fn low(&self, row: usize) -> f64 {
        let from_gap = row as f64 - self.below as f64;
        match self.kind(row) {
            RowKind::Below => from_gap,
            RowKind::Gap => from_gap * self.height / self.gap as f64,
            RowKind::Above => from_gap - self.gap as f64 + self.height,
        }
    }

    /// Velocity of the low side of a row relative to the part below, over that of the part above: 0 below, 1 above, linear
    /// across the gap.
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
