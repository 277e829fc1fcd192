//! Staggered operators of the test problem: viscous stresses of cells and edges, mass, wall
//! friction, fluxes and compressibility, scaled by the reference viscosity.

use super::{Case, Cell, Point, Wood, add_row, shift};
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

    /// Of fluxes `g`, with friction of `stiffness` at faces and nothing else, of cells that yield by `c`, at rest.
    pub fn still(g: Csr<f64>, stiffness: impl Fn(usize) -> f64 + Sync, c: f64) -> Self {
        let (faces, cells) = (g.n_columns(), g.n_rows());
        let fill = |row: usize, entries: &mut RowEntries| entries.add(row, stiffness(row));
        Self {
            a: Csr::assemble(faces, faces, fill).unwrap(),
            block: VelocityBlock::assemble(faces, fill).unwrap(),
            g,
            c: vec![c; cells],
            friction: (0..faces).map(&stiffness).collect(),
            two_eta: vec![stiffness(0); cells],
            b: vec![0.0; faces],
            volume_source: vec![0.0; cells],
            carried: vec![0.0; cells],
        }
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

    /// Velocities and pressures at rest.
    pub fn rest(&self) -> (Vec<f64>, Vec<f64>) {
        (vec![0.0; self.b.len()], vec![0.0; self.c.len()])
    }
}

/// A face across an axis, the lower one of a cell.
type Face = (usize, Point);

struct Stokes {
    case: Case,
    wood: Wood,
    /// Velocity unknown of every cell's three lower faces.
    velocity: Vec<[u32; 3]>,
    cells: Vec<Point>,
    faces: Vec<Face>,
}

impl Stokes {
    /// Numbers the unknowns along grid lines, one velocity component after the other on each line:
    /// neighbouring rows then couple to equal distances.
    fn new(case: &Case) -> Self {
        let wood = Wood::new(case);
        let mut velocity = vec![[NONE; 3]; wood.cell.len()];
        let (mut cells, mut faces) = (Vec::new(), Vec::new());
        let [nx, ny, nz] = wood.n.map(|n| n as i64);
        for (z, y) in (0..nz).flat_map(|z| (0..ny).map(move |y| (z, y))) {
            let line = (0..nx).map(|x| [x, y, z]);
            cells.extend(line.clone().filter(|&at| wood.at(at) == Cell::Liquid));
            for axis in [0, 1, 2] {
                for at in line.clone() {
                    let sides = [wood.at(at), wood.at(shift(at, axis, -1))];
                    if sides.into_iter().all(Cell::is_open) && sides.contains(&Cell::Liquid) {
                        velocity[wood.index(at)][axis] = faces.len() as u32;
                        faces.push((axis, at));
                    }
                }
            }
        }
        Self {
            case: *case,
            wood,
            velocity,
            cells,
            faces,
        }
    }

    fn assemble(&self) -> Result<Problem, SolveError> {
        let (n, cells) = (self.faces.len(), self.cells.len());
        let compressibility = self.case.viscosity / (self.case.bulk_modulus * TIME_STEP);
        let of_cells = |of: &dyn Fn(Point) -> f64| self.cells.iter().map(|&at| of(at)).collect();
        let a = Csr::assemble(n, n, |face, entries| {
            self.momentum_row(self.faces[face], entries);
        })?;
        Ok(Problem {
            block: VelocityBlock::assemble(n, |face, entries| add_row(a.row(face), entries))?,
            a,
            g: Csr::assemble(cells, n, |cell, entries| {
                self.flux_row(self.cells[cell], entries);
            })?,
            c: of_cells(&|at| compressibility * self.open(at)),
            friction: self.faces.iter().map(|&face| self.friction(face)).collect(),
            two_eta: of_cells(&|at| 2.0 * self.viscosity(at)),
            b: (self.faces.iter())
                .map(|&face| self.momentum_row(face, &mut RowEntries::default()))
                .collect(),
            carried: vec![0.0; cells],
            volume_source: (self.cells.iter())
                .map(|&at| self.flux_row(at, &mut RowEntries::default()))
                .collect(),
        })
    }

    fn unknown(&self, (axis, at): Face) -> u32 {
        match self.wood.at(at) {
            Cell::Outside => NONE,
            _ => self.velocity[self.wood.index(at)][axis],
        }
    }

    /// Velocity of a closed face: that of the upper block where it touches it.
    fn closed_velocity(&self, (axis, at): Face) -> f64 {
        let sides = [at, shift(at, axis, -1)].map(|at| self.wood.at(at));
        if axis == 1 && sides.contains(&Cell::Top) {
            SPEED
        } else {
            0.0
        }
    }

    /// Viscosity over the reference.
    fn viscosity(&self, at: Point) -> f64 {
        let wave = |axis: usize, period: f64| {
            let half = 0.5 * std::f64::consts::TAU * at[axis] as f64 / period;
            half.sin().powi(2)
        };
        let exponent = (wave(0, 8.0) + wave(1, 11.0) + wave(2, 37.0)) / 3.0;
        self.case.contrast.powf(exponent)
    }

    /// Open fraction of a cell.
    fn open(&self, at: Point) -> f64 {
        let cut = at[1] + 1 == self.wood.top
            && self.wood.at(at) == Cell::Liquid
            && self.wood.at(shift(at, 1, 1)) == Cell::Top;
        if cut { self.case.sliver } else { 1.0 }
    }

    fn inverse_time(&self) -> f64 {
        DENSITY * EDGE * EDGE / (self.case.viscosity * TIME_STEP)
    }

    /// The liquid cells on both sides of a face.
    fn sides(&self, (axis, at): Face) -> impl Iterator<Item = Point> {
        let sides = [shift(at, axis, -1), at].into_iter();
        sides.filter(|&at| self.wood.at(at) == Cell::Liquid)
    }

    fn volume(&self, face: Face) -> f64 {
        self.sides(face).map(|at| 0.5 * self.open(at)).sum()
    }

    fn mean_viscosity(&self, face: Face) -> f64 {
        let sum: f64 = self.sides(face).map(|at| self.viscosity(at)).sum();
        sum / self.sides(face).count() as f64
    }

    /// Row of `A` for a face; returns its right-hand side.
    fn momentum_row(&self, face: Face, entries: &mut RowEntries) -> f64 {
        let (axis, at) = face;
        let row = self.unknown(face) as usize;
        entries.add(row, self.inverse_time() * self.volume(face));
        let mut rhs = 0.0;
        // A stress that grows with every second face's velocity and falls with that of the others.
        let mut add = |weight: f64, faces: &[Face]| {
            let mine = faces.iter().position(|&other| other == face);
            for (i, &other) in faces.iter().enumerate() {
                let value = if mine.is_some_and(|mine| mine % 2 == i % 2) {
                    weight
                } else {
                    -weight
                };
                match self.unknown(other) {
                    NONE => rhs -= value * self.closed_velocity(other),
                    id => entries.add(id as usize, value),
                }
            }
        };
        for cell in self.sides(face) {
            let stiffness = 2.0 * self.viscosity(cell) * self.open(cell);
            add(stiffness, &[(axis, cell), (axis, shift(cell, axis, 1))]);
        }
        for tangent in (0..3).filter(|&t| t != axis) {
            for up in [0, 1] {
                let edge = self.edge(axis, tangent, shift(at, tangent, up));
                if let Some((faces, [common, rest])) = edge {
                    add(common, &faces);
                    add(rest, &faces[..2]);
                }
            }
        }
        for tangent in (0..3).filter(|&t| t != axis) {
            rhs += self.wall(face, tangent, row, entries);
        }
        rhs
    }

    /// The edge at the lower corner of cell `at` in the plane of two axes: lower and upper face of the first axis, of the second;
    /// weights of the shear stress common to both axes and of the rest of the first.
    fn edge(&self, axis: usize, tangent: usize, at: Point) -> Option<([Face; 4], [f64; 2])> {
        let (low_axis, low_tangent) = (shift(at, axis, -1), shift(at, tangent, -1));
        let corners = [at, low_axis, low_tangent, shift(low_axis, tangent, -1)];
        let kinds = corners.map(|corner| self.wood.at(corner));
        if kinds.contains(&Cell::Outside) || !kinds.contains(&Cell::Liquid) {
            return None;
        }
        let open = kinds.iter().filter(|kind| kind.is_open()).count() as f64;
        let liquid = (corners.into_iter()).filter(|&at| self.wood.at(at) == Cell::Liquid);
        let stiffness: f64 = liquid.map(|at| self.viscosity(at) * self.open(at)).sum();
        let faces = [
            (axis, low_tangent),
            (axis, at),
            (tangent, low_axis),
            (tangent, at),
        ];
        let [here, left, below, corner] = kinds.map(Cell::is_open);
        // Two parallel faces see each other through each half of the edge that has no wall, and not at all where one is
        // open but no unknown.
        let sees = |[a, b]: [(bool, bool); 2], of: &[Face]| {
            let half = |a: bool, b: bool| if a && b { 0.5 } else { 0.0 };
            let lost =
                |(low, high): (bool, bool), face: Face| low && high && self.unknown(face) == NONE;
            match lost(a, of[0]) || lost(b, of[1]) {
                true => 0.0,
                false => half(a.0, b.0) + half(a.1, b.1),
            }
        };
        let first = sees([(corner, below), (left, here)], &faces[..2]);
        let second = sees([(corner, left), (below, here)], &faces[2..]);
        let common = f64::min(first, second);
        Some((
            faces,
            [common, first - common].map(|w| w * stiffness / open),
        ))
    }

    /// Friction of the walls beside a face along one tangent.
    fn wall(&self, face: Face, tangent: usize, row: usize, entries: &mut RowEntries) -> f64 {
        let mut rhs = 0.0;
        for step in [-1, 1] {
            let halves = self.beside(face, tangent, step);
            let walls = halves.into_iter().filter(|half| half.is_body()).count();
            if walls == 0 || !self.case.friction {
                continue;
            }
            let sides = self.sides(face).count() as f64;
            let open = self.volume(face) / sides * 2.0;
            let distance = open * (0.5 - 1.0 / (3.0 * self.width(face, tangent)));
            let stiffness = self.mean_viscosity(face) * 0.25 * walls as f64 / distance * sides;
            entries.add(row, stiffness);
            if face.0 == 1 && halves.contains(&Cell::Top) {
                rhs += stiffness * SPEED;
            }
        }
        rhs
    }

    /// The cells on both sides of the face that is `far` cells along `tangent`.
    fn beside(&self, (axis, at): Face, tangent: usize, far: i64) -> [Cell; 2] {
        let beside = shift(at, tangent, far);
        [beside, shift(beside, axis, -1)].map(|at| self.wood.at(at))
    }

    /// Free length along `tangent` through a face.
    fn width(&self, face: Face, tangent: usize) -> f64 {
        let mut length = 1;
        for step in [-1, 1] {
            for far in 1..WIDEST {
                let pair = self.beside(face, tangent, step * far);
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
    fn friction(&self, face: Face) -> f64 {
        let tangents = (0..3).filter(|&tangent| tangent != face.0 && self.case.friction);
        let lumen: f64 = tangents
            .map(|tangent| 12.0 / self.width(face, tangent).powi(2))
            .sum();
        self.volume(face) * (self.inverse_time() + self.mean_viscosity(face) * lumen)
    }

    /// Row of `G` for a cell; returns its volume source.
    fn flux_row(&self, at: Point, entries: &mut RowEntries) -> f64 {
        let mut source = 0.0;
        for axis in 0..3 {
            for (position, sign) in [(at, -1.0), (shift(at, axis, 1), 1.0)] {
                let below = shift(position, axis, -1);
                match self.unknown((axis, position)) {
                    NONE => source -= sign * self.closed_velocity((axis, position)),
                    id if axis == 1 => entries.add(id as usize, sign),
                    id => {
                        let narrowest = self.open(position).min(self.open(below));
                        entries.add(id as usize, sign * narrowest);
                    }
                }
            }
        }
        source
    }
}
