//! Liquid points, grouped by the tile of nodes that they are nearest to.

use std::ops::Range;

use crate::gradient::Gradient;
use crate::lanes::{Lanes4, Lanes8};
use crate::lattice::{EDGE, HALO, Lattice, block_node};
use crate::real::Real;
use crate::runs::{reorder, run_order};
use crate::stages::Present;

/// All that one point carries; the unit in which points move between tiles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) id: u32,
    /// Offset from the nearest node (cells) and volume at J = 1 (cells).
    pub(crate) place: Lanes4,
    /// Velocity (m/s) and j = J - 1.
    pub(crate) motion: Lanes4,
    /// Stress over density (m2/s2): xx yy zz xy xz yz, then shear rate (1/s) and viscosity
    /// over density (m2/s).
    pub(crate) stress: Lanes8,
    /// Affine velocity field (m/s per cell): its derivative along x, y, z. APIC only.
    pub(crate) affine: [Lanes4; 3],
}

/// Points of a tile in flat arrays of equal length.
#[derive(Clone, Debug, Default)]
pub(crate) struct Points {
    pub(crate) id: Vec<u32>,
    /// Where the 3 x 3 x 3 nodes of a point begin in its tile's halo.
    pub(crate) base: Vec<u16>,
    pub(crate) place: Vec<Lanes4>,
    pub(crate) motion: Vec<Lanes4>,
    pub(crate) stress: Vec<Lanes8>,
    /// Empty unless APIC.
    pub(crate) affine: Vec<[Lanes4; 3]>,
    /// Points came, went or changed node since they were last brought together: few do in a step.
    pub(crate) scattered: bool,
}

/// What a thread keeps of one tile while it works on it.
#[derive(Default)]
pub(crate) struct Scratch {
    /// Nodal values of the tile's halo.
    pub(crate) field: Vec<Lanes8>,
    /// Displacement of each point in this step (cells), which adds to its place: none of the volume.
    pub(crate) shift: Vec<Lanes4>,
    pub(crate) gradient: Gradient,
}

/// Does the same to every array of points but `affine`.
macro_rules! each {
    ($points:ident, |$list:ident| $does:expr) => {{
        let Points {
            id,
            base,
            place,
            motion,
            stress,
            affine: _,
            scattered: _,
        } = $points;
        each!($list, $does, id base place motion stress);
    }};
    ($list:ident, $does:expr, $($array:ident)*) => {
        $({
            let $list = $array;
            $does;
        })*
    };
}

impl Points {
    pub(crate) fn len(&self) -> usize {
        self.id.len()
    }

    pub(crate) fn push(&mut self, point: &Point, base: u16, affine: bool) {
        self.scattered = true;
        if self.len() == self.id.capacity() {
            // An eighth more: points are most of a run's memory, which doubling would half waste.
            let more = self.len() / 8 + 8;
            each!(self, |list| list.reserve_exact(more));
            if affine {
                self.affine.reserve_exact(more);
            }
        }
        self.id.push(point.id);
        self.base.push(base);
        self.place.push(point.place);
        self.motion.push(point.motion);
        self.stress.push(point.stress);
        if affine {
            self.affine.push(point.affine);
        }
    }

    pub(crate) fn get(&self, p: usize) -> Point {
        Point {
            id: self.id[p],
            place: self.place[p],
            motion: self.motion[p],
            stress: self.stress[p],
            affine: self.affine.get(p).copied().unwrap_or([Lanes4::ZERO; 3]),
        }
    }

    /// Brings the points of each node together where moves have scattered them.
    pub(crate) fn gather_runs(&mut self) {
        if !std::mem::take(&mut self.scattered) {
            return;
        }
        if let Some(order) = run_order(&self.base) {
            each!(self, |list| reorder(list, &order));
            if !self.affine.is_empty() {
                reorder(&mut self.affine, &order);
            }
        }
    }

    pub(crate) fn swap_remove(&mut self, p: usize) {
        self.scattered = true;
        each!(self, |list| list.swap_remove(p));
        if !self.affine.is_empty() {
            self.affine.swap_remove(p);
        }
    }
}

/// What the points of a cell add up to: volume at J = 1 (cells) and that times j = J - 1.
pub(crate) type CellSum = [Real; 2];

/// Entries of a tile's halo that follow one another and so do the nodes of a block that they stand for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    /// The block, or seen from the block the tile.
    pub(crate) other: u32,
    /// First entry of the halo.
    pub(crate) local: u8,
    /// First node of the block.
    pub(crate) node: u8,
    pub(crate) len: u8,
    /// Mirrored axes.
    pub(crate) flip: u8,
}

impl Span {
    /// The entries of the halo.
    #[inline(always)]
    pub(crate) fn entries(&self) -> Range<usize> {
        usize::from(self.local)..usize::from(self.local) + usize::from(self.len)
    }

    /// The nodes of the block.
    #[inline(always)]
    pub(crate) fn nodes(&self) -> Range<usize> {
        usize::from(self.node)..usize::from(self.node) + usize::from(self.len)
    }

    /// Does `with` to each of `to` with that of `from`, both as long as the span. Most spans are a row of a block
    /// or its end: loops of a length that the compiler knows.
    #[inline(always)]
    pub(crate) fn each<A, B>(&self, to: &mut [A], from: &[B], with: impl Fn(&mut A, &B)) {
        if let (Ok(to), Ok(from)) = (
            <&mut [A; EDGE]>::try_from(&mut *to),
            <&[B; EDGE]>::try_from(from),
        ) {
            for i in 0..EDGE {
                with(&mut to[i], &from[i]);
            }
        } else if let ([to], [from]) = (&mut *to, from) {
            with(to, from);
        } else {
            for (to, from) in to.iter_mut().zip(from) {
                with(to, from);
            }
        }
    }

    /// The mirrored axes.
    pub(crate) fn mirrored(&self) -> impl Iterator<Item = usize> {
        (0..3).filter(|a| self.flip & (1 << a) != 0)
    }
}

/// What the collision of points with bodies did in one step, summed over a tile.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Hits {
    pub(crate) count: u64,
    pub(crate) trapped: u64,
}

/// A tile: points whose nearest nodes are its 4 x 4 x 4 nodes, and the values of these and the
/// adjacent nodes while its points work on them.
#[derive(Clone, Debug)]
pub(crate) struct Tile {
    pub(crate) key: u64,
    /// Its lowest node.
    pub(crate) origin: [i32; 3],
    pub(crate) points: Points,
    /// Where the nodes of the halo are; those out of every point's reach are in none.
    pub(crate) spans: Vec<Span>,
    /// Sums over this tile's points.
    pub(crate) local: Vec<Lanes8>,
    /// Sums that contact needs; empty where no body is within reach.
    pub(crate) wall_local: Vec<Lanes8>,
    /// Sums of the velocity filter over this tile's points; empty without one.
    pub(crate) filtered: Vec<Lanes4>,
    /// Sums over this tile's points by cell, at the lowest node of each, or whole sums gathered
    /// for them; empty unless the pressure is a cell's.
    pub(crate) cells: Vec<CellSum>,
    /// Per window base: a body is within reach of these nodes.
    pub(crate) near_wall: Vec<bool>,
    /// Per window base: sides of the domain that the node is on, bit a for the low and 3 + a for the high one along
    /// axis a; empty where none is.
    pub(crate) sides: Vec<u8>,
    /// Bodies within reach, bit b for body b.
    pub(crate) bodies: u64,
    /// Points that leave: target node and point, in order of departure.
    pub(crate) leaving: Vec<([i32; 3], Point)>,
    /// Points that left through an open side in this step.
    pub(crate) lost: u64,
    pub(crate) hits: Hits,
    /// Impulse of collisions on each body in this step, density cell^3 m/s.
    pub(crate) push: Vec<[f64; 3]>,
}

impl Tile {
    pub(crate) fn new(key: u64, lattice: &Lattice, present: Present, bodies: usize) -> Self {
        let n = lattice.halo_len();
        let origin = lattice.tile_origin(key);
        let mut sides = vec![0; n];
        for i in 0..lattice.block_len() {
            let local = block_node(i);
            for a in 0..lattice.axes() {
                let node = origin[a] + local[a];
                let (low, high) = (node <= 0, node >= lattice.cells[a]);
                sides[usize::from(base_of(local))] |=
                    u8::from(low) << a | u8::from(high) << (3 + a);
            }
        }
        if sides.iter().all(|&sides| sides == 0) {
            sides = Vec::new();
        }
        Self {
            key,
            origin,
            sides,
            points: Points::default(),
            spans: Vec::new(),
            local: vec![Lanes8::ZERO; n],
            wall_local: Vec::new(),
            filtered: vec![Lanes4::ZERO; if present.filter { n } else { 0 }],
            cells: vec![[0.0; 2]; if present.cell_mean { n } else { 0 }],
            near_wall: vec![false; n],
            bodies: 0,
            leaving: Vec::new(),
            lost: 0,
            hits: Hits::default(),
            push: vec![[0.0; 3]; bodies],
        }
    }

    /// The node nearest to the points with window base `base`.
    #[inline]
    pub(crate) fn node_of(&self, base: u16) -> [i32; 3] {
        let b = usize::from(base);
        [
            self.origin[0] + (b % HALO) as i32,
            self.origin[1] + (b / HALO % HALO) as i32,
            self.origin[2] + (b / (HALO * HALO)) as i32,
        ]
    }
}

/// Window base of the tile-local node (x, y, z), each 0..4.
#[inline]
pub(crate) fn base_of(local: [i32; 3]) -> u16 {
    ((local[2] * HALO as i32 + local[1]) * HALO as i32 + local[0]) as u16
}

/// All window bases of a tile.
pub(crate) fn bases(lattice: &Lattice) -> impl Iterator<Item = u16> {
    (0..lattice.block_len()).map(|i| base_of(block_node(i)))
}
