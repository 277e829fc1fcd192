//! Planes fitted to bond surfaces.

use units::Axis;

use crate::State;
use crate::state::Across;

/// Fits are repeated because the first split of wood into below and above is level; tilts that
/// a box can hold settle in a few rounds.
const ROUNDS: usize = 8;
/// Largest part of the open columns that shows surfaces of both adherends.
const SURFACES: f64 = 0.25;
/// Voxels by which the widths of openings differ where they are the same: they are whole voxels apart, but for rounding.
const SAME: f64 = 1e-3;

/// A plane across the bond: coordinate along the normal = `level` + `slope` . (u - centre).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    normal: Axis,
    axes: [Axis; 2],
    centre: [f64; 2],
    level: f64,
    slope: [f64; 2],
}

impl Plane {
    /// Coordinate along the normal at the centre of the bond area, m.
    pub fn centre_m(&self) -> f64 {
        self.level
    }

    /// The unit vector normal to it that points up.
    pub(crate) fn up(&self) -> [f64; 3] {
        let mut up = [0.0; 3];
        up[self.normal.index()] = self.slant().recip();
        for (axis, slope) in self.axes.iter().zip(self.slope) {
            up[axis.index()] = -slope / self.slant();
        }
        up
    }

    /// By how many degrees a level plane is turned, right-handed, about x, y and z to rise as this one.
    pub fn tilt_deg(&self) -> [f64; 3] {
        let n = self.normal.index();
        let mut tilt = [0.0; 3];
        for (axis, slope) in self.axes.iter().zip(self.slope) {
            let along = axis.index();
            let sign = if (along + 1) % 3 == n { 1.0 } else { -1.0 };
            let degrees = sign * slope.atan().to_degrees();
            // No rise has no sign, neither as zero nor as rounding.
            tilt[3 - along - n] = (1e6 * degrees).round() / 1e6 + 0.0;
        }
        tilt
    }

    /// Area of the plane over its projection along the normal.
    pub fn slant(&self) -> f64 {
        let [a, b] = self.slope;
        (1.0 + a * a + b * b).sqrt()
    }

    /// Signed distance (m) of a point, measured perpendicular to the plane.
    pub fn distance(&self, point: [f64; 3]) -> f64 {
        let uv = self.axes.map(|a| point[a.index()]);
        (point[self.normal.index()] - self.coordinate(uv)) / self.slant()
    }

    fn coordinate(&self, uv: [f64; 2]) -> f64 {
        self.level
            + self.slope[0] * (uv[0] - self.centre[0])
            + self.slope[1] * (uv[1] - self.centre[1])
    }
}

/// Least-squares plane through the middle of the opening between the adherends.
///
/// In every column the opening reaches from the highest wood below the plane to the lowest
/// wood above it. Columns that look into a cut lumen are wide open and say nothing about the
/// surface, so only the narrowest of the open columns count: of wood of the volume fraction f a part f^2, where wood meets wood,
/// at most a quarter (its level on bondline-acer-240 is 0.04 voxels off the true one; that of the narrower half 0.2).
/// Starts from the level `start` and repeats with the fitted plane as long as the plane cuts no
/// more wood than before: in small specimens with few surface columns a fit can otherwise walk
/// off into the lumens. `None` where no column is open between the adherends.
pub(crate) fn plane(state: &State, start: f64) -> Option<Plane> {
    let across = state.across();
    let extent = across.columns.map(|n| n as f64 * across.width_m);
    let mut plane = Plane {
        normal: state.normal,
        axes: across.axes,
        centre: [0, 1].map(|a| across.min_m[a] + 0.5 * extent[a]),
        level: start,
        slope: [0.0; 2],
    };
    let mut openings = Openings::along(state, &across, &plane);
    for _ in 0..ROUNDS {
        let middles = openings.narrowest_middles(&across);
        if middles.is_empty() {
            return None;
        }
        let (level, slope) = least_squares(&middles, plane.centre);
        let next = Plane {
            level,
            slope,
            ..plane
        };
        let next_openings = Openings::along(state, &across, &next);
        if next == plane || next_openings.open.len() < openings.open.len() {
            break;
        }
        (plane, openings) = (next, next_openings);
    }
    Some(plane)
}

/// The openings between the adherends along a plane.
struct Openings {
    /// Highest wood below the plane in each column, m.
    below: Vec<f64>,
    /// Lowest wood above the plane in each column, m.
    above: Vec<f64>,
    /// Columns in which the plane runs between wood, the narrowest opening first.
    open: Vec<usize>,
    /// Part of them that counts.
    part: f64,
}

impl Openings {
    fn along(state: &State, across: &Across, plane: &Plane) -> Self {
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
        let part = (fraction * fraction).min(SURFACES);
        Self {
            below,
            above,
            open,
            part,
        }
    }

    /// Place and middle of the narrowest openings, and of those as narrow.
    fn narrowest_middles(&self, across: &Across) -> Vec<([f64; 2], f64)> {
        let width = |c: usize| self.above[c] - self.below[c];
        let last = (self.part * self.open.len() as f64) as usize;
        let Some(&last) = self.open.get(last) else {
            return Vec::new();
        };
        let widest = width(last) + SAME * across.width_m;
        self.open
            .iter()
            .take_while(|&&c| width(c) <= widest)
            .map(|&c| (across.centre_m(c), 0.5 * (self.below[c] + self.above[c])))
            .collect()
    }
}

/// Level at `centre` and slopes of the least-squares plane. A direction in which the points
/// do not extend (plane strain) has no slope.
fn least_squares(points: &[([f64; 2], f64)], centre: [f64; 2]) -> (f64, [f64; 2]) {
    let count = points.len() as f64;
    let mean = points.iter().fold([0.0; 3], |m, (uv, y)| {
        [m[0] + uv[0] / count, m[1] + uv[1] / count, m[2] + y / count]
    });
    let (mut uu, mut uv, mut vv, mut uy, mut vy) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (position, y) in points {
        let (u, v, y) = (position[0] - mean[0], position[1] - mean[1], y - mean[2]);
        uu += u * u;
        uv += u * v;
        vv += v * v;
        uy += u * y;
        vy += v * y;
    }
    let determinant = uu * vv - uv * uv;
    let slope = if determinant > 1e-12 * (uu * uu + vv * vv) {
        [
            (uy * vv - vy * uv) / determinant,
            (vy * uu - uy * uv) / determinant,
        ]
    } else if uu >= vv && uu > 0.0 {
        [uy / uu, 0.0]
    } else if vv > 0.0 {
        [0.0, vy / vv]
    } else {
        [0.0; 2]
    };
    let level = mean[2] + slope[0] * (centre[0] - mean[0]) + slope[1] * (centre[1] - mean[1]);
    (level, slope)
}
