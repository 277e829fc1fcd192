//! The flow that follows from the velocities of the face unknowns.

use super::{Flow, extend};
use crate::geometry::Lattice;

/// Velocities of all faces of a window, and the flow between them.
pub(crate) struct Field {
    /// Velocity of the low face of each cell along x, y, z, m/s: those solved for and, as
    /// [`extend`] has them, those in the air around; NaN elsewhere.
    pub(crate) value: [Vec<f32>; 3],
    /// The flow between them.
    pub(crate) flow: Flow,
}

impl Field {
    /// The field of the face velocities `u[active[axis][index]]`; the rest as for [`Flow::new`].
    pub(crate) fn new(
        lattice: &Lattice,
        active: &[Vec<u32>; 3],
        u: &[f64],
        bodies: &[[f64; 3]],
        influence: f64,
    ) -> Self {
        let value = extend(lattice, active, u);
        let flow = Flow::new(lattice, &value, active, bodies, influence);
        Self { value, flow }
    }
}
