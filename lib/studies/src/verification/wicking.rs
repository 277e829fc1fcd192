//! Liquid drawn into a slit or a tube by its surface, or kept out by it: Lucas and Washburn's law, and no
//! entry below the jump.

use super::lumen::{Rectangle, Section, quarter};
use super::{LUMEN, Measured, Scene, slit, washburn};
use crate::case_text::{Body, CaseText, PF};
use crate::outputs::Run;

/// Surface tension, N/m.
pub(super) const TENSION: f64 = 0.05;
/// Filled length up to which a run goes, over the width.
const LONGEST: f64 = 4.0;
/// Equivalent length of a tube's mouth and front, over the diameter: that of a hole in a plane is 3 pi/32 (Sampson), of which a
/// reservoir twice as wide and the front take some off, not known how much; 0.1 of it is 1 % of the length at four diameters.
const MOUTH: f64 = 0.2;
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
        entrance: (washburn::TIME_TO_FIVE - 12.5) / 5.0 + slit::corner(n),
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
        entrance: MOUTH,
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
    /// Equivalent length of entrance and front over the width, as under pressure.
    entrance: f64,
}

impl Passage {
    fn of(self, case: CaseText) -> Scene {
        let jump = TENSION * self.degrees.to_radians().cos() * self.jump;
        // L^2 + 2 e L = 2 P d^2/(R eta) t
        let rate = 2.0 * jump.abs() * LUMEN * LUMEN / (self.resistance * PF[2]);
        let end = LUMEN * LUMEN * LONGEST * (LONGEST + 2.0 * self.entrance) / rate;
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
                let filled: Vec<[f64; 2]> = (course.iter())
                    .map(|[t, l]| [t * rate / (LUMEN * LUMEN), l / LUMEN])
                    .filter(|c| c[1] >= 1.0)
                    .collect();
                let (Some(first), Some(last)) = (filled.first(), filled.last()) else {
                    return Err("it was not filled to one width".into());
                };
                let exact = |t: f64| {
                    let start = first[1] + self.entrance;
                    (start * start + t - first[0]).sqrt() - self.entrance
                };
                let off = filled.iter().map(|[t, l]| l / exact(*t) - 1.0);
                let worst = off.fold(0.0, |m: f64, e| if e.abs() > m.abs() { e } else { m });
                Ok(vec![
                    Measured::relative("L at the end", last[1], exact(last[0])),
                    Measured::absolute("L(t) from L = d on, worst", worst),
                ])
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
