//! Liquid that stands under its weight.

#[path = "common/plain.rs"]
mod plain;

use filling::{Implicit, Settings};
use physics::{Motion, Newtonian, Scheme, StepLimit, Viscosity, VoxelBlock};

/// Nothing of it moves, and on a side of the domain no body bears it: forces on bodies are no measure of what the solver leaves.
#[test]
fn thin_liquid_stands_on_a_side_and_on_a_floor() {
    let (h, far) = (1e-3, 1.0);
    for floor in [0.0, 2.0 * h] {
        let mut scene = plain::scene(h, [8, 16, 8]);
        if floor > 0.0 {
            let block = VoxelBlock::solid_box([-far; 3], [far, floor, far]);
            scene.bodies = vec![plain::body("floor", vec![block], Motion::Fixed)];
        }
        scene.points = plain::fill([0.0, floor, 0.0], [0.5 * h; 3], [16, 20, 16]);
        scene.liquid.viscosity = Viscosity::Newtonian(Newtonian(1e-3));
        scene.gravity[1] = -9.81;
        let mut scheme = Implicit::new(scene, Settings::default()).unwrap();
        let (mut time, end) = (0.0, 0.5);
        while time < end * (1.0 - 1e-9) {
            let limit = StepLimit {
                time_s: end - time,
                travel_m: f64::INFINITY,
            };
            time += scheme.advance(limit).unwrap().dt_s;
        }
    }
}
