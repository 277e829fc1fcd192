//! The verdict on a run's last state.

use physics::{LiquidState, Scene, WaterState, norm};

use super::{Verdict, faster_than_sound};
use crate::invariants::Invariants;
use crate::resolve::Setup;

/// Resolution of walls, cells: points may lie this deep in wood.
const WALL_RESOLUTION: f64 = 0.5;
/// Rounding at a face, cells.
const ROUNDING: f64 = 1e-3;
/// Largest fraction of points in wood, within the resolution of walls.
const MOST_IN_WOOD: f64 = 0.01;
/// Largest relative volume change that the pressures of the points do not explain.
const MOST_UNEXPLAINED: f64 = 1e-3;
/// Largest fraction of the liquid's volume in excess in overfull blocks.
const MOST_CROWDED: f64 = 0.01;
/// Largest fraction of the water that the water balance misses.
const MOST_WATER_MISSING: f64 = 1e-9;

/// Judges the last state of a run in which `lost` points left the domain. The number of points is checked only if the scheme
/// `follows` them.
pub(crate) fn judge(
    setup: &Setup,
    liquid: &LiquidState,
    found: &Invariants,
    water: Option<WaterState>,
    lost: u64,
    follows: bool,
) -> Verdict {
    let mut reasons = Vec::new();
    if let Some(name) = not_finite(liquid) {
        reasons.push(format!("a {name} of the liquid is not a finite number"));
    }
    let speeds = liquid.velocity.iter().map(|v| norm(v.map(f64::from)));
    reasons.extend(faster_than_sound(&setup.scene, speeds.fold(0.0, f64::max)));
    let (left, begun) = (liquid.position.len() as u64, setup.liquid.points);
    if follows && left + lost != begun {
        reasons.push(format!(
            "of {begun} material points, {left} remain and {lost} left the domain"
        ));
    }
    if left == 0 {
        reasons.push("no liquid is left in the domain".into());
    }
    let cell = setup.scene.grid.cell_m;
    if found.deepest_m > (WALL_RESOLUTION + ROUNDING) * cell {
        reasons.push(format!(
            "{} of {left} material points lie in rigid bodies, the deepest {:.2} cells; walls are resolved to half a cell, so bodies have moved over liquid that could not escape",
            found.points_in_wood,
            found.deepest_m / cell
        ));
    } else if found.points_in_wood as f64 > MOST_IN_WOOD * begun as f64
        && found.deepest_m > ROUNDING * cell
    {
        reasons.push(format!(
            "{} of {left} material points lie in rigid bodies, more than {} %",
            found.points_in_wood,
            100.0 * MOST_IN_WOOD
        ));
    }
    if found.crowded > MOST_CROWDED {
        reasons.push(format!(
            "{:.1} % of the liquid has no room: it fills blocks with edges of two cells more than one and a half times",
            100.0 * found.crowded
        ));
    }
    let cavities = setup.scene.liquid.cavitation_pressure.is_some();
    let given_off = water.map_or(0.0, |water| water.given_off_m3);
    let unexplained = unexplained(&setup.scene, liquid, setup.liquid.volume_m3 - given_off);
    if let Some(missing) = water
        .map(|water| water.missing)
        .filter(|m| m.is_nan() || m.abs() > MOST_WATER_MISSING)
    {
        reasons.push(format!(
            "{missing:.1e} of the water is neither in the liquid nor in the walls"
        ));
    }
    let off = match cavities {
        true => -unexplained,
        false => unexplained.abs(),
    };
    if lost == 0 && off > MOST_UNEXPLAINED {
        reasons.push(format!(
            "the volume of the liquid differs by {:+.2} % from that expected from its pressures",
            100.0 * unexplained
        ));
    }
    Verdict::because(reasons)
}

/// The first quantity with a value that is not finite.
fn not_finite(liquid: &LiquidState) -> Option<&'static str> {
    let bad = |list: &[f32]| list.iter().any(|x| !x.is_finite());
    let bad_vector = |list: &[[f32; 3]]| bad(list.as_flattened());
    [
        ("position", bad_vector(&liquid.position)),
        ("velocity", bad_vector(&liquid.velocity)),
        ("volume", bad(&liquid.volume)),
        ("pressure", bad(&liquid.pressure)),
        ("shear rate", bad(&liquid.shear_rate)),
    ]
    .iter()
    .find(|(_, bad)| *bad)
    .map(|(name, _)| *name)
}

/// Volume of the points at zero pressure over its nominal value `initial` (m3), minus one.
fn unexplained(scene: &Scene, liquid: &LiquidState, initial: f64) -> f64 {
    let at_rest = |(&volume, &pressure): (&f32, &f32)| {
        f64::from(volume) / (1.0 + scene.liquid.tait.volume_change(f64::from(pressure)))
    };
    let volumes = liquid.volume.iter().zip(&liquid.pressure).map(at_rest);
    volumes.sum::<f64>() / initial - 1.0
}

#[cfg(test)]
mod tests {
    use physics::Points;

    use super::*;
    use crate::verdict::tests::setup;

    fn at_rest(setup: &Setup) -> LiquidState {
        let points: Points = setup.points().collect();
        let n = points.position.len();
        LiquidState {
            position: (points.position.iter())
                .map(|x| x.map(|x| x as f32))
                .collect(),
            velocity: vec![[0.0; 3]; n],
            volume: points.volume.iter().map(|&v| v as f32).collect(),
            pressure: vec![0.0; n],
            shear_rate: vec![0.0; n],
            solids: Vec::new(),
        }
    }

    fn judged(setup: &Setup, liquid: &LiquidState, lost: u64) -> Vec<String> {
        let shifts = vec![[0.0; 3]; setup.scene.bodies.len()];
        let volume = setup.liquid.volume_m3;
        let found = crate::invariants::check(&setup.scene, volume, liquid, &shifts);
        judge(setup, liquid, &found, None, lost, true).reasons
    }

    #[test]
    fn a_state_is_judged_by_what_is_wrong_with_it() {
        let setup = setup();
        let sound = at_rest(&setup);
        assert_eq!(judged(&setup, &sound, 0), Vec::<String>::new());
        let said = |change: &dyn Fn(&mut LiquidState), lost| {
            let mut liquid = sound.clone();
            change(&mut liquid);
            judged(&setup, &liquid, lost).join("; ")
        };
        type Change = fn(&mut LiquidState);
        let cases: [(Change, &str); 8] = [
            (|l| l.position[3][1] = 1.4e-6, "the deepest 0.60 cells"),
            (|l| l.position[3][1] = 1.6e-6, "more than 1 %"),
            (|l| l.shear_rate[0] = f32::NAN, "a shear rate of the liquid"),
            (
                |l| l.velocity[0][2] = f32::INFINITY,
                "a velocity of the liquid",
            ),
            (|l| l.velocity[0][1] = 1001.0, "above its speed of sound"),
            (
                |l| l.volume.iter_mut().for_each(|v| *v *= 1.01),
                "differs by +1.00 %",
            ),
            (|l| l.position = vec![l.position[0]; 32], "has no room"),
            (|l| l.position.truncate(31), "31 remain and 0 left"),
        ];
        for (change, wanted) in cases {
            let found = said(&change, 0);
            assert!(found.contains(wanted), "{found}");
        }
        // Rounding at a face.
        assert_eq!(said(&|l| l.position[3][1] = 1.9999e-6, 0), "");
        let gone = said(&|l| *l = LiquidState::default(), 32);
        assert_eq!(gone, "no liquid is left in the domain");
    }
}
