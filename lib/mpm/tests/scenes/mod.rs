//! Scenes for the verification cases: PF adhesive (paper section 2.2) unless changed.
#![allow(dead_code)] // every test file uses its own part

use mpm::{Explicit, Settings, ShapeFunction, VelocityUpdate};
use physics::{
    Boundary, Clamp, Dimensions, Motion, RigidBody, Scene, Scheme, ShearRate, StepLimit, Table,
    Viscosity, VoxelBlock, WallLaw,
};

#[path = "../../../physics/tests/plain/mod.rs"]
mod plain;

/// The paper's cell, m.
pub const CELL: f64 = 2.9e-6;
/// PF: density (kg/m3), viscosity (Pa s).
pub const DENSITY: f64 = 1200.0;
pub const VISCOSITY: f64 = 1.3;

/// The paper's Table 1: PVA-PF.
pub fn pva_pf() -> Viscosity {
    let table = [
        (1.0, 210.0),
        (6.30957, 87.0),
        (39.8107, 1.7),
        (501.187, 1.0),
    ];
    Viscosity::Table(Table::new(&table).expect("a valid table"))
}

pub const SHAPES: [ShapeFunction; 3] = [
    ShapeFunction::Gimp,
    ShapeFunction::Bspline2,
    ShapeFunction::Linear,
];

/// Each shape with each of these updates but the hat with APIC, which it does not have.
pub fn combined(updates: &[VelocityUpdate]) -> Vec<(ShapeFunction, VelocityUpdate)> {
    let all = SHAPES
        .into_iter()
        .flat_map(|s| updates.iter().map(move |&u| (s, u)));
    all.filter(|&pair| pair != (ShapeFunction::Linear, VelocityUpdate::Apic))
        .collect()
}

/// An empty scene of `cells`; one cell along z means plane strain.
pub fn scene(cells: [usize; 3], boundary: [Boundary; 3]) -> Scene {
    let mut scene = plain::scene(CELL, cells);
    scene.boundary = boundary;
    scene.liquid.shear_rate = ShearRate::Paper;
    scene
}

/// Fills the box from `low` to `high` (cells) with two points per cell and axis, with the
/// velocity `v` at their positions (cells).
pub fn fill(scene: &mut Scene, low: [f64; 3], high: [f64; 3], v: impl Fn([f64; 3]) -> [f64; 3]) {
    let two = scene.dimensions == Dimensions::Two;
    let count = |a: usize| ((high[a] - low[a]) * 2.0).round() as usize;
    let (layers, depth) = if two { (1, 1.0) } else { (count(2), 0.5) };
    let place = |a: usize, i: usize| low[a] + 0.5 * (i as f64 + 0.5);
    for (k, j) in (0..layers).flat_map(|k| (0..count(1)).map(move |j| (k, j))) {
        for i in 0..count(0) {
            let z = if two { 0.5 } else { place(2, k) };
            let x = [place(0, i), place(1, j), z];
            scene.points.position.push(x.map(|x| x * CELL));
            scene.points.velocity.push(v(x));
            scene.points.volume.push(0.25 * depth * CELL.powi(3));
        }
    }
}

/// Liquid at rest in the box from `low` to `high` (cells).
pub fn pour(scene: &mut Scene, low: [f64; 3], high: [f64; 3]) {
    fill(scene, low, high, |_| [0.0; 3]);
}

/// A body of one block.
pub fn body(name: &str, block: VoxelBlock, motion: Motion) -> RigidBody {
    plain::body(name, vec![block], motion)
}

/// A box from `low` to `high` in cells.
pub fn solid(name: &str, low: [f64; 3], high: [f64; 3], motion: Motion) -> RigidBody {
    let [low, high] = [low, high].map(|x| x.map(|x| x * CELL));
    body(name, VoxelBlock::solid_box(low, high), motion)
}

/// Partial slip of next to no length, between a body that rests and one that the clamp drives.
pub fn clamp(scene: &mut Scene, bodies: [RigidBody; 2], closing_speed: f64) {
    scene.wall = WallLaw::PartialSlip {
        influence_length_m: 0.01 * CELL,
    };
    scene.bodies = bodies.into();
    scene.clamp = Some(Clamp {
        closing_speed,
        max_pressure: Some(2.5e6),
        pid: None,
    });
    (scene.bottom, scene.top) = (Some(0), Some(1));
}

/// Liquid pressed into porous voxels by a clamped block; all features at work.
pub fn press() -> Scene {
    let mut s = scene([10, 14, 10], [Boundary::Symmetry; 3]);
    s.boundary[1] = Boundary::Open;
    pour(&mut s, [0.0, 5.0, 0.0], [10.0, 8.0, 10.0]);
    let voxel = [0.5 * CELL; 3];
    let block = |low: f64| {
        VoxelBlock::from_fn([0.0, low * CELL, 0.0], voxel, [20, 10, 20], |i, j, k| {
            (i % 8 < 2 || k % 9 < 2) && (j + i) % 7 != 3
        })
    };
    let bodies = [
        body("bottom", block(0.0), Motion::Fixed),
        body("top", block(8.0), Motion::Clamped),
    ];
    clamp(&mut s, bodies, 20.0);
    s
}

pub fn settings(shape: ShapeFunction, velocity_update: VelocityUpdate, cfl: f64) -> Settings {
    Settings {
        shape,
        velocity_update,
        cfl,
        ..Settings::default()
    }
}

/// No event ahead.
pub const FREE: StepLimit = StepLimit {
    time_s: f64::INFINITY,
    travel_m: f64::INFINITY,
};

/// Takes so many steps.
pub fn advance(run: &mut Explicit, steps: usize) {
    for _ in 0..steps {
        run.advance(FREE).expect("a sound run");
    }
}

/// `of` by so many threads.
pub fn on_threads<T: Send>(threads: usize, of: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build().unwrap().install(of)
}
