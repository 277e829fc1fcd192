//! The gradient of velocity at the points of a tile.

use crate::lanes::Lanes8;
use crate::real::Real;
use crate::window::BATCH;

/// Derivative of each component of velocity along each axis (m/s per cell), a list over points for each, so
/// that any eight points that follow one another are one vector.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gradient {
    /// Axis, component; as many entries more as a vector may reach beyond the last point.
    lists: [[Vec<Real>; 3]; 3],
}

impl Gradient {
    /// Room for `points` points.
    pub(crate) fn resize(&mut self, points: usize) {
        for list in self.lists.as_flattened_mut() {
            list.resize(points + BATCH, 0.0);
        }
    }

    /// Sets that of eight points from point `start` on: axis, component; lanes are points.
    #[inline(always)]
    pub(crate) fn set(&mut self, start: usize, component: usize, along: &[Lanes8; 3]) {
        for a in 0..3 {
            self.lists[a][component][start..start + BATCH].copy_from_slice(&along[a].0);
        }
    }

    /// That of eight points from point `start` on: axis, component; lanes are points.
    #[inline(always)]
    pub(crate) fn of_eight(&self, start: usize) -> [[Lanes8; 3]; 3] {
        let mut eight = [[Lanes8::ZERO; 3]; 3];
        for a in 0..3 {
            for c in 0..3 {
                eight[a][c]
                    .0
                    .copy_from_slice(&self.lists[a][c][start..start + BATCH]);
            }
        }
        eight
    }

    /// Rate of volume change at a point, m/s per cell.
    pub(crate) fn trace(&self, point: usize) -> Real {
        (0..3).map(|a| self.lists[a][a][point]).sum()
    }

    /// Adds `change` along every axis to how fast a point stretches.
    pub(crate) fn stretch(&mut self, point: usize, change: Real) {
        for a in 0..3 {
            self.lists[a][a][point] += change;
        }
    }
}
