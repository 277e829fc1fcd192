//! The explicit scheme at its least, written to be read first: the material point method (Sulsky, Chen
//! & Schreyer, 10.1016/0045-7825(94)90112-0) with the FLIP update (Brackbill & Ruppel,
//! 10.1016/0021-9991(86)90211-1) and uniform GIMP (Bardenhagen & Kober, 10.3970/cmes.2004.005.477)
//! for a drop of Newtonian liquid in free flight, in three dimensions. No bodies, no sides, no
//! options.
//!
//! [`Explicit`](crate::Explicit) with FLIP gives the same drop to the last bit, because both sum in
//! the same order; what it needs more instructions for is what a scene pays for features that it does
//! not use (`make leave-out`). The numbers of the steps are those of docs/methods.md section 2.3.
//!
//! Lengths are in cells, masses and volumes in those of a cell at J = 1, velocities in m/s. Stress is
//! over density (m2/s2), so that mass and volume at J = 1 are one number.

mod points;
mod tiles;

use physics::{Boundary, Dimensions, Failure, LiquidState, Scene, Viscosity};
use rayon::prelude::*;

use crate::fields::point::VOLUME;
use crate::lanes::{Lanes4, Lanes8};
use crate::lattice::{EDGE, HALO};
use crate::real::Real;
use crate::simd::dispatch;
use crate::step::CHECK_EVERY;
use points::{Law, Moves, NodesToPoints, Point, PointsToNodes, Stresses};
use tiles::{Block, Tile, Tiles};

/// A drop in free flight.
pub struct Minimal {
    /// The scene; its points are in `tiles`.
    scene: Scene,
    law: Law,
    /// Time step over the smaller of its two limits.
    cfl: f64,
    limit_s: f64,
    steps: u64,
    grid: Tiles,
    tiles: Vec<Tile>,
    blocks: Vec<Block>,
}

impl Minimal {
    /// The drop of `scene` at the start, to be followed with the Courant number `cfl`, at most 1.
    ///
    /// # Errors
    /// What the scene asks for that is left out here.
    pub fn new(scene: &Scene, cfl: f64) -> Result<Self, String> {
        let Viscosity::Newtonian(viscosity) = scene.liquid.viscosity else {
            return Err("the viscosity is not constant".into());
        };
        let free = scene.dimensions == Dimensions::Three
            && scene.boundary == [Boundary::Open; 3]
            && scene.bodies.is_empty()
            && scene.gravity == [0.0; 3]
            && scene.liquid.cavitation_pressure.is_none();
        if !(free && cfl > 0.0 && cfl <= 1.0) {
            return Err("the scene is not a free drop in three dimensions".into());
        }
        let grid = Tiles::new(scene.grid.cells);
        let mut minimal = Self {
            law: Law::new(&scene.liquid, viscosity, scene.grid.cell_m),
            cfl,
            limit_s: limit(scene, scene.initial_speed(), 0.0),
            steps: 0,
            tiles: vec![Tile::default(); grid.count()],
            blocks: vec![[Lanes8::ZERO; EDGE * EDGE * EDGE]; grid.count()],
            grid,
            scene: scene.clone(),
        };
        minimal.place().map_err(|failure| failure.0)?;
        minimal.scene.points = Default::default();
        Ok(minimal)
    }

    /// Takes one step of at most `longest` (s) and gives its length (s).
    ///
    /// # Errors
    /// A drop that is unstable, or that has come to a side of the domain.
    pub fn step(&mut self, longest: f64) -> Result<f64, Failure> {
        let dt = (self.cfl * self.limit_s).min(longest);
        let dt_over_cell = (dt / self.scene.grid.cell_m) as Real;
        // 2. Points to nodes.
        let full = (self.tiles.par_iter_mut()).filter(|tile| !tile.points.id.is_empty());
        full.for_each(|tile| {
            tile.points.gather_runs();
            dispatch(PointsToNodes { tile, dt_over_cell });
        });
        // 3. Momentum at nodes.
        let (grid, tiles) = (&self.grid, &self.tiles);
        let inner = grid.inner();
        self.blocks[inner.clone()]
            .par_iter_mut()
            .zip(inner)
            .for_each(|(block, b)| advance_nodes(block, &grid.sums(b, tiles)));
        // 6 to 8. Nodes to points, stress, move.
        let (blocks, law) = (&self.blocks, &self.law);
        self.tiles.par_iter_mut().enumerate().for_each(|(t, tile)| {
            grid.gather(t, tile, blocks);
            dispatch(NodesToPoints { tile, dt_over_cell });
            let dt = dt as Real;
            dispatch(Stresses { tile, law, dt });
            dispatch(Moves(tile));
        });
        self.deliver()?;
        self.steps += 1;
        if self.steps.is_multiple_of(CHECK_EVERY) {
            self.check()?;
        }
        Ok(dt)
    }

    /// Puts the scene's points into the tiles of their nearest nodes.
    fn place(&mut self) -> Result<(), Failure> {
        let (cell, min) = (self.scene.grid.cell_m, self.scene.grid.min_m);
        let points = &self.scene.points;
        for (id, (x, v)) in points.position.iter().zip(&points.velocity).enumerate() {
            let at: [f64; 3] = std::array::from_fn(|a| (x[a] - min[a]) / cell);
            let node = at.map(|x| x.round() as i32);
            let [x, y, z] = std::array::from_fn(|a| (at[a] - f64::from(node[a])) as Real);
            let mass = (points.volume[id] / cell.powi(3)) as Real;
            let [vx, vy, vz] = v.map(|v| v as Real);
            let point = Point {
                id: id as u32,
                place: Lanes4([x, y, z, mass]),
                motion: Lanes4([vx, vy, vz, 0.0]),
                stress: Lanes8::ZERO,
            };
            self.grid.insert(&mut self.tiles, node, point)?;
        }
        Ok(())
    }

    /// Brings the points that left their tiles to where they are now, in the order of the tiles.
    fn deliver(&mut self) -> Result<(), Failure> {
        for t in self.grid.inner() {
            let origin = self.grid.origin(t);
            for (node, point) in std::mem::take(&mut self.tiles[t].leaving) {
                let node = std::array::from_fn(|a| origin[a] + node[a]);
                self.grid.insert(&mut self.tiles, node, point)?;
            }
        }
        Ok(())
    }

    /// Renews the limit of the time step by the fastest and the most compressed point.
    fn check(&mut self) -> Result<(), Failure> {
        let (mut fastest, mut least): (f64, Real) = (0.0, 0.0);
        for points in self.tiles.iter().map(|tile| &tile.points) {
            for (motion, id) in points.motion.iter().zip(&points.id) {
                let [vx, vy, vz, j] = motion.0;
                let square = f64::from(vx * vx + vy * vy + vz * vz);
                if !(square + f64::from(j)).is_finite() {
                    return Err(Failure(format!("liquid point {id} is unstable")));
                }
                fastest = fastest.max(square);
                least = least.min(j);
            }
        }
        self.limit_s = limit(&self.scene, fastest.sqrt(), f64::from(least));
        Ok(())
    }

    /// The drop after the last step, its points in the scene's order; no shear rates.
    pub fn liquid(&self) -> LiquidState {
        let (cell, min) = (self.scene.grid.cell_m, self.scene.grid.min_m);
        let mut order: Vec<(u32, usize, usize)> = Vec::new();
        for (t, tile) in self.tiles.iter().enumerate() {
            let ids = tile.points.id.iter().enumerate();
            order.extend(ids.map(|(p, &id)| (id, t, p)));
        }
        order.sort_unstable();
        let density = self.scene.liquid.density as Real;
        let mut state = LiquidState::default();
        for (_, t, p) in order {
            let (points, origin) = (&self.tiles[t].points, self.grid.origin(t));
            let (node, place) = (points.node(p), points.place[p].0);
            let metres = |a: usize| {
                let offset = f64::from(origin[a] + node[a]) + f64::from(place[a]);
                (min[a] + offset * cell) as f32
            };
            let [vx, vy, vz, j] = points.motion[p].0;
            let volume = f64::from(place[VOLUME]) * cell.powi(3) * (1.0 + f64::from(j));
            state.position.push(std::array::from_fn(metres));
            state.velocity.push([vx, vy, vz].map(|v| v as f32));
            state.volume.push(volume as f32);
            let pressure = self.law.pressure(j) * density;
            state.pressure.push(pressure as f32);
        }
        state
    }
}

/// Largest stable step (s) at Courant number 1: a sound wave and the fastest point, or else the
/// diffusion of momentum, cross no cell in it. The speed of sound is that of the smallest j = J - 1.
fn limit(scene: &Scene, speed: f64, j: f64) -> f64 {
    let (cell, liquid) = (scene.grid.cell_m, &scene.liquid);
    let sound = (liquid.tait.stiffness(j.min(0.0)) / liquid.density).sqrt();
    let viscous = match &liquid.viscosity {
        Viscosity::Newtonian(law) => liquid.density * cell * cell / (8.0 * law.0),
        Viscosity::Table(_) | Viscosity::Law(_) => f64::INFINITY,
    };
    (cell / (sound + speed)).min(viscous)
}

/// Velocities of a block's nodes from the sums over points: v+ = (momentum + impulse)/mass in lanes 0
/// to 2, the change of velocity that FLIP gives to the points in lanes 4 to 6.
fn advance_nodes(block: &mut Block, sums: &Block) {
    for (velocity, sum) in block.iter_mut().zip(sums) {
        let [momentum @ .., mass, _, _, _, _] = sum.0;
        let [_, _, _, _, impulse @ .., _] = sum.0;
        *velocity = Lanes8::ZERO;
        if mass > 0.0 {
            for a in 0..3 {
                let before = momentum[a] / mass;
                let after = before + impulse[a] / mass;
                velocity.0[a] = after;
                velocity.0[4 + a] = after - before;
            }
        }
    }
}
