//! Two voxel bodies closing on a slab of liquid, as the adherends of a bond do. Run with
//! `--nocapture` to see the numbers.

#![allow(clippy::print_stdout, reason = "prints for developers")]

#[path = "common/plain.rs"]
mod plain;

use filling::{Implicit, Settings};
use physics::{
    Clamp, Motion, Scene, Scheme, StepLimit, Stop, Table, Viscosity, VoxelBlock, WallLaw,
};

/// Edge of a cell, m.
const H: f64 = 2.9e-6;
/// Cells of the slab.
const GAP: usize = 19;
/// Depth of the slits, cells.
const DEPTH: usize = 30;

/// A slab of PF between two bodies with lumens, `wood(top, i, k)` of whose voxels (half cells)
/// are solid; the upper one comes down at 1 m/s. `across` cells along x and z; along x there
/// are side walls `margin` cells thick beyond them that belong to the lower body.
fn scene(across: [usize; 2], margin: usize, wood: impl Fn(bool, usize, usize) -> bool) -> Scene {
    let flat = across[1] == 1;
    let cells = [across[0] + 2 * margin, 2 * DEPTH + GAP + 4, across[1]];
    let side = margin as f64;
    let voxel = [0.5 * H, 0.5 * H, if flat { H } else { 0.5 * H }];
    let block = |top: bool, low: f64, j: usize| {
        let dims = [2 * across[0], j, if flat { 1 } else { 2 * across[1] }];
        VoxelBlock::from_fn([side * H, low * H, 0.0], voxel, dims, |i, j, k| {
            let floor = !top && j < 4;
            floor || wood(top, i, k)
        })
    };
    let bottom = DEPTH + 2;
    let (step, n) = if flat {
        ([0.5 * H, 0.5 * H, H], [2 * across[0], 2 * GAP, 1])
    } else {
        ([0.5 * H; 3], [2 * across[0], 2 * GAP, 2 * across[1]])
    };
    let points = plain::fill([side * H, bottom as f64 * H, 0.0], step, n);
    let mut below = vec![block(false, 0.0, 2 * bottom)];
    if margin > 0 {
        let n = cells.map(|n| n as f64 * H);
        below.push(VoxelBlock::solid_box([0.0; 3], [side * H, n[1], n[2]]));
        below.push(VoxelBlock::solid_box([n[0] - side * H, 0.0, 0.0], n));
    }
    let above = vec![block(true, (bottom + GAP) as f64, 2 * DEPTH + 4)];
    Scene {
        points,
        bodies: vec![
            plain::body("bottom", below, Motion::Fixed),
            plain::body("top", above, Motion::Clamped),
        ],
        wall: WallLaw::PartialSlip {
            influence_length_m: 0.01 * H,
        },
        clamp: Some(Clamp {
            closing_speed: 1.0,
            max_pressure: None,
            pid: None,
        }),
        stop: Stop::Closed { travel_m: 13.0 * H },
        bottom: Some(0),
        top: Some(1),
        ..plain::scene(H, cells)
    }
}

/// What a run showed, one entry per step.
struct Closed {
    /// Gap (cells), pressure on the upper and on the lower body (Pa), closing speed (m/s).
    history: Vec<[f64; 4]>,
    volume_error: f64,
    iterations: f64,
}

impl Closed {
    /// Pressure on the upper body where the gap passes `gap`.
    fn pressure(&self, gap: f64) -> f64 {
        let after = self.history.iter().position(|h| h[0] <= gap).unwrap();
        let ([g, p, ..], [f, q, ..]) = (self.history[after], self.history[after - 1]);
        q + (p - q) * (f - gap) / (f - g)
    }

    /// Largest relative difference between the forces on the two bodies.
    fn imbalance(&self) -> f64 {
        (self.history.iter().skip(2))
            .map(|[_, top, bottom, _]| (top / bottom - 1.0).abs())
            .fold(0.0, f64::max)
    }

    /// Deviation of log p from its mean over seven steps, rms and largest.
    fn jitter(&self) -> [f64; 2] {
        let logs: Vec<f64> = self.history.iter().skip(4).map(|h| h[1].ln()).collect();
        let windows = logs[..logs.len() - 2].windows(7);
        let off: Vec<f64> = windows
            .map(|w| w[3] - w.iter().sum::<f64>() / 7.0)
            .collect();
        let square = off.iter().map(|d| d * d).sum::<f64>() / off.len() as f64;
        [square.sqrt(), off.iter().fold(0.0, |m, d| m.max(d.abs()))]
    }
}

fn run(scene: Scene, settings: Settings) -> Closed {
    let bodies = scene.bodies.clone();
    let start = scene.liquid_volume();
    let Stop::Closed { travel_m: travel } = scene.stop else {
        panic!("a scene that closes");
    };
    let mut scheme = Implicit::new(scene, settings).unwrap();
    let (mut history, mut iterations, mut gone) = (Vec::new(), 0, 0.0);
    while gone < travel * (1.0 - 1e-9) {
        let limit = StepLimit {
            time_s: f64::INFINITY,
            travel_m: travel - gone,
        };
        let report = scheme.advance(limit).unwrap();
        gone = report.travel_m;
        iterations += report.iterations;
        history.push([
            GAP as f64 - gone / H,
            report.pressure_top,
            report.pressure_bottom,
            report.closing_speed,
        ]);
    }
    let moved = scheme.displacements();
    for x in scheme.liquid().position {
        for (body, d) in bodies.iter().zip(&moved) {
            let at = std::array::from_fn(|a| f64::from(x[a]) - d[a]);
            assert!(!body.contains(at), "particle in {} at {x:?}", body.name);
        }
    }
    Closed {
        iterations: f64::from(iterations) / history.len() as f64,
        volume_error: scheme.diagnostics().volume / start - 1.0,
        history,
    }
}

/// Slits of six cells between ribs of six, those of the upper body above the lower ribs,
/// between side walls.
fn comb() -> Scene {
    scene([48, 1], 2, |top, i, _| i / 12 % 2 == usize::from(top))
}

fn report(name: &str, closed: &Closed) {
    let [rms, most] = closed.jitter();
    println!(
        "{name}: {} steps, {:.1} iterations, P(gap 12) {:.3} MPa, P(gap 8) {:.3} MPa, imbalance {:.1e}, jitter {rms:.4} rms {most:.4} max, volume {:+.4}",
        closed.history.len(),
        closed.iterations,
        1e-6 * closed.pressure(12.0),
        1e-6 * closed.pressure(8.0),
        closed.imbalance(),
        closed.volume_error,
    );
}

/// The prototype gives 1.10 to 1.12 MPa over the 48 of 52 cells between the side walls at a gap
/// of 12 cells.
#[test]
fn a_comb_closes_smoothly() {
    for cfl in [0.5, 1.0] {
        let settings = Settings {
            cfl,
            ..Settings::default()
        };
        let closed = run(comb(), settings);
        report(&format!("comb, CFL {cfl}"), &closed);
        let pressure = 1e-6 * closed.pressure(12.0) * 52.0 / 48.0;
        assert!((pressure / 1.11 - 1.0).abs() < 0.05, "{pressure} MPa");
        assert!(closed.imbalance() < 0.005);
        assert!(closed.jitter()[0] < 0.02);
        assert!(closed.volume_error.abs() < 0.006);
    }
}

#[test]
fn the_clamp_holds_its_pressure() {
    let mut scene = comb();
    let limit = 1.2e6;
    if let Some(clamp) = &mut scene.clamp {
        clamp.max_pressure = Some(limit);
    }
    let closed = run(scene, Settings::default());
    let over = closed
        .history
        .iter()
        .map(|h| h[1] / limit)
        .fold(0.0, f64::max);
    let [_, last, _, speed] = closed.history[closed.history.len() - 1];
    println!(
        "limit {limit:e} Pa: largest {over:.4} of it, at the end {:.4}, speed {speed:.3} m/s",
        last / limit
    );
    assert!(over < 1.01 && (last / limit - 1.0).abs() < 0.01 && speed < 0.9);
    // Its speed is known only after a solve; without another one a slower clamp left a rest of its
    // way to ever smaller steps.
    let ways = closed
        .history
        .windows(2)
        .map(|pair| pair[0][0] - pair[1][0]);
    let least = ways.fold(f64::INFINITY, f64::min);
    println!("smallest step {least:.2e} cells");
    assert!(least > 0.01, "{least} cells in a step");
}

/// Square lumens of six cells between walls of one cell, displaced against each other.
#[test]
fn wood_closes_in_three_dimensions() {
    let wood = |top: bool, i: usize, k: usize| {
        let shift = if top { 7 } else { 0 };
        (i + shift) % 14 < 2 || (k + shift) % 14 < 2
    };
    let closed = run(scene([14, 14], 0, wood), Settings::default());
    report("wood 14 x 14 cells", &closed);
    // Inertia of the liquid as the upper surface crosses the cells, in so small a sample.
    assert!(closed.imbalance() < 0.015 && closed.jitter()[0] < 0.03);
    assert!(closed.volume_error.abs() < 0.006);
}

/// PVA-PF at rest is 210 times as thick as it flows (paper Table 1).
#[test]
fn a_liquid_that_is_thick_at_rest_starts_as_it_will_flow() {
    let wood = |top: bool, i: usize, k: usize| {
        let shift = if top { 7 } else { 0 };
        (i + shift) % 14 < 2 || (k + shift) % 14 < 2
    };
    let mut scene = scene([14, 14], 0, wood);
    let table = Table::new(&[
        (1.0, 210.0),
        (6.30957, 87.0),
        (39.8107, 1.7),
        (501.187, 1.0),
    ]);
    scene.liquid.viscosity = Viscosity::Table(table.unwrap());
    let mut scheme = Implicit::new(scene, Settings::default()).unwrap();
    let limit = StepLimit {
        time_s: f64::INFINITY,
        travel_m: H,
    };
    let [first, second] = [(); 2].map(|()| scheme.advance(limit).unwrap().iterations);
    println!("{first} and {second} iterations");
    assert!(first <= 2 * second, "{first} against {second}");
}

/// Ribs on ribs until they touch: the last liquid between them must get out into the lumens.
#[test]
fn aligned_walls_close_to_nothing() {
    let wood = |_: bool, i: usize, k: usize| i % 14 < 2 || k % 14 < 2;
    let mut scene = scene([7, 7], 0, wood);
    scene.stop = Stop::Closed {
        travel_m: GAP as f64 * H,
    };
    let closed = run(scene, Settings::default());
    report("wood on wood", &closed);
    assert!(closed.history[closed.history.len() - 1][0].abs() < 1e-6);
    assert!(closed.volume_error.abs() < 0.006);
}

/// Bit by bit the same liquid after ten steps with any number of threads.
#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let wood = |top: bool, i: usize, k: usize| {
        let shift = if top { 7 } else { 0 };
        (i + shift) % 14 < 2 || (k + shift) % 14 < 2
    };
    let after = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| {
            let mut scheme = Implicit::new(scene([14, 14], 0, wood), Settings::default()).unwrap();
            let mut reports = Vec::new();
            for _ in 0..10 {
                let limit = StepLimit {
                    time_s: f64::INFINITY,
                    travel_m: 13.0 * H,
                };
                reports.push(scheme.advance(limit).unwrap());
            }
            let liquid = scheme.liquid();
            let bits = |v: &[f32]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            let found = [
                bits(liquid.position.as_flattened()),
                bits(liquid.velocity.as_flattened()),
                bits(&liquid.pressure),
                bits(&liquid.shear_rate),
            ];
            (reports, found)
        })
    };
    let one = after(1);
    assert!(one == after(2) && one == after(3));
}
