//! Which tiles and blocks exist and how they are linked.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use rayon::prelude::*;

use crate::lanes::Lanes8;
use crate::lattice::{EDGE, HALO, Lattice, block_index};
use crate::nodes::Block;
use crate::stages::Present;
use crate::tiles::{Point, Span, Tile, base_of, bases};
use crate::walls::{BlockShape, Integrator, NearBody, Rows};

/// Tiles where liquid is and the blocks of nodes that it reaches, both ordered by key, which
/// fixes the order of every sum.
pub(crate) struct Grid {
    pub(crate) lattice: Lattice,
    pub(crate) tiles: Vec<Tile>,
    pub(crate) blocks: Vec<Block>,
    block_keys: Vec<u64>,
    tile_of: HashMap<u64, usize>,
    bodies: usize,
    /// Of each body.
    rows: Vec<Rows>,
    present: Present,
    /// Tiles changed since the bodies' reach was marked on them.
    unseen: bool,
}

impl Grid {
    pub(crate) fn new(lattice: Lattice, bodies: usize, present: Present) -> Self {
        Self {
            lattice,
            tiles: Vec::new(),
            blocks: Vec::new(),
            block_keys: Vec::new(),
            tile_of: HashMap::new(),
            bodies,
            rows: Vec::new(),
            present,
            unseen: true,
        }
    }

    /// An empty grid made like `other`.
    pub(crate) fn like(other: &Self) -> Self {
        Self::new(other.lattice.clone(), other.bodies, other.present)
    }

    /// Adds points with their nearest nodes, making tiles as needed.
    pub(crate) fn insert(&mut self, points: impl IntoIterator<Item = ([i32; 3], Point)>) {
        let mut new: BTreeMap<u64, Tile> = BTreeMap::new();
        for (node, point) in points {
            let key = self.lattice.tile_key(node);
            let tile = match self.tile_of.get(&key) {
                Some(&t) => &mut self.tiles[t],
                None => new
                    .entry(key)
                    .or_insert_with(|| Tile::new(key, &self.lattice, self.present, self.bodies)),
            };
            let origin = tile.origin;
            let base = base_of(std::array::from_fn(|a| node[a] - origin[a]));
            tile.points.push(&point, base, self.present.affine);
        }
        if new.is_empty() {
            return;
        }
        self.tiles.retain(|tile| tile.points.len() > 0);
        self.tiles.extend(new.into_values());
        self.tiles.sort_by_key(|tile| tile.key);
        self.link();
        self.unseen = true;
    }

    /// Delivers the points that left their tiles, in tile order.
    pub(crate) fn deliver(&mut self) {
        let mut leaving = Vec::new();
        for tile in &mut self.tiles {
            leaving.append(&mut tile.leaving);
        }
        self.insert(leaving);
    }

    /// Rebuilds the links between tiles and blocks.
    fn link(&mut self) {
        let lattice = &self.lattice;
        self.tile_of = self
            .tiles
            .iter()
            .enumerate()
            .map(|(t, tile)| (tile.key, t))
            .collect();
        let mut old: HashMap<u64, Block> = self
            .block_keys
            .drain(..)
            .zip(self.blocks.drain(..))
            .collect();
        let places = self
            .tiles
            .iter()
            .flat_map(|tile| halo(tile.origin, lattice));
        let keys = places.flatten().map(|(key, ..)| key);
        self.block_keys = distinct(keys).into_iter().collect();
        let mut index = HashMap::with_capacity(self.block_keys.len());
        for (b, &key) in self.block_keys.iter().enumerate() {
            index.insert(key, b);
            self.blocks.push(
                old.remove(&key)
                    .unwrap_or_else(|| Block::new(key, lattice, self.bodies, self.present)),
            );
        }
        for block in &mut self.blocks {
            block.spans.clear();
        }
        for (t, tile) in self.tiles.iter_mut().enumerate() {
            tile.spans.clear();
            for (local, place) in halo(tile.origin, lattice).enumerate() {
                let Some((key, node, flip)) = place else {
                    continue;
                };
                let b = index[&key] as u32;
                if let Some(last) = tile.spans.last_mut()
                    && (last.other, last.flip, flip) == (b, 0, 0)
                    && (last.entries().end, last.nodes().end) == (local, node)
                {
                    last.len += 1;
                    continue;
                }
                tile.spans.push(Span {
                    other: b,
                    local: local as u8,
                    node: node as u8,
                    len: 1,
                    flip,
                });
            }
            for span in &tile.spans {
                let other = t as u32;
                self.blocks[span.other as usize]
                    .spans
                    .push(Span { other, ..*span });
            }
        }
    }

    /// Integrals of the bodies, displaced by `shifts` (cells) and whether each ever moves, at the nodes.
    #[inline(never)] // `make leave-out` counts its instructions by its name
    pub(crate) fn see_bodies(
        &mut self,
        parts: &[Vec<BlockShape>],
        shifts: &[([f64; 3], bool)],
        integrator: &Integrator,
    ) {
        let low = self.blocks.iter().map(|block| block.origin[1]);
        let nodes = low.clone().min().unwrap_or(0)..low.max().unwrap_or(0) + EDGE as i32;
        self.rows.resize_with(parts.len(), Rows::default);
        for ((rows, parts), &(shift, _)) in self.rows.iter_mut().zip(parts).zip(shifts) {
            if !rows.are_of(shift, &nodes) {
                *rows = Rows::new(parts, shift, nodes.clone(), integrator);
            }
        }
        let rows = &self.rows;
        let changed = (self.blocks.par_iter_mut())
            .map(|block| see(block, parts, shifts, rows, integrator))
            .reduce(|| false, |a, b| a | b);
        if changed || self.unseen {
            self.unseen = false;
            self.mark_walls();
        }
    }

    /// Marks the cells of every tile from which a body is within reach, and makes room for what contact needs
    /// where there is one.
    fn mark_walls(&mut self) {
        let layers = if self.lattice.three { 3 } else { 1 };
        for tile in &mut self.tiles {
            let mut at = vec![false; self.lattice.halo_len()];
            tile.bodies = 0;
            for span in &tile.spans {
                let walls = &self.blocks[span.other as usize].walls;
                for (near, node) in at[span.entries()].iter_mut().zip(span.nodes()) {
                    for (body, wall) in walls.iter().enumerate() {
                        if wall.near >> node & 1 == 1 {
                            *near = true;
                            tile.bodies |= 1 << body;
                        }
                    }
                }
            }
            let sums = if tile.bodies == 0 { 0 } else { at.len() };
            if tile.wall_local.len() != sums {
                tile.wall_local = vec![Lanes8::ZERO; sums];
            }
            for base in bases(&self.lattice) {
                let base = usize::from(base);
                tile.near_wall[base] = (0..layers)
                    .any(|z| (0..3).any(|y| (0..3).any(|x| at[base + (z * HALO + y) * HALO + x])));
            }
        }
    }
}

/// Brings what a block knows of the bodies to their displacements (cells); says whether the
/// nodes within their reach changed.
fn see(
    block: &mut Block,
    parts: &[Vec<BlockShape>],
    shifts: &[([f64; 3], bool)],
    rows: &[Rows],
    integrator: &Integrator,
) -> bool {
    let mut changed = false;
    for (body, (parts, &(shift, moves))) in parts.iter().zip(shifts).enumerate() {
        match block.walls.get_mut(body) {
            None => {
                block
                    .walls
                    .push(NearBody::new(parts, block.origin, shift, integrator));
                changed = true;
            }
            Some(near) if near.is_stale(shift) => {
                *near = NearBody::new(parts, block.origin, shift, integrator);
                changed = true;
            }
            Some(_) => {}
        }
        block.walls[body].update(&rows[body], block.origin, moves);
    }
    changed
}

/// The keys in order, each once; most of the list repeat the one before.
fn distinct(keys: impl Iterator<Item = u64>) -> BTreeSet<u64> {
    let (mut set, mut last) = (BTreeSet::new(), None);
    for key in keys {
        if last.replace(key) != Some(key) {
            set.insert(key);
        }
    }
    set
}

/// Block key, node in the block and mirrored axes of every halo node of the tile whose lowest node is
/// `origin`.
fn halo(origin: [i32; 3], lattice: &Lattice) -> impl Iterator<Item = Option<(u64, usize, u8)>> {
    (0..lattice.halo_len()).map(move |local| {
        let depth = if lattice.three {
            (local / (HALO * HALO)) as i32 - 1
        } else {
            0
        };
        let folded = lattice.fold([
            origin[0] + (local % HALO) as i32 - 1,
            origin[1] + (local / HALO % HALO) as i32 - 1,
            origin[2] + depth,
        ])?;
        let key = lattice.tile_key(folded.node);
        let lowest = lattice.tile_origin(key);
        let within = std::array::from_fn(|a| folded.node[a] - lowest[a]);
        Some((key, block_index(within), folded.flip))
    })
}
