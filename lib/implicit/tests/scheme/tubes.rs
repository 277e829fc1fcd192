//! Flow along tubes whose walls are steps of voxels, against that of ever finer cells.

use physics::{Scene, VoxelBlock};

use crate::plain;
use crate::runs::{advance, append, driven, mean_velocity, solved};

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
        let part = cell.min(VOXEL);
        let [along, parts] = [2.0 * cell, VOXEL].map(|edge| (edge / part).round() as usize);
        for (j, k) in (0..n * n).map(|i| (i % n, i / n)) {
            if self.open(j, k) {
                let low = [0.0, j as f64 * VOXEL, k as f64 * VOXEL];
                let points = plain::fill(low, [part; 3], [along, parts, parts]);
                append(&mut scene.points, points);
            }
        }
        driven(scene, vec![wall], PULL)
    }
}

fn speed(diameter: f64, shift: [f64; 2], finer: usize) -> f64 {
    let tube = Tube {
        diameter,
        shift,
        finer,
    };
    let scene = tube.scene();
    let mut scheme = solved(&scene, 1e-7);
    advance(&mut scheme, 1e-3);
    mean_velocity(&scene, &scheme)
}

/// Errors with one and with two voxels a cell, against four and eight cells a voxel.
fn errors(diameter: f64, shift: [f64; 2]) -> [f64; 2] {
    let of = |finer| speed(diameter, shift, finer);
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
        let [own, image] = [0.3, -0.3].map(|x| speed(diameter, [x, 0.1], 0));
        assert!((image / own - 1.0).abs() < 1e-5, "{own} {image}");
    }
}
