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
