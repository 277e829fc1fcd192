//! Likely causes of a failed solve.

use crate::components::components;
use crate::system::SaddleSystem;
use crate::{NEARLY, SolveError};

/// The property of a system that likely made the iteration fail.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Cause {
    /// Unbalanced sources in a closed space, without a free surface, that only compression takes up.
    #[error("sources of {cells} connected cells without a free surface do not balance")]
    Unbalanced {
        /// Number of cells of the space.
        cells: usize,
    },
    /// Large viscosity times compressibility.
    #[error("viscosity times compressibility is {ratio:.0e}")]
    Stiff {
        /// eta/(K dt), the largest C times the largest coupling of two velocities.
        ratio: f64,
    },
    /// Large inertia over viscosity.
    #[error("inertia and friction are {ratio:.0e} times the viscosity")]
    Inertial {
        /// rho h^2/(eta dt), the largest D_B over the largest coupling of two velocities.
        ratio: f64,
    },
    /// None of these.
    #[error("for no cause that is known")]
    Unknown,
}

/// Inertia and friction over viscosity above which they are named as the cause. This and the next two bounds only choose
/// the words of a message.
const INERTIAL: f64 = 1e6;
/// Viscosity times compressibility above which it is named as the cause.
const STIFF: f64 = 1e8;
/// Pressure, in units of viscosity times speed over cell, up to which compression takes up the sources of a closed space
/// without harm.
const HARMLESS: f64 = 1e4;
/// Rounding of the sum of the sources of a closed space, relative.
const BALANCED: f64 = 1e-6;

/// Adds the likely cause to an error; an error with a usable solution stays as it is.
pub(crate) fn with_cause(error: SolveError, system: &SaddleSystem) -> SolveError {
    let near = |residual, tolerance| residual <= NEARLY * tolerance;
    match error {
        SolveError::NotConverged {
            residual,
            tolerance,
            ..
        } if near(residual, tolerance) => error,
        SolveError::NotConverged { .. } | SolveError::Overflow { .. } => SolveError::Unsolved {
            error: Box::new(error),
            cause: cause(system),
        },
        _ => error,
    }
}

fn cause(system: &SaddleSystem) -> Cause {
    let most = |list: &[f64]| list.iter().copied().fold(0.0, f64::max);
    let coupling = system.a.largest_coupling();
    let inertia = match coupling {
        0.0 => 0.0,
        coupling => most(system.friction) / coupling,
    };
    let stiffness = most(system.c) * coupling;
    if let Some(cells) = unbalanced(system) {
        Cause::Unbalanced { cells }
    } else if stiffness > STIFF {
        Cause::Stiff { ratio: stiffness }
    } else if inertia > INERTIAL {
        Cause::Inertial { ratio: inertia }
    } else {
        Cause::Unknown
    }
}

/// Number of cells of the first closed space (without a free surface) whose sources do not balance.
fn unbalanced(system: &SaddleSystem) -> Option<usize> {
    let faces = system.g.transpose();
    let sides = |cell: u32| {
        let of_cell = system.g.row(cell as usize).0.iter();
        of_cell.map(|&face| faces.row(face as usize).0)
    };
    let neighbours = |cell| sides(cell).flatten().copied();
    let unbalanced = |space: &Vec<u32>| {
        let of = |values: &[f64]| {
            space
                .iter()
                .map(|&c| values[c as usize])
                .collect::<Vec<f64>>()
        };
        let sources = of(system.volume_source);
        let moved: f64 = sources.iter().map(|s| s.abs()).sum();
        let left: f64 = sources.iter().sum::<f64>().abs();
        let softness: f64 = of(system.c).iter().sum();
        let open = || {
            space
                .iter()
                .any(|&cell| sides(cell).any(|sides| sides.len() < 2))
        };
        left > (BALANCED * moved).max(HARMLESS * softness) && !open()
    };
    let mut spaces = components(system.g.n_rows(), neighbours);
    spaces.find(unbalanced).map(|space| space.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Csr, VelocityBlock};

    /// Applies `said` to a closed system of two cells and the two faces between them, with given friction, compressibility
    /// and unbalanced source.
    fn of<T>([friction, c, left]: [f64; 3], said: impl Fn(&SaddleSystem) -> T) -> T {
        let a = VelocityBlock::assemble(2, |face, entries| {
            entries.add(face, 4.0);
            entries.add(1 - face, -1.0);
        });
        let a = a.unwrap();
        let pair = Csr::assemble(2, 2, |cell, entries| {
            (0..2).for_each(|face| entries.add(face, [1.0, -1.0][cell]));
        });
        said(&SaddleSystem {
            c: &[c; 2],
            friction: &[friction; 2],
            volume_source: &[0.5, -0.5 + left],
            ..SaddleSystem::still(&a, &pair.unwrap(), &[1.0; 2], &[0.0; 2])
        })
    }

    #[test]
    fn causes_are_named_from_their_limits_on() {
        for (below, above, word) in [
            ([0.9e6, 0.0, 0.0], [1.1e6, 0.0, 0.0], "Inertial"),
            ([0.0, 0.9e8, 0.0], [0.0, 1.1e8, 0.0], "Stiff"),
            ([0.0, 0.0, 0.9e-6], [0.0, 0.0, 1.1e-6], "Unbalanced"),
            ([0.0, 1e-6, 1.9e-2], [0.0, 1e-6, 2.1e-2], "Unbalanced"),
        ] {
            let named = |of_what| format!("{:?}", of(of_what, cause)).starts_with(word);
            assert!(!named(below) && named(above), "{word}");
        }
    }

    /// A residual up to ten times the tolerance is usable.
    #[test]
    fn a_solution_nearly_there_needs_no_cause() {
        let kept = |residual: f64| {
            let error = SolveError::NotConverged {
                iterations: 1,
                residual,
                tolerance: 1e-5,
            };
            of([0.0; 3], |system| {
                with_cause(error.clone(), system) == error
            })
        };
        assert!(kept(0.9e-4) && !kept(1.1e-4));
    }
}
