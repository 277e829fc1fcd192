//! One time step; reads as the algorithm.

use std::time::Instant;

use physics::{Failure, Rheology, StepLimit, StepReport, Viscosity};
use rayon::prelude::*;

use crate::cell_mean::{equalise, share_rate};
use crate::collide::move_points;
use crate::explicit::Explicit;
use crate::nodes::{Block, Mode, NodeStep};
use crate::plan::acoustic_limit;
use crate::real::Real;
use crate::settings::{PressureFrom, VelocityUpdate};
use crate::tiles::{NOWHERE, Tile};
use crate::topology::unlink;
use crate::walls::{BlockShape, Integrator, NearBody};

/// Named stages whose time is reported.
#[derive(Clone, Copy)]
pub(crate) enum Stage {
    Bodies,
    PointsToNodes,
    Nodes,
    Filter,
    NodesToPoints,
    Sort,
}

impl Stage {
    pub(crate) const COUNT: usize = 6;
    pub(crate) const NAMES: [&'static str; Self::COUNT] = [
        "bodies at nodes",
        "points to nodes",
        "contact and momentum",
        "velocity filter",
        "nodes to points and stress",
        "sort and control",
    ];
}

/// Steps between checks of the whole state, which also renew the time step.
pub(crate) const CHECK_EVERY: u64 = 64;
/// Courant numbers of the two limits below which a point alone in its cells is stable with any
/// shape but the hat: dt 2 nu q < 1 and 3 (c dt)^2 q < 2, q at most 28/3 per cell^2, the sum over
/// nodes of slope^2 / weight of GIMP along an axis.
const ALONE_VISCOUS: f64 = 0.4;
const ALONE_ACOUSTIC: f64 = 0.25;
/// Relative volume changes j outside which Eq. 1 has no meaning.
const SOUND_J: std::ops::Range<Real> = -0.7..1.0;

impl Explicit {
    pub(crate) fn step(&mut self, limit: StepLimit) -> Result<StepReport, Failure> {
        let mut speed = self.control.as_ref().map_or(0.0, |control| control.speed());
        if limit.travel_m <= 0.0 {
            speed = 0.0;
        }
        let mut dt = (self.settings.cfl * self.state.limit_s).min(limit.time_s);
        if speed > 0.0 {
            dt = dt.min(limit.travel_m / speed);
        }
        let velocities = self.body_velocities(speed);
        let slow: Vec<[Real; 3]> = velocities.iter().map(|v| v.map(|v| v as Real)).collect();

        let mut clock = Instant::now();
        self.see_bodies();
        self.lap(Stage::Bodies, &mut clock);
        self.points_to_nodes(dt);
        self.lap(Stage::PointsToNodes, &mut clock);
        match self.scene.liquid.viscosity.clone() {
            Viscosity::Newtonian(law) => self.nodes(dt, &slow, &law, &mut clock),
            Viscosity::Table(law) => self.nodes(dt, &slow, &law, &mut clock),
        }
        let from = self.state.displacement.clone();
        for (x, v) in self.state.displacement.iter_mut().zip(&velocities) {
            for a in 0..3 {
                x[a] += v[a] * dt;
            }
        }
        self.nodes_to_points(dt, &from, &slow)?;
        self.lap(Stage::NodesToPoints, &mut clock);
        self.unseen |= self.grid.deliver();
        if self.settings.pressure == PressureFrom::CellMean {
            equalise(&mut self.grid, &self.stress);
        }
        self.state.step += 1;
        self.state.time_s += dt;
        self.state.travel_m += speed * dt;
        let report = self.report(dt, speed);
        self.steer(&report);
        self.project(dt)?;
        if self.state.step.is_multiple_of(CHECK_EVERY) {
            self.check()?;
        }
        self.lap(Stage::Sort, &mut clock);
        Ok(report)
    }

    fn lap(&mut self, stage: Stage, clock: &mut Instant) {
        let now = Instant::now();
        self.stage_s[stage as usize] += (now - *clock).as_secs_f64();
        *clock = now;
    }

    /// Integrals of the bodies at the nodes, for where the bodies are now.
    fn see_bodies(&mut self) {
        if self.parts.is_empty() {
            return;
        }
        let cell = self.scene.grid.cell_m;
        let shifts: Vec<[f64; 3]> = self
            .state
            .displacement
            .iter()
            .map(|x| x.map(|x| x / cell))
            .collect();
        let (parts, integrator) = (&self.parts, &self.integrator);
        let changed = self
            .grid
            .blocks
            .par_iter_mut()
            .map(|block| see(block, parts, &shifts, integrator))
            .reduce(|| false, |a, b| a | b);
        if changed || self.unseen {
            self.unseen = false;
            self.grid.mark_walls();
        }
    }

    fn points_to_nodes(&mut self, dt: f64) {
        let scale = (dt / self.scene.grid.cell_m) as Real;
        let p2g = self.kernels.p2g;
        self.grid
            .tiles
            .par_iter_mut()
            .for_each(|tile| p2g(tile, scale));
    }

    /// Contact, sides and momentum at the nodes, then the velocity filter.
    fn nodes<R: Rheology>(
        &mut self,
        dt: f64,
        velocities: &[[Real; 3]],
        rheology: &R,
        clock: &mut Instant,
    ) {
        let (cell, density) = (self.scene.grid.cell_m, self.scene.liquid.density);
        let mode = self.mode();
        let law = self.scene.wall;
        let separation = self.separation;
        let fall = self.scene.gravity.map(|g| (g * dt) as Real);
        let step = NodeStep {
            law,
            rheology,
            velocities,
            separation,
            fall,
            dt_over_mass: dt / (density * cell),
            mode,
        };
        let tiles = &self.grid.tiles;
        self.grid
            .blocks
            .par_iter_mut()
            .for_each(|block| block.advance(tiles, &step));
        self.lap(Stage::Nodes, clock);
        if let VelocityUpdate::Xpic(order) | VelocityUpdate::Fmpm(order) =
            self.settings.velocity_update
        {
            let filter = self.kernels.filter;
            for round in 2..=order {
                let blocks = &self.grid.blocks;
                let keep = round == 2 && mode == Mode::FilterBefore;
                self.grid.tiles.par_iter_mut().for_each(|tile| {
                    gather_filtered(tile, blocks);
                    filter(tile, keep);
                });
                let tiles = &self.grid.tiles;
                self.grid
                    .blocks
                    .par_iter_mut()
                    .for_each(|block| block.refine(tiles, &step));
            }
            self.lap(Stage::Filter, clock);
        }
    }

    /// Velocities, stress and positions of the points.
    fn nodes_to_points(
        &mut self,
        dt: f64,
        from: &[[f64; 3]],
        velocities: &[[Real; 3]],
    ) -> Result<(), Failure> {
        let mut tiles = std::mem::take(&mut self.grid.tiles);
        let bodies = self.obstacles(from, &self.state.displacement, velocities);
        let (blocks, lattice) = (&self.grid.blocks, &self.grid.lattice);
        let scale = (dt / self.scene.grid.cell_m) as Real;
        let shared = self.settings.pressure == PressureFrom::CellMean;
        let fault = tiles
            .par_iter_mut()
            .map(|tile| {
                gather_velocity(tile, blocks);
                (self.kernels.g2p)(tile, scale, self.settings.velocity_update);
                if shared {
                    share_rate(tile, lattice.axes());
                }
                self.flow.update(tile, &self.stress, dt as Real);
                move_points(tile, lattice, &bodies)
            })
            .reduce(|| None, |a, b| a.or(b).map(|x| b.map_or(x, |b| b.min(x))));
        self.grid.tiles = tiles;
        for tile in &self.grid.tiles {
            self.state.lost += tile.lost;
            self.state.corrections.stopped += tile.hits.count;
            self.state.corrections.trapped += tile.hits.trapped;
        }
        match fault {
            Some(id) => Err(Failure(format!(
                "step {}: liquid point {id} would move by more than 0.9 of a cell or its velocity is not finite: {}",
                self.state.step + 1,
                self.unstable(id)
            ))),
            None => Ok(()),
        }
    }

    /// Impulse on the bodies as pressure over the bond area.
    fn report(&self, dt: f64, speed: f64) -> StepReport {
        let (cell, density) = (self.scene.grid.cell_m, self.scene.liquid.density);
        let unit = density * cell.powi(3) / (dt * self.scene.grid.area_m2());
        let force = |body: Option<usize>, sign: f64| {
            body.map_or(0.0, |b| {
                let nodes: f64 = self
                    .grid
                    .blocks
                    .iter()
                    .map(|block| block.reaction[b][1])
                    .sum();
                let points: f64 = self.grid.tiles.iter().map(|tile| tile.push[b][1]).sum();
                sign * (nodes + points) * unit
            })
        };
        StepReport {
            dt_s: dt,
            closing_speed: speed,
            travel_m: self.state.travel_m,
            pressure_bottom: force(self.scene.bottom, -1.0),
            pressure_top: force(self.scene.top, 1.0),
            lost: self.state.lost,
            iterations: 0,
        }
    }

    /// Clamp control on the mean of the two pressures, which differ by the liquid's inertia.
    fn steer(&mut self, report: &StepReport) {
        let pressure = match (self.scene.bottom, self.scene.top) {
            (Some(_), Some(_)) => 0.5 * (report.pressure_bottom + report.pressure_top),
            (Some(_), None) => report.pressure_bottom,
            (None, Some(_)) => report.pressure_top,
            (None, None) => return,
        };
        if let Some(control) = &mut self.control {
            control.observe(pressure, report.dt_s);
        }
    }

    /// Checks all points: stops an unstable run and renews the limits of the time step.
    fn check(&mut self) -> Result<(), Failure> {
        let sound = self.scene.liquid.sound_speed();
        let (mut fastest, mut least): (f64, Real) = (0.0, 0.0);
        for tile in &self.grid.tiles {
            for (motion, id) in tile.points.motion.iter().zip(&tile.points.id) {
                let [vx, vy, vz, j] = motion.0;
                let square = f64::from(vx * vx + vy * vy + vz * vz);
                if !(square.sqrt() < 10.0 * sound && SOUND_J.contains(&j)) {
                    return Err(Failure(format!(
                        "step {}: liquid point {id} has speed {:.3e} m/s and volume ratio J = {:.4}: {}",
                        self.state.step,
                        square.sqrt(),
                        1.0 + j,
                        self.cause(*id, j)
                    )));
                }
                fastest = fastest.max(square);
                least = least.min(j);
            }
        }
        let acoustic = acoustic_limit(&self.scene, fastest.sqrt(), f64::from(least));
        self.state.limit_s = acoustic.min(self.plan.viscous_s);
        if let Some(projection) = &mut self.projection {
            projection.speed = fastest.sqrt();
        }
        Ok(())
    }

    /// The shortest and the longest step limit (s) that a sound run can have.
    pub(crate) fn limits_s(&self) -> (f64, f64) {
        let fastest = 10.0 * self.scene.liquid.sound_speed();
        let least = acoustic_limit(&self.scene, fastest, f64::from(SOUND_J.start));
        let first = self.plan.acoustic_s.min(self.plan.viscous_s);
        (least.min(first), self.plan.viscous_s)
    }

    fn cause(&self, id: u32, j: Real) -> String {
        if self.is_alone(id) {
            self.unstable(id)
        } else if j <= SOUND_J.start {
            "the liquid is crushed, probably between bodies that leave it no room".into()
        } else if j >= SOUND_J.end {
            match self.scene.liquid.cavitation_pressure {
                None => {
                    "the liquid is torn apart: a cavitation_pressure limits the tension it carries"
                }
                Some(_) => "the liquid flies apart, beyond what a volume ratio can describe",
            }
            .into()
        } else {
            self.unstable(id)
        }
    }

    /// The likely cause of an instability at a point.
    fn unstable(&self, id: u32) -> String {
        let advice = format!(
            "the step is {} of its {} limit",
            self.settings.cfl, self.plan.limit
        );
        if self.is_alone(id) {
            // No other point shares the nodes and carries their velocity gradient to the next step, so
            // that the stress reverses the gradient in each.
            return format!(
                "the run is unstable where that point is alone, a drop smaller than a cell; {advice}, and such a drop needs {ALONE_VISCOUS} of the viscous and {ALONE_ACOUSTIC} of the acoustic limit"
            );
        }
        format!("the run is unstable; {advice} and a smaller cfl may help")
    }

    /// Whether no other point is within a cell and a half, the reach of a node, of this one.
    fn is_alone(&self, id: u32) -> bool {
        let nodes = || {
            self.grid.tiles.iter().flat_map(|tile| {
                let points = &tile.points;
                (0..points.len()).map(move |p| (points.id[p], tile.node_of(points.base[p])))
            })
        };
        let Some((_, own)) = nodes().find(|(other, _)| *other == id) else {
            return false;
        };
        let near = |node: [i32; 3]| (0..3).all(|a| (node[a] - own[a]).abs() <= 1);
        nodes().filter(|(_, node)| near(*node)).count() == 1
    }
}

/// Brings what a block knows of the bodies to their displacements (cells); says whether the
/// nodes within their reach changed.
fn see(
    block: &mut Block,
    parts: &[Vec<BlockShape>],
    shifts: &[[f64; 3]],
    integrator: &Integrator,
) -> bool {
    let mut changed = false;
    for (body, (parts, &shift)) in parts.iter().zip(shifts).enumerate() {
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
        block.walls[body].update(parts, block.origin, shift, integrator);
    }
    changed
}

/// Copies the nodal velocities to the halo of a tile.
fn gather_velocity(tile: &mut Tile, blocks: &[Block]) {
    for (value, &link) in tile.local.iter_mut().zip(&tile.links) {
        if link != NOWHERE {
            let (block, node) = unlink(link);
            *value = blocks[block].velocity[node];
        }
    }
    for (value, &flip) in tile.local.iter_mut().zip(&tile.flips) {
        for a in (0..3).filter(|a| flip & (1 << a) != 0) {
            value.0[a] = -value.0[a];
            value.0[4 + a] = -value.0[4 + a];
        }
    }
}

/// Copies w_l of the velocity filter to the halo of a tile.
fn gather_filtered(tile: &mut Tile, blocks: &[Block]) {
    for (value, &link) in tile.filter_in.iter_mut().zip(&tile.links) {
        if link != NOWHERE {
            let (block, node) = unlink(link);
            *value = blocks[block].filtered(node);
        }
    }
    for (value, &flip) in tile.filter_in.iter_mut().zip(&tile.flips) {
        for a in (0..3).filter(|a| flip & (1 << a) != 0) {
            value.0[a] = -value.0[a];
        }
    }
}
