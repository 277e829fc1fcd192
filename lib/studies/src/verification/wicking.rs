//! Liquid drawn into a slit or a tube by its surface, or kept out by it: Lucas and Washburn's law, and no
//! entry below the jump.

use super::lumen::{Rectangle, Section, quarter};
use super::{LUMEN, Measured, Scene};
use crate::case_text::{Body, CaseText, PF};
use crate::outputs::Run;

/// Surface tension, N/m.
pub(super) const TENSION: f64 = 0.05;
/// Filled length up to which a run goes, over the width.
const LONGEST: f64 = 4.0;
/// Equivalent length of entrance and front over the width; where a run ends depends on it, its error does not.
const ENTRANCE: f64 = 0.3;
/// States of a run that L(t) is taken from.
const STATES: u32 = 60;

/// Slit of `n` cells in plane strain, a liquid of this contact angle, walls `offset` cells off the nodes
/// across the slit and along it.
pub fn slit_scene(n: u32, offset: [f64; 2], degrees: f64) -> Scene {
    let h = LUMEN / f64::from(n);
    let (mouth, low) = (
        3.0 * LUMEN + (2.0 + offset[1]) * h,
        1.5 * LUMEN + offset[0] * h,
    );
    let size = [mouth + (LONGEST + 1.5) * LUMEN, 4.0 * LUMEN];
    let bodies = vec![
        Body::wall([mouth, 0.0, 0.0], [size[0], low, h]),
        Body::wall([mouth, low + LUMEN, 0.0], [size[0], size[1], h]),
        Body::liquid([2.0 * h, 0.0, 0.0], [mouth, size[1], h]),
    ];
    let passage = Passage {
        name: format!(
            "wicking-slit-n{n}-{degrees}deg-off{}-{}",
            offset[0], offset[1]
        ),
        degrees,
        mouth,
        area: LUMEN * h,
        jump: 2.0 / LUMEN,
        resistance: 12.0,
    };
    let case = CaseText {
        bodies,
        ..CaseText::plane(String::new(), h, size)
    };
    passage.of(case)
}

/// A quarter of a tube of `n` cells.
pub fn tube_scene(n: u32, degrees: f64) -> Scene {
    let section = Section::Round(2);
    let h = LUMEN / f64::from(n);
    let mouth = 1.5 * LUMEN + 2.0 * h;
    let right = LUMEN + 2.0 * h;
    let far = mouth + (LONGEST + 1.5) * LUMEN;
    let shape = quarter(section, n, LUMEN, right);
    let wall = |r: &Rectangle| Body::wall([mouth, r.low[0], r.low[1]], [far, r.high[0], r.high[1]]);
    let mut bodies: Vec<Body> = shape.sides.iter().map(wall).collect();
    bodies.push(wall(&shape.roof));
    bodies.push(Body::liquid([2.0 * h, 0.0, 0.0], [mouth, right, right]));
    let passage = Passage {
        name: format!("wicking-tube-n{n}-{degrees}deg"),
        degrees,
        mouth,
        area: section.area(n) * LUMEN * LUMEN / 4.0,
        jump: 4.0 / LUMEN,
        resistance: section.staircase_resistance(n),
    };
    let case = CaseText {
        bodies,
        ..CaseText::new(String::new(), h, 3, [far, right, right])
    };
    passage.of(case)
}

/// A passage behind a reservoir with a free surface at its back.
struct Passage {
    name: String,
    degrees: f64,
    /// Where it begins, m.
    mouth: f64,
    /// Its area in the domain, m2.
    area: f64,
    /// Perimeter over area, 1/m.
    jump: f64,
    /// Pressure gradient over viscosity and mean velocity times the square of the width.
    resistance: f64,
}

impl Passage {
    fn of(self, case: CaseText) -> Scene {
        let jump = TENSION * self.degrees.to_radians().cos() * self.jump;
        // L^2 + 2 e L = 2 P d^2/(R eta) t
        let rate = 2.0 * jump.abs() * LUMEN * LUMEN / (self.resistance * PF[2]);
        let end = LUMEN * LUMEN * LONGEST * (LONGEST + 2.0 * ENTRANCE) / rate;
        let entry = jump < 0.0;
        let against = match entry {
            true => "no entry",
            false => "Lucas-Washburn",
        };
        let case = CaseText {
            title: format!(
                "A passage in front of a reservoir, contact angle {} degrees.\nAgainst {against}.",
                self.degrees
            ),
            wetting: Some([TENSION, self.degrees]),
            stop: Some(end),
            snapshots: STATES,
            history_every: end / 100.0,
            ..case
        };
        Scene {
            name: self.name,
            case,
            against,
            measure: Box::new(move |run| {
                let course = course(run, self.mouth, self.area)?;
                if entry {
                    let most = course.iter().fold(0.0, |most: f64, c| most.max(c[1]));
                    return Ok(vec![Measured::absolute(
                        "length entered over width",
                        most / LUMEN,
                    )]);
                }
                let found = growth(&course).ok_or("L(t) has no growth: too few states")?;
                Ok(vec![Measured::relative(
                    "L over the root of t",
                    found.sqrt(),
                    rate.sqrt(),
                )])
            }),
        }
    }
}

/// Time (s) and filled length (m) of each state.
fn course(run: &Run, mouth: f64, area: f64) -> Result<Vec<[f64; 2]>, String> {
    (run.states()?.iter())
        .map(|state| {
            let said = |e: particle_file::Error| e.to_string();
            let position = state.vectors("position").map_err(said)?;
            let volume = state.column::<f32>("volume").map_err(said)?;
            let inside = position
                .iter()
                .zip(volume)
                .filter(|(x, _)| f64::from(x[0]) > mouth);
            let filled: f64 = inside.map(|(_, v)| f64::from(*v)).sum();
            Ok([state.header().time_s, filled / area])
        })
        .collect()
}

/// c of t = a + b L + L^2/c through the states from one width on, by least squares: b is the part of
/// entrance and front. `None` where they do not determine it.
fn growth(course: &[[f64; 2]]) -> Option<f64> {
    let points = course.iter().filter(|c| c[1] >= LUMEN);
    let points: Vec<[f64; 2]> = points.map(|[t, l]| [*t, l / LUMEN]).collect();
    let sum = |f: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(f).sum::<f64>();
    let m: Vec<f64> = (0..5).map(|k| sum(&|p| p[1].powi(k))).collect();
    let r: Vec<f64> = (0..3).map(|k| sum(&|p| p[0] * p[1].powi(k))).collect();
    // The normal equations by Cramer's rule.
    let with = |last: [f64; 3]| {
        last[0] * (m[1] * m[3] - m[2] * m[2]) - last[1] * (m[0] * m[3] - m[1] * m[2])
            + last[2] * (m[0] * m[2] - m[1] * m[1])
    };
    let curvature = with([r[0], r[1], r[2]]) / with([m[2], m[3], m[4]]);
    (curvature > 0.0 && curvature.is_finite()).then(|| LUMEN * LUMEN / curvature)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entrance_and_front_are_no_part_of_the_growth() {
        let course: Vec<[f64; 2]> = (0..40)
            .map(|i| f64::from(i) * 0.1)
            .map(|l| [3.0 + 0.4 * l + l * l / 5.0, l * LUMEN])
            .collect();
        let found = growth(&course).unwrap() / (LUMEN * LUMEN);
        assert!((found - 5.0).abs() < 1e-6, "{found}");
    }
}
