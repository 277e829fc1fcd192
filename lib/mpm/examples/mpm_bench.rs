//! Liquid particle-steps per second of the explicit scheme.
//!
//!     cargo run --release -p mpm --example mpm_bench -- [steps] [case]
//!
//! `case` picks the lines that begin with it, such as `wood,Gimp`.
//! Scene "wood": a slab of liquid between two porous voxel blocks with voxels of half a cell,
//! eight points per cell, the upper one closing at 1 m/s, partial slip. Scene "free": the same
//! liquid without bodies, scene "table" the first with the paper's PVA-PF table. Threads: `RAYON_NUM_THREADS`. Rates are per wall-clock second and,
//! for machines that are shared, per second of processor time.

#![allow(clippy::print_stdout, reason = "prints for developers")]

use std::time::Instant;

use mpm::{Explicit, PressureFrom, Settings, ShapeFunction, VelocityUpdate};
use physics::{
    Boundary, Clamp, Dimensions, GridBox, Liquid, Motion, Newtonian, Points, RigidBody, Scene,
    Scheme, ShearRate, StepLimit, Stop, Table, Tait, Viscosity, VoxelBlock, WallLaw,
};

const CELL: f64 = 2.9e-6;
const WIDTH: usize = 24;
const WOOD: usize = 12;
const SLAB: usize = 6;

/// Lumens of 12 voxels along z with walls of 2 voxels.
fn porous(i: usize, j: usize) -> bool {
    i % 14 < 2 || j % 14 < 2
}

/// The paper's Table 1.
fn pva_pf() -> Viscosity {
    let points = [
        (1.0, 210.0),
        (6.30957, 87.0),
        (39.8107, 1.7),
        (501.187, 1.0),
    ];
    Viscosity::Table(Table::new(&points).expect("a valid table"))
}

fn scene(walls: bool, viscosity: Viscosity) -> Scene {
    let height = 2 * WOOD + SLAB;
    let mut points = Points::default();
    for k in 0..2 * WIDTH {
        for j in 2 * WOOD..2 * (WOOD + SLAB) {
            for i in 0..2 * WIDTH {
                points
                    .position
                    .push([i, j, k].map(|n| (n as f64 + 0.5) * 0.5 * CELL));
                points.velocity.push([0.0; 3]);
                points.volume.push(CELL.powi(3) / 8.0);
            }
        }
    }
    let voxel = [0.5 * CELL; 3];
    let dims = [2 * WIDTH, 2 * WOOD, 2 * WIDTH];
    let wood = |low: usize, upper: bool| {
        VoxelBlock::from_fn([0.0, low as f64 * CELL, 0.0], voxel, dims, |i, j, _| {
            porous(i, if upper { j } else { 2 * WOOD - 1 - j } + 5)
        })
    };
    let body = |name: &str, block, motion| RigidBody {
        name: name.into(),
        blocks: vec![block],
        motion,
    };
    let bodies = vec![
        body("bottom", wood(0, false), Motion::Fixed),
        body("top", wood(WOOD + SLAB, true), Motion::Clamped),
    ];
    Scene {
        dimensions: Dimensions::Three,
        grid: GridBox {
            cell_m: CELL,
            min_m: [0.0; 3],
            cells: [WIDTH, height, WIDTH],
        },
        boundary: [Boundary::Symmetry, Boundary::Open, Boundary::Symmetry],
        liquid: Liquid {
            density: 1200.0,
            tait: Tait { bulk_modulus: 1e9 },
            viscosity,
            shear_rate: ShearRate::Paper,
            cure: None,
            water: None,
            cavitation_pressure: None,
            wetting: None,
        },
        points,
        bodies: if walls { bodies } else { Vec::new() },
        wall: WallLaw::PartialSlip {
            influence_length_m: 0.01 * CELL,
        },
        gravity: [0.0; 3],
        clamp: walls.then_some(Clamp {
            closing_speed: 1.0,
            max_pressure: Some(2.5e6),
            pid: None,
        }),
        programme: Vec::new(),
        stop: Stop::Time(1.0),
        bottom: walls.then_some(0),
        top: walls.then_some(1),
    }
}

/// Processor time of this process so far, s; Linux only, else 0.
fn processor_s() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> = stat
        .rsplit(')')
        .next()
        .unwrap_or("")
        .split_whitespace()
        .collect();
    let ticks = |i: usize| fields.get(i).and_then(|f| f.parse().ok()).unwrap_or(0.0);
    (ticks(11) + ticks(12)) / 100.0
}

/// What is timed in every scene.
fn variants() -> Vec<Settings> {
    let of = |shape, velocity_update| Settings {
        shape,
        velocity_update,
        ..Settings::default()
    };
    let apic = of(ShapeFunction::Gimp, VelocityUpdate::Apic);
    vec![
        of(ShapeFunction::Gimp, VelocityUpdate::Flip),
        of(ShapeFunction::Gimp, VelocityUpdate::Xpic(5)),
        apic,
        Settings {
            pressure: PressureFrom::CellMean,
            ..apic
        },
        Settings {
            density_projection: Some(0.04),
            ..apic
        },
        of(ShapeFunction::Bspline2, VelocityUpdate::Flip),
        of(ShapeFunction::Linear, VelocityUpdate::Flip),
    ]
}

fn main() {
    let steps: usize = std::env::args()
        .nth(1)
        .map_or(400, |n| n.parse().expect("a number of steps"));
    let only = std::env::args().nth(2).unwrap_or_default();
    let threads = rayon::current_num_threads();
    println!(
        "scene,shape,update,threads,points,steps,million_point_steps_per_s,per_cpu_s,stages_percent"
    );
    let pf = || Viscosity::Newtonian(Newtonian(1.3));
    for (scene_name, scene) in [
        ("wood", scene(true, pf())),
        ("free", scene(false, pf())),
        ("table", scene(true, pva_pf())),
    ] {
        for settings in variants() {
            let (shape, update) = (settings.shape, settings.velocity_update);
            let mut name = format!("{scene_name},{shape:?},{update:?}");
            if settings.pressure == PressureFrom::CellMean {
                name += " cell-mean";
            }
            if settings.density_projection.is_some() {
                name += " projection";
            }
            if !name.starts_with(&only) {
                continue;
            }
            let mut run = Explicit::new(&scene, &settings).expect("a valid scene");
            let limit = StepLimit {
                time_s: f64::INFINITY,
                travel_m: f64::INFINITY,
            };
            run.advance(limit).expect("a sound run");
            let (start, cpu) = (Instant::now(), processor_s());
            let before = run.stage_times();
            for _ in 0..steps {
                run.advance(limit).expect("a sound run");
            }
            let (wall, cpu) = (start.elapsed().as_secs_f64(), processor_s() - cpu);
            let points = scene.points.position.len();
            let stages: Vec<String> = run
                .stage_times()
                .iter()
                .zip(&before)
                .map(|(s, b)| format!("{} {:.0}", s.name, 100.0 * (s.wall_s - b.wall_s) / wall))
                .collect();
            println!(
                "{name},{threads},{points},{steps},{:.2},{:.2},{}",
                points as f64 * steps as f64 / wall / 1e6,
                points as f64 * steps as f64 / cpu / 1e6,
                stages.join("; ")
            );
        }
    }
}
