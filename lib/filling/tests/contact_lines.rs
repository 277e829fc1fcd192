//! Contact lines that hold between an advancing and a receding angle.

#![allow(clippy::print_stdout, reason = "prints for developers")]

#[path = "common/plain.rs"]
mod plain;

use filling::{Implicit, Settings};
use physics::{Motion, Scheme, StepLimit, VoxelBlock, Wetting};

/// Width of the slit, m.
const H: f64 = 17.4e-6;
const ETA: f64 = 1.3;
/// Surface tension, N/m.
const SIGMA: f64 = 0.05;

/// Way of a slug of 3 H in a slit of `n` cells, walls off by `offset`, under a body force along it of `share` of what its
/// contact lines hold between `advancing` and `receding`, over H, in `times` a time in
/// which it would go H without them; beyond that of the plates, which go `drift` H in that time.
fn slid(
    n: usize,
    offset: f64,
    [advancing, receding]: [f64; 2],
    [share, times, drift]: [f64; 3],
) -> f64 {
    let h = H / n as f64;
    let low = (1.0 + offset) * h;
    let far = 99.0 * H;
    let plates = [[-far, low], [low + H, far]]
        .map(|[from, to]| VoxelBlock::solid_box([-far, from, 0.0], [far, to, h]));
    let mut scene = plain::scene(h, [8 * n, n + 3, 1]);
    let size = [0.5 * h, 0.5 * h, h];
    scene.points = plain::fill([2.0 * H, low, 0.0], size, [6 * n, 2 * n, 1]);
    let angles = Wetting {
        tension: SIGMA,
        advancing: f64::to_radians(advancing),
        receding: f64::to_radians(receding),
    };
    scene.liquid.wetting = Some(angles);
    let [held, freed] = angles.adhesion();
    let force = share * 2.0 * (freed - held) / (H * 3.0 * H);
    scene.gravity[0] = force / scene.liquid.density;
    let once = H / (force * H * H / (12.0 * ETA));
    let along = Motion::Constant([drift * H / once, 0.0, 0.0]);
    scene.bodies = vec![plain::body("plates", plates.to_vec(), along)];
    let end = times * once;
    let middle = |scheme: &Implicit| {
        let liquid = scheme.liquid();
        let parts = liquid.position.iter().zip(&liquid.volume);
        let whole: f64 = liquid.volume.iter().map(|&v| f64::from(v)).sum();
        parts
            .map(|(x, &v)| f64::from(x[0]) * f64::from(v))
            .sum::<f64>()
            / whole
    };
    let mut scheme = Implicit::new(scene, Settings::default()).unwrap();
    let (start, mut time, mut steps) = (middle(&scheme), 0.0, 0);
    while time < end * (1.0 - 1e-9) {
        let limit = StepLimit {
            time_s: (end - time).min(0.05 * end),
            travel_m: f64::INFINITY,
        };
        time += scheme.advance(limit).unwrap().dt_s;
        steps += 1;
    }
    let settled = ("steps whose contact lines did not settle", 0);
    assert!(scheme.counts().contains(&settled));
    let way = (middle(&scheme) - start) / H - drift * times;
    println!(
        "slug in a slit of {n} cells off by {offset}, {advancing}/{receding} degrees, {share} of what holds, {times} times, drift {drift}: way {way:+.4} in {steps} steps"
    );
    way
}

/// Between both angles a slug creeps by thousandths of a cell in a step; beyond it goes by what is left of the force.
#[test]
fn contact_lines_hold_a_slug_until_they_are_pulled_harder() {
    for (offset, angles) in [(0.0, [60.0, 20.0]), (0.4, [110.0, 80.0])] {
        for share in [0.25, 0.5, 0.9] {
            for (times, drift) in [(1.0, 0.0), (100.0, 0.0), (1.0, 1.5)] {
                let way = slid(6, offset, angles, [share, times, drift]);
                assert!((-0.004..0.004).contains(&way));
            }
        }
        for (share, drift) in [(1.5, 0.0), (3.0, 0.0), (1.5, 1.5)] {
            let exact = 1.0 - 1.0 / share;
            let error = slid(6, offset, angles, [share, 1.0, drift]) / exact - 1.0;
            println!("off by {error:+.3}");
            assert!(error.abs() < 0.03);
        }
    }
}

/// Way in its first step, over H, of a slug of 3 H between plates of which one has teeth of half a cell, a cell apart, under
/// a pressure of `pressure` (Pa) on it, that would move it by 0.2 H; its liquid has this surface `tension`, N/m.
fn started(pressure: f64, tension: f64) -> f64 {
    let (n, h) = (6, H / 6.0);
    let far = 99.0 * H;
    let mut blocks = vec![
        VoxelBlock::solid_box([-far, -far, 0.0], [far, h, h]),
        VoxelBlock::solid_box([-far, h + H, 0.0], [far, far, h]),
    ];
    blocks.extend((0..4 * n).map(|tooth| {
        let low = 2.0 * h * tooth as f64;
        VoxelBlock::solid_box([low, 0.0, 0.0], [low + h, 1.5 * h, h])
    }));
    let mut scene = plain::scene(h, [8 * n, n + 3, 1]);
    let size = [0.5 * h, 0.5 * h, h];
    scene.points = plain::fill([2.0 * H, 1.5 * h, 0.0], size, [6 * n, 2 * n - 1, 1]);
    scene.liquid.wetting = Some(Wetting {
        tension,
        advancing: f64::to_radians(60.0),
        receding: f64::to_radians(60.0),
    });
    let force = pressure / (3.0 * H);
    scene.gravity[0] = force / scene.liquid.density;
    scene.bodies = vec![plain::body("plates", blocks, Motion::Constant([0.0; 3]))];
    let mut scheme = Implicit::new(scene, Settings::default()).unwrap();
    let time_s = 0.2 * H * 12.0 * ETA / (force * H * H);
    let before = scheme.liquid().position;
    let limit = StepLimit {
        time_s,
        travel_m: f64::INFINITY,
    };
    let dt = scheme.advance(limit).unwrap().dt_s;
    let after = scheme.liquid().position;
    let ways = before.iter().zip(&after);
    let sum: f64 = ways.map(|(a, b)| f64::from(b[0] - a[0])).sum();
    sum / before.len() as f64 / H * (time_s / dt)
}

/// Teeth of half a cell hold a slug by some 250 Pa: forty times as much moves it in the first step as if they did not.
#[test]
fn a_slug_that_teeth_hold_starts_at_once() {
    let [held, free] = [SIGMA, 1e-9].map(|tension| started(1e4, tension));
    println!("way {held:.4}, without menisci {free:.4} H");
    assert!((held / free - 1.0).abs() < 0.1);
}
