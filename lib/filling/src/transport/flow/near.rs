//! The profiles of a cell's faces side by side, for the points in it one after the other.

use super::{Flow, tangents};
use crate::system::NONE;

/// Profiles of the two faces of a cell along each axis, coefficient by coefficient: face 2 axis is the
/// low one, face 2 axis + 1 the high one, and the last two are none, which fills the vector.
struct Stencil {
    /// Index of the cell in the window.
    index: usize,
    coefficients: [[f32; 8]; 9],
    /// Axes along which both faces have a velocity of their own.
    whole: [bool; 3],
}

impl Stencil {
    const NONE: Self = Self {
        index: usize::MAX,
        coefficients: [[0.0; 8]; 9],
        whole: [false; 3],
    };

    fn fill(&mut self, flow: &Flow, index: usize) {
        self.index = index;
        for axis in 0..flow.window.domain.axes {
            let high = index + flow.window.stride(axis);
            let slots = [index, high].map(|face| flow.slot[axis][face]);
            self.whole[axis] = !slots.contains(&NONE);
            if self.whole[axis] {
                for (side, slot) in slots.into_iter().enumerate() {
                    let profile = &flow.faces[slot as usize].profile;
                    for (all, &one) in self.coefficients.iter_mut().zip(profile.coefficients()) {
                        all[2 * axis + side] = one;
                    }
                }
            }
        }
    }

    /// Values of all profiles at a point's distances from the cell's centre. The arithmetic is that of
    /// [`super::profile::Profile::value`], operation by operation.
    #[inline]
    fn values(&self, from_centre: [f32; 3]) -> [f32; 8] {
        let (mut a, mut b) = ([0.0; 8], [0.0; 8]);
        for axis in 0..3 {
            let [t1, t2] = tangents(axis).map(|t| from_centre[t]);
            (a[2 * axis], a[2 * axis + 1]) = (t1, t1);
            (b[2 * axis], b[2 * axis + 1]) = (t2, t2);
        }
        let c = &self.coefficients;
        std::array::from_fn(|i| {
            let row = |m: usize| c[3 * m][i] + b[i] * (c[3 * m + 1][i] + b[i] * c[3 * m + 2][i]);
            row(0) + a[i] * (row(1) + a[i] * row(2))
        })
    }
}

/// The stencils that were asked for last: a point is mostly in the cell of the one before, and half
/// a step ahead in that one's.
pub(crate) struct Near {
    stencils: [Stencil; 2],
    latest: usize,
}

impl Default for Near {
    fn default() -> Self {
        Self {
            stencils: [Stencil::NONE; 2],
            latest: 0,
        }
    }
}

impl Near {
    #[inline]
    fn of(&mut self, flow: &Flow, index: usize) -> &Stencil {
        if self.stencils[self.latest].index != index {
            self.latest ^= 1;
            if self.stencils[self.latest].index != index {
                self.stencils[self.latest].fill(flow, index);
            }
        }
        &self.stencils[self.latest]
    }
}

impl Flow {
    /// Velocity (m/s) at a point given in cells of the domain; `near` is kept from point to point of
    /// this flow. In plane strain z stays 0.
    #[inline]
    pub(crate) fn velocity(&self, point: [f64; 3], near: &mut Near) -> [f64; 3] {
        let (local, cell, index) = self.place(point);
        let stencil = near.of(self, index);
        let values =
            stencil.values(std::array::from_fn(|a| (local[a] - cell[a] as f64 - 0.5) as f32));
        let mut velocity = [0.0; 3];
        for (axis, v) in velocity.iter_mut().enumerate().take(self.window.domain.axes) {
            *v = if stencil.whole[axis] {
                let along = local[axis] - cell[axis] as f64;
                let [low, high] = [0, 1].map(|side| f64::from(values[2 * axis + side]));
                (1.0 - along) * low + along * high
            } else {
                self.component::<true>(axis, index, cell, local, |face, at| {
                    f64::from(face.profile.value(at))
                })
            };
        }
        velocity
    }
}
