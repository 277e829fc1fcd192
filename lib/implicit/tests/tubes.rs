//! Flow along tubes whose walls are steps of voxels, against that of ever finer cells.

#![allow(clippy::print_stdout, reason = "prints for developers")]

#[path = "common/plain.rs"]
mod plain;

use implicit::{Implicit, Settings};
use physics::{Boundary, Motion, Scene, Scheme, StepLimit, VoxelBlock};

/// Edge of a voxel, m.
const VOXEL: f64 = 2e-6;
const PULL: f64 = 1e3;

/// A tube of so many voxels across, its axis off the middle of the voxels by `shift`, in cells of `finer` to a voxel, or two
/// voxels where that is 0.
struct Tube {
    diameter: f64,
    shift: [f64; 2],
    finer: usize,
}

impl Tube {
    fn voxels(&self) -> usize {
        (self.diameter as usize + 4).next_multiple_of(2)
    }

    fn open(&self, j: usize, k: usize) -> bool {
        let middle = 0.5 * self.voxels() as f64;
        let off = |i: usize, shift: f64| i as f64 + 0.5 - middle - shift;
        off(j, self.shift[0]).hypot(off(k, self.shift[1])) < 0.5 * self.diameter
    }

    fn scene(&self) -> Scene {
        let n = self.voxels();
        let cell = match self.finer {
            0 => 2.0 * VOXEL,
            finer => VOXEL / finer as f64,
        };
        let across = (VOXEL * n as f64 / cell).round() as usize;
        let mut scene = plain::scene(cell, [2, across, across]);
        let size = [2.0 * cell, VOXEL, VOXEL];
        let wall = VoxelBlock::from_fn([0.0; 3], size, [1, n, n], |_, j, k| !self.open(j, k));
        scene.bodies = vec![plain::body("wall", vec![wall], Motion::Fixed)];
        let part = cell.min(VOXEL);
        let [along, parts] = [2.0 * cell, VOXEL].map(|edge| (edge / part).round() as usize);
        for (j, k) in (0..n * n)
            .map(|i| (i % n, i / n))
            .filter(|&(j, k)| self.open(j, k))
        {
            let low = [0.0, j as f64 * VOXEL, k as f64 * VOXEL];
            let points = plain::fill(low, [part; 3], [along, parts, parts]);
            scene.points.position.extend(points.position);
            scene.points.velocity.extend(points.velocity);
            scene.points.volume.extend(points.volume);
        }
        scene.boundary[0] = Boundary::Periodic;
        scene.gravity = [PULL, 0.0, 0.0];
        scene
    }

    fn mean_velocity(&self) -> f64 {
        let settings = Settings {
            tolerance: 1e-7,
            ..Settings::default()
        };
        let scene = self.scene();
        let mut scheme = Implicit::new(&scene, settings).unwrap();
        let limit = StepLimit {
            time_s: 1e-3,
            travel_m: f64::INFINITY,
        };
        scheme.advance(limit).unwrap();
        // By the power that the weight gives off: points sample the profile.
        let found = scheme.diagnostics();
        found.viscous_power / (scene.liquid.density * PULL * found.volume)
    }
}

/// Errors with one and with two voxels a cell, against four and eight cells a voxel.
fn errors(diameter: f64, shift: [f64; 2]) -> [f64; 2] {
    let of = |finer| {
        let tube = Tube {
            diameter,
            shift,
            finer,
        };
        tube.mean_velocity()
    };
    let [coarse, fine] = [of(4), of(8)];
    // Along re-entrant edges differences have the error h^(4/3).
    let reference = fine + (fine - coarse) / (2.0_f64.powf(4.0 / 3.0) - 1.0);
    let errors = [1, 0].map(|finer| of(finer) / reference - 1.0);
    let [one, two] = errors.map(|e| 100.0 * e);
    println!(
        "{diameter} voxels, off by {shift:?}: one a cell {one:+.2} %, two {two:+.2} %, four cells a voxel {:+.2} %",
        100.0 * (coarse / reference - 1.0)
    );
    errors
}

#[test]
fn flow_along_tubes_of_voxels_is_that_of_finer_cells() {
    for diameter in [4.0, 6.0, 8.0, 12.0] {
        for shift in [[0.0, 0.0], [0.5, 0.5], [0.3, 0.1], [1.0, 1.0]] {
            let [one, two] = errors(diameter, shift);
            assert!(one.abs() < 0.02);
            // Tubes of six cells.
            assert!(diameter < 12.0 || two.abs() < 0.02);
        }
    }
}

/// Cells of two voxels join what is alike in them, on whichever side it lies.
#[test]
fn mirror_images_of_tubes_have_one_flow() {
    for diameter in [6.0, 8.0, 12.0] {
        let of = |x: f64| {
            let tube = Tube {
                diameter,
                shift: [x, 0.1],
                finer: 0,
            };
            tube.mean_velocity()
        };
        let (own, image) = (of(0.3), of(-0.3));
        assert!((image / own - 1.0).abs() < 1e-5, "{own} {image}");
    }
}
