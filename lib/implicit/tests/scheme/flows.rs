//! Liquid that flies on.

use physics::{Boundary, Scheme, WallLaw};

use crate::plain;
use crate::runs::{advance, solved};

/// Liquid that nothing touches goes on as it came, but for the friction by which all liquid has a velocity.
#[test]
fn liquid_that_nothing_holds_keeps_its_velocity() {
    let (h, speed) = (1e-6, 0.25);
    let mut scene = plain::scene(h, [8, 8, 1]);
    scene.points = plain::fill([0.0, 2.0 * h, 0.0], [0.5 * h, 0.5 * h, h], [16, 6, 1]);
    scene.points.velocity.fill([speed, 0.0, 0.0]);
    scene.boundary[0] = Boundary::Periodic;
    scene.wall = WallLaw::Frictionless;
    let mut scheme = solved(&scene, 1e-6);
    (0..3).for_each(|_| _ = advance(&mut scheme, 1e-5));
    assert_eq!(scheme.objection(), None);
    for v in scheme.liquid().velocity {
        let off = [f64::from(v[0]) - speed, f64::from(v[1])].map(f64::abs);
        assert!(off[0] < 5e-4 && off[1] < 1e-5, "{v:?}");
    }
}
