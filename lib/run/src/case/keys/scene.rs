//! Keys of what is where: cells, bodies, body force, sides.

use mpm::ShapeFunction;
use physics::{Boundary, Choice};
use units::{Acceleration, Length};

use super::{Absent, Key, Table, choice, quantity, three, word};
use crate::case::SchemeName;

pub(super) const GRID: Table = Table {
    path: "grid",
    repeated: false,
    always: true,
    about: "The cells in which the flow is computed.",
    keys: &[
        Key {
            name: "cell",
            form: || format!("{}, voxels", quantity::<Length>()),
            absent: Absent::Needed("always"),
            text: "Edge of a cubic cell, a length or a multiple of the bond file's voxel: `\"2 voxels\"`. Two voxels of the stack are the paper's and usual. Take one voxel where `--explain` says that half of the lumens' volume has fewer than 5 cells across, and for errors (`make` does so by itself): some ten times the cost, five times the memory. Implicit scheme: one or two voxels a cell, or a whole number of cells a voxel.",
        },
        Key {
            name: "dimensions",
            form: || "2 or 3".into(),
            absent: Absent::Value("3"),
            text: "2 is plane strain: one layer of cells along z. For trials and verification; lumens that run along z are tubes only in 3.",
        },
        Key {
            name: "shape",
            form: choice::<ShapeFunction>,
            absent: Absent::Of("`\"gimp\"`", |case, _| {
                let used = case.integrator.scheme == SchemeName::Explicit;
                used.then(|| word(ShapeFunction::default().name()))
            }),
            text: "Explicit scheme: shape function between points and nodes. `\"gimp\"` is the paper's; change it to compare. `\"linear\"` is unstable where a liquid surface lies off the nodes.",
        },
        Key {
            name: "points_per_direction",
            form: || "1 to 4".into(),
            absent: Absent::Value("2"),
            text: "Material points along a cell's edge at the start; 2 makes 8 a cell, as in the paper. The points of a voxel must be a whole number: 1 where a cell is one voxel and memory is short. To the implicit scheme they say where liquid is at the start, no more.",
        },
        Key {
            name: "domain.min",
            form: three_of::<Length>,
            absent: Absent::Of("low corner of all `[[body]]`", |case, setup| {
                let scene = &setup.scene;
                (!case.body.is_empty()).then(|| three::<Length>(scene.grid.min_m))
            }),
            text: "Low corner of the box to compute in. Give it, with `domain.max`, where liquid is to move beyond the bodies of the start. Not with a bond file, which has its own box.",
        },
        Key {
            name: "domain.max",
            form: three_of::<Length>,
            absent: Absent::Of(
                "high corner of all `[[body]]`, in whole cells",
                |case, setup| {
                    let scene = &setup.scene;
                    (!case.body.is_empty()).then(|| three::<Length>(scene.grid.max_m()))
                },
            ),
            text: "Its high corner.",
        },
    ],
};

pub(super) const BODY: Table = Table {
    path: "body",
    repeated: true,
    always: false,
    about: "A box of liquid or wall. Together they describe the scene of a run without `--particles`; with it they are refused. In plane strain z is ignored. Implicit scheme: walls lie on faces of cells or half way between them.",
    keys: &[
        Key {
            name: "material",
            form: || "`\"adhesive\"`, `\"rigid\"`".into(),
            absent: Absent::Needed("always"),
            text: "Liquid or wall.",
        },
        Key {
            name: "box.min",
            form: three_of::<Length>,
            absent: Absent::Needed("always"),
            text: "Low corner. Boxes of liquid may touch and not overlap.",
        },
        Key {
            name: "box.max",
            form: three_of::<Length>,
            absent: Absent::Needed("always"),
            text: "High corner.",
        },
        Key {
            name: "velocity",
            form: || "three speeds, `\"clamp\"`".into(),
            absent: Absent::Value("[\"0 m/s\", \"0 m/s\", \"0 m/s\"]"),
            text: "Of liquid at the start, of a wall for good. `\"clamp\"`: a wall that `[clamp]` drives along -y. Implicit scheme: one wall moves along y; others only along themselves, from side to side of the domain.",
        },
        Key {
            name: "name",
            form: || "text".into(),
            absent: Absent::Value("\"wall\""),
            text: "Walls of one name and velocity are one body. Name two of them `\"bottom\"` and `\"top\"` to say whose pressures the history has; otherwise they are the first at rest and the first that moves. Of no effect on liquid.",
        },
    ],
};

pub(super) const GRAVITY: Table = Table {
    path: "gravity",
    repeated: false,
    always: true,
    about: "Body force.",
    keys: &[Key {
        name: "acceleration",
        form: three_of::<Acceleration>,
        absent: Absent::Value("[\"0 m/s2\", \"0 m/s2\", \"0 m/s2\"]"),
        text: "Along x, y and z. Of no weight in a bond line: 20 um of adhesive weigh 0.2 Pa. For verification cases such as films on an incline.",
    }],
};

pub(super) const BOUNDARY: Table = Table {
    path: "boundary",
    repeated: false,
    always: true,
    about: "The sides of the box: `\"symmetry\"` mirrors, liquid leaves through `\"open\"`, `\"periodic\"` joins both ends. What of a rigid box lies beyond a periodic side comes in at the other one. A moving body that would collide with another one, through periodic sides too, or go from within through a mirror is refused.",
    keys: &[
        Key {
            name: "x",
            form: choice::<Boundary>,
            absent: Absent::Value("\"symmetry\""),
            text: "Sides normal to x. A piece cut out of a larger bond line has neighbours like itself, which symmetry stands for; take `\"open\"` for a free edge of the bond.",
        },
        Key {
            name: "y",
            form: choice::<Boundary>,
            absent: Absent::Value("\"symmetry\""),
            text: "Sides normal to y, the bond normal: the outer ends of the wood. `\"periodic\"` is refused with a clamp.",
        },
        Key {
            name: "z",
            form: choice::<Boundary>,
            absent: Absent::Value("\"symmetry\""),
            text: "Sides normal to z; in plane strain nothing else.",
        },
    ],
};

fn three_of<D: units::Dimension>() -> String {
    format!("three {}s", quantity::<D>())
}
