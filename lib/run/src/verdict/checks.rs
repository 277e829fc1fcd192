//! Checks during a run: of each step's report, and of the diagnostics of states before they are written.

use physics::{Diagnostics, Failure, Scene, StepReport};

use super::faster_than_sound;
use crate::resolve::{OVERLAP_CELLS, Setup};

/// Largest mean pressure over bulk modulus for which Eq. 1 holds: 200 MPa at the paper's 1 GPa, the end of the measurements
/// to which such laws with a universal C are fitted. The volume change there is 10.5 %.
pub(crate) const MOST_PRESSURE: f64 = 0.2;

/// Checks the report of a step.
/// Errors: a number that is not finite, or a clamp that overlaps another body.
pub(crate) fn check_step(setup: &Setup, report: &StepReport) -> Result<(), Failure> {
    let numbers = [
        ("time step", report.dt_s),
        ("closing speed", report.closing_speed),
        ("clamp's travel", report.travel_m),
        ("pressure on the lower body", report.pressure_bottom),
        ("pressure on the upper body", report.pressure_top),
    ];
    finite(&numbers)?;
    match &setup.clamp_clearance {
        Some((clearance_m, other))
            if report.travel_m > clearance_m + OVERLAP_CELLS * setup.scene.grid.cell_m =>
        {
            Err(Failure(format!(
                "the clamp's body has met {other} after {:.4} um and would overlap it; an earlier stop, stop = \"closed\" or a lower max_pressure is needed",
                1e6 * clearance_m
            )))
        }
        _ => Ok(()),
    }
}

/// Checks the diagnostics of a state before a row, snapshot or checkpoint.
/// Errors: a number that is not finite, liquid faster than sound, or a pressure beyond the range of Eq. 1.
pub(crate) fn check_state(
    setup: &Setup,
    diagnostics: &Diagnostics,
    lost: u64,
) -> Result<(), Failure> {
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
    // All points have the same volume up to rounding.
    let part = 1.0 - lost as f64 / setup.liquid.points as f64;
    let given_off = diagnostics.water.map_or(0.0, |water| water.given_off_m3);
    let change = diagnostics.volume / (part * setup.liquid.volume_m3 - given_off) - 1.0;
    let scene = &setup.scene;
    let most = compressed(scene);
    let pressure = scene.liquid.tait.pressure(change);
    let range = format!(
        "above {:.3e} Pa ({MOST_PRESSURE} of the bulk modulus), the limit of the pressure law",
        MOST_PRESSURE * scene.liquid.tait.bulk_modulus
    );
    if change < most {
        return Err(Failure(format!(
            "the liquid is compressed by {:.1} % on average; its pressure, {pressure:.3e} Pa, is {range}: a body presses liquid that cannot escape; {}, an outlet or less travel is needed",
            -100.0 * change,
            match scene.clamp.and_then(|clamp| clamp.max_pressure) {
                Some(_) => "a lower max_pressure",
                None => "a max_pressure",
            }
        )));
    }
    // With a cavitation pressure, cavities are intended.
    if change > -most && scene.liquid.cavitation_pressure.is_none() {
        return Err(Failure(format!(
            "the liquid is {:.1} % larger than at rest on average, and its tension is {range}: it is torn apart; a cavitation_pressure would limit its tension",
            100.0 * change
        )));
    }
    Ok(())
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
            "the {name} is {}, which is unphysical; another integrator.cfl may help, and --explain shows which values of the case are extreme",
            if number.is_nan() {
                "not a number"
            } else {
                "infinite"
            }
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::tests::setup;

    #[test]
    fn rows_hold_finite_numbers_and_volumes_within_the_pressure_law() {
        let setup = setup();
        let of = |factor: f64, energy: f64| Diagnostics {
            volume: factor * setup.liquid.volume_m3,
            kinetic_energy: energy,
            ..Diagnostics::default()
        };
        let said = |factor, energy, lost| {
            check_state(&setup, &of(factor, energy), lost).map_err(|failure| failure.0)
        };
        // In the last case half of the points left.
        for (factor, lost) in [(1.0, 0), (0.9, 0), (0.5, 16)] {
            assert_eq!(said(factor, 1.0, lost), Ok(()));
        }
        for (factor, energy, wanted) in [
            (0.89, 1.0, "compressed by 11.0 %"),
            (1.2, 1.0, "20.0 % larger than at rest"),
            (1.0, f64::NAN, "kinetic energy is not a number"),
        ] {
            let found = said(factor, energy, 0).unwrap_err();
            assert!(found.contains(wanted), "{found}");
        }
        let fast = Diagnostics {
            max_speed: 1001.0,
            ..of(1.0, 1.0)
        };
        let fast = check_state(&setup, &fast, 0).unwrap_err().0;
        assert!(fast.contains("above its speed of sound"), "{fast}");
    }

    #[test]
    fn a_step_reports_finite_numbers_and_no_body_in_another() {
        let mut setup = setup();
        setup.clamp_clearance = Some((1e-6, "'bottom'".into()));
        let report = StepReport {
            travel_m: 1e-6,
            ..StepReport::default()
        };
        assert_eq!(check_step(&setup, &report), Ok(()));
        let beyond = StepReport {
            travel_m: 1.1e-6,
            ..report
        };
        let said = check_step(&setup, &beyond).unwrap_err().0;
        assert!(said.contains("has met 'bottom' after 1.0000 um"), "{said}");
        let infinite = StepReport {
            pressure_top: f64::NEG_INFINITY,
            ..report
        };
        let said = check_step(&setup, &infinite).unwrap_err().0;
        assert!(said.contains("on the upper body is infinite"), "{said}");
    }
}
