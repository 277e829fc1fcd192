//! Cost of the particle side of a step: sorting, liquid fractions, transfer, transport.
//!
//! ```text
//! cargo run --release -p filling --example particle_bench -- [cells across [steps]]
//! RAYON_NUM_THREADS=1 cargo run ...
//! ```
//! A slab 19 cells thick between two blocks of wood with lumens of six cells, one voxel (half a
//! cell) of wall around each; 197 cells across are a full-size run with 5.9 million particles.

#![allow(clippy::print_stdout, reason = "prints for developers")]

use std::time::Instant;

use filling::advect::{self, Flow, Path};
use filling::fractions::{self, Fractions};
use filling::lattice::Lattice;
use filling::operator::NONE;
use filling::particles::{Bins, Particles};
use filling::solids::{OPEN, Solids};
use filling::window::{Domain, Window};
use physics::{Boundary, Motion, RigidBody, Tait, VoxelBlock};

/// Thickness of the slab and depth of the wood on either side, cells.
const SLAB: usize = 19;
const DEPTH: usize = 30;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let across: usize = arguments.next().map_or(Ok(80), |text| text.parse())?;
    let steps: usize = arguments.next().map_or(Ok(3), |text| text.parse())?;
    let domain = Domain {
        cells: [across, SLAB + 2 * DEPTH, across],
        boundary: [Boundary::Symmetry; 3],
        axes: 3,
    };
    let wood = |low: usize| {
        let dims = [2 * across, 2 * DEPTH, 2 * across];
        VoxelBlock::from_fn([0.0, low as f64, 0.0], [0.5; 3], dims, |i, _, k| {
            i % 13 == 0 || k % 13 == 0
        })
    };
    let body = |name: &str, low: usize| RigidBody {
        name: name.into(),
        blocks: vec![wood(low)],
        motion: Motion::Fixed,
    };
    let bodies = vec![body("bottom", 0), body("top", DEPTH + SLAB)];
    let rest = Solids::new(bodies, domain, [0.0; 3], 1.0);
    let mut particles = slab(across);
    println!(
        "{} particles, {} threads",
        particles.len(),
        rayon::current_num_threads()
    );
    let mut bins = Bins::default();
    let mut fractions = Fractions::default();
    for step in 0..steps {
        let closed = 0.3 * step as f64;
        let at = |closed: f64| rest.displaced(&[[0.0; 3], [0.0, -closed, 0.0]]);
        let (before, after) = (at(closed), at(closed + 0.3));
        let (from, to) = particles.extent();
        let window = Window::around(domain, from, to);
        let mut clock = Clock::start();
        let lattice = Lattice::new(at(closed + 0.15), window);
        clock.lap("geometry");
        particles.sort(&window, &mut bins);
        clock.lap("sort");
        fractions.update(&particles, &bins, &window, &lattice.open);
        clock.lap("fractions");
        let mut field = Vec::new();
        for axis in 0..3 {
            fractions::velocities(&particles, &bins, &window, axis, &mut field);
        }
        let tait = Tait { bulk_modulus: 1e9 };
        fractions::pressures(&particles, &bins, &window, tait, &mut field);
        clock.lap("u*, p*");
        let (active, u) = stagnation_flow(&lattice, &fractions);
        clock.skip();
        let value = advect::extend(&lattice, &active, &u);
        clock.lap("extend");
        let velocities = [[0.0; 3], [0.0, -1.0, 0.0]];
        let flow = Flow::new(&lattice, &value, &active, &velocities, 0.01);
        clock.lap("profiles");
        let path = Path {
            before: &before,
            after: &after,
            scale: 0.3,
        };
        let moved = path.follow(&mut particles, |x| flow.velocity(x));
        clock.lap("move");
        path.follow(&mut particles, |_| [0.0; 3]);
        clock.lap("deflect only");
        advect::set_velocities(&mut particles, &flow, None);
        advect::set_volume_changes(&mut particles, &window, &field, tait, -1e6);
        clock.lap("carry");
        clock.total();
        println!("  {moved:?}");
    }
    Ok(())
}

fn slab(across: usize) -> Particles {
    let mut position = Vec::new();
    for k in 0..2 * across {
        for j in 0..2 * SLAB {
            for i in 0..2 * across {
                position.push([i, j + 2 * DEPTH, k].map(|s| 0.25 + 0.5 * s as f64));
            }
        }
    }
    let n = position.len();
    Particles {
        position,
        velocity: vec![[0.0; 3]; n],
        volume: vec![0.125; n],
        j: vec![0.0; n],
        id: (0..n as u32).collect(),
    }
}

/// Face velocities of liquid pressed from both sides towards the middle plane and outwards.
fn stagnation_flow(lattice: &Lattice, liquid: &Fractions) -> ([Vec<u32>; 3], Vec<f64>) {
    let window = &lattice.window;
    let mut active: [Vec<u32>; 3] = std::array::from_fn(|_| vec![NONE; window.len()]);
    let mut u = Vec::new();
    let middle = 0.5 * window.domain.cells[0] as f64;
    for (axis, faces) in active.iter_mut().enumerate() {
        for (index, face) in faces.iter_mut().enumerate() {
            let wet = liquid.cell[index] > 0.5
                || index >= window.stride(axis) && liquid.cell[index - window.stride(axis)] > 0.5;
            if wet && lattice.face(axis, index) == OPEN {
                let x = window.face_centre(axis, window.coordinates(index));
                *face = u.len() as u32;
                u.push([0.5 * (x[0] - middle) / middle, -0.3, 0.1][axis]);
            }
        }
    }
    (active, u)
}

struct Clock {
    last: Instant,
    total: f64,
    said: String,
}

impl Clock {
    fn start() -> Self {
        Self {
            last: Instant::now(),
            total: 0.0,
            said: String::new(),
        }
    }

    fn lap(&mut self, name: &str) {
        let seconds = self.last.elapsed().as_secs_f64();
        self.total += seconds;
        self.said += &format!("{name} {seconds:.2}, ");
        self.skip();
    }

    fn skip(&mut self) {
        self.last = Instant::now();
    }

    fn total(&self) {
        println!("{}total {:.2} s", self.said, self.total);
    }
}
