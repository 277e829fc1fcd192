//! What full cells lack behind a front, where liquid rolls over the walls.
//!
//! Cells there count as full before particles have filled them, because the wedge of air between the tip of a front and its
//! contact lines is thinner than cells can tell.

/// Density of a full cell from which it lacks nothing: the rest is the density projection's, and noise of the particles.
const ENOUGH: f32 = 0.8;
/// Density up to which liquid does not touch the walls of a full cell: that of one that is half wedge, half liquid.
const APART: f32 = 0.5;

/// Part of its open volume that a cell of a liquid fraction and a density lacks.
pub(crate) fn lack(fraction: f32, density: f32) -> f32 {
    match fraction < 1.0 {
        true => 0.0,
        false => (ENOUGH - density).max(0.0),
    }
}

/// Part of the walls wet by a cell's liquid fraction that its liquid touches.
pub(crate) fn touching(fraction: f32, density: f32) -> f32 {
    1.0 - (lack(fraction, density) / (ENOUGH - APART)).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn full_cells_alone_lack_liquid() {
        let both = |fraction, density| (lack(fraction, density), touching(fraction, density));
        assert_eq!(both(0.99, 0.1), (0.0, 1.0));
        assert_eq!(both(1.0, 0.81), (0.0, 1.0));
        let (lack, touching) = both(1.0, 0.65);
        assert!((lack - 0.15).abs() < 1e-6 && (touching - 0.5).abs() < 1e-6);
        assert_eq!(both(1.0, 0.5).1, 0.0);
        assert_eq!(both(1.0, 0.2).1, 0.0);
    }
}
