//! Scenes for the verification cases: PF adhesive (paper section 2.2) unless changed.
#![allow(dead_code)] // every test file uses its own part

use mpm::{Explicit, Settings, ShapeFunction, VelocityUpdate};
use physics::{
    Boundary, Clamp, Dimensions, GridBox, Liquid, Motion, Newtonian, Points, RigidBody, Scene,
    Scheme, ShearRate, StepLimit, StepReport, Stop, Tait, Viscosity, VoxelBlock, WallLaw,
};

/// The paper's cell, m.
pub const CELL: f64 = 2.9e-6;
/// PF: density (kg/m3), viscosity (Pa s), bulk modulus (Pa).
pub const DENSITY: f64 = 1200.0;
pub const VISCOSITY: f64 = 1.3;
pub const MODULUS: f64 = 1e9;

pub fn pf() -> Liquid {
    Liquid {
        density: DENSITY,
        tait: Tait {
            bulk_modulus: MODULUS,
        },
        viscosity: Viscosity::Newtonian(Newtonian(VISCOSITY)),
        shear_rate: ShearRate::Paper,
        cure: None,
        water: None,
        cavitation_pressure: None,
        wetting: None,
    }
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
    Scene {
        dimensions: if cells[2] == 1 {
            Dimensions::Two
        } else {
            Dimensions::Three
        },
        grid: GridBox {
            cell_m: CELL,
            min_m: [0.0; 3],
            cells,
        },
        boundary,
        liquid: pf(),
        points: Points::default(),
        bodies: Vec::new(),
        wall: WallLaw::Stick,
        gravity: [0.0; 3],
        clamp: None,
        programme: Vec::new(),
        stop: Stop::Time(1.0),
        bottom: None,
        top: None,
    }
}

/// Fills the box from `low` to `high` (cells) with two points per cell and axis, with the
/// velocity `v` at their positions (cells).
pub fn fill(scene: &mut Scene, low: [f64; 3], high: [f64; 3], v: impl Fn([f64; 3]) -> [f64; 3]) {
    let two = scene.dimensions == Dimensions::Two;
    let count = |a: usize| ((high[a] - low[a]) * 2.0).round() as usize;
    let (layers, depth) = if two { (1, 1.0) } else { (count(2), 0.5) };
    for k in 0..layers {
        for j in 0..count(1) {
            for i in 0..count(0) {
                let z = if two {
                    0.5
                } else {
                    low[2] + 0.5 * (k as f64 + 0.5)
                };
                let x = [
                    low[0] + 0.5 * (i as f64 + 0.5),
                    low[1] + 0.5 * (j as f64 + 0.5),
                    z,
                ];
                scene.points.position.push(x.map(|x| x * CELL));
                scene.points.velocity.push(v(x));
                scene.points.volume.push(0.25 * depth * CELL.powi(3));
            }
        }
    }
}

/// A box from `low` to `high` in cells.
pub fn solid(name: &str, low: [f64; 3], high: [f64; 3], motion: Motion) -> RigidBody {
    RigidBody {
        name: name.into(),
        blocks: vec![VoxelBlock::solid_box(
            low.map(|x| x * CELL),
            high.map(|x| x * CELL),
        )],
        motion,
    }
}

/// Liquid pressed into porous voxels by a clamped block; all features at work.
pub fn press() -> Scene {
    let mut s = scene([10, 14, 10], [Boundary::Symmetry; 3]);
    s.boundary[1] = Boundary::Open;
    s.wall = WallLaw::PartialSlip {
        influence_length_m: 0.01 * CELL,
    };
    fill(&mut s, [0.0, 5.0, 0.0], [10.0, 8.0, 10.0], |_| [0.0; 3]);
    let voxel = [0.5 * CELL; 3];
    let block = |low: f64| {
        VoxelBlock::from_fn([0.0, low * CELL, 0.0], voxel, [20, 10, 20], |i, j, k| {
            (i % 8 < 2 || k % 9 < 2) && (j + i) % 7 != 3
        })
    };
    let body = |name: &str, low: f64, motion| physics::RigidBody {
        name: name.into(),
        blocks: vec![block(low)],
        motion,
    };
    s.bodies = vec![
        body("bottom", 0.0, Motion::Fixed),
        body("top", 8.0, Motion::Clamped),
    ];
    s.clamp = Some(Clamp {
        closing_speed: 20.0,
        max_pressure: Some(2.5e6),
        pid: None,
    });
    (s.bottom, s.top) = (Some(0), Some(1));
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

/// Runs to `end` (s), handing every step to `see`.
pub fn run_to(run: &mut Explicit, end: f64, mut see: impl FnMut(&Explicit, &StepReport, f64)) {
    let mut time = 0.0;
    while end - time > 1e-6 * end {
        let limit = StepLimit {
            time_s: end - time,
            ..FREE
        };
        let report = run.advance(limit).expect("a sound run");
        time += report.dt_s;
        see(run, &report, time);
    }
}
