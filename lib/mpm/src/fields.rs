//! Which lane of a packed value holds which field. Unless said otherwise a vector comes first, in
//! lanes 0, 1 and 2.

/// Index of a lane, or of the first of a vector.
pub(crate) type Lane = usize;

/// Of a point: `place` is its offset from the nearest node and its volume, `motion` its velocity and
/// j, `stress` xx yy zz xy xz yz, rate and viscosity.
pub(crate) mod point {
    use super::Lane;
    /// `place`: volume at J = 1, which is the mass (cells).
    pub(crate) const VOLUME: Lane = 3;
    /// `motion`: j = J - 1.
    pub(crate) const J: Lane = 3;
    /// `stress`: shear rate, 1/s.
    pub(crate) const SHEAR_RATE: Lane = 6;
    /// `stress`: viscosity over density, m2/s.
    pub(crate) const VISCOSITY: Lane = 7;
}

/// Of what points add up to at a node: `Tile::local`.
pub(crate) mod sum {
    use super::Lane;
    /// Momentum.
    pub(crate) const MOMENTUM: Lane = 0;
    /// Mass; also that of the filter's sums.
    pub(crate) const MASS: Lane = 3;
    /// Impulse of the stress.
    pub(crate) const IMPULSE: Lane = 4;
    /// Volume.
    pub(crate) const VOLUME: Lane = 7;
}

/// Of what points near bodies add up to at a node: `Tile::wall_local`.
pub(crate) mod wall_sum {
    use super::Lane;
    /// First moment of mass about the node.
    pub(crate) const MOMENT: Lane = 0;
    /// Gradient of volume.
    pub(crate) const GRADIENT: Lane = 4;
}

/// Of a node's velocities, v+ first: `Block::velocity`.
pub(crate) mod node {
    use super::Lane;
    /// 1 where there is mass, else 0; also beside w of the filter.
    pub(crate) const ONE: Lane = 3;
    /// The increment, or v* of a filter.
    pub(crate) const SECOND: Lane = 4;
}

/// Of a body at a node: `NearBody::values`.
pub(crate) mod body {
    use super::Lane;
    /// Volume of the body.
    pub(crate) const VOLUME: Lane = 0;
    /// Its gradient.
    pub(crate) const GRADIENT: Lane = 1;
    /// Its first moment about the node.
    pub(crate) const MOMENT: Lane = 4;
}
