//! The scenes: a press with a lumen, a sealed chamber, liquid torn apart, droplets.

use crate::case_text::{Body, CaseText, PF, Viscosity, partial_slip};
use crate::lines::Values;
use crate::press::Press;

/// Edge of a cell, m (paper section 2.3); a voxel is half of it.
const CELL: f64 = 2.9e-6;

/// A scene with what its results are measured against.
#[derive(Clone, Debug)]
pub(super) struct Scene {
    /// The case; its end is set by [`Scene::lasting`].
    pub(super) case: CaseText,
    /// Fastest speed the scene's own motion gives the liquid, m/s.
    pub(super) speed: f64,
    /// How long the scene's motion takes, s.
    pub(super) duration: f64,
    /// How far the clamp moves in that time at its closing speed, m; 0 without one.
    pub(super) travel: f64,
    /// What the trial's balance error is.
    pub(super) balance: Balance,
}

/// A conserved or balanced quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Balance {
    /// Pressure on the upper against that on the lower body, over the later half of the run.
    Forces,
    /// Mean velocity of the liquid at the end against this one (m/s) at the start, over the
    /// speed.
    Momentum([f64; 2]),
    /// Neither: liquid is thrown about.
    None,
}

impl Scene {
    /// The case that ends after `seconds`.
    pub(super) fn lasting(&self, seconds: f64) -> CaseText {
        let mut case = self.case.clone();
        case.history_every = seconds / 100.0;
        match &mut case.clamp {
            Some(clamp) => clamp.push_str(&format!("stop = \"{} us\"\n", seconds * 1e6)),
            None => case.stop = Some(seconds),
        }
        case
    }

    /// The same scene in three dimensions, `cells` deep.
    pub(super) fn deep(mut self, cells: u32) -> Self {
        let depth = f64::from(cells) * CELL;
        self.case.dimensions = 3;
        self.case.size[2] = depth;
        for body in &mut self.case.bodies {
            body.max[2] = depth;
        }
        self
    }
}

fn scale(x: [f64; 3]) -> [f64; 3] {
    x.map(|x| x * CELL)
}

fn wall(min: [f64; 3], max: [f64; 3]) -> Body {
    Body::wall(scale(min), scale(max)).named("bottom")
}

fn liquid(min: [f64; 3], max: [f64; 3]) -> Body {
    Body::liquid(scale(min), scale(max))
}

/// The paper's PVA-PF (Table 1).
pub(crate) const PVA_PF: [[f64; 2]; 4] = [
    [1.0, 210.0],
    [6.30957, 87.0],
    [39.8107, 1.7],
    [501.187, 1.0],
];

/// The scene of a line, with its liquid and walls.
pub(super) fn of(values: &Values) -> Option<Scene> {
    let number = |key: &'static str, usual| values.number(key).unwrap_or(usual);
    let mut scene = match values.name {
        "press" => press(values),
        "sealed" => sealed_lumen(values),
        "torn" => torn(number("speed", 1.0)),
        "free" => free_drop(number("size", 1.0)),
        "splash" => splash(number("size", 1.0), number("speed", 1.0)),
        _ => return None,
    };
    let case = &mut scene.case;
    case.bulk_modulus = number("modulus", PF[1]);
    case.viscosity = match values.word("eta") {
        Some("table") => Viscosity::Table(PVA_PF.to_vec()),
        _ => Viscosity::Newtonian(number("eta", PF[2])),
    };
    case.contact = match values.word("slip") {
        Some(cells) => partial_slip(&format!("{cells} cell")),
        None => format!("law = \"{}\"\n", values.word("walls").unwrap_or("stick")),
    };
    Some(scene)
}

/// An upper body presses a slab of liquid into a lumen of the lower one, or where there is none in a sealed chamber; floors a
/// quarter cell off the nodes, the walls of the lumen half a cell.
fn press(values: &Values) -> Scene {
    let number = |key: &'static str, usual| values.number(key).unwrap_or(usual);
    let (width, lumen, speed) = (16.0, number("lumen", 6.0), number("speed", 1.0));
    let [left, right] = [-0.5, 0.5].map(|side| 0.5 * width + side * lumen + 0.5);
    let shape = Press {
        width,
        liquid: [0.0, width],
        slab: number("slab", 4.0),
        air: 0.0,
        floors: [2.25, 8.25],
        lumen: (lumen > 0.0).then_some([left, right]),
        travel: number("travel", 1.5),
        depth: [number("depth", 1.0); 2],
    };
    let limit = match values.word("limit") {
        Some("none") => "",
        _ => "max_pressure = \"2500000 Pa\"\n",
    };
    let travel = shape.travel * CELL;
    Scene {
        case: CaseText {
            clamp: Some(format!("closing_speed = \"{speed} m/s\"\n{limit}")),
            ..shape.case(CELL)
        },
        // Mean speed in the lumen; between closing plates the liquid leaves sideways.
        speed: speed * (width / lumen.max(1.0)),
        duration: travel / speed,
        travel,
        balance: Balance::Forces,
    }
}

/// A lumen full of liquid, closed by a wall of one voxel, under the slab that is pressed. Both
/// have nowhere to go: the slab is compressed to the pressure limit, the lumen must stay as it is.
fn sealed_lumen(values: &Values) -> Scene {
    let mut scene = press(values);
    let roof = wall([5.25, 7.75, 0.0], [11.25, 8.25, 1.0]);
    let lumen = liquid([5.25, 2.25, 0.0], [11.25, 7.75, 1.0]);
    scene.case.bodies.extend([roof, lumen]);
    scene
}

/// Bodies in a plane of `size` cells, without a clamp.
fn thrown(size: [f64; 2], bodies: Vec<Body>) -> CaseText {
    CaseText {
        bodies,
        ..CaseText::plane(CELL, size.map(|x| x * CELL))
    }
}

/// Two halves of a block of liquid that fly apart: tension, J far above 1.
pub(super) fn torn(speed: f64) -> Scene {
    let half =
        |from: f64, v: f64| liquid([from, 2.0, 0.0], [from + 4.0, 6.0, 1.0]).moving([v, 0.0, 0.0]);
    let bodies = vec![half(6.0, -speed), half(10.0, speed)];
    Scene {
        case: CaseText {
            boundary: ["open", "open", "symmetry"],
            ..thrown([20.0, 8.0], bodies)
        },
        speed,
        duration: 4.0 * CELL / speed,
        travel: 0.0,
        balance: Balance::Momentum([0.0; 2]),
    }
}

/// A drop of liquid `size` cells wide at this velocity (m/s), a fraction of a cell off the nodes.
fn drop(size: f64, [u, v]: [f64; 2]) -> Body {
    liquid([4.1, 4.1, 0.0], [4.1 + size, 4.1 + size, 1.0]).moving([u, v, 0.0])
}

/// A drop in free flight through a periodic box.
fn free_drop(size: f64) -> Scene {
    let velocity = [1.0, -0.5];
    let bodies = vec![drop(size, velocity)];
    Scene {
        case: CaseText {
            boundary: ["periodic", "periodic", "symmetry"],
            ..thrown([12.0; 2], bodies)
        },
        speed: 1.25_f64.sqrt(),
        duration: 6.0 * CELL,
        travel: 0.0,
        balance: Balance::Momentum(velocity),
    }
}

/// A drop that hits a floor.
fn splash(size: f64, speed: f64) -> Scene {
    let floor = wall([0.0; 3], [12.0, 2.5, 1.0]);
    let bodies = vec![floor, drop(size, [0.0, -speed])];
    Scene {
        case: thrown([12.0; 2], bodies),
        speed,
        duration: 4.0 * CELL / speed,
        travel: 0.0,
        balance: Balance::None,
    }
}
