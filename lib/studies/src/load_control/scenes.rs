//! The scenes: films, lumens and blocks that a clamp presses on at a pressure limit.

use crate::case_text::{Body, CaseText, Viscosity};

/// Edge of a cell, m.
pub(super) const CELL: f64 = 2e-6;
/// Closing speed, m/s.
const SPEED: f64 = 1.0;

/// Shape of a press, lengths in cells.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// Name in tables.
    pub(super) name: &'static str,
    /// Width of the domain.
    width: f64,
    /// Where the liquid is along x.
    liquid: [f64; 2],
    /// Thickness of the liquid.
    slab: f64,
    /// Air between liquid and upper body.
    air: f64,
    /// Distance of the floor from the nodes.
    offset: f64,
    /// Lumen of the lower body, from and to.
    lumen: Option<[f64; 2]>,
    /// How far the upper body moves.
    pub(super) travel: f64,
    /// Cells along z, and how many of them hold liquid; one for plane strain.
    depth: [f64; 2],
}

const FILM: Shape = Shape {
    name: "film",
    width: 14.0,
    liquid: [0.0, 6.0],
    slab: 4.0,
    air: 0.0,
    offset: 0.0,
    lumen: None,
    travel: 1.5,
    depth: [1.0, 1.0],
};

/// Eight presses: air in the gap or none, walls on the nodes and off them, one and two fronts,
/// lumens, a film of two cells, three dimensions.
pub const SHAPES: [Shape; 8] = [
    FILM,
    Shape {
        name: "film under air",
        width: 12.0,
        air: 1.0,
        travel: 2.0,
        ..FILM
    },
    Shape {
        name: "film off the nodes",
        offset: 0.37,
        ..FILM
    },
    Shape {
        name: "two fronts under air",
        width: 16.0,
        liquid: [5.0, 11.0],
        air: 0.6,
        offset: 0.25,
        ..FILM
    },
    Shape {
        name: "thin film",
        slab: 2.0,
        travel: 0.5,
        ..FILM
    },
    Shape {
        name: "lumen",
        width: 16.0,
        liquid: [0.0, 16.0],
        offset: 0.25,
        lumen: Some([5.0, 11.0]),
        ..FILM
    },
    Shape {
        name: "narrow lumen under air",
        width: 12.0,
        liquid: [0.0, 12.0],
        air: 0.5,
        offset: 0.25,
        lumen: Some([4.5, 7.5]),
        travel: 1.3,
        ..FILM
    },
    Shape {
        name: "block",
        width: 8.0,
        liquid: [0.0, 4.0],
        depth: [8.0, 4.0],
        ..FILM
    },
];

impl Shape {
    /// Distance between the plates at the start, m.
    pub(super) fn gap(&self) -> f64 {
        (self.slab + self.air) * CELL
    }

    /// Whether the upper plate touches the liquid from the start.
    pub(super) fn touches(&self) -> bool {
        self.air == 0.0
    }

    /// The case for a liquid of `viscosity` (Pa s) under a limit of `pressure` (Pa).
    pub(super) fn case(&self, pressure: f64, viscosity: f64) -> CaseText {
        let [deep, wet] = self.depth;
        let floor = 10.0 + self.offset;
        let plate = floor + self.slab + self.air;
        let top = (plate + 2.0).ceil();
        let wall = |min: [f64; 2], max: [f64; 2]| {
            let [min, max] = [[min[0], min[1], 0.0], [max[0], max[1], deep]];
            Body::wall(min.map(|x| x * CELL), max.map(|x| x * CELL))
        };
        let mut bodies = Vec::new();
        if let Some([from, to]) = self.lumen {
            let bottom = 2.0 + self.offset;
            bodies.push(wall([0.0, 0.0], [self.width, bottom]).named("bottom"));
            bodies.push(wall([0.0, bottom], [from, floor]));
            bodies.push(wall([to, bottom], [self.width, floor]));
        } else {
            bodies.push(wall([0.0, 0.0], [self.width, floor]).named("bottom"));
        }
        let plate = wall([0.0, plate], [self.width, top + self.travel]);
        bodies.push(plate.clamped().named("top"));
        let [left, right] = self.liquid;
        let (low, high) = ([left, floor, 0.0], [right, floor + self.slab, wet]);
        bodies.push(Body::liquid(low.map(|x| x * CELL), high.map(|x| x * CELL)));
        let travel = self.travel * CELL;
        // The slowest takes some hundred times the viscosity over the pressure.
        let limit = 20.0 * travel / SPEED + 2000.0 * viscosity / pressure;
        let (travel, limit) = (travel * 1e6, limit * 1e6);
        let size = [self.width, top, deep].map(|x| x * CELL);
        CaseText {
            title: format!("{}: a press at a pressure limit.", self.name),
            viscosity: Viscosity::Newtonian(viscosity),
            clamp: Some(format!(
                "closing_speed = \"{SPEED} m/s\"\nmax_pressure = \"{pressure} Pa\"\ntravel = \"{travel} um\"\ntime_limit = \"{limit} us\"\n"
            )),
            bodies,
            // A row for every step.
            history_every: 1e-15,
            ..CaseText::new(CELL, if deep > 1.0 { 3 } else { 2 }, size)
        }
    }
}
