//! The scenes: a press with a lumen, a sealed chamber, liquid torn apart, droplets.

use crate::case_text::{Body, CaseText, Viscosity};

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

    /// The same scene of another liquid.
    pub(super) fn of(mut self, viscosity: Viscosity, bulk_modulus: f64) -> Self {
        self.case.viscosity = viscosity;
        self.case.bulk_modulus = bulk_modulus;
        self
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

    /// The same scene with other lines of `[contact]`.
    pub(super) fn walls(mut self, contact: &str) -> Self {
        self.case.contact = contact.into();
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

/// Shape of a press, lengths in cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Press {
    /// Width of the lumen in the lower body; none at 0.
    pub(super) lumen: f64,
    /// Thickness of the slab of liquid.
    pub(super) slab: f64,
    /// How far the upper body moves.
    pub(super) travel: f64,
    /// Closing speed, m/s.
    pub(super) speed: f64,
    /// Pressure limit, Pa.
    pub(super) limit: Option<f64>,
    /// Cells along z; one for plane strain.
    pub(super) depth: u32,
}

impl Default for Press {
    fn default() -> Self {
        Self {
            lumen: 6.0,
            slab: 4.0,
            travel: 1.5,
            speed: 1.0,
            limit: Some(2.5e6),
            depth: 1,
        }
    }
}

/// An upper body presses a slab of liquid into a lumen of the lower one; floors a quarter cell off
/// the nodes, the walls of the lumen half a cell.
pub(super) fn press(shape: Press) -> Scene {
    let (width, off, aside) = (16.0, 0.25, 0.5);
    let floor = 8.0 + off;
    let plate = floor + shape.slab;
    let top = (plate + 2.0).ceil();
    let depth = f64::from(shape.depth);
    let [left, right] = [-0.5, 0.5].map(|side| 0.5 * width + side * shape.lumen + aside);
    let mut bodies = Vec::new();
    if shape.lumen > 0.0 {
        bodies.push(wall([0.0; 3], [width, 2.0 + off, depth]));
        bodies.push(wall([0.0, 2.0 + off, 0.0], [left, floor, depth]));
        bodies.push(wall([right, 2.0 + off, 0.0], [width, floor, depth]));
    } else {
        bodies.push(wall([0.0; 3], [width, floor, depth]));
    }
    let upper = wall([0.0, plate, 0.0], [width, top + shape.travel, depth]);
    bodies.push(upper.clamped().named("top"));
    bodies.push(liquid([0.0, floor, 0.0], [width, plate, depth]));
    let limit = (shape.limit).map_or(String::new(), |p| format!("max_pressure = \"{p} Pa\"\n"));
    let dimensions = if shape.depth == 1 { 2 } else { 3 };
    let case = CaseText {
        title: "A slab of liquid pressed into a lumen.".into(),
        clamp: Some(format!("closing_speed = \"{} m/s\"\n{limit}", shape.speed)),
        bodies,
        ..CaseText::new(CELL, dimensions, scale([width, top, depth]))
    };
    // Mean speed in the lumen; between closing plates the liquid leaves sideways.
    let narrowing = width / shape.lumen.max(1.0);
    Scene {
        case,
        speed: shape.speed * narrowing,
        duration: shape.travel * CELL / shape.speed,
        travel: shape.travel * CELL,
        balance: Balance::Forces,
    }
}

/// A chamber full of liquid whose lid moves in until `j` of its volume is left.
pub(super) fn chamber(j: f64, speed: f64) -> Scene {
    let mut scene = press(Press {
        lumen: 0.0,
        slab: 8.0,
        travel: 8.0 * (1.0 - j),
        speed,
        limit: None,
        depth: 1,
    });
    scene.case.title = "A sealed chamber whose lid moves in.".into();
    scene
}

/// A lumen full of liquid, closed by a wall of one voxel, under the slab that is pressed. Both
/// have nowhere to go: the slab is compressed to the pressure limit, the lumen must stay as it is.
pub(super) fn sealed_lumen() -> Scene {
    let mut scene = press(Press::default());
    let roof = wall([5.25, 7.75, 0.0], [11.25, 8.25, 1.0]);
    let lumen = liquid([5.25, 2.25, 0.0], [11.25, 7.75, 1.0]);
    scene.case.bodies.extend([roof, lumen]);
    scene.case.title = "Liquid in a lumen sealed by a wall of one voxel.".into();
    scene
}

/// Bodies in a plane of `size` cells, without a clamp.
fn thrown(title: &str, size: [f64; 2], bodies: Vec<Body>) -> CaseText {
    CaseText {
        title: title.into(),
        bodies,
        ..CaseText::plane(CELL, size.map(|x| x * CELL))
    }
}

/// Two halves of a block of liquid that fly apart: tension, J far above 1.
pub(super) fn torn(speed: f64) -> Scene {
    let half =
        |from: f64, v: f64| liquid([from, 2.0, 0.0], [from + 4.0, 6.0, 1.0]).moving([v, 0.0, 0.0]);
    let bodies = vec![half(6.0, -speed), half(10.0, speed)];
    let title = "Two halves of a block of liquid fly apart.";
    Scene {
        case: CaseText {
            boundary: ["open", "open", "symmetry"],
            ..thrown(title, [20.0, 8.0], bodies)
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
pub(super) fn free_drop(size: f64) -> Scene {
    let velocity = [1.0, -0.5];
    let bodies = vec![drop(size, velocity)];
    Scene {
        case: CaseText {
            boundary: ["periodic", "periodic", "symmetry"],
            ..thrown("A drop in free flight.", [12.0; 2], bodies)
        },
        speed: 1.25_f64.sqrt(),
        duration: 6.0 * CELL,
        travel: 0.0,
        balance: Balance::Momentum(velocity),
    }
}

/// A drop that hits a floor.
pub(super) fn splash(size: f64, speed: f64) -> Scene {
    let floor = wall([0.0; 3], [12.0, 2.5, 1.0]);
    let bodies = vec![floor, drop(size, [0.0, -speed])];
    Scene {
        case: thrown("A drop hits a floor.", [12.0; 2], bodies),
        speed,
        duration: 4.0 * CELL / speed,
        travel: 0.0,
        balance: Balance::None,
    }
}
