//! Viscous coupling of one face to its walls.

use std::num::NonZeroU32;

/// Viscous coupling of a face to its walls, per viscosity, for its low and its high half. Stored in single precision.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct WallCoupling<T = f64> {
    /// Wall friction coefficient A_w/(d_w + l).
    pub(crate) friction: [T; 2],
    /// Friction times tangential wall velocity: that of sliding walls, cells/s, and that per closing speed.
    pub(crate) sliding: [[T; 2]; 2],
    /// Friction times the square of the wall velocity per closing speed.
    pub(crate) resistance: [T; 2],
    /// Wall area of both halves, and its product with the open height next to the walls.
    pub(crate) area: T,
    pub(crate) height: T,
    /// Sum of 1/H^2 over the two tangential axes, H the channel width.
    pub(crate) inverse_width_squared: T,
    /// Number plus one among the couplings that depend on the height of the gap; `None` for others.
    pub(super) of_gap: Option<NonZeroU32>,
    /// Whether the face has walls.
    pub(super) walled: bool,
    /// Code of a body whose wall acts on the face; the last one found if there are several.
    pub(crate) body: u8,
}

impl WallCoupling {
    /// Adds the friction of a wall to a half. The wall slides at `own` (cells/s) and moves by `clamp` per closing speed.
    pub(super) fn add(&mut self, half: usize, friction: f64, [own, clamp]: [f64; 2]) {
        self.friction[half] += friction;
        self.sliding[half][0] += friction * own;
        self.sliding[half][1] += friction * clamp;
        self.resistance[half] += friction * clamp * clamp;
    }
}

impl<T: Copy> WallCoupling<T> {
    /// The coupling converted to another precision.
    pub(super) fn with<U>(self, of: impl Fn(T) -> U) -> WallCoupling<U> {
        WallCoupling {
            friction: self.friction.map(&of),
            sliding: self.sliding.map(|half| half.map(&of)),
            resistance: self.resistance.map(&of),
            area: of(self.area),
            height: of(self.height),
            inverse_width_squared: of(self.inverse_width_squared),
            of_gap: self.of_gap,
            walled: self.walled,
            body: self.body,
        }
    }
}
