//! Moving the points, and keeping them out of the bodies.
//!
//! Contact at nodes blurs a wall over about a cell. That is not enough for wood: behind a wall
//! one voxel thick a node's velocity is the liquid's on either side, and points leak through. So
//! a point may not enter a solid voxel: its path is followed axis by axis, stopped at the
//! first face, and the impulse goes to the body. Every such stop is counted.

use physics::Boundary;

use crate::fields::point::VOLUME;
use crate::lanes::Lanes4;
use crate::lattice::{EDGE, HALO, Lattice, nearest};
use crate::real::Real;
use crate::simd::{Kernel, dispatch};
use crate::tiles::{Tile, base_of};
use crate::walls::BlockShape;

/// A body while points move: its parts and where it is.
pub(crate) struct Obstacle<'a> {
    pub(crate) parts: &'a [BlockShape],
    /// Displacement (cells) at the start and the end of the step.
    pub(crate) from: [f64; 3],
    pub(crate) to: [f64; 3],
    /// Velocity, m/s.
    pub(crate) velocity: [Real; 3],
}

impl Obstacle<'_> {
    /// Whether it holds a point at the end of the step.
    pub(crate) fn contains(&self, node: [i32; 3], d: &Lanes4, lattice: &Lattice) -> bool {
        let mut parts = self.parts.iter();
        parts.any(|part| part.contains(node, d, &self.to, lattice))
    }
}

/// The first point whose displacement is not a number or 0.9 of a cell or longer.
pub(crate) type Fault = Option<u32>;

/// Of two tiles' faults the one of the lowest point.
pub(crate) fn first_fault(a: Fault, b: Fault) -> Fault {
    a.into_iter().chain(b).min()
}

/// Moves all points of a tile by their displacements `shift` (cells) and sorts out those that leave.
pub(crate) fn move_points(
    tile: &mut Tile,
    shift: &mut Vec<Lanes4>,
    lattice: &Lattice,
    bodies: &[Obstacle],
) -> Fault {
    tile.lost = 0;
    tile.hits = Default::default();
    tile.push.fill([0.0; 3]);
    let mut fault = None;
    dispatch(Move {
        tile,
        shift,
        lattice,
        bodies,
        fault: &mut fault,
    });
    fault
}

struct Move<'a> {
    tile: &'a mut Tile,
    shift: &'a mut Vec<Lanes4>,
    lattice: &'a Lattice,
    bodies: &'a [Obstacle<'a>],
    fault: &'a mut Fault,
}

impl Kernel for Move<'_> {
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        if self.tile.bodies == 0 && self.tile.sides.is_empty() {
            self.each::<FMA, true>();
        } else {
            self.each::<FMA, false>();
        }
    }
}

impl Move<'_> {
    /// Most points stay with their node and far from every face; the others go one by one. `FREE` where the
    /// tile is at no side and out of every body's reach.
    #[inline(always)]
    fn each<const FMA: bool, const FREE: bool>(self) {
        let Self {
            tile,
            shift: shifts,
            lattice,
            bodies,
            fault,
        } = self;
        let grids: Vec<FaceGrid> = faces(tile, lattice, bodies);
        let axes = lattice.axes();
        let nearest = nearest(axes);
        let (mut here, mut local) = (usize::MAX, [0.0; 4]);
        let mut p = 0;
        while p < tile.points.len() {
            let shift = shifts[p];
            let d = tile.points.place[p].plus::<FMA>(shift);
            let base = usize::from(tile.points.base[p]);
            if base != here {
                (here, local) = (base, local_of(base));
            }
            let clear = FREE || !tile.near_wall[base] || far(&grids, &local, &d, &shift);
            let beyond = !FREE && tile.sides.get(base).is_some_and(|&sides| leaves(sides, &d));
            if clear && !beyond && d.is_within(nearest) {
                tile.points.place[p] = d;
                p += 1;
            } else if !(0..axes).all(|a| shift.0[a].abs() < 0.9) {
                *fault = Some(tile.points.id[p]);
                return;
            } else if move_point(tile, p, d, lattice, if clear { &[] } else { bodies }) {
                p += 1;
            } else {
                shifts.swap_remove(p);
            }
        }
    }
}

/// Faces of a block's voxels in the coordinates of a tile: offset from its lowest node (cells)
/// times `scale` plus `origin` is an integer on a face.
struct FaceGrid {
    scale: Lanes4,
    origin: Lanes4,
    /// How far (voxels) the block moves in the step, and a margin for rounding.
    margin: Lanes4,
}

/// The face grids of the bodies near a tile.
fn faces(tile: &Tile, lattice: &Lattice, bodies: &[Obstacle]) -> Vec<FaceGrid> {
    let near = bodies
        .iter()
        .enumerate()
        .filter(|(b, _)| tile.bodies >> b & 1 == 1);
    near.flat_map(|(_, body)| body.parts.iter().map(move |part| (body, part)))
        .map(|(body, part)| {
            let (mut scale, mut origin, mut margin) =
                (Lanes4::ZERO, Lanes4([0.5; 4]), Lanes4::ZERO);
            for a in 0..3 {
                let inverse = 1.0 / part.voxel[a];
                let low = (f64::from(tile.origin[a]) - body.to[a] - part.origin[a]) * inverse;
                let travel = (body.to[a] - body.from[a]).abs() * inverse;
                scale.0[a] = inverse as Real;
                origin.0[a] = (low - low.floor()) as Real;
                // Through a periodic side faces need not repeat: look at every point there.
                let periodic = lattice.boundary[a] == Boundary::Periodic;
                margin.0[a] = if periodic { 1.0 } else { travel as Real + 1e-4 };
            }
            FaceGrid {
                scale,
                origin,
                margin,
            }
        })
        .collect()
}

/// The tile-local node of window base `base`, and nothing beside it.
#[inline(always)]
fn local_of(base: usize) -> [Real; 4] {
    [
        (base % HALO) as Real,
        (base / HALO % HALO) as Real,
        (base / (HALO * HALO)) as Real,
        0.0,
    ]
}

/// Whether a point at `d` from a node is beyond one of the sides that the node is on (`Tile::sides`).
#[inline(always)]
fn leaves(sides: u8, d: &Lanes4) -> bool {
    let low = |a: usize| sides >> a & 1 == 1 && d.0[a] < 0.0;
    let high = |a: usize| sides >> (3 + a) & 1 == 1 && d.0[a] > 0.0;
    sides != 0 && (0..3).any(|a| low(a) || high(a))
}

/// Whether a point at `d` from the tile-local node `local` after moving by `shift` cannot have crossed a
/// face. In whole vectors: the fourth lane, of no axis, is half way between faces.
#[inline(always)]
fn far(grids: &[FaceGrid], local: &[Real; 4], d: &Lanes4, shift: &Lanes4) -> bool {
    let mut clear = true;
    for grid in grids {
        let mut room = [0.0; 4];
        for a in 0..4 {
            let x = (local[a] + d.0[a]) * grid.scale.0[a] + grid.origin.0[a];
            let off_middle = (x - x.floor() - 0.5).abs();
            let margin = shift.0[a].abs() * grid.scale.0[a] + grid.margin.0[a];
            room[a] = 0.5 - off_middle - margin;
        }
        clear &= (room[0] > 0.0) & (room[1] > 0.0) & (room[2] > 0.0) & (room[3] > 0.0);
    }
    clear
}

/// Moves point `p` to offset `d` from its old node, through the faces of `bodies`, nodes and
/// sides; says whether it still is in the tile.
#[inline(never)]
fn move_point(
    tile: &mut Tile,
    p: usize,
    mut d: Lanes4,
    lattice: &Lattice,
    bodies: &[Obstacle],
) -> bool {
    let mut node = tile.node_of(tile.points.base[p]);
    if !bodies.is_empty() {
        collide(tile, p, node, &mut d, lattice, bodies);
    }
    let inside = settle(tile, p, &mut node, &mut d, lattice);
    tile.points.place[p] = d;
    if !inside {
        tile.lost += 1;
        tile.points.swap_remove(p);
        return false;
    }
    let local: [i32; 3] = std::array::from_fn(|a| node[a] - tile.origin[a]);
    let mut axes = local[..lattice.axes()].iter();
    let stays = axes.all(|l| (0..EDGE as i32).contains(l));
    if stays {
        let base = base_of(local);
        tile.points.scattered |= tile.points.base[p] != base;
        tile.points.base[p] = base;
    } else {
        tile.leaving.push((node, tile.points.get(p)));
        tile.points.swap_remove(p);
    }
    stays
}

/// Finds the nearest node and applies the sides; says whether the point is still inside.
#[inline]
fn settle(
    tile: &mut Tile,
    p: usize,
    node: &mut [i32; 3],
    d: &mut Lanes4,
    lattice: &Lattice,
) -> bool {
    for a in 0..lattice.axes() {
        let n = lattice.cells[a];
        let outside = (node[a] == 0 && d.0[a] < 0.0) || (node[a] == n && d.0[a] > 0.0);
        if outside && lattice.boundary[a] == Boundary::Symmetry {
            d.0[a] = -d.0[a];
            tile.points.motion[p].0[a] = -tile.points.motion[p].0[a];
        }
        if outside && lattice.boundary[a] == Boundary::Open {
            return false;
        }
        if d.0[a] >= 0.5 {
            d.0[a] -= 1.0;
            node[a] += 1;
        } else if d.0[a] < -0.5 {
            d.0[a] += 1.0;
            node[a] -= 1;
        }
        if lattice.boundary[a] == Boundary::Periodic {
            node[a] = node[a].rem_euclid(n);
        }
    }
    true
}

/// Keeps point `p` out of the bodies on its way to offset `d` from `node`.
fn collide(
    tile: &mut Tile,
    p: usize,
    node: [i32; 3],
    d: &mut Lanes4,
    lattice: &Lattice,
    bodies: &[Obstacle],
) {
    let start = tile.points.place[p];
    let mass = f64::from(start.0[VOLUME]);
    let mut hit = false;
    for (b, body) in bodies.iter().enumerate() {
        if tile.bodies >> b & 1 == 0 {
            continue;
        }
        for part in body.parts {
            let stops = part.sweep(node, &start, d, (&body.from, &body.to), lattice);
            let Some(stops) = stops else { continue };
            hit = true;
            let v = &mut tile.points.motion[p].0;
            for a in 0..3 {
                // Stopped going up: no faster than the body; going down: no slower.
                let slip = v[a] - body.velocity[a];
                if Real::from(stops[a]) * slip > 0.0 {
                    tile.push[b][a] += mass * f64::from(slip);
                    v[a] = body.velocity[a];
                }
            }
        }
    }
    if hit {
        tile.hits.count += 1;
        let trapped = bodies.iter().any(|body| body.contains(node, d, lattice));
        tile.hits.trapped += u64::from(trapped);
    }
}

#[cfg(test)]
mod tests;
