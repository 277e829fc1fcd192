//! The stages of a step: what both schemes do for a scene, and what they do without.

use physics::{
    Amount, Boundary, Clamp, Dimensions, GridBox, Liquid, Motion, Newtonian, RigidBody, Scene,
    ShearRate, Stages, Stop, Table, Tait, Viscosity, VoxelBlock, WallLaw,
};

const COMMON: [&str; 9] = [
    "third dimension",
    "wall contact",
    "wall friction",
    "viscosity table",
    "body force",
    "clamp control",
    "load control",
    "mirror images",
    "periodic images",
];

/// A Newtonian drop that flies freely through open sides.
fn drop() -> Scene {
    Scene {
        dimensions: Dimensions::Three,
        grid: GridBox {
            cell_m: 1e-6,
            min_m: [0.0; 3],
            cells: [8; 3],
        },
        boundary: [Boundary::Open; 3],
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
        points: Default::default(),
        bodies: Vec::new(),
        wall: WallLaw::Stick,
        gravity: [0.0; 3],
        clamp: None,
        programme: Vec::new(),
        stop: Stop::Time(1e-6),
        bottom: None,
        top: None,
    }
}

/// A bond line with all that a scene can have.
fn bond() -> Scene {
    let block = VoxelBlock::from_fn([0.0; 3], [1e-6; 3], [8, 2, 8], |_, _, _| true);
    let viscosity = Table::new(&[(1.0, 210.0), (500.0, 1.0)]).unwrap();
    let mut scene = drop();
    scene.boundary = [Boundary::Periodic, Boundary::Open, Boundary::Symmetry];
    scene.liquid.viscosity = Viscosity::Table(viscosity);
    scene.bodies.push(RigidBody {
        name: "wood".into(),
        blocks: vec![block],
        motion: Motion::Clamped,
    });
    scene.gravity = [0.0, -9.81, 0.0];
    scene.clamp = Some(Clamp {
        closing_speed: 1.0,
        max_pressure: Some(2.5e6),
        pid: Some(Default::default()),
    });
    scene
}

fn explicit(scene: &Scene, settings: &mpm::Settings) -> Stages {
    mpm::Plan::new(scene, &Amount::default(), settings).stages
}

fn implicit(scene: &Scene) -> Stages {
    implicit::Plan::new(scene, &Amount::default(), &implicit::Settings::default()).stages
}

#[test]
fn a_free_drop_needs_next_to_nothing() {
    let plain = explicit(&drop(), &mpm::Settings::default());
    assert_eq!(plain.present(), ["third dimension", "shear rate of points"]);
    let more = [
        "velocity filter",
        "affine velocity field",
        "cell-mean pressure",
        "density projection",
    ];
    let whys = plain.iter().filter_map(|stage| stage.absent.as_deref());
    assert_eq!(
        whys.collect::<Vec<_>>()[..4],
        [
            "the scene has no rigid body",
            "the scene has no rigid body",
            "Newtonian liquid, 1.3 Pa s",
            "gravity is zero"
        ]
    );
    let names: Vec<_> = plain.iter().map(|stage| stage.name).collect();
    assert_eq!(
        names,
        [&COMMON[..], &more, &["shear rate of points"]].concat()
    );
    assert_eq!(implicit(&drop()).present(), ["third dimension"]);
    let flat = Scene {
        dimensions: Dimensions::Two,
        ..drop()
    };
    assert!(!implicit(&flat).has(Stages::THIRD_DIMENSION));
}

#[test]
fn a_bond_line_has_every_stage_that_is_asked_for() {
    let settings = mpm::Settings {
        velocity_update: mpm::VelocityUpdate::Xpic(5),
        pressure: mpm::PressureFrom::CellMean,
        density_projection: Some(0.04),
        ..Default::default()
    };
    let own = [
        "velocity filter",
        "cell-mean pressure",
        "density projection",
        "shear rate of points",
    ];
    let all = explicit(&bond(), &settings);
    assert_eq!(all.present(), [&COMMON[..], &own].concat());
    assert_eq!(
        implicit(&bond()).present(),
        [&COMMON[..], &["PID"]].concat()
    );
}
