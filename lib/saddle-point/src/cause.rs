//! Why a saddle-point system was not solved.

use crate::csr::Csr;
use crate::system::SaddleSystem;
use crate::{NEARLY, SolveError};

/// What of a system is likely to blame where the iteration fails.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Cause {
    /// Sources of a closed space, no cell of it at a free surface, that compression alone takes up.
    #[error("sources of {cells} connected cells without a free surface do not balance")]
    Unbalanced {
        /// Its cells.
        cells: usize,
    },
    /// Viscosity against compressibility.
    #[error("viscosity times compressibility is {ratio:.0e}")]
    Stiff {
        /// eta/(K dt), the largest 2 eta C.
        ratio: f64,
    },
    /// Inertia against viscosity.
    #[error("inertia and friction are {ratio:.0e} times the viscosity")]
    Inertial {
        /// rho h^2/(eta dt), the largest D_B over the largest 2 eta.
        ratio: f64,
    },
    /// None of these.
    #[error("for no cause that is known")]
    Unknown,
}

/// Weight of inertia and friction over viscosity beyond which they are named as the cause; as the next two, words of a message
/// alone.
const FAST: f64 = 1e6;
/// Viscosity times compressibility beyond which it is named.
const STIFF: f64 = 1e8;
/// Pressure, in units of viscosity times speed over a cell, up to which compression takes up the sources of a
/// closed space without harm.
const TAKEN_UP: f64 = 1e4;
/// Part of the sources of a closed space that may be left over by rounding.
const BALANCED: f64 = 1e-6;

/// The error with its likely cause; one that a step can live with stays as it is.
pub(crate) fn explained(error: SolveError, system: &SaddleSystem) -> SolveError {
    match error {
        SolveError::NotConverged {
            residual,
            tolerance,
            ..
        } if residual <= NEARLY * tolerance => error,
        SolveError::NotConverged { .. } | SolveError::Overflow { .. } => SolveError::Unsolved {
            error: Box::new(error),
            cause: cause(system),
        },
        _ => error,
    }
}

fn cause(system: &SaddleSystem) -> Cause {
    let most = |list: &mut dyn Iterator<Item = f64>| list.fold(0.0, f64::max);
    let viscosity = most(&mut system.two_eta.iter().copied());
    let inertia = most(&mut system.friction.iter().copied()) / viscosity;
    let stiffness = most(&mut system.c.iter().zip(system.two_eta).map(|(c, eta)| c * eta));
    if let Some(cells) = unbalanced(system) {
        Cause::Unbalanced { cells }
    } else if stiffness > STIFF {
        Cause::Stiff { ratio: stiffness }
    } else if inertia > FAST {
        Cause::Inertial { ratio: inertia }
    } else {
        Cause::Unknown
    }
}

/// Cells of the first closed space (no cell of it at a free surface) whose sources do not balance.
fn unbalanced(system: &SaddleSystem) -> Option<usize> {
    let faces = system.g.transpose();
    let mut seen = vec![false; system.g.n_rows()];
    for cell in 0..seen.len() {
        if seen[cell] {
            continue;
        }
        let space = Space::around(cell, system.g, &faces, &mut seen);
        let of = |values: &[f64]| space.cells.iter().map(|&c| values[c]).collect::<Vec<f64>>();
        let sources = of(system.volume_source);
        let moved: f64 = sources.iter().map(|s| s.abs()).sum();
        let left: f64 = sources.iter().sum::<f64>().abs();
        let softness: f64 = of(system.c).iter().sum();
        if !space.open && left > (BALANCED * moved).max(TAKEN_UP * softness) {
            return Some(space.cells.len());
        }
    }
    None
}

/// Connected cells.
struct Space {
    cells: Vec<usize>,
    /// Whether one of them has a face to air.
    open: bool,
}

impl Space {
    fn around(start: usize, g: &Csr<f64>, faces: &Csr<f64>, seen: &mut [bool]) -> Self {
        seen[start] = true;
        let mut found = Self {
            cells: vec![start],
            open: false,
        };
        let mut next = 0;
        while let Some(&cell) = found.cells.get(next) {
            next += 1;
            for &face in g.row(cell).0 {
                let sides = faces.row(face as usize).0;
                found.open |= sides.len() < 2;
                for &side in sides {
                    if !std::mem::replace(&mut seen[side as usize], true) {
                        found.cells.push(side as usize);
                    }
                }
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::VelocityBlock;

    /// Two cells and the face between them, closed.
    fn pair() -> Csr<f64> {
        Csr::assemble(2, 1, |cell, entries| entries.add(0, [1.0, -1.0][cell])).unwrap()
    }

    /// What `said` makes of the pair with a friction, a compressibility and a source left over.
    fn of<T>([friction, c, left]: [f64; 3], said: impl Fn(&SaddleSystem) -> T) -> T {
        let one = VelocityBlock::assemble(1, |_, entries| entries.add(0, 1.0));
        said(&SaddleSystem {
            a: &one.unwrap(),
            g: &pair(),
            pockets: 0,
            standing: &[],
            clinging: &[],
            slow: 0.0,
            c: &[c; 2],
            friction: &[friction],
            two_eta: &[1.0; 2],
            b: &[0.0],
            volume_source: &[0.5, -0.5 + left],
            carried: &[0.0; 2],
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

    /// A residual up to ten times the tolerance is one that a step can live with.
    #[test]
    fn a_solution_nearly_there_needs_no_cause() {
        let kept = |residual: f64| {
            let error = SolveError::NotConverged {
                iterations: 1,
                residual,
                tolerance: 1e-5,
            };
            of([0.0; 3], |system| explained(error.clone(), system) == error)
        };
        assert!(kept(0.9e-4) && !kept(1.1e-4));
    }
}
