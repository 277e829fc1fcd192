//! The hold of walls on one face beside them.

/// Friction that holds a face to the walls beside it, per viscosity: in its low and its high half. FaceMap in single precision.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct WallCoupling<T = f64> {
    /// Area of walls over the distance to them, of the halves in the low and the high pore.
    pub(crate) friction: [T; 2],
    /// The same times the velocity of the walls along the face: what moves by itself, cells/s, and what moves with the
    /// closing speed, per unit of that.
    pub(crate) sliding: [[T; 2]; 2],
    /// The same times the square of the latter.
    pub(crate) resistance: [T; 2],
    /// Area of walls, of both halves, and that times the open height beside them.
    pub(crate) area: T,
    pub(crate) height: T,
    /// Sum of 1/H^2 over the axes across the face.
    pub(crate) inverse_width_squared: T,
    /// Whether the height of the gap is part of it.
    pub(crate) depends_on_gap: bool,
    /// Whether there are walls beside it.
    pub(super) walled: bool,
    /// Code of the body that most recently was found beside it.
    pub(crate) body: u8,
}

impl WallCoupling {
    /// Adds friction in a half, with a wall that moves so: by itself, and per closing speed.
    pub(super) fn add(&mut self, half: usize, friction: f64, [own, clamp]: [f64; 2]) {
        self.friction[half] += friction;
        self.sliding[half][0] += friction * own;
        self.sliding[half][1] += friction * clamp;
        self.resistance[half] += friction * clamp * clamp;
    }
}

impl<T: Copy> WallCoupling<T> {
    /// The same in another precision.
    pub(super) fn with<U>(self, of: impl Fn(T) -> U) -> WallCoupling<U> {
        WallCoupling {
            friction: self.friction.map(&of),
            sliding: self.sliding.map(|half| half.map(&of)),
            resistance: self.resistance.map(&of),
            area: of(self.area),
            height: of(self.height),
            inverse_width_squared: of(self.inverse_width_squared),
            depends_on_gap: self.depends_on_gap,
            walled: self.walled,
            body: self.body,
        }
    }
}
