//! The cells that liquid touches: how much of it, how much room, and which faces are open.

use physics::Boundary;

use super::covered::covered;
use crate::collide::Obstacle;
use crate::fields::point::{J, VOLUME};
use crate::lanes::Lanes4;
use crate::lattice::{EDGE, Lattice};
use crate::real::Real;
use crate::tiles::Tile;

/// Fraction of the density error that one projection removes; this and the next four are by trial. Half or twice of it
/// changes the pressure in a slit by 8 and 5 %.
const KAPPA: f64 = 0.5;
/// Largest relative error that counts.
const CLIP: f64 = 0.3;
/// Liquid over room from which a cell resists; below, it is air with spray. Half or twice of it: 1 and 8 %.
const FULL: f64 = 0.5;
/// Open part of a cell below which it counts as wall. Half or twice of it: 1 and 7 %.
const SLIVER: f64 = 0.1;
/// Longest displacement, cells.
const LONGEST: f64 = 0.25;

/// No cell.
pub(super) const NONE: u32 = u32::MAX;
/// Thickness (cells) of the layers whose open part is a face's: thin against a voxel, thick against rounding.
const SKIN: f64 = 1e-6;

/// One cell that liquid touches.
#[derive(Clone, Debug, Default)]
pub(super) struct Cell {
    /// Liquid volume, cells.
    liquid: f64,
    /// Open volume, cells.
    room: f64,
    /// The cells across its low and high faces, [`NONE`] for air and walls.
    pub(super) next: [[u32; 2]; 3],
    /// Open areas of these faces, cells^2.
    pub(super) area: [[f64; 2]; 3],
    /// Whether psi is an unknown here; it is 0 elsewhere.
    pub(super) full: bool,
    /// Volume to be pushed out, cells.
    pub(super) source: f64,
    /// Potential of the displacement, cells^2.
    pub(super) psi: f64,
}

/// The cells that liquid touches.
pub(super) struct Cells<'a> {
    lattice: &'a Lattice,
    low: [i32; 3],
    dims: [usize; 3],
    /// Index in `list` of every cell of the window.
    index: Vec<u32>,
    pub(super) list: Vec<Cell>,
}

impl<'a> Cells<'a> {
    /// The cells around the points of `tiles`, with their density errors.
    pub(super) fn new(tiles: &[Tile], lattice: &'a Lattice, bodies: &[Obstacle]) -> Self {
        let (low, dims) = window(tiles, lattice);
        let mut cells = Self {
            lattice,
            low,
            dims,
            index: vec![NONE; dims.iter().product()],
            list: Vec::new(),
        };
        cells.deposit(tiles, bodies);
        cells.link(bodies);
        cells
    }

    /// Place in the window of a cell, after the sides have been applied.
    fn place(&self, mut cell: [i32; 3]) -> Option<usize> {
        let mut place = 0;
        for a in (0..3).rev() {
            let n = self.lattice.cells[a];
            if a < self.lattice.axes() {
                match self.lattice.boundary[a] {
                    Boundary::Periodic => cell[a] = cell[a].rem_euclid(n),
                    Boundary::Symmetry if cell[a] < 0 => cell[a] = -1 - cell[a],
                    Boundary::Symmetry if cell[a] >= n => cell[a] = 2 * n - 1 - cell[a],
                    _ => {}
                }
            } else {
                cell[a] = 0;
            }
            let within = usize::try_from(cell[a] - self.low[a]).ok()?;
            if within >= self.dims[a] {
                return None;
            }
            place = place * self.dims[a] + within;
        }
        Some(place)
    }

    fn at(&self, cell: [i32; 3]) -> u32 {
        self.place(cell).map_or(NONE, |place| self.index[place])
    }

    /// Index of a cell, listed with its room when it is met first; `None` outside the grid.
    fn meet(&mut self, cell: [i32; 3], bodies: &[Obstacle]) -> Option<usize> {
        let place = self.place(cell)?;
        if self.index[place] == NONE {
            self.index[place] = self.list.len() as u32;
            let own = self.cell_at(place);
            let low = own.map(f64::from);
            self.list.push(Cell {
                room: 1.0 - covered(low, low.map(|x| x + 1.0), bodies, self.lattice),
                ..Cell::default()
            });
        }
        Some(self.index[place] as usize)
    }

    fn cell_at(&self, place: usize) -> [i32; 3] {
        let [x, y, _] = self.dims;
        let within = [place % x, place / x % y, place / (x * y)];
        std::array::from_fn(|a| self.low[a] + within[a] as i32)
    }

    /// Every point's volume as a cube around it, shared among the cells it overlaps; what would
    /// lie in walls stays in the point's own cell.
    fn deposit(&mut self, tiles: &[Tile], bodies: &[Obstacle]) {
        let axes = self.lattice.axes();
        for tile in tiles {
            for p in 0..tile.points.len() {
                let node = tile.node_of(tile.points.base[p]);
                let d = tile.points.place[p].0.map(f64::from);
                let volume = d[VOLUME] * (1.0 + f64::from(tile.points.motion[p].0[J]));
                let half = 0.5 * volume.max(0.0).powf(1.0 / axes as f64).min(1.0);
                let (own, part) = own_cell(node, &tile.points.place[p]);
                let Some(home) = self.meet(own, bodies) else {
                    continue;
                };
                for corner in 0..1_usize << axes {
                    let (mut cell, mut share) = (own, volume);
                    for a in 0..axes {
                        let below = (half - part[a]).max(0.0);
                        let above = (part[a] + half - 1.0).max(0.0);
                        // A cube of at most one cell reaches over one face of an axis or,
                        // a whole cell wide, over none.
                        let (side, over) = if below > above {
                            (-1, below)
                        } else {
                            (1, above)
                        };
                        let over = over / (2.0 * half).max(f64::MIN_POSITIVE);
                        if corner >> a & 1 == 1 {
                            cell[a] += side;
                            share *= over;
                        } else {
                            share *= 1.0 - over;
                        }
                    }
                    if share <= 0.0 {
                        continue;
                    }
                    let to = self
                        .meet(cell, bodies)
                        .filter(|&c| self.list[c].room > SLIVER)
                        .unwrap_or(home);
                    self.list[to].liquid += share;
                }
            }
        }
    }

    /// Finds open faces, full cells and what is to be pushed out of them.
    fn link(&mut self, bodies: &[Obstacle]) {
        for cell in &mut self.list {
            cell.full = cell.room > SLIVER && cell.liquid >= FULL * cell.room;
        }
        for place in 0..self.index.len() {
            let c = self.index[place];
            if c != NONE {
                let own = self.cell_at(place);
                for a in 0..self.lattice.axes() {
                    for side in 0..2 {
                        self.face(c as usize, own, a, side, bodies);
                    }
                }
                let cell = &mut self.list[c as usize];
                let error = (cell.liquid / cell.room.max(SLIVER) - 1.0).clamp(-CLIP, CLIP);
                // A cell next to air is not too thin but partly filled.
                let surface = (0..3).any(|a| {
                    (0..2).any(|side| cell.area[a][side] > 0.0 && cell.next[a][side] == NONE)
                });
                if cell.full && !(surface && error < 0.0) {
                    cell.source = KAPPA * error * cell.room;
                }
            }
        }
    }

    /// The face of cell `c` (at `own`) on `side` (0 low, 1 high) of axis `a`.
    fn face(&mut self, c: usize, own: [i32; 3], a: usize, side: usize, bodies: &[Obstacle]) {
        let mut beyond = own;
        beyond[a] += if side == 0 { -1 } else { 1 };
        let at_side = beyond[a] < 0 || beyond[a] >= self.lattice.cells[a];
        let closed = at_side && self.lattice.boundary[a] == Boundary::Symmetry;
        let next = self.at(beyond);
        let room = |c: u32| (c != NONE).then(|| self.list[c as usize].room);
        let sliver = room(next).is_some_and(|room| room <= SLIVER);
        let area = if closed || sliver || self.list[c].room <= SLIVER {
            0.0
        } else if self.list[c].room == 1.0 && room(next) == Some(1.0) {
            1.0
        } else {
            let plane = f64::from(own[a] + side as i32);
            let open = |from: f64, to: f64| {
                let mut low = own.map(f64::from);
                let mut high = low.map(|x| x + 1.0);
                (low[a], high[a]) = (from, to);
                1.0 - covered(low, high, bodies, self.lattice) / SKIN
            };
            open(plane - SKIN, plane).min(open(plane, plane + SKIN))
        };
        let full = next != NONE && self.list[next as usize].full;
        let cell = &mut self.list[c];
        // Rounding of a covered face is no opening.
        cell.area[a][side] = if area > 1e-3 { area } else { 0.0 };
        cell.next[a][side] = if full && area > 1e-3 { next } else { NONE };
    }

    /// Displacement on a face of a cell along its axis.
    fn on_face(&self, c: usize, a: usize, side: usize) -> f64 {
        let cell = &self.list[c];
        if cell.area[a][side] == 0.0 {
            return 0.0;
        }
        let next = cell.next[a][side];
        let psi = if next == NONE {
            0.0
        } else {
            self.list[next as usize].psi
        };
        let outward = (cell.psi - psi).clamp(-LONGEST, LONGEST);
        if side == 0 { -outward } else { outward }
    }

    /// Displacement (cells) of a point: linear between the faces of its cell.
    pub(super) fn displacement(&self, node: [i32; 3], d: &Lanes4) -> Lanes4 {
        let (own, part) = own_cell(node, d);
        let c = self.at(own);
        let mut shift = Lanes4::ZERO;
        if c != NONE {
            for a in 0..self.lattice.axes() {
                let (low, high) = (
                    self.on_face(c as usize, a, 0),
                    self.on_face(c as usize, a, 1),
                );
                shift.0[a] = (low + part[a] * (high - low)) as Real;
            }
        }
        shift
    }
}

/// The cell a point is in and its place there, 0 to 1.
fn own_cell(node: [i32; 3], d: &Lanes4) -> ([i32; 3], [f64; 3]) {
    let mut own = node;
    let part = std::array::from_fn(|a| {
        if d.0[a] < 0.0 {
            own[a] -= 1;
            1.0 + f64::from(d.0[a])
        } else {
            f64::from(d.0[a])
        }
    });
    (own, part)
}

/// Lowest cell and size of the box that holds all cells the points of `tiles` can touch; the
/// whole grid along periodic axes, so that neighbours are found through the sides.
fn window(tiles: &[Tile], lattice: &Lattice) -> ([i32; 3], [usize; 3]) {
    let axes = lattice.axes();
    let (mut low, mut dims) = ([0; 3], [1; 3]);
    for a in 0..axes {
        let n = lattice.cells[a];
        let origins = || tiles.iter().map(|tile| tile.origin[a]);
        let (mut first, mut last) = (
            origins().min().unwrap_or(0) - 2,
            origins().max().unwrap_or(0) + EDGE as i32 + 1,
        );
        if lattice.boundary[a] == Boundary::Periodic {
            (first, last) = (0, n - 1);
        }
        low[a] = first.clamp(0, n - 1);
        dims[a] = (last.clamp(0, n - 1) - low[a] + 1) as usize;
    }
    (low, dims)
}
