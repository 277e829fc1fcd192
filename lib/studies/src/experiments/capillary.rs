//! Capillary rise of glycerol in glass tubes, with a contact angle that depends on the speed, against the law that others fitted to
//! their measurements (lib/studies/reference/capillary).

use super::capillary_voxels::{DIP, POOL, Voxels};
use super::squeeze::rows;
use crate::Result;
use crate::method::Method;
use crate::numbers::last;
use crate::study::{Study, side_by_side};
use crate::verification::lumen::Section;

/// Density of glycerol, kg/m3.
pub(super) const DENSITY: f64 = 1260.0;
/// Its viscosity, Pa s.
pub(super) const VISCOSITY: f64 = 1.0111;
/// Its surface tension, N/m.
pub(super) const TENSION: f64 = 0.06347;
/// Its contact angle on glass at rest, degrees.
pub(super) const ANGLE: f64 = 5.6308;
/// Its weight per mass, m/s2.
pub(super) const GRAVITY: f64 = 9.81;

/// The k that predicts all tubes, of the law without ends of a tube.
pub(super) const SLOWING: f64 = 88.0;
/// What mouth and dip of the tubes run resist, as a part of k.
const ENDS: f64 = 4.0;
/// Mouth as a length of tube, diameters: half of an orifice's resistance (Sampson 1891).
const MOUTH: f64 = 0.27;

/// Radius of the tube that is run in smaller cells and with a constant angle too, m.
const WIDEST: f64 = 1e-3;
/// Part of Jurin's height at which a run ends.
const RISEN: f64 = 0.8;

/// A tube of the experiments and the k fitted to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tube {
    /// Radius, m.
    pub(super) radius: f64,
    /// Fitted to the heights, the angles and both, each with its deviation.
    pub(super) fits: [[f64; 2]; 3],
}

/// A run of a tube.
pub(super) struct Rise {
    pub(super) tube: Tube,
    pub(super) cells: u32,
    /// Its k without that of the ends; 0 is a constant angle.
    pub(super) slowing: f64,
    /// Times (s) and heights over the pool (m).
    pub(super) heights: Vec<[f64; 2]>,
    pub(super) cpu_s: f64,
}

/// The tubes of the table.
pub(super) fn tubes() -> Result<Vec<Tube>> {
    let rows: Vec<(f64, String, [f64; 2])> =
        rows(include_str!("../../reference/capillary/fits.csv"))?;
    let tubes = rows.chunks_exact(3).map(|of| Tube {
        radius: of[0].0,
        fits: [0, 1, 2].map(|i| of[i].2),
    });
    Ok(tubes.collect())
}

/// Runs the tubes that the study wants.
pub(super) fn run(study: &Study) -> Result<Vec<Rise>> {
    let mut wanted = Vec::new();
    for tube in tubes()? {
        for (cells, slowing) in [(4, SLOWING), (6, SLOWING), (4, 0.0)] {
            let name = name(&tube, cells, slowing);
            let all = tube.radius == WIDEST || (cells, slowing) == (4, SLOWING);
            if all && study.wants(&name) {
                wanted.push((tube, cells, slowing));
            }
        }
    }
    side_by_side(&wanted, |&(tube, cells, slowing)| {
        rise(study, tube, cells, slowing)
    })
}

fn name(tube: &Tube, cells: u32, slowing: f64) -> String {
    format!("capillary-{}mm-{cells}-k{slowing}", 1e3 * tube.radius)
}

fn rise(study: &Study, tube: Tube, cells: u32, slowing: f64) -> Result<Rise> {
    let method = match slowing > 0.0 {
        true => Method::implicit().setting(format!("adhesive.dynamic_angle={}", slowing - ENDS)),
        false => Method::implicit(),
    };
    let voxels = Voxels::new(tube, cells);
    let name = name(&tube, cells, slowing);
    let run = super::run_case(study, &name, &voxels.case(), &method)?;
    Ok(Rise {
        heights: voxels.heights(&run)?,
        tube,
        cells,
        slowing,
        cpu_s: run.cpu_s(),
    })
}

/// What resists and drives the liquid in a tube.
struct Motion {
    /// Height at which it rests, m.
    rest: f64,
    /// Length of tube that resists as all does that does not grow with the height, m.
    ends: f64,
    /// Time in which weight alone would move it by a metre at no height, over the metre of tube, s/m.
    pace: f64,
}

impl Motion {
    /// Time at which the liquid is at a height, s: the speed u of a length h obeys resistance (h + ends) u = weight (rest - h).
    fn time(&self, height: f64) -> f64 {
        let risen = height / self.rest;
        self.pace * (-height - (self.rest + self.ends) * (1.0 - risen).ln())
    }

    /// Height at a time, m.
    fn height(&self, time: f64) -> f64 {
        last(self.rest, |height| self.time(height) < time)
    }
}

/// Cosine of the angle at rest.
fn cosine() -> f64 {
    ANGLE.to_radians().cos()
}

impl Tube {
    /// Motion by the law with a k, in a round tube without ends over a wide pool.
    fn motion(&self, slowing: f64) -> Motion {
        let weight = DENSITY * GRAVITY;
        Motion {
            rest: 2.0 * TENSION * cosine() / (self.radius * weight),
            ends: 0.25 * slowing * self.radius,
            pace: 8.0 * VISCOSITY / (self.radius.powi(2) * weight),
        }
    }

    /// Height at a time by that, m.
    pub(super) fn height(&self, slowing: f64, time: f64) -> f64 {
        self.motion(slowing).height(time)
    }

    /// Jurin's height, m.
    pub(super) fn jurin(&self) -> f64 {
        self.motion(0.0).rest
    }

    /// Time at which a run ends, s.
    pub(super) fn end(&self) -> f64 {
        self.motion(SLOWING).time(RISEN * self.jurin())
    }
}

impl Rise {
    /// Height by the equation of motion of the same tube of voxels, with its mouth, dip and pool, m.
    pub(super) fn law(&self, time: f64) -> f64 {
        let voxels = Voxels::new(self.tube, self.cells);
        let (h, d) = (voxels.cell, 2.0 * self.tube.radius);
        let resistance = Section::Round(2).staircase_resistance(self.cells);
        let narrow = [4.0 / d, 1.0 / (POOL[0] * h)];
        let weight = DENSITY * GRAVITY;
        let slowing = (self.slowing - ENDS).max(0.0);
        let falls = voxels.falls();
        let motion = Motion {
            rest: TENSION * cosine() * (narrow[0] - narrow[1]) / weight,
            ends: (1.0 + falls) * (DIP * h + MOUTH * d + slowing * narrow[0] * d * d / resistance),
            pace: VISCOSITY * resistance / (d * d * weight) / (1.0 + falls).powi(2),
        };
        motion.height(time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Long before rest a tube without friction of its front fills as Washburn says, with it at the speed tension/(k viscosity).
    #[test]
    fn first_heights_are_those_of_washburn_and_of_the_front() {
        let tube = tubes().unwrap()[0];
        let time = 1e-3;
        let washburn = (0.5 * TENSION * cosine() * tube.radius * time / VISCOSITY).sqrt();
        assert!((tube.height(0.0, time) / washburn - 1.0).abs() < 0.02);
        let front = TENSION * cosine() * time / (SLOWING * VISCOSITY);
        assert!((tube.height(SLOWING, time) / front - 1.0).abs() < 0.02);
    }
}
