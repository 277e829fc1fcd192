//! Default scene for tests of both schemes: PF between symmetry sides, with sticking walls.

use physics::{
    Boundary, Dimensions, GridBox, Liquid, Motion, Newtonian, Points, RigidBody, Scene, ShearRate,
    Stop, Tait, Viscosity, VoxelBlock, WallLaw,
};

/// A scene without liquid and bodies in `cells` of edge `cell_m`; plane strain for one cell along z.
pub fn scene(cell_m: f64, cells: [usize; 3]) -> Scene {
    Scene {
        dimensions: if cells[2] == 1 {
            Dimensions::Two
        } else {
            Dimensions::Three
        },
        grid: GridBox {
            cell_m,
            min_m: [0.0; 3],
            cells,
        },
        boundary: [Boundary::Symmetry; 3],
        liquid: Liquid {
            density: 1200.0,
            tait: Tait { bulk_modulus: 1e9 },
            viscosity: Viscosity::Newtonian(Newtonian(1.3)),
            shear_rate: ShearRate::Rheometer,
            cure: None,
            water: None,
            cavitation_pressure: None,
            wetting: None,
        },
        points: Points::default(),
        bodies: Vec::new(),
        wall: WallLaw::Stick,
        gravity: [0.0; 3],
        clamp: None,
        programme: Vec::new(),
        stop: Stop::Time(1.0),
        bottom: None,
        top: None,
    }
}

/// A rigid body.
pub fn body(name: &str, blocks: Vec<VoxelBlock>, motion: Motion) -> RigidBody {
    RigidBody {
        name: name.into(),
        blocks,
        motion,
    }
}

/// `n` liquid points at rest along each axis, the first corner at `low` and each of `size`, m.
pub fn fill(low: [f64; 3], size: [f64; 3], n: [usize; 3]) -> Points {
    let mut points = Points::default();
    for k in 0..n[2] {
        for j in 0..n[1] {
            for i in 0..n[0] {
                let at = [i, j, k];
                let centre = |a: usize| low[a] + size[a] * (at[a] as f64 + 0.5);
                points.position.push(std::array::from_fn(centre));
                points.velocity.push([0.0; 3]);
                points.volume.push(size.iter().product());
            }
        }
    }
    points
}
