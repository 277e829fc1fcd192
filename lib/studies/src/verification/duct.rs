//! Steady flow through a square duct and a tube made of voxels, driven by a body force along
//! the axis; a quarter of the cross-section is computed, mirrored at both axes.

use super::lumen::{Rectangle, Section, quarter};
use super::{LUMEN, Measured, Scene, mean_velocity, pressing};
use crate::case_text::{Body, CaseText, PF};

/// Body force per mass along the axis, m/s2.
const G: f64 = 2.3e5;

/// A lumen of `n` cells; odd numbers put its walls half a cell off the nodes.
pub fn scene(section: Section, n: u32, until: f64) -> Scene {
    let cell = LUMEN / f64::from(n);
    let (long, far) = (4.0 * cell, (f64::from(n.div_ceil(2)) + 3.0) * cell);
    let shape = quarter(section, n, LUMEN, far);
    let body = |make: fn([f64; 3], [f64; 3]) -> Body, r: &Rectangle| {
        make([0.0, r.low[1], r.low[0]], [long, r.high[1], r.high[0]])
    };
    let roof = body(Body::wall, &shape.roof).pressing(pressing(until));
    let mut bodies = vec![roof.named("top")];
    let sides = shape.sides.iter();
    bodies.extend(sides.map(|r| body(Body::wall, r).named("bottom")));
    bodies.extend(shape.open.iter().map(|r| body(Body::liquid, r)));
    let name = section.name();
    let case = CaseText {
        title: format!(
            "Developed flow through a lumen ({name}) of {n} cells, a quarter of it.\nAgainst rho g d^2/(c eta), c = 28.454 (square) or 32 (tube, d from the voxels' area), and finite differences in the same staircase."
        ),
        gravity: [G, 0.0, 0.0],
        boundary: ["periodic", "symmetry", "symmetry"],
        stop: Some(until),
        bodies,
        history_every: until / 20.0,
        ..CaseText::new(cell, 3, [long, far, far])
    };
    let name = format!("duct-{name}-n{n}");
    Scene::new(name, "White 2006; Hagen-Poiseuille", case, move |run| {
        let mean = mean_velocity(run, PF[0] * G)?;
        let exact = |resistance: f64| PF[0] * G * LUMEN.powi(2) / (resistance * PF[2]);
        let smooth = exact(section.resistance(n));
        let mut list = vec![Measured::relative("mean velocity", mean, smooth)];
        if section != Section::Square {
            let stairs = exact(section.staircase_resistance(n));
            let what = "mean velocity, same staircase";
            list.push(Measured::relative(what, mean, stairs));
        }
        Ok(list)
    })
}
