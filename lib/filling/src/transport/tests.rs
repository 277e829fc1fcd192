//! Particles carry the flux that was solved for.

mod taken_up;
mod walls;

use physics::{Boundary, ShearRate, VoxelBlock};

use super::*;
use crate::geometry::tests::{lattice, whole};
use crate::geometry::{Domain, Lattice, OPEN};
use crate::liquid::tests::at;
use crate::system::NONE;

const SIDES: [Boundary; 3] = [Boundary::Symmetry; 3];

/// A straight channel along x between walls at `low` and `high` in y and, in 3D, z.
struct Channel {
    lattice: Lattice,
    low: [f64; 2],
    width: f64,
    axes: usize,
}

impl Channel {
    fn new(axes: usize, width: f64, offset: [f64; 2]) -> Self {
        let low = [3.0 + offset[0], 3.0 + offset[1]];
        let n = width.ceil() as usize + 7;
        let cells = [6, n, if axes == 3 { n } else { 1 }];
        let domain = Domain {
            cells,
            boundary: [Boundary::Periodic, Boundary::Symmetry, Boundary::Symmetry],
            axes,
        };
        let end = n as f64 + 1.0;
        let (a, b) = (low[0], low[0] + width);
        let mut blocks = vec![
            VoxelBlock::solid_box([0.0, -1.0, -1.0], [6.0, a, end]),
            VoxelBlock::solid_box([0.0, b, -1.0], [6.0, end, end]),
        ];
        if axes == 3 {
            let (c, d) = (low[1], low[1] + width);
            blocks.push(VoxelBlock::solid_box([0.0, a, -1.0], [6.0, b, c]));
            blocks.push(VoxelBlock::solid_box([0.0, a, d], [6.0, b, end]));
        }
        let lattice = lattice(domain, vec![blocks]);
        Self {
            lattice,
            low,
            width,
            axes,
        }
    }

    /// The flow along x whose face velocities are the means of `profile` over their control
    /// volumes, which share the cross-section; `profile` takes distances from the low walls.
    fn flow(&self, influence: f64, profile: impl Fn([f64; 2]) -> f64) -> Flow {
        let w = &self.lattice.window;
        let mut value: [Vec<f32>; 3] = std::array::from_fn(|_| vec![f32::NAN; w.len()]);
        let mut active: [Vec<u32>; 3] = std::array::from_fn(|_| vec![NONE; w.len()]);
        for index in 0..w.len() {
            let cell = w.coordinates(index);
            let centre = w.face_centre(0, cell);
            if self.lattice.face(0, index) != OPEN {
                continue;
            }
            // Every cross-section is the same.
            if cell[0] > 0 {
                value[0][index] = value[0][index - 1];
                active[0][index] = active[0][index - 1];
                continue;
            }
            let extent = |t: usize| {
                let x = centre[t + 1] - self.low[t];
                let down = if x < 1.0 - 1e-9 { x } else { 0.5 };
                let up = if self.width - x < 1.0 - 1e-9 {
                    self.width - x
                } else {
                    0.5
                };
                [x - down, x + up]
            };
            let (a, b) = (extent(0), if self.axes == 3 { extent(1) } else { [0.0; 2] });
            let mut sum = 0.0;
            let part = |[l, h]: [f64; 2], i: i32| l + (h - l) * (f64::from(i) + 0.5) / 24.0;
            for i in 0..24 {
                for k in 0..24 {
                    sum += profile([part(a, i), part(b, k)]);
                }
            }
            value[0][index] = (sum / 576.0) as f32;
            active[0][index] = 0;
        }
        Flow::new(&self.lattice, &value, &active, &[[0.0; 3]], influence)
    }

    /// Flux carried by `per_cell` regular particles per cell and direction that fill the channel,
    /// over the exact one, and largest drift across it.
    fn transported(&self, flow: &Flow, mean: f64, per_cell: f64) -> (f64, f64) {
        let n = (per_cell * self.width).round() as usize;
        let step = self.width / n as f64;
        let mut points = Vec::new();
        for i in 0..2 {
            for j in 0..n {
                for k in 0..if self.axes == 3 { n } else { 1 } {
                    let place = |low: f64, j: usize| low + step * (j as f64 + 0.5);
                    let z = if self.axes == 3 {
                        place(self.low[1], k)
                    } else {
                        0.5
                    };
                    points.push([0.5 + 3.0 * f64::from(i), place(self.low[0], j), z]);
                }
            }
        }
        let mut particles = at(points.clone(), 0.1);
        let path = Path {
            before: &self.lattice.solids,
            after: &self.lattice.solids,
            scale: 0.3 / mean,
        };
        let (mut gone, mut drift) = (0.0, 0.0_f64);
        for _ in 0..5 {
            let before = particles.position.clone();
            path.follow(&mut particles, |x, near| flow.velocity(x, near));
            for (x, y) in particles.position.iter().zip(&before) {
                gone += (x[0] - y[0]).rem_euclid(6.0);
            }
        }
        for (x, y) in particles.position.iter().zip(&points) {
            drift = drift.max((x[1] - y[1]).abs()).max((x[2] - y[2]).abs());
        }
        (gone / (5.0 * 0.3 * points.len() as f64), drift)
    }
}

/// The profile is exact; what is left is the midpoint rule of the particles over it, 1.4 % for
/// two per cell in three cells.
#[test]
fn particles_carry_the_flux_of_a_slit() {
    for (n, per_cell, tolerance) in [
        (3.0, 2.0, 0.015),
        (3.0, 7.0, 0.002),
        (6.0, 2.0, 0.004),
        (12.0, 2.0, 0.001),
    ] {
        for slip in [0.0, 0.5] {
            let mut worst: f64 = 0.0;
            for step in 0..20 {
                let channel = Channel::new(2, n, [0.05 * f64::from(step), 0.0]);
                let flow = channel.flow(slip, |[y, _]| slip + y - y * y / n);
                let (ratio, drift) = channel.transported(&flow, slip + n / 6.0, per_cell);
                assert!(drift < 1e-12);
                if (ratio - 1.0).abs() > worst.abs() {
                    worst = ratio - 1.0;
                }
            }
            println!(
                "slit of {n} cells, {per_cell} particles per cell, slip {slip}: flux {worst:+.4}"
            );
            assert!(worst.abs() < tolerance, "{n} cells, slip {slip}: {worst}");
        }
    }
}

/// Series solution of the flow in a square duct of width n, unit pressure gradient.
fn duct(n: f64, [y, z]: [f64; 2]) -> f64 {
    let pi = std::f64::consts::PI;
    (0..12)
        .map(|i| f64::from(2 * i + 1))
        .map(|k| {
            let across = ((k * pi * (z / n - 0.5)).cosh() / (0.5 * k * pi).cosh()).min(1.0);
            4.0 * n * n / (pi * k).powi(3) * (1.0 - across) * (k * pi * y / n).sin()
        })
        .sum()
}

#[test]
fn particles_carry_the_flux_of_a_square_duct() {
    for (n, per_cell, tolerance) in [
        (3.0, 2.0, 0.035),
        (3.0, 7.0, 0.01),
        (6.0, 2.0, 0.01),
        (6.0, 7.0, 0.005),
    ] {
        let mut worst: f64 = 0.0;
        for offset in [
            [0.0, 0.0],
            [0.25, 0.0],
            [0.5, 0.0],
            [0.25, 0.75],
            [0.5, 0.5],
            [0.9, 0.35],
        ] {
            let channel = Channel::new(3, n, offset);
            let flow = channel.flow(0.0, |at| duct(n, at));
            let (ratio, drift) = channel.transported(&flow, 0.035_144 * n * n, per_cell);
            assert!(drift < 1e-12);
            println!(
                "duct of {n} cells, {per_cell} particles, offset {offset:?}: {:+.4}",
                ratio - 1.0
            );
            worst = worst.max((ratio - 1.0).abs());
        }
        assert!(
            worst < tolerance,
            "{n} cells, {per_cell} particles: {worst}"
        );
    }
}

/// The shear rate at the particles next to the wall of a slit, where it is largest.
#[test]
fn shear_rates_of_a_slit() {
    for off in [0.0, 0.25, 0.5, 0.75] {
        let channel = Channel::new(2, 6.0, [off, 0.0]);
        let flow = channel.flow(0.0, |[y, _]| y - y * y / 6.0);
        let mut worst: f64 = 0.0;
        for j in 0..12 {
            let y = 0.25 + 0.5 * f64::from(j);
            let particles = at(vec![[2.3, channel.low[0] + y, 0.5]], 0.1);
            let rate = shear_rates(&particles, &flow, ShearRate::Rheometer, 1.0)[0];
            worst = worst.max((f64::from(rate) - (1.0 - y / 3.0).abs()).abs());
        }
        println!(
            "slit of 6 cells, offset {off}: largest shear rate error {worst:.4} of the wall's"
        );
        assert!(worst < 1e-3);
    }
}
