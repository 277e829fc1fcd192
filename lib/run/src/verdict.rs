//! Whether a run's results can be relied on: what is looked at while it runs, and the judgement of
//! its last state. Exit status 0 is a claim that all of it holds.
//!
//! The bounds and the sound runs they were set by are in docs/verdicts.md.

use std::fs;
use std::path::Path;

use physics::{Diagnostics, Failure, LiquidState, Scene, StepReport};
use serde::{Deserialize, Serialize};

use crate::folder;
use crate::invariants::Invariants;
use crate::resolve::{OVERLAP, Setup};

/// Mean pressure over the bulk modulus to which Eq. 1 holds: 200 MPa at the paper's 1 GPa, where
/// the measurements end that such laws with a universal C are fitted to. The mean volume change
/// there is 10.5 %.
pub(crate) const MOST_PRESSURE: f64 = 0.2;
/// Depth in wood, in cells, that is no more than the resolution of walls.
const WALL_RESOLUTION: f64 = 0.5;
/// Depth in wood, in cells, that is rounding at a face.
const ROUNDING: f64 = 1e-3;
/// Part of the points that may lie in wood within the resolution of walls.
const MOST_IN_WOOD: f64 = 0.01;
/// Volume change that the pressures of the points may leave unexplained.
const MOST_UNEXPLAINED: f64 = 1e-3;

/// Whether the last state of a run is sound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Whether nothing speaks against it.
    pub sound: bool,
    /// What does, a clause each.
    pub reasons: Vec<String>,
}

impl Verdict {
    fn because(reasons: Vec<String>) -> Self {
        Self {
            sound: reasons.is_empty(),
            reasons,
        }
    }

    /// This one, and what the scheme says against its results.
    pub(crate) fn and(mut self, objection: Option<String>) -> Self {
        self.reasons.extend(objection);
        Self::because(self.reasons)
    }

    /// That of the run that ended in `folder`; `None` where its summary does not say.
    pub fn of_ended(folder: &Path) -> Option<Self> {
        let text = fs::read_to_string(folder.join(folder::SUMMARY)).ok()?;
        let summary: serde_json::Value = serde_json::from_str(&text).ok()?;
        serde_json::from_value(summary.get("verdict")?.clone()).ok()
    }

    /// What is wrong, as a sentence; nothing of a sound state.
    pub fn objection(&self) -> Option<String> {
        (!self.sound).then(|| {
            format!(
                "the results are not sound (kept, and marked so in summary.json): {}",
                self.reasons.join("; ")
            )
        })
    }
}

/// Looks at what a step reported.
///
/// # Errors
/// A number that is none, or a clamp that has gone into another body.
pub(crate) fn step(setup: &Setup, report: &StepReport) -> Result<(), Failure> {
    let numbers = [
        ("time step", report.dt_s),
        ("closing speed", report.closing_speed),
        ("clamp's travel", report.travel_m),
        ("pressure on the lower body", report.pressure_bottom),
        ("pressure on the upper body", report.pressure_top),
    ];
    finite(&numbers)?;
    match &setup.clamp_room {
        Some((room_m, other)) if report.travel_m > room_m + OVERLAP * setup.scene.grid.cell_m => {
            Err(Failure(format!(
                "the clamp's body has met '{other}' after {:.4} um and would overlap it; an earlier stop, stop = \"closed\" or a lower max_pressure is needed",
                1e6 * room_m
            )))
        }
        _ => Ok(()),
    }
}

/// Looks at the diagnostics of a state that is to be written: row, snapshot or checkpoint.
///
/// # Errors
/// A number that is none, liquid faster than its sound, or more pressure than Eq. 1 holds for.
pub(crate) fn state(setup: &Setup, diagnostics: &Diagnostics, lost: u64) -> Result<(), Failure> {
    finite(&[
        ("kinetic energy", diagnostics.kinetic_energy),
        ("viscous power", diagnostics.viscous_power),
        ("volume of the liquid", diagnostics.volume),
        ("largest speed", diagnostics.max_speed),
    ])?;
    if let Some(said) = faster_than_sound(&setup.scene, diagnostics.max_speed) {
        return Err(Failure(format!(
            "{said}; another integrator.cfl, a lower speed or a higher viscosity may help"
        )));
    }
    // Points differ in volume by the rounding of their lattices alone.
    let part = 1.0 - lost as f64 / setup.liquid.points as f64;
    let change = diagnostics.volume / (part * setup.liquid.volume_m3) - 1.0;
    let scene = &setup.scene;
    let most = compressed(scene);
    let pressure = scene.liquid.tait.pressure(change);
    let range = format!(
        "beyond {:.3e} Pa ({MOST_PRESSURE} of the bulk modulus), to which the pressure law holds",
        MOST_PRESSURE * scene.liquid.tait.bulk_modulus
    );
    if change < most {
        return Err(Failure(format!(
            "the liquid is compressed by {:.1} % on average, {pressure:.3e} Pa and {range}: a body presses liquid that cannot get away; {}, a way out or less travel is needed",
            -100.0 * change,
            if scene
                .clamp
                .is_some_and(|clamp| clamp.max_pressure.is_some())
            {
                "a lower max_pressure"
            } else {
                "a max_pressure"
            }
        )));
    }
    // Cavities that open at a tension given are meant.
    if change > -most && scene.liquid.cavitation_pressure.is_none() {
        return Err(Failure(format!(
            "the liquid is {:.1} % larger than at rest on average, a tension {range}: it is torn apart; a cavitation_pressure limits the tension it carries",
            100.0 * change
        )));
    }
    Ok(())
}

/// What is wrong with liquid of this largest speed (m/s), if it is too fast for any scheme here.
fn faster_than_sound(scene: &Scene, speed: f64) -> Option<String> {
    let sound = scene.liquid.sound_speed();
    (speed > sound).then(|| {
        format!(
            "liquid moves at {speed:.3e} m/s, above its speed of sound sqrt(K/rho) = {sound:.3e} m/s, which no pressing gives it"
        )
    })
}

/// Mean relative volume change at [`MOST_PRESSURE`].
fn compressed(scene: &Scene) -> f64 {
    let tait = scene.liquid.tait;
    tait.volume_change(MOST_PRESSURE * tait.bulk_modulus)
}

fn finite(numbers: &[(&str, f64)]) -> Result<(), Failure> {
    match numbers.iter().find(|(_, number)| !number.is_finite()) {
        None => Ok(()),
        Some((name, number)) => Err(Failure(format!(
            "the {name} is {}: the state is no longer one of liquid; another integrator.cfl may help, and --explain shows which numbers of the case are extreme",
            if number.is_nan() {
                "not a number"
            } else {
                "infinite"
            }
        ))),
    }
}

/// Judges the last state of a run in which `lost` points left the domain.
pub(crate) fn judge(setup: &Setup, liquid: &LiquidState, found: &Invariants, lost: u64) -> Verdict {
    let mut reasons = Vec::new();
    if let Some(name) = not_finite(liquid) {
        reasons.push(format!("a {name} of the liquid is not a finite number"));
    }
    reasons.extend(faster_than_sound(&setup.scene, largest_speed(liquid)));
    let (left, begun) = (liquid.position.len() as u64, setup.liquid.points);
    if left + lost != begun {
        reasons.push(format!(
            "of {begun} material points {left} are left and {lost} went out of the domain"
        ));
    }
    if left == 0 {
        reasons.push("no liquid is left in the domain".into());
    }
    let cell = setup.scene.grid.cell_m;
    if found.deepest_m > (WALL_RESOLUTION + ROUNDING) * cell {
        reasons.push(format!(
            "{} of {left} material points lie in rigid bodies, the deepest {:.2} cells; half a cell is what walls are resolved to, so bodies have moved over liquid that could not get away",
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
    let cavities = setup.scene.liquid.cavitation_pressure.is_some();
    let unexplained = unexplained(&setup.scene, liquid, setup.liquid.volume_m3);
    let off = if cavities {
        -unexplained
    } else {
        unexplained.abs()
    };
    if lost == 0 && off > MOST_UNEXPLAINED {
        reasons.push(format!(
            "the liquid's volume is {:+.2} % off what its pressures explain",
            100.0 * unexplained
        ));
    }
    Verdict::because(reasons)
}

/// Largest speed of a point, m/s.
fn largest_speed(liquid: &LiquidState) -> f64 {
    let square = |v: &[f32; 3]| v.iter().map(|&x| f64::from(x).powi(2)).sum::<f64>();
    (liquid.velocity.iter().map(square))
        .fold(0.0, f64::max)
        .sqrt()
}

/// First kind of number of the state that is not finite somewhere.
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

/// Volume that the points would have without their pressures over `initial` (m3), minus one.
fn unexplained(scene: &Scene, liquid: &LiquidState, initial: f64) -> f64 {
    let at_rest = |(&volume, &pressure): (&f32, &f32)| {
        f64::from(volume) / (1.0 + scene.liquid.tait.volume_change(f64::from(pressure)))
    };
    liquid
        .volume
        .iter()
        .zip(&liquid.pressure)
        .map(at_rest)
        .sum::<f64>()
        / initial
        - 1.0
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::case::Case;
    use crate::resolve::resolve;

    /// A box of 4 x 2 cells of 1 um full of liquid on a floor of one cell.
    pub(crate) fn setup() -> Setup {
        let text = r#"
[grid]
cell = "1 um"
dimensions = 2
[adhesive]
density = "1000 kg/m3"
bulk_modulus = "1 GPa"
viscosity = "1 Pa s"
[contact]
law = "stick"
[stop]
time = "1 us"
[integrator]
scheme = "implicit"
[[body]]
material = "rigid"
box = { min = ["0 um", "0 um", "0 um"], max = ["4 um", "2 um", "1 um"] }
[[body]]
material = "adhesive"
box = { min = ["0 um", "2 um", "0 um"], max = ["4 um", "4 um", "1 um"] }
"#;
        let case = Case::parse(text, Path::new("case.toml")).unwrap();
        resolve(&case, None).unwrap()
    }

    fn at_rest(setup: &Setup) -> LiquidState {
        let points = setup.scene_for_scheme().points;
        let n = points.position.len();
        LiquidState {
            position: (points.position.iter())
                .map(|x| x.map(|x| x as f32))
                .collect(),
            velocity: vec![[0.0; 3]; n],
            volume: points.volume.iter().map(|&v| v as f32).collect(),
            pressure: vec![0.0; n],
            shear_rate: vec![0.0; n],
        }
    }

    fn judged(setup: &Setup, liquid: &LiquidState, lost: u64) -> Vec<String> {
        let shifts = vec![[0.0; 3]; setup.scene.bodies.len()];
        let volume = setup.liquid.volume_m3;
        let found = crate::invariants::check(&setup.scene, volume, liquid, &shifts);
        judge(setup, liquid, &found, lost).reasons
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
        let deep = said(&|l| l.position[3][1] = 1.4e-6, 0);
        assert!(deep.contains("the deepest 0.60 cells"), "{deep}");
        let shallow = said(&|l| l.position[3][1] = 1.6e-6, 0);
        assert!(shallow.contains("more than 1 %"), "{shallow}");
        let rounding = said(&|l| l.position[3][1] = 1.9999e-6, 0);
        assert_eq!(rounding, "");
        let nan = said(&|l| l.shear_rate[0] = f32::NAN, 0);
        assert!(nan.contains("a shear rate of the liquid"), "{nan}");
        let infinite = said(&|l| l.velocity[0][2] = f32::INFINITY, 0);
        assert!(infinite.contains("a velocity of the liquid"), "{infinite}");
        let fast = said(&|l| l.velocity[0][1] = 1001.0, 0);
        assert!(fast.contains("above its speed of sound"), "{fast}");
        let grown = said(&|l| l.volume.iter_mut().for_each(|v| *v *= 1.01), 0);
        assert!(grown.contains("+1.00 % off"), "{grown}");
        let missing = said(
            &|l| {
                l.position.pop();
                l.velocity.pop();
            },
            0,
        );
        assert!(missing.contains("31 are left and 0 went out"), "{missing}");
        let gone = said(&|l| *l = LiquidState::default(), 32);
        assert_eq!(gone, "no liquid is left in the domain");
    }

    #[test]
    fn an_objection_of_the_scheme_counts() {
        let none = || Verdict::because(Vec::new());
        assert!(none().and(None).sound);
        let said = none().and(Some("it did not settle".into())).objection();
        assert!(said.unwrap().ends_with(": it did not settle"));
    }

    #[test]
    fn only_a_state_with_reasons_against_it_is_objected_to() {
        assert_eq!(Verdict::because(Vec::new()).objection(), None);
        let reasons = ["no liquid is left", "a volume is off"].map(str::to_owned);
        let said = Verdict::because(reasons.into()).objection().unwrap();
        assert!(said.starts_with("the results are not sound"), "{said}");
        assert!(
            said.ends_with(": no liquid is left; a volume is off"),
            "{said}"
        );
    }

    #[test]
    fn rows_hold_finite_numbers_and_volumes_within_the_pressure_law() {
        let setup = setup();
        let of = |factor: f64, energy: f64| Diagnostics {
            volume: factor * setup.liquid.volume_m3,
            kinetic_energy: energy,
            ..Diagnostics::default()
        };
        let said = |factor, energy, lost| {
            state(&setup, &of(factor, energy), lost).map_err(|failure| failure.0)
        };
        assert_eq!(said(1.0, 1.0, 0), Ok(()));
        assert_eq!(said(0.9, 1.0, 0), Ok(()));
        // Half of the points went out.
        assert_eq!(said(0.5, 1.0, 16), Ok(()));
        let small = said(0.89, 1.0, 0).unwrap_err();
        assert!(small.contains("compressed by 11.0 %"), "{small}");
        let large = said(1.2, 1.0, 0).unwrap_err();
        assert!(large.contains("20.0 % larger than at rest"), "{large}");
        let fast = Diagnostics {
            max_speed: 1001.0,
            ..of(1.0, 1.0)
        };
        let fast = state(&setup, &fast, 0).unwrap_err().0;
        assert!(fast.contains("above its speed of sound"), "{fast}");
        let nan = said(1.0, f64::NAN, 0).unwrap_err();
        assert!(nan.contains("kinetic energy is not a number"), "{nan}");
    }

    #[test]
    fn a_step_reports_finite_numbers_and_no_body_in_another() {
        let mut setup = setup();
        setup.clamp_room = Some((1e-6, "bottom".into()));
        let report = StepReport {
            travel_m: 1e-6,
            ..StepReport::default()
        };
        assert_eq!(step(&setup, &report), Ok(()));
        let beyond = StepReport {
            travel_m: 1.1e-6,
            ..report
        };
        let said = step(&setup, &beyond).unwrap_err().0;
        assert!(said.contains("has met 'bottom' after 1.0000 um"), "{said}");
        let infinite = StepReport {
            pressure_top: f64::NEG_INFINITY,
            ..report
        };
        let said = step(&setup, &infinite).unwrap_err().0;
        assert!(
            said.contains("pressure on the upper body is infinite"),
            "{said}"
        );
    }
}
