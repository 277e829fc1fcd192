//! Steps of a scheme, and sums over its liquid.

use implicit::{Implicit, Settings};
use physics::{
    Array, Clamp, LiquidState, Motion, Press, PressStage, Saved, Scene, Scheme, StepLimit,
    StepReport, VoxelBlock,
};

use crate::plain;

/// Viscosity of the liquid, Pa s.
pub const ETA: f64 = 1.3;
/// Width of slits and tubes, m.
pub const H: f64 = 17.4e-6;

/// A scheme with default settings, but for what a test changes.
pub fn with(scene: &Scene, change: impl FnOnce(&mut Settings)) -> Implicit {
    let mut settings = Settings::default();
    change(&mut settings);
    Implicit::new(scene, settings).unwrap()
}

/// A scheme with another solver tolerance.
pub fn solved(scene: &Scene, tolerance: f64) -> Implicit {
    with(scene, |settings| settings.tolerance = tolerance)
}

/// A scheme with default settings.
pub fn plainly(scene: &Scene) -> Implicit {
    with(scene, |_| ())
}

/// A checkpoint with other numbers in an array.
pub fn forged(scheme: &Implicit, name: &str, change: impl Fn(&mut Vec<f64>)) -> Saved {
    let mut saved = scheme.save();
    match saved.0.iter_mut().find(|array| array.0 == name) {
        Some((_, Array::F64(values))) => change(values),
        _ => panic!("no array {name}"),
    }
    saved
}

/// A stage of a press programme that ends with its time.
pub fn stage(kind: Press, speed: f64, pressure: Option<f64>, time_s: f64) -> PressStage {
    PressStage {
        kind,
        speed,
        pressure,
        time_s,
        travel_m: None,
        contact: false,
        slower: None,
    }
}

/// One step, of `time_s` at most.
pub fn advance(scheme: &mut Implicit, time_s: f64) -> StepReport {
    let limit = StepLimit {
        time_s,
        travel_m: f64::INFINITY,
    };
    scheme.advance(limit).unwrap()
}

/// Steps until `end` (s); `seen` gets each report and its time.
pub fn until(scheme: &mut Implicit, end: f64, mut seen: impl FnMut(&StepReport, f64)) {
    let mut time = 0.0;
    while time < end * (1.0 - 1e-9) {
        let report = advance(scheme, end - time);
        time += report.dt_s;
        seen(&report, time);
    }
}

/// A box one cell deep, its corners in cells of edge `h` (m).
pub fn block(h: f64, low: [f64; 2], high: [f64; 2]) -> VoxelBlock {
    VoxelBlock::solid_box([low[0] * h, low[1] * h, 0.0], [high[0] * h, high[1] * h, h])
}

/// Two bodies, the upper one with its motion.
pub fn press(scene: &mut Scene, names: [&str; 2], blocks: [Vec<VoxelBlock>; 2], upper: Motion) {
    let motions = [Motion::Fixed, upper];
    scene.bodies = (names.into_iter().zip(blocks).zip(motions))
        .map(|((name, blocks), motion)| plain::body(name, blocks, motion))
        .collect();
    (scene.bottom, scene.top) = (Some(0), Some(1));
}

/// A clamp without a PID.
pub fn clamp(closing_speed: f64, max_pressure: f64) -> Option<Clamp> {
    Some(Clamp {
        closing_speed,
        max_pressure: Some(max_pressure),
        pid: None,
    })
}

/// Volume of the liquid at zero pressure.
pub fn at_rest(scene: &Scene, liquid: &LiquidState) -> f64 {
    (liquid.volume.iter().zip(&liquid.pressure))
        .map(|(&v, &p)| f64::from(v) / (1.0 + scene.liquid.tait.volume_change(f64::from(p))))
        .sum()
}
