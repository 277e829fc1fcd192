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

#[path = "../tests/scenes/mod.rs"]
mod scenes;

use std::time::Instant;

use mpm::{Explicit, PressureFrom, Settings, ShapeFunction, VelocityUpdate};
use physics::{Boundary, Motion, Newtonian, Scene, Scheme, Viscosity, VoxelBlock};
use scenes::{CELL, VISCOSITY, body, clamp, pour, pva_pf};

const WIDTH: usize = 24;
const WOOD: usize = 12;
const SLAB: usize = 6;

/// Lumens of 12 voxels along z with walls of 2 voxels.
fn porous(i: usize, j: usize) -> bool {
    i % 14 < 2 || j % 14 < 2
}

fn scene(walls: bool, viscosity: Viscosity) -> Scene {
    let mut scene = scenes::scene([WIDTH, 2 * WOOD + SLAB, WIDTH], [Boundary::Symmetry; 3]);
    scene.boundary[1] = Boundary::Open;
    scene.liquid.viscosity = viscosity;
    let [width, low, high] = [WIDTH, WOOD, WOOD + SLAB].map(|n| n as f64);
    pour(&mut scene, [0.0, low, 0.0], [width, high, width]);
    let wood = |low: usize, upper: bool| {
        let (origin, dims) = (
            [0.0, low as f64 * CELL, 0.0],
            [2 * WIDTH, 2 * WOOD, 2 * WIDTH],
        );
        VoxelBlock::from_fn(origin, [0.5 * CELL; 3], dims, |i, j, _| {
            porous(i, if upper { j } else { 2 * WOOD - 1 - j } + 5)
        })
    };
    if walls {
        let bodies = [
            body("bottom", wood(0, false), Motion::Fixed),
            body("top", wood(WOOD + SLAB, true), Motion::Clamped),
        ];
        clamp(&mut scene, bodies, 1.0);
    }
    scene
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
    let cpu_seconds = || machine::cpu_seconds().unwrap_or(f64::NAN);
    let steps: usize = std::env::args()
        .nth(1)
        .map_or(400, |n| n.parse().expect("a number of steps"));
    let only = std::env::args().nth(2).unwrap_or_default();
    let threads = rayon::current_num_threads();
    println!(
        "scene,shape,update,threads,points,steps,million_point_steps_per_s,per_cpu_s,stages_percent"
    );
    let pf = || Viscosity::Newtonian(Newtonian(VISCOSITY));
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
            scenes::advance(&mut run, 1);
            let (start, cpu) = (Instant::now(), cpu_seconds());
            let before = run.stage_times();
            scenes::advance(&mut run, steps);
            let (wall, cpu) = (start.elapsed().as_secs_f64(), cpu_seconds() - cpu);
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
