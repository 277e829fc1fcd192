//! The profiles of a cell's faces side by side, for the points in it one after the other.

use super::faces::Face;
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

    /// Values of all profiles at `[a, b]`. The arithmetic is that of [`Profile::value`], operation by
    /// operation.
    ///
    /// [`Profile::value`]: super::profile::Profile::value
    #[inline]
    fn values(&self, [a, b]: &[[f32; 8]; 2]) -> [f32; 8] {
        let c = &self.coefficients;
        std::array::from_fn(|i| {
            let row = |m: usize| c[3 * m][i] + b[i] * (c[3 * m + 1][i] + b[i] * c[3 * m + 2][i]);
            row(0) + a[i] * (row(1) + a[i] * row(2))
        })
    }

    /// Slopes of all profiles along both tangents at `[a, b]`, as those of
    /// [`Profile::slope`](super::profile::Profile::slope).
    #[inline]
    fn slopes(&self, [a, b]: &[[f32; 8]; 2]) -> [[f32; 8]; 2] {
        let c = &self.coefficients;
        let first = std::array::from_fn(|i| {
            let row = |m: usize| c[3 * m][i] + b[i] * (c[3 * m + 1][i] + b[i] * c[3 * m + 2][i]);
            row(1) + 2.0 * a[i] * row(2)
        });
        let second = std::array::from_fn(|i| {
            let row = |m: usize| c[3 * m + 1][i] + 2.0 * b[i] * c[3 * m + 2][i];
            row(0) + a[i] * (row(1) + a[i] * row(2))
        });
        [first, second]
    }
}

/// A point's places on the faces of its cell, along the first and the second tangent of each.
#[inline]
fn places(local: [f64; 3], cell: [usize; 3]) -> [[f32; 8]; 2] {
    let from_centre: [f32; 3] = std::array::from_fn(|a| (local[a] - cell[a] as f64 - 0.5) as f32);
    let mut places = [[0.0; 8]; 2];
    for axis in 0..3 {
        for (place, t) in places.iter_mut().zip(tangents(axis)) {
            place[2 * axis..2 * axis + 2].fill(from_centre[t]);
        }
    }
    places
}

/// Between the values at the low and at the high face of a cell along `axis`.
#[inline]
fn between(values: &[f32; 8], axis: usize, along: f64) -> f64 {
    let [low, high] = [0, 1].map(|side| f64::from(values[2 * axis + side]));
    (1.0 - along) * low + along * high
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
        let values = stencil.values(&places(local, cell));
        let mut velocity = [0.0; 3];
        for (axis, v) in velocity
            .iter_mut()
            .enumerate()
            .take(self.window.domain.axes)
        {
            *v = if stencil.whole[axis] {
                between(&values, axis, local[axis] - cell[axis] as f64)
            } else {
                self.component::<true>(axis, index, cell, local, value_of)
            };
        }
        velocity
    }

    /// |dev D| (m/s per cell) at a point given in cells of the domain; `near` as for
    /// [`Flow::velocity`].
    pub(crate) fn deviator_norm(&self, point: [f64; 3], near: &mut Near) -> f64 {
        let (local, cell, index) = self.place(point);
        let stencil = near.of(self, index);
        let at = places(local, cell);
        let (values, slopes) = (stencil.values(&at), stencil.slopes(&at));
        let axes = self.window.domain.axes;
        let mut gradient = [[0.0; 3]; 3];
        for (axis, gradient) in gradient.iter_mut().enumerate().take(axes) {
            let along = local[axis] - cell[axis] as f64;
            if stencil.whole[axis] {
                let [low, high] = [0, 1].map(|side| f64::from(values[2 * axis + side]));
                gradient[axis] = high - low;
            } else {
                let [low, high] = [0.0, 1.0].map(|end| {
                    let mut local = local;
                    local[axis] = cell[axis] as f64 + end;
                    self.component::<true>(axis, index, cell, local, value_of)
                });
                gradient[axis] = high - low;
            }
            for (which, t) in tangents(axis)
                .into_iter()
                .enumerate()
                .filter(|t| t.1 < axes)
            {
                gradient[t] = if stencil.whole[axis] {
                    between(&slopes[which], axis, along)
                } else {
                    let slope = |f: &Face, at: [f32; 2]| f64::from(f.profile.slope(at, which));
                    self.component::<false>(axis, index, cell, local, slope)
                };
            }
        }
        super::deviator_norm(&gradient)
    }
}

#[inline]
fn value_of(face: &Face, at: [f32; 2]) -> f64 {
    f64::from(face.profile.value(at))
}

#[cfg(test)]
mod tests {
    use physics::VoxelBlock;

    use super::*;
    use crate::geometry::OPEN;
    use crate::geometry::tests::{domain, lattice};
    use crate::liquid::tests::sequence;

    /// Faces side by side give what they give one by one, to the last bit, whichever cell was asked for
    /// before; near walls and in air too.
    #[test]
    fn a_cells_faces_together_are_its_faces_one_by_one() {
        let mut random = sequence(8);
        for axes in [2, 3] {
            let depth = if axes == 3 { 8 } else { 1 };
            let wall = VoxelBlock::solid_box([3.3, 2.0, 0.0], [5.2, 6.6, 0.6 * depth as f64]);
            let lattice = lattice(domain([9, 8, depth], axes), vec![vec![wall]]);
            let n = lattice.window.len();
            let mut active: [Vec<u32>; 3] = std::array::from_fn(|_| vec![NONE; n]);
            let mut value: [Vec<f32>; 3] = std::array::from_fn(|_| vec![f32::NAN; n]);
            for axis in 0..axes {
                for face in (0..n).filter(|&face| lattice.face(axis, face) == OPEN) {
                    if random() < 0.9 {
                        (active[axis][face], value[axis][face]) = (0, random() as f32 - 0.5);
                    }
                }
            }
            let flow = Flow::new(&lattice, &value, &active, &[[0.1, -0.2, 0.3]], 0.01);
            let (mut near, mut whole) = (Near::default(), 0);
            for _ in 0..4000 {
                let size = [9.0, 8.0, depth as f64];
                let point = size.map(|size| size * random());
                let (local, cell, index) = flow.place(point);
                let velocity = flow.velocity(point, &mut near);
                let mut gradient = [[0.0; 3]; 3];
                for axis in 0..axes {
                    let of = |local| flow.component::<true>(axis, index, cell, local, value_of);
                    assert_eq!(velocity[axis].to_bits(), of(local).to_bits());
                    for (which, t) in tangents(axis)
                        .into_iter()
                        .enumerate()
                        .filter(|t| t.1 < axes)
                    {
                        let slope = |f: &Face, at: [f32; 2]| f64::from(f.profile.slope(at, which));
                        gradient[axis][t] =
                            flow.component::<false>(axis, index, cell, local, slope);
                    }
                    let [low, high] = [0.0, 1.0].map(|end| {
                        let mut local = local;
                        local[axis] = cell[axis] as f64 + end;
                        of(local)
                    });
                    gradient[axis][axis] = high - low;
                }
                let rate = flow.deviator_norm(point, &mut near);
                assert_eq!(
                    rate.to_bits(),
                    crate::transport::flow::deviator_norm(&gradient).to_bits()
                );
                whole += u32::from(near.of(&flow, index).whole[..axes] == [true; 3][..axes]);
            }
            assert!(
                (400..3600).contains(&whole),
                "{whole} of 4000 in cells with all faces"
            );
        }
    }
}
