//! Liquid pressed by a clamp onto a lumen sealed by a thin roof: nothing leaks in.

use super::{Measured, Scene};
use crate::case_text::{Body, CaseText, PF};

const CELL: f64 = 2.9e-6;
/// Pressure of the clamp, Pa.
const PRESSURE: f64 = 2.5e6;

/// Roof and side wall of `voxels` half cells, wood `offset` cells off the nodes along y. One
/// lumen is empty, one beside it behind a wall as thin is full.
pub fn scene(voxels: u32, offset: f64) -> Scene {
    let thick = 0.5 * f64::from(voxels);
    let (width, floor) = (8.0, 1.0 + offset);
    let (middle, roof) = (0.5 * width, floor + 4.0);
    let (slab, lid) = (roof + thick, roof + thick + 2.0);
    // Slow enough that explicit steps come near the limit without overshooting it.
    let until = 0.4e-6;
    let m = |[x, y]: [f64; 2], z: f64| [x, y, z].map(|x| x * CELL);
    let wall = |low, high| Body::wall(m(low, 0.0), m(high, 1.0)).named("bottom");
    let liquid = |low, high| Body::liquid(m(low, 0.0), m(high, 1.0));
    let case = CaseText {
        title: format!(
            "A lumen sealed by walls of {voxels} voxels, {offset} cell off the nodes, under {PRESSURE} Pa.\nReference: no leak."
        ),
        clamp: Some(format!(
            "closing_speed = \"0.03 m/s\"\nmax_pressure = \"{PRESSURE} Pa\"\nstop = \"{:.3} us\"\ntravel = \"5.8 um\"\n",
            until * 1e6
        )),
        boundary: ["symmetry", "open", "symmetry"],
        bodies: vec![
            wall([0.0, 0.0], [width, floor]),
            wall([0.0, roof], [middle, slab]),
            wall([middle - thick, floor], [middle, roof]),
            wall([0.0, lid], [width, lid + 6.0]).clamped().named("top"),
            liquid([middle, floor], [width, roof]),
            liquid([middle, roof], [width, slab]),
            liquid([0.0, slab], [width, lid]),
        ],
        history_every: until / 40.0,
        ..CaseText::plane(CELL, [width * CELL, (lid + 3.0) * CELL])
    };
    let name = format!("sealed-w{voxels}-off{offset}");
    Scene::new(name, "no leak", case, move |run| {
        let inside = |[x, y, _]: [f64; 3]| x < (middle - thick) * CELL && y < roof * CELL;
        let points = run.points()?;
        let leaked = points.iter().filter(|p| inside(p.at)).count();
        let volume = run.summary("volume_change").unwrap_or(f64::NAN);
        let [pressure] = run.ends(["pressure_top_Pa"])?;
        // The lumen's void stays empty, so all liquid is under the clamp's pressure.
        let compressed = -0.0894 * (pressure / (0.0894 * PF[1])).ln_1p();
        Ok(vec![
            Measured::count("points leaked into the sealed lumen", leaked),
            Measured::absolute("volume beyond Tait", volume - compressed),
        ])
    })
}
