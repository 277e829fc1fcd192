//! Liquid drawn into a slit or a tube by its surface, or kept out by it: Lucas and Washburn's law, and no
//! entry below the jump; or up between plates, to Jurin's height.

use super::lumen::{Rectangle, Section, quarter};
use super::{LUMEN, Measured, Scene, slit};
use crate::Result;
use crate::case_text::{Body, CaseText, PF};
use crate::numbers::{largest, worst};
use crate::outputs::{Run, points};

/// Surface tension, N/m.
const TENSION: f64 = 0.05;
/// Filled length up to which a run goes, over the width.
const LONGEST: f64 = 4.0;
/// Equivalent length of a tube's mouth and front, over the diameter: that of a hole in a plane is 3 pi/32 (Sampson), of which a
/// reservoir twice as wide and the front take some off, not known how much; 0.1 of it is 1 % of the length at four diameters.
const MOUTH: f64 = 0.2;
/// States of a run that L(t) is taken from.
const STATES: u32 = 60;

/// Slit of `n` cells in plane strain, a liquid of this contact angle whose contact lines resist by `slowing` Ca, walls `offset`
/// cells off the nodes across the slit and along it.
pub fn slit_scene(n: u32, [aside, along]: [f64; 2], degrees: f64, slowing: f64) -> Scene {
    let h = LUMEN / f64::from(n);
    let (mouth, low) = (3.0 * LUMEN + (2.0 + along) * h, 1.5 * LUMEN + aside * h);
    let size = [mouth + (LONGEST + 1.5) * LUMEN, 4.0 * LUMEN];
    let bodies = vec![
        Body::wall([mouth, 0.0, 0.0], [size[0], low, h]),
        Body::wall([mouth, low + LUMEN, 0.0], [size[0], size[1], h]),
        Body::liquid([2.0 * h, 0.0, 0.0], [mouth, size[1], h]),
    ];
    Passage {
        name: format!("wicking-slit-n{n}-{degrees}deg-off{aside}-{along}"),
        degrees,
        mouth,
        area: LUMEN * h,
        jump: 2.0 / LUMEN,
        resistance: 12.0,
        entrance: slit::entrance(n),
    }
    .filled(bodies, slowing, CaseText::plane(h, size))
}

/// A quarter of a tube or square of `n` cells before a reservoir so many widths deep, of the same liquid.
pub fn tube_scene(section: Section, n: u32, depth: f64, degrees: f64, slowing: f64) -> Scene {
    let h = LUMEN / f64::from(n);
    let mouth = depth * LUMEN + 2.0 * h;
    let right = LUMEN + 2.0 * h;
    let far = mouth + (LONGEST + 1.5) * LUMEN;
    let shape = quarter(section, n, LUMEN, right);
    let wall = |r: &Rectangle| Body::wall([mouth, r.low[0], r.low[1]], [far, r.high[0], r.high[1]]);
    let mut bodies: Vec<Body> = shape.sides.iter().map(wall).collect();
    bodies.push(wall(&shape.roof));
    bodies.push(Body::liquid([2.0 * h, 0.0, 0.0], [mouth, right, right]));
    Passage {
        name: format!("wicking-{}-n{n}-{degrees}deg", section.name()),
        degrees,
        mouth,
        area: section.area(n) * LUMEN * LUMEN / 4.0,
        jump: 4.0 / LUMEN,
        resistance: section.staircase_resistance(n),
        entrance: MOUTH,
    }
    .filled(bodies, slowing, CaseText::new(h, 3, [far, right, right]))
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
    fn filled(self, bodies: Vec<Body>, slowing: f64, case: CaseText) -> Scene {
        let entrance = self.entrance + slowing * self.jump * LUMEN / self.resistance;
        let degrees = self.degrees;
        let jump = TENSION * degrees.to_radians().cos() * self.jump;
        // L^2 + 2 e L = 2 P d^2/(R eta) t
        let rate = 2.0 * jump.abs() * LUMEN * LUMEN / (self.resistance * PF[2]);
        let end = LUMEN * LUMEN * LONGEST * (LONGEST + 2.0 * entrance) / rate;
        let entry = jump < 0.0;
        let against = match entry {
            true => "no entry",
            false => "Lucas-Washburn",
        };
        let case = CaseText {
            title: format!(
                "A passage in front of a reservoir, contact angle {degrees} degrees.\nAgainst {against}."
            ),
            bodies,
            wetting: Some([TENSION, degrees]),
            stop: Some(end),
            snapshots: STATES,
            history_every: end / 100.0,
            ..case
        };
        Scene::new(self.name, against, case, move |run| {
            let course = course(run, self.mouth, self.area)?;
            if entry {
                let most = largest(course.iter().map(|c| c[1]));
                let what = "length entered over width";
                return Ok(vec![Measured::absolute(what, most)]);
            }
            let filled: Vec<_> = course.into_iter().filter(|c| c[1] >= 1.0).collect();
            let [Some(first), Some(last)] = [filled.first(), filled.last()] else {
                return Err("it was not filled to one width".into());
            };
            let exact = |t: f64| {
                let start = first[1] + entrance;
                (start * start + (t - first[0]) * rate / (LUMEN * LUMEN)).sqrt() - entrance
            };
            let worst = worst(filled.iter().map(|[t, l]| l / exact(*t) - 1.0));
            Ok(vec![
                Measured::relative("L at the end", last[1], exact(last[0])),
                Measured::absolute("L(t) from L = d on, worst", worst.unwrap_or(0.0)),
            ])
        })
    }
}

/// Time (s) and filled length (widths) of each state.
fn course(run: &Run, mouth: f64, area: f64) -> Result<Vec<[f64; 2]>> {
    let at = |state: &particle_file::ParticleFile| {
        let points = points(state)?;
        let inside = points.iter().filter(|p| p.at[0] > mouth);
        let filled = inside.map(|p| p.volume).sum::<f64>() / area;
        Ok([state.header().time_s, filled / LUMEN])
    };
    run.states()?.iter().map(at).collect()
}

/// 2 sigma/(rho g H) over H.
const HEIGHT: f64 = 1.5;
/// Time, in units of 3 eta H/sigma: the liquid comes to rest within a few.
const UNTIL: f64 = 40.0;

/// Plates with a slit between them that dip into a pool: Jurin's height. A slit of `n` cells (even), walls `offset` cells off the nodes.
pub fn jurin_scene(n: u32, offset: f64, degrees: f64) -> Scene {
    let h = LUMEN / f64::from(n);
    let (left, low) = (2.0 * LUMEN + offset * h, LUMEN);
    let (side, level) = (5.0 * LUMEN, 2.0 * LUMEN);
    let (before, right) = (left - 0.5 * LUMEN, left + LUMEN);
    let after = right + 0.5 * LUMEN;
    let plate = |from: f64, to: f64| Body::wall([from, low, 0.0], [to, side, h]);
    // The pool under the plates, and the three parts between and beside them.
    let pool = |from: f64, to: f64| Body::liquid([from, low, 0.0], [to, level, h]);
    let bodies = vec![
        plate(before, left),
        plate(right, after),
        Body::liquid([0.0; 3], [side, low, h]),
        pool(0.0, before),
        pool(left, right),
        pool(after, side),
    ];
    let pull = 2.0 * TENSION / (PF[0] * LUMEN * LUMEN * HEIGHT);
    let until = UNTIL * 3.0 * PF[2] * LUMEN / TENSION;
    let case = CaseText {
        title: format!(
            "A slit of {n} cells dips into a pool, contact angle {degrees} degrees.\nAgainst Jurin's height."
        ),
        bodies,
        gravity: [0.0, -pull, 0.0],
        wetting: Some([TENSION, degrees]),
        stop: Some(until),
        history_every: until / 100.0,
        ..CaseText::plane(h, [side, side])
    };
    let name = format!("jurin-n{n}-{degrees}deg-off{offset}");
    Scene::new(name, "2 sigma cos(theta)/(rho g H)", case, move |run| {
        let mut above = [0.0; 2];
        for p in run.points()?.iter().filter(|p| p.at[1] > low) {
            let inside = (left..right).contains(&p.at[0]);
            above[usize::from(inside)] += p.volume / h;
        }
        // Beside the plates, 3 H in all, menisci reach to their mirror images.
        let found = above[1] / LUMEN - above[0] / (3.0 * LUMEN);
        let exact = degrees.to_radians().cos() * (1.0 - 1.0 / 3.0) * HEIGHT * LUMEN;
        Ok(vec![Measured::relative("height", found, exact)])
    })
}
