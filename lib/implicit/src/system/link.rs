//! The hold of walls on one face beside them.

/// Friction that holds a face to the walls beside it, per viscosity: in its low and its high half.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Link {
    /// Area of walls over the distance to them, of the halves in the low and the high pore.
    pub(crate) friction: [f64; 2],
    /// The same times the velocity of the walls along the face: what moves by itself, cells/s, and what moves with the
    /// closing speed, per unit of that.
    pub(crate) sliding: [[f64; 2]; 2],
    /// The same times the square of the latter.
    pub(crate) resistance: [f64; 2],
    /// Area of walls, of both halves, and that times the open height beside them.
    pub(crate) area: f64,
    pub(crate) height: f64,
    /// Whether the height of the gap is part of it.
    pub(crate) by_gap: bool,
    /// Whether there are walls beside it.
    pub(super) walled: bool,
    /// Code of the body that most recently was found beside it.
    pub(crate) body: u8,
    /// Sum of 1/H^2 over the axes across the face.
    pub(crate) narrowness: f64,
}

impl Link {
    /// Adds friction in a half, with a wall that moves so: by itself, and per closing speed.
    pub(super) fn add(&mut self, half: usize, friction: f64, [own, clamp]: [f64; 2]) {
        self.friction[half] += friction;
        self.sliding[half][0] += friction * own;
        self.sliding[half][1] += friction * clamp;
        self.resistance[half] += friction * clamp * clamp;
    }
}

/// A link as it is kept, in single precision.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Single {
    friction: [f32; 2],
    sliding: [[f32; 2]; 2],
    resistance: [f32; 2],
    area: f32,
    height: f32,
    narrowness: f32,
    pub(super) by_gap: bool,
    pub(super) walled: bool,
    body: u8,
}

impl From<Link> for Single {
    fn from(link: Link) -> Self {
        let single = |pair: [f64; 2]| pair.map(|value| value as f32);
        Self {
            friction: single(link.friction),
            sliding: link.sliding.map(single),
            resistance: single(link.resistance),
            area: link.area as f32,
            height: link.height as f32,
            narrowness: link.narrowness as f32,
            by_gap: link.by_gap,
            walled: link.walled,
            body: link.body,
        }
    }
}

impl From<Single> for Link {
    fn from(link: Single) -> Self {
        let double = |pair: [f32; 2]| pair.map(f64::from);
        Self {
            friction: double(link.friction),
            sliding: link.sliding.map(double),
            resistance: double(link.resistance),
            area: f64::from(link.area),
            height: f64::from(link.height),
            narrowness: f64::from(link.narrowness),
            by_gap: link.by_gap,
            walled: link.walled,
            body: link.body,
        }
    }
}
