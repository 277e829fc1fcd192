//! Integrals of the shape function along one axis.

use physics::Boundary;

use super::block::BlockShape;
use crate::lattice::Lattice;
use crate::real::Real;
use crate::settings::ShapeFunction;

/// Integrals over one voxel along one axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slice {
    pub(super) index: usize,
    /// Of the shape function, of its slope, and of the shape function times position.
    pub(super) w: Real,
    pub(super) g: Real,
    pub(super) m: Real,
}

/// What is needed to integrate over bodies.
#[derive(Clone, Debug)]
pub(crate) struct Integrator {
    pub(super) lattice: Lattice,
    spline: bool,
}

impl Integrator {
    pub(crate) fn new(lattice: &Lattice, shape: ShapeFunction) -> Self {
        Self {
            lattice: lattice.clone(),
            spline: shape == ShapeFunction::Bspline2,
        }
    }

    fn reach(&self) -> f64 {
        if self.spline { 1.5 } else { 1.0 }
    }

    /// The shape function at `x` cells from the node.
    fn value(&self, x: f64) -> f64 {
        let a = x.abs();
        if !self.spline {
            (1.0 - a).max(0.0)
        } else if a < 0.5 {
            0.75 - a * a
        } else {
            0.5 * (1.5 - a).max(0.0).powi(2)
        }
    }

    /// Its integral from minus infinity to `x`.
    fn integral(&self, x: f64) -> f64 {
        let half = |a: f64| {
            if !self.spline {
                0.5 * (1.0 - a).max(0.0).powi(2)
            } else if a < 0.5 {
                0.5 - 0.75 * a + a.powi(3) / 3.0
            } else {
                (1.5 - a).max(0.0).powi(3) / 6.0
            }
        };
        if x < 0.0 { half(-x) } else { 1.0 - half(x) }
    }

    /// The integral of x times it from minus infinity to `x`.
    fn moment(&self, x: f64) -> f64 {
        let a = x.abs().min(self.reach());
        if !self.spline {
            a * a / 2.0 - a.powi(3) / 3.0 - 1.0 / 6.0
        } else if a < 0.5 {
            0.375 * a * a - a.powi(4) / 4.0 - 13.0 / 64.0
        } else {
            let u = 1.5 - a;
            u.powi(4) / 8.0 - u.powi(3) / 4.0
        }
    }

    /// Integrals over the voxels of `block` within reach (+ `margin`) of node `g` on `axis`,
    /// the body being displaced by `shift` cells. Mirror and periodic images are included.
    pub(super) fn slices(
        &self,
        block: &BlockShape,
        axis: usize,
        g: i32,
        shift: f64,
        margin: f64,
    ) -> Vec<Slice> {
        let (origin, voxel) = (block.origin[axis] + shift, block.voxel[axis]);
        let count = block.solid.dims()[axis];
        if axis == 2 && !self.lattice.three {
            return depth_slices(origin, voxel, count);
        }
        let mut slices = Vec::new();
        let n = f64::from(self.lattice.cells[axis]);
        let x = f64::from(g);
        let boundary = self.lattice.boundary[axis];
        let reach = self.reach() + margin;
        let mut images = vec![(x, 1.0)];
        match boundary {
            Boundary::Periodic => {
                // However many periods the body has gone.
                let (low, high) = (
                    origin - reach - x,
                    origin + count as f64 * voxel + reach - x,
                );
                let periods = (low / n).ceil() as i64..=(high / n).floor() as i64;
                images = periods.map(|k| (x + k as f64 * n, 1.0)).collect();
            }
            Boundary::Symmetry => {
                images.extend((g != 0).then_some((-x, -1.0)));
                images.extend((x != n).then_some((2.0 * n - x, -1.0)));
            }
            Boundary::Open => {}
        }
        let (clip_low, clip_high) = match boundary {
            Boundary::Symmetry => (0.0, n),
            _ => (f64::NEG_INFINITY, f64::INFINITY),
        };
        for (node, sign) in images {
            let first = ((node - reach - origin) / voxel).floor().max(0.0) as usize;
            let last = ((node + reach - origin) / voxel)
                .ceil()
                .clamp(0.0, count as f64) as usize;
            for index in first..last {
                let low = (origin + index as f64 * voxel).max(clip_low);
                let high = (origin + (index + 1) as f64 * voxel).min(clip_high);
                if high <= low {
                    continue;
                }
                let (low, high) = (low - node, high - node);
                slices.push(Slice {
                    index,
                    w: (self.integral(high) - self.integral(low)) as Real,
                    g: (sign * (self.value(high) - self.value(low))) as Real,
                    m: (sign * (self.moment(high) - self.moment(low))) as Real,
                });
            }
        }
        slices
    }
}

/// Integrals over the voxels along the depth of plane strain, one cell, where the shape function is 1.
fn depth_slices(origin: f64, voxel: f64, count: usize) -> Vec<Slice> {
    let slice = |index: usize| {
        let low = (origin + index as f64 * voxel).max(0.0);
        let high = (origin + (index + 1) as f64 * voxel).min(1.0);
        (high > low).then_some(Slice {
            index,
            w: (high - low) as Real,
            g: 0.0,
            m: 0.0,
        })
    };
    (0..count).filter_map(slice).collect()
}

#[cfg(test)]
mod tests {
    use physics::VoxelBlock;

    use super::*;

    /// A body that had gone more than a period was gone for the nodes.
    #[test]
    fn a_body_is_felt_however_many_periods_it_has_gone() {
        let lattice = Lattice::cube(6, Boundary::Periodic);
        let of = Integrator::new(&lattice, ShapeFunction::Gimp);
        for width in [1, 4, 12] {
            let block = BlockShape {
                origin: [4.0; 3],
                voxel: [0.5; 3],
                solid: VoxelBlock::from_fn([0.0; 3], [1.0; 3], [width; 3], |_, _, _| true),
            };
            for g in 0..6 {
                let felt = |shift: f64| -> [f64; 2] {
                    let slices = of.slices(&block, 0, g, shift, 0.0);
                    let sum =
                        |of: fn(&Slice) -> Real| slices.iter().map(|s| f64::from(of(s))).sum();
                    [sum(|s| s.w), sum(|s| s.g)]
                };
                let near = |a: [f64; 2], b: [f64; 2]| (0..2).all(|i| (a[i] - b[i]).abs() < 1e-6);
                for periods in [-1000.0, -2.0, -1.0, 1.0, 2.0, 3.0, 1000.0] {
                    let (there, here) = (felt(0.25 + 6.0 * periods), felt(0.25));
                    assert!(near(there, here), "{width} {g}: {there:?} for {here:?}");
                }
                assert!(width < 12 || near(felt(0.25), [1.0, 0.0]), "a full period");
            }
        }
    }

    /// By the midpoint rule from beyond the reach on.
    #[test]
    fn integrals_are_those_of_the_shape_function() {
        const STEP: f64 = 1e-3;
        let lattice = Lattice::cube(4, Boundary::Open);
        for shape in [ShapeFunction::Gimp, ShapeFunction::Bspline2] {
            let of = Integrator::new(&lattice, shape);
            let (mut sum, mut moment) = (0.0, 0.0);
            for i in 0..4000 {
                let x = f64::from(i) * STEP - 2.0;
                for (found, exact) in [(of.integral(x), sum), (of.moment(x), moment)] {
                    assert!((found - exact).abs() < 1e-6, "{shape:?} at {x}: {exact}");
                }
                let middle = x + 0.5 * STEP;
                sum += STEP * of.value(middle);
                moment += STEP * middle * of.value(middle);
            }
            assert!((sum - 1.0).abs() < 1e-6 && moment.abs() < 1e-6, "{shape:?}");
        }
    }
}
