//! Which lane of a packed value holds which field. Unless said otherwise a vector comes first, in
//! lanes 0, 1 and 2.

/// Of a point: `place` is its offset from the nearest node and its volume, `motion` its velocity and
/// j, `stress` xx yy zz xy xz yz, rate and viscosity.
pub(crate) mod point {
    /// `place`: volume at J = 1, which is the mass (cells).
    pub(crate) const VOLUME: usize = 3;
    /// `motion`: j = J - 1.
    pub(crate) const J: usize = 3;
    /// `stress`: shear rate, 1/s.
    pub(crate) const SHEAR_RATE: usize = 6;
    /// `stress`: viscosity over density, m2/s.
    pub(crate) const VISCOSITY: usize = 7;
}

/// Of what points add up to at a node: `Tile::local`.
pub(crate) mod sum {
    /// Momentum.
    pub(crate) const MOMENTUM: usize = 0;
    /// Mass; also that of the filter's sums.
    pub(crate) const MASS: usize = 3;
    /// Impulse of the stress.
    pub(crate) const IMPULSE: usize = 4;
    /// Volume.
    pub(crate) const VOLUME: usize = 7;
}

/// Of what points near bodies add up to at a node: `Tile::wall_local`.
pub(crate) mod wall_sum {
    /// First moment of mass about the node.
    pub(crate) const MOMENT: usize = 0;
    /// Gradient of volume.
    pub(crate) const GRADIENT: usize = 4;
}

/// Of a node's velocities, v+ first: `Block::velocity`.
pub(crate) mod node {
    /// 1 where there is mass, else 0; also beside w of the filter.
    pub(crate) const ONE: usize = 3;
    /// The increment, or v* of a filter.
    pub(crate) const SECOND: usize = 4;
}

/// Of a body at a node: `NearBody::values`.
pub(crate) mod body {
    /// Volume of the body.
    pub(crate) const VOLUME: usize = 0;
    /// Its gradient.
    pub(crate) const GRADIENT: usize = 1;
    /// Its first moment about the node.
    pub(crate) const MOMENT: usize = 4;
}
