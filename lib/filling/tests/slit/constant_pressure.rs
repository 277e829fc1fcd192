//! A piston under constant pressure fills the slit: Washburn's law.

use filling::{Implicit, Settings};
use physics::{Clamp, Course, Cure, CureLaw, Motion, Scheme, StepLimit, VoxelBlock};

use crate::{ETA, H, corner, scene};

/// Pressure on the piston, Pa.
const PRESSURE: f64 = 1e6;

/// Time to fill the slit to 5 H, in units of 12 eta/P.
fn time_to_fill(n: usize, offset: f64, cure: Option<Cure>) -> f64 {
    let mut scene = scene(n, [offset, 0.0]);
    // The clamp pushes downwards, so the scene is turned upside down.
    let top = scene.grid.max_m()[1];
    for body in &mut scene.bodies {
        for block in &mut body.blocks {
            let (mut low, mut high) = (block.origin(), block.max());
            (low[1], high[1]) = (top - high[1], top - low[1]);
            *block = VoxelBlock::solid_box(low, high);
        }
    }
    for x in &mut scene.points.position {
        x[1] = top - x[1];
    }
    scene.liquid.cure = cure;
    let h = H / n as f64;
    scene.bodies[1].motion = Motion::Clamped;
    scene.clamp = Some(Clamp {
        closing_speed: 5.0,
        max_pressure: Some(PRESSURE * 4.0 * H * h / scene.grid.area_m2()),
        pid: None,
    });
    (scene.bottom, scene.top) = (Some(0), Some(1));
    let mut scheme = Implicit::new(scene, Settings::default()).unwrap();
    let (mut time, mut travel, goal) = (0.0, 0.0, 5.0 * H / 4.0);
    while travel < goal * (1.0 - 1e-9) {
        let limit = StepLimit {
            time_s: f64::INFINITY,
            travel_m: goal - travel,
        };
        let report = scheme.advance(limit).unwrap();
        time += report.dt_s;
        travel = report.travel_m;
    }
    time * PRESSURE / (12.0 * ETA)
}

/// Time by finite elements behind a tracked front (lib/studies/reference), the piston's sides
/// giving way over 1/24 H.
const TIME_TO_FIVE: f64 = 14.26;

#[test]
fn filling_at_constant_pressure() {
    for (n, tolerance) in [(6, 0.05), (12, 0.03)] {
        let reference = TIME_TO_FIVE + 5.0 * corner(n);
        for offset in [0.0, 0.25, 0.5] {
            let time = time_to_fill(n, offset, None);
            println!(
                "slit of {n} cells, offset {offset}: filled to 5 H in {time:.2}, reference {reference:.2}"
            );
            if offset == 0.0 {
                assert!(
                    (time / reference - 1.0).abs() < tolerance,
                    "{n} cells: {time}"
                );
            }
        }
    }
}

/// Without inertia to speak of, the course over the integral of 1/viscosity is that without cure.
#[test]
fn a_liquid_that_cures_fills_by_the_integral_of_fluidity() {
    /// t_gel in units of 12 eta/P; the viscosity grows 60-fold until the slit is filled.
    const GEL: f64 = 45.0;
    let law = CureLaw {
        course: Some(Course::Gel {
            time: GEL * 12.0 * ETA / PRESSURE,
            exponent: 2.0,
        }),
        temperature: Vec::new(),
        reference: 300.0,
        cure_energy: 0.0,
        flow_energy: 0.0,
    };
    let plain = time_to_fill(6, 0.0, None);
    let time = time_to_fill(6, 0.0, Some(Cure::new(&law).unwrap()));
    let fluidity = GEL / 3.0 * (1.0 - (1.0 - time / GEL).powi(3));
    println!("filled with cure in {time:.2}, integral {fluidity:.3}, without {plain:.3}");
    assert!(time > 1.5 * plain && (fluidity / plain - 1.0).abs() < 5e-3);
}
