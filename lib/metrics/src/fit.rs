//! Planes fitted to bond surfaces.

use std::fmt;

use units::Axis;

use crate::State;
use crate::openings::{Middle, Openings};

/// Most rounds of fitting: the first plane that splits the wood is level, and any tilt that fits the box converges in a few.
const ROUNDS: usize = 8;
/// Least fraction of the open columns that a trusted fit uses. If wood meets wood in fewer, lumens are mistaken for surfaces.
const LEAST_FRACTION: f64 = 0.04;

/// A plane across the bond: coordinate along the normal = `level` + `slope` . (u - centre).
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    normal: Axis,
    axes: [Axis; 2],
    centre: [f64; 2],
    level: f64,
    slope: [f64; 2],
    /// Standard errors of the slopes.
    error: [f64; 2],
    /// A sentence if the plane may not run between the adherends.
    pub(crate) doubt: Option<String>,
}

/// Tilt of a fitted plane: right-handed turns of a level plane about x, y and z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tilt {
    /// The turns, degrees.
    pub deg: [f64; 3],
    /// Their standard errors, degrees.
    pub error_deg: [f64; 3],
}

impl fmt::Display for Tilt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Adding 0 removes the sign of -0.
        let [x, y, z] = self.deg.map(|deg| (1e2 * deg).round() / 1e2 + 0.0);
        let [dx, dy, dz] = self.error_deg;
        write!(
            f,
            "turned by {x:.2}, {y:.2} and {z:.2} degrees about x, y and z (standard errors {dx:.2}, {dy:.2} and {dz:.2})"
        )
    }
}

impl Plane {
    /// Coordinate along the normal at the centre of the bond area, m.
    pub fn centre_m(&self) -> f64 {
        self.level
    }

    /// Upward unit normal of the plane.
    pub(crate) fn up(&self) -> [f64; 3] {
        let mut up = [0.0; 3];
        up[self.normal.index()] = self.slant().recip();
        for (axis, slope) in self.axes.iter().zip(self.slope) {
            up[axis.index()] = -slope / self.slant();
        }
        up
    }

    /// Tilt of the plane.
    pub fn tilt(&self) -> Tilt {
        let n = self.normal.index();
        let mut tilt = Tilt {
            deg: [0.0; 3],
            error_deg: [0.0; 3],
        };
        for ((axis, slope), error) in self.axes.iter().zip(self.slope).zip(self.error) {
            let along = axis.index();
            let sign = if (along + 1) % 3 == n { 1.0 } else { -1.0 };
            let degrees = sign * slope.atan().to_degrees();
            // Rounding and adding 0 remove the sign of -0 and of tiny slopes.
            tilt.deg[3 - along - n] = (1e6 * degrees).round() / 1e6 + 0.0;
            tilt.error_deg[3 - along - n] = (error / (1.0 + slope * slope)).to_degrees();
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

    pub(crate) fn coordinate(&self, uv: [f64; 2]) -> f64 {
        self.level
            + self.slope[0] * (uv[0] - self.centre[0])
            + self.slope[1] * (uv[1] - self.centre[1])
    }

    /// The least-squares plane through `middles`; `None` if they do not extend along an axis with more than one column.
    fn through(&self, middles: &[Middle], columns: [usize; 2]) -> Option<Self> {
        let (level, slope) = least_squares(middles, self.centre, columns)?;
        Some(Self {
            level,
            slope,
            ..self.clone()
        })
    }

    /// Adds standard errors by a jackknife: planes through the `middles` without one quarter of the bond area. Roughness is
    /// correlated over many columns, so the scatter of columns about the plane would give errors ten times too small. Quarters
    /// are the fewest parts that determine a plane's three numbers. Slopes of 200 crops of bondline-acer-240, 32 to 128 voxels
    /// wide, are off by 1.5 to 2.5 such errors (rms). If the level start plane was `kept`, the errors are about the mean of the
    /// jackknife planes, as it is no fit.
    fn with_errors(
        mut self,
        middles: &[Middle],
        state: &State,
        (part, opening): (f64, f64),
        kept: bool,
    ) -> Result<Self, String> {
        let across = state.across();
        let n = state.normal.index();
        let half = |uv: [f64; 2], a: usize| across.columns[a] > 1 && uv[a] >= self.centre[a];
        let mut bare = false;
        let mut without = Vec::new();
        for quarter in QUARTERS {
            if [0, 1].iter().any(|&a| quarter[a] && across.columns[a] == 1) {
                continue;
            }
            let rest = |(uv, _): &&Middle| [0, 1].map(|a| half(*uv, a)) != quarter;
            let rest: Vec<Middle> = middles.iter().filter(rest).copied().collect();
            let plane = (rest.len() < middles.len())
                .then(|| self.through(&rest, across.columns))
                .flatten();
            bare |= plane.is_none();
            without.extend(plane.map(|p| [p.level, p.slope[0], p.slope[1]]));
        }
        if without.len() < 2 {
            return Err(too_few(middles));
        }
        let count = without.len() as f64;
        let about = match kept {
            true => [0, 1, 2].map(|i| without.iter().map(|p| p[i]).sum::<f64>() / count),
            false => [self.level, self.slope[0], self.slope[1]],
        };
        let error = |of: [f64; 3]| {
            let each = without
                .iter()
                .map(|p| (0..3).map(|i| (p[i] - about[i]) * of[i]).sum());
            ((count - 1.0) / count * each.map(|d: f64| d * d).sum::<f64>()).sqrt()
        };
        self.error = [error([0.0, 1.0, 0.0]), error([0.0, 0.0, 1.0])];
        let said = match kept {
            true => "no tilted plane cuts less wood: the level plane is kept,".into(),
            false => format!("the plane fitted to {} columns is", middles.len()),
        };
        let said = format!("{said} {}", self.tilt());
        let mut unsure = 0.0_f64;
        for quarter in QUARTERS {
            let corner = [0, 1].map(|a| match quarter[a] {
                true => state.box_max_m[self.axes[a].index()],
                false => state.box_min_m[self.axes[a].index()],
            });
            if !(state.box_min_m[n]..=state.box_max_m[n]).contains(&self.coordinate(corner)) {
                return Err(format!(
                    "{said} and beyond the specimen at a corner of the bond area"
                ));
            }
            let [u, v] = [0, 1].map(|a| corner[a] - self.centre[a]);
            // Two standard errors are 95 %.
            unsure = unsure.max(2.0 * error([1.0, u, v]));
        }
        self.doubt = if bare {
            Some(format!(
                "{said} and uncertain: a quarter of the bond area shows too few surfaces"
            ))
        } else if unsure > 0.5 * opening {
            Some(format!(
                "{said} with an error of {:.1} um at a corner of the bond area, more than half of the {:.1} um between the adherends",
                1e6 * unsure,
                1e6 * opening
            ))
        } else if part < LEAST_FRACTION {
            Some(format!(
                "{said} and uncertain: walls are so thin that they meet across only {:.1} % of the bond area, and lumens are mistaken for surfaces",
                1e2 * part
            ))
        } else {
            kept.then_some(said)
        };
        Ok(self)
    }
}

const QUARTERS: [[bool; 2]; 4] = [[false, false], [true, false], [false, true], [true, true]];

fn too_few(middles: &[Middle]) -> String {
    format!(
        "no plane can be fitted: only {} columns show the surfaces of both adherends, too small a part of the bond area",
        middles.len()
    )
}

/// Least-squares plane through the middle of the opening between the adherends.
///
/// In every column the opening reaches from the highest wood below the plane to the lowest wood above it. Columns over a cut
/// lumen are wide open and do not show the surface, so only the narrowest open columns count: the fraction f^2 in which wood
/// meets wood, with f the volume fraction of wood, at most a quarter (on bondline-acer-240 its level is 0.04 voxels off;
/// that of the narrower half 0.2). Starts from the level `start` and repeats with the fitted plane as long as it cuts no more
/// wood than before: else, in small specimens with few surface columns, a fit can drift into the lumens.
///
/// # Errors
/// A sentence: too few open columns, or a plane that leaves the specimen.
pub(crate) fn plane(state: &State, start: f64) -> Result<Plane, String> {
    let across = state.across();
    let extent = across.columns.map(|n| n as f64 * across.width_m);
    let mut plane = Plane {
        normal: state.normal,
        axes: across.axes,
        centre: [0, 1].map(|a| across.min_m[a] + 0.5 * extent[a]),
        level: start,
        slope: [0.0; 2],
        error: [0.0; 2],
        doubt: None,
    };
    let mut kept = false;
    let mut openings = Openings::along(state, &across, &plane);
    for round in 0..ROUNDS {
        let (middles, _) = openings.narrowest(&across);
        let next = plane.through(&middles, across.columns);
        let next = next.ok_or_else(|| too_few(&middles))?;
        if next == plane {
            break;
        }
        let next_openings = Openings::along(state, &across, &next);
        if next_openings.open.len() < openings.open.len() {
            kept = round == 0;
            break;
        }
        (plane, openings) = (next, next_openings);
    }
    let (middles, opening) = openings.narrowest(&across);
    plane.with_errors(&middles, state, (openings.part, opening), kept)
}

/// Level at `centre` and slopes of the least-squares plane; no slope along an axis of one column (plane strain).
fn least_squares(
    points: &[Middle],
    centre: [f64; 2],
    columns: [usize; 2],
) -> Option<(f64, [f64; 2])> {
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
    if columns[0] == 1 {
        (uu, uv, uy) = (1.0, 0.0, 0.0);
    }
    if columns[1] == 1 {
        (vv, uv, vy) = (1.0, 0.0, 0.0);
    }
    let determinant = uu * vv - uv * uv;
    if points.is_empty() || determinant <= 1e-12 * uu * vv {
        return None;
    }
    let slope = [
        (uy * vv - vy * uv) / determinant,
        (vy * uu - uy * uv) / determinant,
    ];
    let level = mean[2] + slope[0] * (centre[0] - mean[0]) + slope[1] * (centre[1] - mean[1]);
    Some((level, slope))
}
