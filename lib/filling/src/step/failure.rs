//! What a failed solve says of the case, and what of it to change.

use physics::Failure;
use saddle_point::{Cause, SolveError};

use super::Implicit;
use super::length::Fit;

impl Implicit {
    pub(super) fn failure(&self, what: &str) -> Failure {
        Failure(format!("step {}: {what}", self.state.steps + 1))
    }

    /// Attempts at a step of which none was acceptable, the last for this reason.
    pub(super) fn no_step(&self, last: Fit) -> Failure {
        let why = match last {
            Fit::Misplaced => format!(
                "the speed at which the clamp holds its max_pressure is another in each attempt, \
                 {:.3e} m/s at last: a lower closing_speed or a higher max_pressure is needed",
                self.state.drive.speed
            ),
            Fit::Dried(_) => "the liquid dries too fast for any: a smaller uptake, a larger \
                              diffusivity or a flatter viscosity_by_solids is needed"
                .into(),
            Fit::Fast | Fit::Missed | Fit::Good => format!(
                "the liquid is the faster the shorter the step, {:.3e} m/s at last: a wall may push \
                 liquid that is enclosed on all sides",
                self.state.pace
            ),
        };
        self.failure(&format!("no acceptable time step was found: {why}"))
    }

    /// A system whose forces on the bodies differ from those on the liquid by this part of them.
    pub(super) fn unbalanced(&self, part: f64) -> Failure {
        self.failure(&format!(
            "forces on the bodies and on the liquid differ by {:.1} % at a hundredth of the linear solver's tolerance: where viscosities lie too far apart for it, \
             a law with a thinner liquid at low rates is needed",
            100.0 * part
        ))
    }

    /// A system of the step that was not solved.
    pub(super) fn unsolved(&self, error: SolveError) -> Failure {
        self.failure(&sentence(&error))
    }
}

fn sentence(error: &SolveError) -> String {
    match error {
        SolveError::NotFinite { .. } => format!(
            "{error}; speeds, gravity or pressures of the case or of the step before are beyond all \
             bounds, and a smaller integrator.cfl may help where the case is not to blame"
        ),
        SolveError::Unsolved { error, cause } => format!("{error}: {}", advice(*cause)),
        _ => error.to_string(),
    }
}

fn advice(cause: Cause) -> String {
    match cause {
        Cause::Unbalanced { cells } => format!(
            "walls move into {cells} cells of liquid that is enclosed and has no way out but to be \
             compressed; a max_pressure, a way out, less travel, a lower bulk_modulus or an earlier \
             end is needed"
        ),
        Cause::Stiff { ratio } => format!(
            "viscous stress is {ratio:.0e} times what compresses the liquid in a step, eta/(K dt): \
             a lower viscosity, a higher bulk_modulus or a slower motion is needed"
        ),
        Cause::Inertial { ratio } => format!(
            "inertia, rho h^2/(eta dt), or what holds menisci at rest is {ratio:.0e} times the viscous stress in a \
             cell: a higher viscosity, an earlier end where nothing flows any more or scheme = \"explicit\" is needed"
        ),
        Cause::Unknown => "a smaller integrator.cfl makes the steps and their systems easier, a \
                           larger integrator.tolerance asks for less"
            .into(),
    }
}
