//! Liquid drawn into slits and tubes by its surface: Lucas-Washburn, Jurin's height, no entry. Run with
//! `--nocapture` to see the errors.

#![allow(clippy::print_stdout, reason = "prints for developers")]

#[path = "common/plain.rs"]
mod plain;

use filling::{Implicit, Settings};
use physics::{Motion, Scene, Scheme, StepLimit, VoxelBlock, Wetting};

/// Width of slits and tubes, m.
const H: f64 = 17.4e-6;
const ETA: f64 = 1.3;
/// Surface tension, N/m.
const SIGMA: f64 = 0.05;

fn wetting(degrees: f64) -> Wetting {
    Wetting {
        tension: SIGMA,
        advancing: degrees.to_radians(),
        receding: degrees.to_radians(),
    }
}

/// A passage along x.
#[derive(Clone, Copy)]
enum Passage {
    /// Between plates, in plane strain.
    Slit,
    /// Round, of voxels of half a cell.
    Tube,
}

/// A passage of `n` cells behind a reservoir twice (tube) or four times (slit) as wide and three times as deep,
/// with a free surface at its back, walls off by `offset` cells along x and y; and the x of its mouth, m.
fn wicking(kind: Passage, n: usize, offset: [f64; 2], degrees: f64) -> (Scene, f64) {
    let h = H / n as f64;
    let (w, far) = (n as f64, 999.0);
    let mouth = 3.0 * w + 2.0 + offset[0];
    let columns = 6 * n + (2.0 * offset[0]).round() as usize;
    let dx = (mouth - 2.0) * h / columns as f64;
    let block = |low: [f64; 2], high: [f64; 2]| {
        VoxelBlock::solid_box([low[0] * h, low[1] * h, 0.0], [high[0] * h, high[1] * h, h])
    };
    let (cells, points, wood) = match kind {
        Passage::Slit => {
            let low = 1.5 * w + offset[1];
            let plates = vec![
                block([mouth, -far], [far, low]),
                block([mouth, low + w], [far, far]),
            ];
            let points = plain::fill([2.0 * h, 0.0, 0.0], [dx, 0.5 * h, h], [columns, 8 * n, 1]);
            ([8 * n + 4, 4 * n, 1], points, plates)
        }
        Passage::Tube => {
            // One cell more than the domain on each side.
            let open = |v: usize| 0.5 * (v as f64 + 0.5) - w - 1.0;
            let round = |j: usize, k: usize| open(j).hypot(open(k)) < 0.5 * w;
            let low = (offset[1] - 1.0) * h;
            let tube = VoxelBlock::from_fn(
                [mouth * h, low, low],
                [far * h, 0.5 * h, 0.5 * h],
                [1, 4 * n + 4, 4 * n + 4],
                |_, j, k| !round(j, k),
            );
            let size = [dx, 0.5 * h, 0.5 * h];
            let points = plain::fill([2.0 * h, 0.0, 0.0], size, [columns, 4 * n, 4 * n]);
            ([7 * n + 4, 2 * n, 2 * n], points, vec![tube])
        }
    };
    let mut scene = plain::scene(h, cells);
    scene.points = points;
    scene.bodies = vec![plain::body("wood", wood, Motion::Fixed)];
    scene.liquid.wetting = Some(wetting(degrees));
    (scene, mouth * h)
}

/// Time and volume beyond the mouth, step by step, until it is as large as `until` or at `end`.
fn course(scene: Scene, mouth: f64, until: f64, end: f64) -> Vec<[f64; 2]> {
    let mut scheme = Implicit::new(scene, Settings::default()).unwrap();
    let mut course = vec![[0.0; 2]];
    let mut time = 0.0;
    while time < end * (1.0 - 1e-9) && course[course.len() - 1][1] < until {
        let limit = StepLimit {
            time_s: end - time,
            travel_m: f64::INFINITY,
        };
        time += scheme.advance(limit).unwrap().dt_s;
        let liquid = scheme.liquid();
        let inside = (liquid.position.iter().zip(&liquid.volume))
            .filter(|(x, _)| f64::from(x[0]) > mouth)
            .map(|(_, &v)| f64::from(v))
            .sum();
        course.push([time, inside]);
    }
    course
}

/// Error of L at the end of the course against L (L + 2 e) = t/`unit` + constant from one width on, lengths in H;
/// `width` is the volume of a length of H, `e` the equivalent length of entrance and front.
fn length_error(course: &[[f64; 2]], width: f64, unit: f64, e: f64) -> f64 {
    let lengths: Vec<[f64; 2]> = (course.iter())
        .map(|[t, v]| [t / unit, v / width])
        .filter(|c| c[1] >= 1.0)
        .collect();
    let (first, last) = (lengths[0], lengths[lengths.len() - 1]);
    last[1] / (((first[1] + e).powi(2) + last[0] - first[0]).sqrt() - e) - 1.0
}

/// Error of Lucas and Washburn in a slit: L^2 = H sigma cos(theta) t/(3 eta).
fn in_slit(n: usize, offset: [f64; 2], degrees: f64) -> f64 {
    let (scene, mouth) = wicking(Passage::Slit, n, offset, degrees);
    let width = H * H * H / n as f64;
    let unit = 3.0 * ETA * H / wetting(degrees).adhesion()[0];
    let course = course(scene, mouth, 4.2 * width, 100.0 * unit);
    let error = length_error(&course, width, unit, 0.24);
    println!(
        "slit of {n} cells, walls off by {offset:?}, {degrees} degrees: L {error:+.3} in {} steps",
        course.len() - 1
    );
    // A cell and a half a step: no surface wave limits it.
    assert!(course.len() < 9 * n);
    error
}

#[test]
fn lucas_washburn_in_slits() {
    for (offset, degrees) in [
        ([0.0, 0.0], 0.0),
        ([0.0, 0.25], 60.0),
        ([0.0, 0.5], 60.0),
        ([0.5, 0.0], 60.0),
    ] {
        assert!(in_slit(6, offset, degrees).abs() < 0.05);
    }
}

/// A front that only advances knows nothing of the angle at which it would recede.
#[test]
fn lucas_washburn_with_contact_lines_that_hold() {
    let degrees = 60.0;
    let (mut scene, mouth) = wicking(Passage::Slit, 6, [0.0, 0.25], degrees);
    let lines = Wetting {
        receding: 0.0,
        ..wetting(degrees)
    };
    scene.liquid.wetting = Some(lines);
    let width = H * H * H / 6.0;
    let unit = 3.0 * ETA * H / lines.adhesion()[0];
    let course = course(scene, mouth, 4.2 * width, 100.0 * unit);
    let error = length_error(&course, width, unit, 0.24);
    println!("60/0 degrees: L {error:+.3} in {} steps", course.len() - 1);
    assert!(error.abs() < 0.05);
}

#[test]
#[ignore = "10 s; prints the numbers of other widths"]
fn lucas_washburn_in_other_slits() {
    for n in [3, 12] {
        for offset in [[0.0, 0.0], [0.0, 0.25], [0.0, 0.5], [0.5, 0.0]] {
            in_slit(n, offset, 60.0);
        }
    }
}

/// L^2 = r sigma cos(theta) t/(2 eta), the resistance that of the voxels' own area.
#[test]
fn lucas_washburn_in_a_tube() {
    for (n, offset) in [(6, [0.0, 0.0]), (6, [0.0, 0.25])] {
        let (scene, mouth) = wicking(Passage::Tube, n, offset, 0.0);
        let open = |v: &usize| {
            let at = |v: usize| (v % (2 * n)) as f64 + 0.5 - n as f64;
            at(*v).hypot(at(v / (2 * n))) < n as f64
        };
        let voxels = 4 * n * n;
        let area = (0..voxels).filter(open).count() as f64 / voxels as f64;
        let unit = std::f64::consts::PI / area * ETA * H / SIGMA;
        let course = course(scene, mouth, 3.0 * area * H * H * H, 100.0 * unit);
        let error = length_error(&course, area * H * H * H, unit, 0.2);
        println!("tube of {n} cells, walls off by {offset:?}: L {error:+.3}");
        assert!(error.abs() < 0.05);
    }
}

/// Teeth of half a cell, a cell apart, on one wall of a slit hold menisci: liquid at rest starts, and goes as they let it.
#[test]
fn liquid_at_rest_enters_a_slit_with_teeth() {
    let (mut scene, mouth) = wicking(Passage::Slit, 6, [0.0, 0.0], 60.0);
    let h = H / 6.0;
    let low = 1.5 * H;
    scene.bodies[0].blocks.extend((0..24).map(|tooth| {
        let x = mouth + 2.0 * h * f64::from(tooth);
        VoxelBlock::solid_box([x, low, 0.0], [x + h, low + 0.5 * h, h])
    }));
    let unit = 3.0 * ETA * H / wetting(60.0).adhesion()[0];
    let course = course(scene, mouth, f64::INFINITY, 4.0 * unit);
    // By lubrication, the volume in widths of H: teeth narrow half of the slit to `open`, and hold by half of
    // what the pull falls by behind each, which leaves that of a slit without teeth.
    let open = 11.0 / 12.0;
    let [resistance, area] = [f64::powi(open, -3), open].map(|of| 0.5 * (1.0 + of));
    let exact = area * (f64::hypot(2.0 / (resistance * area).sqrt(), 0.24) - 0.24);
    let error = course[course.len() - 1][1] / (H * H * h) / exact - 1.0;
    let steps = course.len() - 1;
    println!("slit with teeth: volume {error:+.3} in {steps} steps");
    assert!(error.abs() < 0.04);
}

/// What is in the passage after 20 units of time where it does not wet, over H, pressed by a body force that gives
/// `share` of its jump at the mouth.
fn entered(kind: Passage, share: f64) -> f64 {
    let (mut scene, mouth) = wicking(kind, 6, [0.0, 0.0], 120.0);
    let (jump, volume) = match kind {
        Passage::Slit => (SIGMA / H, H * H * H / 6.0),
        Passage::Tube => (2.0 * SIGMA / H, 7.0 / 9.0 * H * H * H),
    };
    scene.gravity[0] = share * jump / (scene.liquid.density * 3.0 * H);
    let end = 20.0 * 3.0 * ETA * H / SIGMA;
    let course = course(scene, mouth, 1.5 * volume, end);
    let most = course.iter().fold(0.0, |most: f64, c| most.max(c[1]));
    println!(
        "120 degrees, pressed by {share} of the jump: {:.3} H within {} steps",
        most / volume,
        course.len() - 1
    );
    most / volume
}

#[test]
fn what_does_not_wet_enters_only_under_pressure() {
    // A cell is 0.17 H.
    assert!(entered(Passage::Slit, 0.0) < 0.1);
    assert!(entered(Passage::Slit, 0.8) < 0.1);
    assert!(entered(Passage::Slit, 1.5) > 0.5);
    assert!(entered(Passage::Tube, 0.8) < 0.1);
}

/// Two plates `n`/2 cells thick, with a slit of H between them, dip into a pool: the height to which the liquid in
/// it stands above that beside them over 2 sigma/(rho g H) = 3/2 H.
fn rise(n: usize, offset: f64, degrees: f64) -> f64 {
    let (h, w) = (H / n as f64, n as f64);
    let (left, low) = (2.0 * w + offset, w + 0.25);
    let block = |x: f64| {
        let (low, high) = ([x * h, low * h, 0.0], [(x + 0.5 * w) * h, 99.0 * w * h, h]);
        VoxelBlock::solid_box(low, high)
    };
    let plates = vec![block(left - 0.5 * w), block(left + w)];
    let mut scene = plain::scene(h, [5 * n, 5 * n, 1]);
    let pool = plain::fill([0.0; 3], [0.5 * h, 0.5 * h, h], [10 * n, 4 * n, 1]);
    for (point, x) in pool.position.iter().enumerate() {
        if !plates.iter().any(|plate| plate.contains(*x)) {
            scene.points.position.push(*x);
            scene.points.velocity.push([0.0; 3]);
            scene.points.volume.push(pool.volume[point]);
        }
    }
    scene.bodies = vec![plain::body("plates", plates, Motion::Fixed)];
    scene.liquid.wetting = Some(wetting(degrees));
    let height = 1.5 * H;
    scene.gravity[1] = -2.0 * SIGMA / (scene.liquid.density * H * height);
    let mut scheme = Implicit::new(scene, Settings::default()).unwrap();
    let (mut time, end) = (0.0, 120.0 * ETA * H / SIGMA);
    while time < end * (1.0 - 1e-9) {
        let limit = StepLimit {
            time_s: end - time,
            travel_m: f64::INFINITY,
        };
        time += scheme.advance(limit).unwrap().dt_s;
    }
    let liquid = scheme.liquid();
    let mut above = [0.0; 2];
    for (x, v) in liquid.position.iter().zip(&liquid.volume) {
        if f64::from(x[1]) > low * h {
            let inside = (left * h..(left + w) * h).contains(&f64::from(x[0]));
            above[usize::from(inside)] += f64::from(*v) / h;
        }
    }
    // Beside the plates the liquid stands in slits that are 3 H wide in all, 6 H with their mirror images.
    (above[1] / H - above[0] / (3.0 * H)) / height
}

/// Beside the plates menisci reach to their mirror images, 3 H away in the mean.
#[test]
fn jurins_height() {
    for (n, offset, degrees) in [(6, 0.0, 0.0), (6, 0.2, 60.0), (6, 0.5, 120.0)] {
        let exact = f64::cos(f64::to_radians(degrees)) * (1.0 - 1.0 / 3.0);
        let error = rise(n, offset, degrees) / exact - 1.0;
        println!("slit of {n} cells, off by {offset}, {degrees} degrees: height {error:+.3}");
        assert!(error.abs() < 0.05);
    }
}
