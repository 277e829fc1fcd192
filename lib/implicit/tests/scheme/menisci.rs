//! Liquid between two menisci.

use physics::{Motion, Scheme, VoxelBlock, Wetting};

use crate::plain;
use crate::runs::{ETA, H, advance, plainly};

/// Surface tension, N/m.
const SIGMA: f64 = 0.05;
/// Cells across a channel.
const N: usize = 6;

/// Liquid in a channel along x between two menisci rests at minus their capillary pressure. The domain is a quarter of the
/// section, in the corner of as much wood.
#[test]
fn liquid_between_two_menisci_rests() {
    let (h, w, far) = (H / N as f64, 0.5 * N as f64, 999.0);
    let block = |low: [f64; 2], high: [f64; 2]| {
        let side = |at: [f64; 2], x: f64| [x * h, at[0] * h, at[1] * h];
        VoxelBlock::solid_box(side(low, -1.0), side(high, far))
    };
    let open = |v: usize| 0.5 * (v as f64 + 0.5);
    let voxel = [far * h, 0.5 * h, 0.5 * h];
    let solid = |_, j, k| open(j).hypot(open(k)) >= w;
    let stairs = VoxelBlock::from_fn([-h, 0.0, 0.0], voxel, [1, 4 * N, 4 * N], solid);
    let square = vec![block([w, 0.0], [far, far]), block([0.0, w], [w, far])];
    // Cells along z, and perimeter over area, over 1/H.
    for (kind, walls, deep, narrowness) in [
        ("slit", vec![block([w, 0.0], [far, 1.0])], 1, 2.0),
        ("square", square, 2 * N, 4.0),
        ("tube", vec![stairs], 2 * N, 4.0),
    ] {
        let mut scene = plain::scene(h, [20, 2 * N, deep]);
        let (dz, nz) = if deep == 1 {
            (h, 1)
        } else {
            (0.5 * h, 2 * deep)
        };
        let all = plain::fill([5.0 * h, 0.0, 0.0], [0.5 * h, 0.5 * h, dz], [16, 4 * N, nz]);
        for (x, volume) in all.position.into_iter().zip(all.volume) {
            if !walls.iter().any(|block| block.contains(x)) {
                scene.points.position.push(x);
                scene.points.velocity.push([0.0; 3]);
                scene.points.volume.push(volume);
            }
        }
        scene.bodies = vec![plain::body("wood", walls, Motion::Fixed)];
        scene.liquid.wetting = Some(Wetting {
            tension: SIGMA,
            contact_angle: 0.0,
        });
        let mut scheme = plainly(&scene);
        (0..5).for_each(|_| _ = advance(&mut scheme, 1e-3));
        let jump = SIGMA * narrowness / H;
        let pressures = scheme.liquid().pressure.into_iter().map(f64::from);
        let lowest = pressures.fold(0.0, f64::min);
        let speed = scheme.diagnostics().max_speed * ETA / SIGMA;
        println!(
            "{kind}: speed {speed:.1e} sigma/eta, pressure {:.6} of the jump",
            lowest / jump
        );
        assert!(speed < 1e-5 && (lowest / jump + 1.0).abs() < 1e-3);
    }
}
