//! Which way things go: signs that a symmetric scene would not tell.

use physics::{
    Boundary, Clamp, Dimensions, GridBox, Liquid, Motion, Newtonian, Points, Scene, ShearRate,
    Stop, Tait, Viscosity, WallLaw,
};

/// -dp/dJ by central differences: liquid gets stiffer as it is compressed (j < 0), softer as it is
/// stretched.
#[test]
fn stiffness_is_the_slope_of_the_pressure() {
    let tait = Tait { bulk_modulus: 1e9 };
    for j in [-0.2, -0.05, 0.0, 0.03, 0.1] {
        let slope = (tait.pressure(j - 1e-6) - tait.pressure(j + 1e-6)) / 2e-6;
        let stiffness = tait.stiffness(j);
        assert!((slope / stiffness - 1.0).abs() < 1e-6, "{j}: {stiffness}");
    }
    assert!(tait.stiffness(-0.1) > 3.0 * tait.stiffness(0.0));
}

#[test]
fn the_clamp_closes_downwards() {
    let scene = |clamp| Scene {
        dimensions: Dimensions::Three,
        grid: GridBox {
            cell_m: 1e-6,
            min_m: [0.0; 3],
            cells: [2; 3],
        },
        boundary: [Boundary::Symmetry; 3],
        liquid: Liquid {
            density: 1200.0,
            tait: Tait { bulk_modulus: 1e9 },
            viscosity: Viscosity::Newtonian(Newtonian(1.3)),
            shear_rate: ShearRate::Paper,
            cure: None,
            water: None,
            cavitation_pressure: None,
            wetting: None,
        },
        points: Points::default(),
        wall: WallLaw::Stick,
        bodies: Vec::new(),
        gravity: [0.0; 3],
        clamp,
        programme: Vec::new(),
        stop: Stop::Time(1.0),
        bottom: None,
        top: None,
    };
    let driven = scene(Some(Clamp {
        closing_speed: 2.0,
        max_pressure: None,
        pid: None,
    }));
    assert_eq!(driven.velocity(Motion::Clamped), [0.0, -2.0, 0.0]);
    assert_eq!(driven.velocity(Motion::Fixed), [0.0; 3]);
    let constant = [1.0, -0.5, 0.25];
    assert_eq!(driven.velocity(Motion::Constant(constant)), constant);
    assert_eq!(scene(None).velocity(Motion::Clamped), [0.0; 3]);
}
