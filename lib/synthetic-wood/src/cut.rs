//! How an adherend is cut from its stem.

use rand::RngExt;

use super::random::{Feature, stream};
use super::recipe::Plan;

/// A position in the wood, um: along the fibres (l), along the rays (r) and along the growth
/// ring (t), from the middle of the bond plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WoodPoint {
    pub(crate) l: f32,
    pub(crate) r: f32,
    pub(crate) t: f32,
}

/// How an adherend was cut from the tree: unit vectors of l, r and t in box coordinates.
#[derive(Clone, Debug)]
pub(crate) struct Cut {
    axes: [[f32; 3]; 3],
}

/// Grain angle against the bond plane where none is given, degrees: "a few", so that lumens end in the surface.
const DIVE: [f32; 2] = [3.0, 6.0];
/// Largest grain angle within the bond plane, degrees.
const DRIFT: f32 = 3.0;
/// Angle between the rays and the bond normal, degrees: the bottom adherend is peeled (rays
/// along the normal), the top one sawn nearly on the quarter (rays across it).
const RAY_ANGLE: [[f32; 2]; 2] = [[-12.0, 12.0], [62.0, 84.0]];

impl Cut {
    pub(crate) fn new(plan: &Plan, side: usize) -> Self {
        let mut random = stream(plan, side, Feature::Cut);
        let [lowest, highest] = RAY_ANGLE[side];
        let rays = random.random_range(lowest..highest).to_radians();
        let sign = if random.random::<bool>() { 1.0 } else { -1.0 };
        let drawn = random.random_range(DIVE[0]..DIVE[1]).to_radians();
        let dive = sign * plan.grain_angle.unwrap_or(drawn);
        let drift = random.random_range(-DRIFT..DRIFT).to_radians();
        let l = unit([drift.tan(), dive.tan(), 1.0]);
        let across = [rays.sin(), rays.cos(), 0.0];
        let along = dot(across, l);
        let r = unit([0, 1, 2].map(|i| across[i] - along * l[i]));
        let t = [
            l[1] * r[2] - l[2] * r[1],
            l[2] * r[0] - l[0] * r[2],
            l[0] * r[1] - l[1] * r[0],
        ];
        Self { axes: [l, r, t] }
    }

    /// Wood coordinates of a box position (um from the middle of the bond plane).
    pub(crate) fn locate(&self, position: [f32; 3]) -> WoodPoint {
        let [l, r, t] = self.axes.map(|axis| dot(axis, position));
        WoodPoint { l, r, t }
    }

    /// Where the fibre at (r, t) crosses the middle page (z = 0): x and y, um.
    pub(crate) fn crossing(&self, r: f32, t: f32) -> [f32; 2] {
        let [el, er, et] = &self.axes;
        let l = -(r * er[2] + t * et[2]) / el[2];
        [0, 1].map(|i| l * el[i] + r * er[i] + t * et[i])
    }

    /// Smallest and largest l, r and t in a box given by its two corners.
    pub(crate) fn bounds(&self, corners: [[f32; 3]; 2]) -> [[f32; 2]; 3] {
        self.axes.map(|axis| {
            let reach = [0, 1, 2].map(|i| {
                let ends = corners.map(|corner| axis[i] * corner[i]);
                [ends[0].min(ends[1]), ends[0].max(ends[1])]
            });
            [0, 1].map(|end| reach.iter().map(|ends| ends[end]).sum())
        })
    }

    /// Slope of the fibres against the bond plane, dy/dz.
    pub(crate) fn slope(&self) -> f32 {
        self.axes[0][1] / self.axes[0][2]
    }

    /// Component of the ring direction t along box axis `axis` (0 x, 1 y).
    pub(crate) fn ring_along(&self, axis: usize) -> f32 {
        self.axes[2][axis]
    }
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn unit(v: [f32; 3]) -> [f32; 3] {
    let length = dot(v, v).sqrt();
    v.map(|c| c / length)
}
