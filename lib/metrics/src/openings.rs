//! Openings between the adherends, through which a plane is fitted.

use crate::State;
use crate::fit::Plane;
use crate::state::Across;

/// Largest fraction of the open columns taken to show the surfaces of both adherends.
const MOST_SURFACES: f64 = 0.25;
/// Rounding of the widths of openings, which are whole voxels, voxels.
const ROUNDING: f64 = 1e-3;

/// A column's place across the bond and the middle of its opening, m.
pub(crate) type Middle = ([f64; 2], f64);

/// The openings between the adherends along a plane.
pub(crate) struct Openings {
    /// Highest wood below the plane in each column, m.
    below: Vec<f64>,
    /// Lowest wood above the plane in each column, m.
    above: Vec<f64>,
    /// Columns in which the plane runs between wood, the narrowest opening first.
    pub(crate) open: Vec<usize>,
    /// Fraction of the open columns that counts.
    pub(crate) part: f64,
}

impl Openings {
    pub(crate) fn along(state: &State, across: &Across, plane: &Plane) -> Self {
        let n = state.normal.index();
        let columns = across.columns[0] * across.columns[1];
        let mut below = vec![f64::NEG_INFINITY; columns];
        let mut above = vec![f64::INFINITY; columns];
        let (mut wood, mut voxels) = (0, 0);
        for block in state.wood_blocks() {
            wood += block.bits.count();
            voxels += block.bits.dims().iter().product::<usize>();
            let half = 0.5 * block.voxel_m;
            block.bits.for_each(|index| {
                let centre = block.centre_m(index);
                let column = across.column(centre);
                let height = plane.coordinate(across.centre_m(column));
                if centre[n] < height {
                    below[column] = below[column].max(centre[n] + half);
                } else {
                    above[column] = above[column].min(centre[n] - half);
                }
            });
        }
        let width = |c: usize| above[c] - below[c];
        let mut open: Vec<usize> = (0..columns)
            .filter(|&c| width(c).is_finite() && width(c) > 0.5 * across.width_m)
            .collect();
        open.sort_unstable_by(|&a, &b| width(a).total_cmp(&width(b)).then(a.cmp(&b)));
        let fraction = wood as f64 / voxels.max(1) as f64;
        Self {
            below,
            above,
            open,
            part: (fraction * fraction).min(MOST_SURFACES),
        }
    }

    /// Place and middle of the narrowest openings, ties included, and the width of the widest of them.
    pub(crate) fn narrowest(&self, across: &Across) -> (Vec<Middle>, f64) {
        let width = |c: usize| self.above[c] - self.below[c];
        let last = (self.part * self.open.len() as f64) as usize;
        let Some(&last) = self.open.get(last) else {
            return (Vec::new(), 0.0);
        };
        let widest = width(last) + ROUNDING * across.width_m;
        let middles = self
            .open
            .iter()
            .take_while(|&&c| width(c) <= widest)
            .map(|&c| (across.centre_m(c), 0.5 * (self.below[c] + self.above[c])));
        (middles.collect(), width(last))
    }
}
