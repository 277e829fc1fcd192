//! Staggered operators of the test problem: viscous stresses of cells and edges, mass, wall
//! friction, fluxes and compressibility, scaled by the reference viscosity.

mod shear;

use super::{Case, Cell, Wood};
use saddle_point::{Csr, RowEntries, SaddleSystem, SolveError, VelocityBlock};

/// Cell edge, m; density, kg/m3; time step, s; speed of the upper block, m/s.
const EDGE: f64 = 2.9e-6;
const DENSITY: f64 = 1200.0;
const TIME_STEP: f64 = 1e-6;
const SPEED: f64 = -1.0;
/// Widths of lumens are capped at this many cells.
const WIDEST: i64 = 40;
const NONE: u32 = u32::MAX;

/// An assembled problem.
pub struct Problem {
    pub a: Csr<f64>,
    /// The same, for the solver.
    pub block: VelocityBlock,
    pub g: Csr<f64>,
    pub c: Vec<f64>,
    pub friction: Vec<f64>,
    pub two_eta: Vec<f64>,
    pub b: Vec<f64>,
    pub volume_source: Vec<f64>,
    pub carried: Vec<f64>,
}

impl Problem {
    pub fn new(case: &Case) -> Result<Self, SolveError> {
        Stokes::new(case).assemble()
    }

    pub fn system(&self) -> SaddleSystem<'_> {
        SaddleSystem {
            a: &self.block,
            g: &self.g,
            pockets: 0,
            standing: &[],
            clinging: &[],
            slow: 0.0,
            c: &self.c,
            friction: &self.friction,
            two_eta: &self.two_eta,
            b: &self.b,
            volume_source: &self.volume_source,
            carried: &self.carried,
        }
    }
}

/// The matrix as the solver takes it.
fn block(a: &Csr<f64>) -> Result<VelocityBlock, SolveError> {
    VelocityBlock::assemble(a.n_rows(), |row, entries| {
        let (columns, values) = a.row(row);
        for (&column, &value) in columns.iter().zip(values) {
            entries.add(column as usize, value);
        }
    })
}

type Point = [i64; 3];

fn shift(mut at: Point, axis: usize, by: i64) -> Point {
    at[axis] += by;
    at
}

struct Face {
    axis: usize,
    at: Point,
}

struct Stokes {
    case: Case,
    wood: Wood,
    /// Velocity unknown of every cell's three lower faces.
    velocity: Vec<[u32; 3]>,
    cells: Vec<Point>,
    faces: Vec<Face>,
}

impl Stokes {
    fn new(case: &Case) -> Self {
        let wood = Wood::new(case);
        let mut stokes = Self {
            case: *case,
            velocity: vec![[NONE; 3]; wood.cell.len()],
            cells: Vec::new(),
            faces: Vec::new(),
            wood,
        };
        stokes.number();
        stokes
    }

    /// Numbers the unknowns along grid lines, one velocity component after the other on each line:
    /// neighbouring rows then couple to equal distances.
    fn number(&mut self) {
        let [nx, ny, nz] = self.wood.n.map(|n| n as i64);
        for (z, y) in (0..nz).flat_map(|z| (0..ny).map(move |y| (z, y))) {
            let line = (0..nx).map(|x| [x, y, z]);
            let liquid = line.clone().filter(|&at| self.wood.at(at) == Cell::Liquid);
            self.cells.extend(liquid);
            for axis in 0..3 {
                for at in line.clone() {
                    if self.is_active(axis, at) {
                        let index = self.wood.index(at.map(|v| v as usize));
                        self.velocity[index][axis] = self.faces.len() as u32;
                        self.faces.push(Face { axis, at });
                    }
                }
            }
        }
    }

    /// Whether the lower face of a cell along `axis` is open and wet.
    fn is_active(&self, axis: usize, at: Point) -> bool {
        let sides = [self.wood.at(at), self.wood.at(shift(at, axis, -1))];
        sides.into_iter().all(Cell::is_open) && sides.contains(&Cell::Liquid)
    }

    fn assemble(&self) -> Result<Problem, SolveError> {
        let n = self.faces.len();
        let eta = self.case.viscosity;
        let cells = self.cells.len();
        let compressibility = eta / (self.case.bulk_modulus * TIME_STEP);
        let a = Csr::assemble(n, n, |face, entries| {
            self.momentum_row(face, entries);
        })?;
        let g = Csr::assemble(cells, n, |cell, entries| {
            self.flux_row(cell, entries);
        })?;
        Ok(Problem {
            block: block(&a)?,
            a,
            g,
            c: self
                .cells
                .iter()
                .map(|&at| compressibility * self.open(at))
                .collect(),
            friction: (0..n)
                .map(|face| self.friction(&self.faces[face]))
                .collect(),
            two_eta: self
                .cells
                .iter()
                .map(|&at| 2.0 * self.viscosity(at))
                .collect(),
            b: (0..n)
                .map(|face| self.momentum_row(face, &mut RowEntries::default()))
                .collect(),
            carried: vec![0.0; cells],
            volume_source: (0..cells)
                .map(|cell| self.flux_row(cell, &mut RowEntries::default()))
                .collect(),
        })
    }

    fn face(&self, axis: usize, at: Point) -> u32 {
        match self.wood.at(at) {
            Cell::Outside => NONE,
            _ => self.velocity[self.wood.index(at.map(|v| v as usize))][axis],
        }
    }

    /// Velocity of a closed face: that of the upper block where it touches it.
    fn closed_velocity(&self, axis: usize, at: Point) -> f64 {
        let touches =
            self.wood.at(at) == Cell::Top || self.wood.at(shift(at, axis, -1)) == Cell::Top;
        if axis == 1 && touches { SPEED } else { 0.0 }
    }

    /// Viscosity over the reference.
    fn viscosity(&self, at: Point) -> f64 {
        let wave = |axis: usize, period: f64| {
            (0.5 * std::f64::consts::TAU * at[axis] as f64 / period)
                .sin()
                .powi(2)
        };
        let exponent = (wave(0, 8.0) + wave(1, 11.0) + wave(2, 37.0)) / 3.0;
        self.case.contrast.powf(exponent)
    }

    /// Open fraction of a cell.
    fn open(&self, at: Point) -> f64 {
        let cut = at[1] + 1 == self.wood.top as i64
            && self.wood.at(at) == Cell::Liquid
            && self.wood.at(shift(at, 1, 1)) == Cell::Top;
        if cut { self.case.sliver } else { 1.0 }
    }

    fn inverse_time(&self) -> f64 {
        DENSITY * EDGE * EDGE / (self.case.viscosity * TIME_STEP)
    }

    /// The liquid cells on both sides of a face.
    fn sides(&self, face: &Face) -> impl Iterator<Item = Point> {
        [shift(face.at, face.axis, -1), face.at]
            .into_iter()
            .filter(|&at| self.wood.at(at) == Cell::Liquid)
    }

    fn volume(&self, face: &Face) -> f64 {
        self.sides(face).map(|at| 0.5 * self.open(at)).sum()
    }

    fn mean_viscosity(&self, face: &Face) -> f64 {
        let sum: f64 = self.sides(face).map(|at| self.viscosity(at)).sum();
        sum / self.sides(face).count() as f64
    }

    /// Row of `A` for a face; returns its right-hand side.
    fn momentum_row(&self, row: usize, entries: &mut RowEntries) -> f64 {
        let face = &self.faces[row];
        let axis = face.axis;
        let mut rhs = 0.0;
        entries.add(row, self.inverse_time() * self.volume(face));
        // Normal stress of the cells on both sides.
        for (side, far) in [(-1, -1), (0, 1)] {
            let cell = shift(face.at, axis, side);
            if self.wood.at(cell) != Cell::Liquid {
                continue;
            }
            let stiffness = 2.0 * self.viscosity(cell) * self.open(cell);
            let other = shift(face.at, axis, far);
            entries.add(row, stiffness);
            match self.face(axis, other) {
                NONE => rhs += stiffness * self.closed_velocity(axis, other),
                id => entries.add(id as usize, -stiffness),
            }
        }
        for tangent in (0..3).filter(|&t| t != axis) {
            for up in [0, 1] {
                rhs += self.shear(row, axis, tangent, shift(face.at, tangent, up), entries);
            }
            rhs += self.wall(row, face, tangent, entries);
        }
        rhs
    }

    /// Friction of the walls beside a face along one tangent.
    fn wall(&self, row: usize, face: &Face, tangent: usize, entries: &mut RowEntries) -> f64 {
        if !self.case.friction {
            return 0.0;
        }
        let mut rhs = 0.0;
        for step in [-1, 1] {
            let beside = shift(face.at, tangent, step);
            let halves = [beside, shift(beside, face.axis, -1)].map(|at| self.wood.at(at));
            let walls = halves.into_iter().filter(|half| half.is_body()).count();
            if walls == 0 {
                continue;
            }
            let width = self.width(face, tangent);
            let open = self.volume(face) / self.sides(face).count() as f64 * 2.0;
            let distance = open * (0.5 - 1.0 / (3.0 * width));
            let wet = 0.5 * self.sides(face).count() as f64;
            let stiffness = self.mean_viscosity(face) * 0.5 * walls as f64 / distance * wet;
            entries.add(row, stiffness);
            if face.axis == 1 && halves.contains(&Cell::Top) {
                rhs += stiffness * SPEED;
            }
        }
        rhs
    }

    /// Free length along `tangent` through a face.
    fn width(&self, face: &Face, tangent: usize) -> f64 {
        let mut length = 1;
        for step in [-1, 1] {
            for far in 1..WIDEST {
                let beside = shift(face.at, tangent, step * far);
                let pair = [beside, shift(beside, face.axis, -1)].map(|at| self.wood.at(at));
                if pair.contains(&Cell::Outside) {
                    return WIDEST as f64;
                }
                if pair.into_iter().any(Cell::is_body) {
                    break;
                }
                length += 1;
            }
        }
        length.min(WIDEST) as f64
    }

    /// Friction and inertia of the liquid around a face, for the pressure preconditioner.
    fn friction(&self, face: &Face) -> f64 {
        let lumen: f64 = (0..3)
            .filter(|&tangent| tangent != face.axis)
            .map(|tangent| 12.0 / self.width(face, tangent).powi(2))
            .sum();
        let lumen = if self.case.friction { lumen } else { 0.0 };
        self.volume(face) * (self.inverse_time() + self.mean_viscosity(face) * lumen)
    }

    /// Row of `G` for a cell; returns its volume source.
    fn flux_row(&self, row: usize, entries: &mut RowEntries) -> f64 {
        let at = self.cells[row];
        let mut source = 0.0;
        for axis in 0..3 {
            for (position, sign) in [(at, -1.0), (shift(at, axis, 1), 1.0)] {
                match self.face(axis, position) {
                    NONE => source -= sign * self.closed_velocity(axis, position),
                    id => {
                        let narrowest = if axis == 1 {
                            1.0
                        } else {
                            let neighbour = shift(position, axis, -1);
                            self.open(position).min(self.open(neighbour))
                        };
                        entries.add(id as usize, sign * narrowest);
                    }
                }
            }
        }
        source
    }
}
