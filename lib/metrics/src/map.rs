//! Penetration of each column across the bond.

use crate::state::Across;
use crate::{Datum, Side, State};

/// Weighted penetration of each column of voxels across the bond (paper Figs. 8, 9).
#[derive(Clone, Debug)]
pub struct Map {
    /// The columns; the first axis runs fastest.
    pub across: Across,
    /// Volume of adhesive in each column, m3.
    pub volume_m3: Vec<f64>,
    /// Sum of V Y^2 in each column, m5.
    moment: Vec<f64>,
}

impl Map {
    /// The map of `side` of a state.
    pub fn new(state: &State, datum: &Datum, side: Side) -> Self {
        let across = state.across();
        let columns = across.columns[0] * across.columns[1];
        let mut map = Self {
            across,
            volume_m3: vec![0.0; columns],
            moment: vec![0.0; columns],
        };
        state.for_each_parcel(|point, volume| {
            let (on, depth) = datum.depth(point, state.voxel_m);
            let volume = side.share(on) * volume;
            if volume > 0.0 {
                let column = across.column(point);
                map.volume_m3[column] += volume;
                map.moment[column] += volume * depth * depth;
            }
        });
        map
    }

    /// WP of a column, m; `None` where it holds no adhesive.
    pub fn wp_m(&self, column: usize) -> Option<f64> {
        let volume = self.volume_m3[column];
        (volume > 0.0).then(|| (self.moment[column] / volume).sqrt())
    }
}
