//! Synthetic test problem of the linear solver: two blocks with slanting square lumens, a gap between them, liquid in the gap and
//! in the ends of the lumens, the upper block closing at unit speed. Lengths are in cells; every wall lies on a face.

#![allow(dead_code, reason = "the benchmark uses less of it than the tests")]

mod problem;

pub use problem::Problem;
use saddle_point::{Csr, RowEntries, SolveError, VelocityBlock};

/// Indices of a cell, or of the cell above a face.
type Point = [i64; 3];
/// A face across an axis, the lower one of a cell.
type Face = (usize, Point);

/// Density times the square of the cell's edge over the time step, Pa s: 1200 kg/m3, 2.9 um, and the time step, s.
const INERTIA: f64 = 1200.0 * 2.9e-6 * 2.9e-6 / TIME_STEP;
const TIME_STEP: f64 = 1e-6;
/// Velocity of the upper block.
const SPEED: f64 = -1.0;
/// Width of a lumen, and length over which it slants by one cell, cells.
const PITCH: i64 = 8;
const SLANT: i64 = 5;
/// Distance of walls from the centre of the adjacent cell.
const DISTANCE: f64 = 0.45;
const NONE: u32 = u32::MAX;

fn shift(mut at: Point, axis: usize, by: i64) -> Point {
    at[axis] += by;
    at
}

/// Adds the entries of a row.
pub fn add_row((columns, values): (&[u32], &[f64]), entries: &mut RowEntries) {
    for (&column, &value) in columns.iter().zip(values) {
        entries.add(column as usize, value);
    }
}

/// Content of a cell; outside the domain is a symmetry plane.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Cell {
    Air,
    Liquid,
    Bottom,
    Top,
    Outside,
}

impl Cell {
    fn is_body(self) -> bool {
        matches!(self, Self::Bottom | Self::Top)
    }

    fn is_open(self) -> bool {
        matches!(self, Self::Air | Self::Liquid)
    }
}

/// Size and physics of a problem.
#[derive(Clone, Copy)]
pub struct Case {
    /// Cells along x, y (bond normal) and z.
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
    /// Whether the liquid sticks to the walls.
    pub friction: bool,
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
        }
    }
}

impl Case {
    /// Rows of the gap.
    fn gap(&self) -> std::ops::Range<i64> {
        let bottom = ((self.cells[1] - self.gap) / 2) as i64;
        bottom..bottom + self.gap as i64
    }

    fn at(&self, at: Point) -> Cell {
        if (0..3).any(|axis| !(0..self.cells[axis] as i64).contains(&at[axis])) {
            return Cell::Outside;
        }
        let ([x, y, z], gap, depth) = (at, self.gap(), self.depth as i64);
        let wall = |by: i64| {
            (x + by + y / SLANT).rem_euclid(PITCH) == 0 || (z + by).rem_euclid(PITCH) == 0
        };
        match y {
            y if y < gap.start && wall(0) => Cell::Bottom,
            y if y >= gap.end && wall(3) => Cell::Top,
            y if (gap.start - depth..gap.end + depth).contains(&y) => Cell::Liquid,
            _ => Cell::Air,
        }
    }

    /// Viscosity over the reference.
    fn viscosity(&self, at: Point) -> f64 {
        let wave = |axis: usize, period: f64| {
            let half = 0.5 * std::f64::consts::TAU * at[axis] as f64 / period;
            half.sin().powi(2)
        };
        let exponent = (wave(0, 8.0) + wave(1, 11.0) + wave(2, 37.0)) / 3.0;
        self.contrast.powf(exponent)
    }

    /// The liquid cells on both sides of a face.
    fn sides(&self, (axis, at): Face) -> impl Iterator<Item = Point> {
        let sides = [shift(at, axis, -1), at].into_iter();
        sides.filter(|&at| self.at(at) == Cell::Liquid)
    }

    /// Liquid of a face, and that times its viscosity.
    fn liquid(&self, face: Face) -> [f64; 2] {
        let viscous = self.sides(face).map(|at| 0.5 * self.viscosity(at));
        [0.5 * self.sides(face).count() as f64, viscous.sum()]
    }

    /// Velocity of a closed face: that of the upper block where it touches it.
    fn closed_velocity(&self, (axis, at): Face) -> f64 {
        let sides = [at, shift(at, axis, -1)].map(|at| self.at(at));
        match axis == 1 && sides.contains(&Cell::Top) {
            true => SPEED,
            false => 0.0,
        }
    }

    /// Friction and inertia of the liquid around a face, for the pressure preconditioner.
    fn friction(&self, face: Face) -> f64 {
        let (axis, [_, y, _]) = face;
        let widths = match self.gap().contains(&y) {
            true => [f64::INFINITY, self.gap as f64, f64::INFINITY],
            false => [(PITCH - 1) as f64, f64::INFINITY, (PITCH - 1) as f64],
        };
        let tangents = (0..3).filter(|&tangent| tangent != axis && self.friction);
        let lumen: f64 = tangents.map(|t| 12.0 / widths[t].powi(2)).sum();
        let [liquid, viscous] = self.liquid(face);
        liquid * INERTIA / self.viscosity + viscous * lumen
    }
}

/// Numbers of the unknowns.
struct Stokes {
    case: Case,
    /// Velocity unknown of every cell's three lower faces, x fastest.
    velocity: Vec<[u32; 3]>,
    cells: Vec<Point>,
    faces: Vec<Face>,
}

impl Stokes {
    /// Numbers the unknowns along grid lines, one velocity component after the other on each line:
    /// neighbouring rows then couple to equal distances.
    fn new(case: &Case) -> Self {
        let [nx, ny, nz] = case.cells.map(|n| n as i64);
        let mut velocity = vec![[NONE; 3]; case.cells.iter().product()];
        let (mut cells, mut faces) = (Vec::new(), Vec::new());
        for (z, y) in (0..nz).flat_map(|z| (0..ny).map(move |y| (z, y))) {
            let line = (0..nx).map(|x| [x, y, z]);
            cells.extend(line.clone().filter(|&at| case.at(at) == Cell::Liquid));
            for (axis, at) in (0..3).flat_map(|axis| line.clone().map(move |at| (axis, at))) {
                let sides = [at, shift(at, axis, -1)].map(|at| case.at(at));
                if sides.into_iter().all(Cell::is_open) && sides.contains(&Cell::Liquid) {
                    velocity[((z * ny + y) * nx + at[0]) as usize][axis] = faces.len() as u32;
                    faces.push((axis, at));
                }
            }
        }
        Self {
            case: *case,
            velocity,
            cells,
            faces,
        }
    }

    fn unknown(&self, (axis, at): Face) -> u32 {
        if self.case.at(at) == Cell::Outside {
            return NONE;
        }
        let ([x, y, z], [nx, ny, _]) = (at.map(|i| i as usize), self.case.cells);
        self.velocity[(z * ny + y) * nx + x][axis]
    }

    fn assemble(&self) -> Result<Problem, SolveError> {
        let (n, cells, case) = (self.faces.len(), self.cells.len(), &self.case);
        let compressibility = case.viscosity / (case.bulk_modulus * TIME_STEP);
        let of_cells = |of: &dyn Fn(Point) -> f64| self.cells.iter().map(|&at| of(at)).collect();
        let none = || RowEntries::default();
        let a = Csr::assemble(n, n, |face, entries| {
            self.momentum_row(self.faces[face], entries);
        })?;
        Ok(Problem {
            block: VelocityBlock::assemble(n, |face, entries| add_row(a.row(face), entries))?,
            a,
            g: Csr::assemble(cells, n, |cell, entries| {
                self.flux_row(self.cells[cell], entries);
            })?,
            c: vec![compressibility; cells],
            friction: self.faces.iter().map(|&face| case.friction(face)).collect(),
            b: (self.faces.iter())
                .map(|&face| self.momentum_row(face, &mut none()))
                .collect(),
            carried: vec![0.0; cells],
            volume_source: of_cells(&|at| self.flux_row(at, &mut none())),
        })
    }

    /// Row of `A` for a face; returns its right-hand side.
    fn momentum_row(&self, face: Face, entries: &mut RowEntries) -> f64 {
        let ((axis, at), case) = (face, &self.case);
        let row = self.unknown(face) as usize;
        entries.add(row, INERTIA / case.viscosity * case.liquid(face)[0]);
        let mut rhs = 0.0;
        // The stress has a positive coefficient for every second face and a negative one for the others.
        let mut add = |weight: f64, faces: &[Face]| {
            let mine = faces.iter().position(|&other| other == face);
            for (i, &other) in faces.iter().enumerate() {
                let same = mine.is_some_and(|mine| mine % 2 == i % 2);
                let value = if same { weight } else { -weight };
                match self.unknown(other) {
                    NONE => rhs -= value * case.closed_velocity(other),
                    id => entries.add(id as usize, value),
                }
            }
        };
        for cell in case.sides(face) {
            let stiffness = 2.0 * case.viscosity(cell);
            add(stiffness, &[(axis, cell), (axis, shift(cell, axis, 1))]);
        }
        for tangent in (0..3).filter(|&t| t != axis) {
            for up in [0, 1] {
                // The corner at the low side of both axes.
                let corner = shift(at, tangent, up);
                let faces = [
                    (axis, shift(corner, tangent, -1)),
                    (axis, corner),
                    (tangent, shift(corner, axis, -1)),
                    (tangent, corner),
                ];
                let around = [faces[0], faces[1]].map(|face| case.liquid(face)[1]);
                let stiffness = 0.5 * (around[0] + around[1]);
                let flows = faces.map(|face| self.unknown(face) != NONE);
                match flows {
                    [true, true, true, true] => add(stiffness, &faces),
                    [true, true, ..] => add(stiffness, &faces[..2]),
                    _ => {}
                }
            }
        }
        if case.friction {
            rhs += self.walls(face, row, entries);
        }
        rhs
    }

    /// Friction of the walls beside a face, for each half of it; returns the drag of the upper block.
    fn walls(&self, face: Face, row: usize, entries: &mut RowEntries) -> f64 {
        let ((axis, at), case) = (face, &self.case);
        let mut rhs = 0.0;
        for tangent in (0..3).filter(|&t| t != axis) {
            for step in [-1, 1] {
                let beside = shift(at, tangent, step);
                for half in [beside, shift(beside, axis, -1)].map(|at| case.at(at)) {
                    if half.is_body() {
                        let stiffness = 0.5 * case.liquid(face)[1] / DISTANCE;
                        entries.add(row, stiffness);
                        if axis == 1 && half == Cell::Top {
                            rhs += stiffness * SPEED;
                        }
                    }
                }
            }
        }
        rhs
    }

    /// Row of `G` for a cell; returns its volume source.
    fn flux_row(&self, at: Point, entries: &mut RowEntries) -> f64 {
        let mut source = 0.0;
        for axis in 0..3 {
            for (position, sign) in [(at, -1.0), (shift(at, axis, 1), 1.0)] {
                match self.unknown((axis, position)) {
                    NONE => source -= sign * self.case.closed_velocity((axis, position)),
                    id => entries.add(id as usize, sign),
                }
            }
        }
        source
    }
}
