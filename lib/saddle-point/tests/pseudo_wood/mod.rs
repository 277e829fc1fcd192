//! Synthetic test problem of the linear solver: two blocks of tilted lumens with walls of one
//! cell and a vessel now and then, a gap between them, liquid in the gap and in the ends of the
//! lumens, the upper block closing at unit speed. Lengths are in cells; every wall lies on a face.

#![allow(dead_code, reason = "the benchmark uses less of it than the tests")]

mod assembly;

pub use assembly::Problem;
use saddle_point::RowEntries;

/// A cell, or a face by the cell above it.
type Point = [i64; 3];

fn shift(mut at: Point, axis: usize, by: i64) -> Point {
    at[axis] += by;
    at
}

/// Adds the row of a matrix.
pub fn add_row((columns, values): (&[u32], &[f64]), entries: &mut RowEntries) {
    for (&column, &value) in columns.iter().zip(values) {
        entries.add(column as usize, value);
    }
}

/// What fills a cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Cell {
    Air,
    Liquid,
    Bottom,
    Top,
    /// Beyond the domain: a symmetry plane.
    Outside,
}

impl Cell {
    pub fn is_body(self) -> bool {
        matches!(self, Self::Bottom | Self::Top)
    }

    pub fn is_open(self) -> bool {
        matches!(self, Self::Air | Self::Liquid)
    }
}

/// Size and physics of a problem.
#[derive(Clone, Copy)]
pub struct Case {
    /// Cells along x, y (bond normal) and z (near the lumens' direction).
    pub cells: [usize; 3],
    /// Cells between the blocks.
    pub gap: usize,
    /// Cells the lumens are filled to.
    pub depth: usize,
    /// Viscosity, Pa s.
    pub viscosity: f64,
    /// Largest over smallest viscosity in the liquid.
    pub contrast: f64,
    /// Bulk modulus, Pa; infinite for an incompressible liquid.
    pub bulk_modulus: f64,
    /// Whether the walls hold the liquid.
    pub friction: bool,
    /// Open height of the cells in front of the closing body, as a fraction of a cell.
    pub sliver: f64,
}

impl Default for Case {
    fn default() -> Self {
        Self {
            cells: [32, 48, 48],
            gap: 12,
            depth: 10,
            viscosity: 1.3,
            contrast: 1.0,
            bulk_modulus: 1e9,
            friction: true,
            sliver: 1.0,
        }
    }
}

const PITCH: i64 = 8;
const SLOPE: f64 = 0.1;
/// Vessels: distance between them, squared inner and outer radius.
const VESSEL_PITCH: i64 = 60;
const VESSEL: (i64, i64) = (81, 110);

/// The cells of a problem, x fastest.
pub struct Wood {
    pub n: [usize; 3],
    pub cell: Vec<Cell>,
    /// First row of the upper block.
    pub top: i64,
}

impl Wood {
    pub fn new(case: &Case) -> Self {
        let n = case.cells;
        let bottom = ((n[1] - case.gap) / 2) as i64;
        let top = bottom + case.gap as i64;
        let place = |i: usize| [i % n[0], i / n[0] % n[1], i / (n[0] * n[1])].map(|v| v as i64);
        let cell = (0..n.iter().product())
            .map(|i| substance(place(i), [bottom, top], case.depth as i64))
            .collect();
        let mut wood = Self { n, cell, top };
        wood.drop_disconnected([1, (bottom + top) / 2, 1]);
        wood
    }

    pub fn index(&self, at: Point) -> usize {
        let [x, y, z] = at.map(|v| v as usize);
        (z * self.n[1] + y) * self.n[0] + x
    }

    /// The cell at a position that may lie outside.
    pub fn at(&self, at: Point) -> Cell {
        let inside = (0..3).all(|d| (0..self.n[d] as i64).contains(&at[d]));
        if inside {
            self.cell[self.index(at)]
        } else {
            Cell::Outside
        }
    }

    /// Turns liquid that does not touch the gap into air.
    fn drop_disconnected(&mut self, seed: Point) {
        let mut reached = vec![false; self.cell.len()];
        let mut front = vec![seed];
        reached[self.index(seed)] = true;
        while let Some(from) = front.pop() {
            for (axis, step) in (0..3).flat_map(|axis| [(axis, -1), (axis, 1)]) {
                let to = shift(from, axis, step);
                if self.at(to) == Cell::Liquid
                    && !std::mem::replace(&mut reached[self.index(to)], true)
                {
                    front.push(to);
                }
            }
        }
        for (cell, reached) in self.cell.iter_mut().zip(reached) {
            if *cell == Cell::Liquid && !reached {
                *cell = Cell::Air;
            }
        }
    }
}

fn substance([x, y, z]: Point, [bottom, top]: [i64; 2], depth: i64) -> Cell {
    let tilt = (SLOPE * z as f64).round() as i64;
    let wall = if y < bottom {
        is_wall(x, y - tilt, 20, bottom - 6).then_some(Cell::Bottom)
    } else if y >= top {
        is_wall(x + 3, y + tilt, 40, top + 6).then_some(Cell::Top)
    } else {
        None
    };
    let wet = y >= bottom - depth && y < top + depth;
    wall.unwrap_or(if wet { Cell::Liquid } else { Cell::Air })
}

/// Whether a point of a cross-section lies in a cell wall.
fn is_wall(x: i64, y: i64, vessel_x: i64, vessel_y: i64) -> bool {
    let from_vessel = (x - vessel_x + VESSEL_PITCH / 2).rem_euclid(VESSEL_PITCH) - VESSEL_PITCH / 2;
    let square = from_vessel * from_vessel + (y - vessel_y) * (y - vessel_y);
    if square < VESSEL.1 {
        return square >= VESSEL.0;
    }
    x.rem_euclid(PITCH) == 0 || y.rem_euclid(PITCH) == 0
}
