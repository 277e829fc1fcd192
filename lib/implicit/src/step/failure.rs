//! Messages of failed steps, with the key of the case to change.

use physics::Failure;
use saddle_point::{Cause, SolveError};

use super::Implicit;

impl Implicit {
    pub(super) fn failure(&self, why: &str) -> Failure {
        Failure(format!(
            "step {} at {:.6e} s: {why}",
            self.state.steps + 1,
            self.state.time
        ))
    }

    /// The failure after the last attempt at a step was too long still; `dries` if because of the loss of water.
    pub(super) fn no_acceptable_length(&self, dries: bool) -> Failure {
        let why = match dries {
            true => {
                "the liquid dries too fast: a smaller uptake, a larger diffusivity or a flatter \
                     viscosity_by_solids is needed"
                    .to_owned()
            }
            false => format!(
                "the liquid's speed grows as the step gets shorter, {:.3e} m/s in the last attempt: a wall may push \
                 liquid that is enclosed on all sides",
                self.state.courant_speed * self.setup.units.cell_m
            ),
        };
        self.failure(&format!("no acceptable time step was found: {why}"))
    }

    /// The message for a linear system that was not solved.
    pub(super) fn unsolved(&self, error: &SolveError) -> String {
        match error {
            SolveError::NotFinite { .. } => format!(
                "{error}; a speed, gravity or pressure of the case or of the step before is far too large; if the case is \
                 correct, a smaller integrator.cfl may help"
            ),
            SolveError::Unsolved { error, cause } => {
                format!("{error}: {}", advice(*cause))
            }
            _ => error.to_string(),
        }
    }
}

/// What to change in a case.
fn advice(cause: Cause) -> String {
    match cause {
        Cause::Unbalanced { cells } => format!(
            "walls move into {cells} cells of enclosed liquid, which has no outlet and can only be compressed; a \
             max_pressure, an outlet, less travel, a lower bulk_modulus or an earlier end is needed"
        ),
        Cause::Stiff { ratio } => format!(
            "viscous stress is {ratio:.0e} times the stress that compresses the liquid in a step, eta/(K dt): a lower viscosity, a \
             higher bulk_modulus or a slower motion is needed"
        ),
        Cause::Inertial { ratio } => format!(
            "inertia, rho h^2/(eta dt), is {ratio:.0e} times the viscous stress in a cell: a higher viscosity, an earlier \
             end if nothing flows any more, or scheme = \"explicit\" is needed"
        ),
        Cause::Unknown => "a smaller integrator.cfl makes the linear systems easier, a larger \
                           integrator.tolerance relaxes them"
            .into(),
    }
}
