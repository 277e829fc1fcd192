//! One time step; reads as the algorithm.

use physics::{Failure, Motion, Rheology, StepLimit, StepReport, Viscosity, WallLaw};
use rayon::prelude::*;

use crate::cell_mean::{equalise, share_rate};
use crate::collide::{first_fault, move_points};
use crate::density;
use crate::explicit::Explicit;
use crate::halo::{gather_filtered, gather_velocity};
use crate::nodes::NodeStep;
use crate::real::Real;
use crate::settings::Mode;
use crate::stages::Stage;
use crate::tiles::Scratch;

/// Steps between checks of the whole state, which also renew the time step: they then cost next to nothing.
pub(crate) const CHECK_EVERY: u64 = 64;

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

        self.clock.start();
        if self.present.contact {
            self.see_bodies();
        }
        self.clock.lap(Stage::Bodies);
        self.points_to_nodes(dt);
        self.clock.lap(Stage::PointsToNodes);
        match self.scene.liquid.viscosity.clone() {
            Viscosity::Newtonian(law) => self.nodes(dt, &slow, &law),
            Viscosity::Table(law) => self.nodes(dt, &slow, &law),
            Viscosity::Law(law) => self.nodes(dt, &slow, &law),
        }
        let from = self.state.displacement.clone();
        for (x, v) in self.state.displacement.iter_mut().zip(&velocities) {
            for a in 0..3 {
                x[a] += v[a] * dt;
            }
        }
        self.nodes_to_points(dt, &from, &slow)?;
        self.clock.lap(Stage::NodesToPoints);
        self.grid.deliver();
        if self.present.cell_mean {
            equalise(&mut self.grid, &self.stress);
        }
        self.state.step += 1;
        self.state.time_s += dt;
        self.state.travel_m += speed * dt;
        let report = self.report(dt, speed);
        if self.present.load {
            self.steer(dt);
        }
        if self.present.projection {
            self.project(dt)?;
        }
        if self.state.step.is_multiple_of(CHECK_EVERY) {
            self.check()?;
        }
        self.clock.lap(Stage::Sort);
        Ok(report)
    }

    /// Integrals of the bodies at the nodes, for where the bodies are now.
    fn see_bodies(&mut self) {
        let cell = self.scene.grid.cell_m;
        let displacements = self.state.displacement.iter();
        let shifts: Vec<([f64; 3], bool)> = displacements
            .zip(&self.scene.bodies)
            .map(|(x, body)| (x.map(|x| x / cell), body.motion != Motion::Fixed))
            .collect();
        self.grid.see_bodies(&self.parts, &shifts, &self.integrator);
    }

    fn points_to_nodes(&mut self, dt: f64) {
        let scale = (dt / self.scene.grid.cell_m) as Real;
        let (kernels, shape) = (self.kernels, self.settings.shape);
        self.grid.tiles.par_iter_mut().for_each(|tile| {
            tile.points.gather_runs();
            (kernels.p2g)(tile, scale, shape);
        });
    }

    /// Contact, sides and momentum at the nodes, then the velocity filter.
    fn nodes<R: Rheology>(&mut self, dt: f64, velocities: &[[Real; 3]], rheology: &R) {
        let (cell, density) = (self.scene.grid.cell_m, self.scene.liquid.density);
        let mode = self.mode;
        let [x, y, z] = self.scene.gravity.map(|g| (g * dt) as Real);
        let step = NodeStep {
            law: match self.present.friction {
                true => self.scene.wall,
                false => WallLaw::Frictionless,
            },
            rheology,
            velocities,
            separation: self.separation,
            fall: match self.present.force {
                true => [x, y, z, 0.0],
                false => [0.0; 4],
            },
            dt_over_mass: dt / (density * cell),
            mode,
        };
        let (blocks, tiles) = (&mut self.grid.blocks, &self.grid.tiles);
        (blocks.par_iter_mut()).for_each(|block| block.advance(tiles, &step));
        self.clock.lap(Stage::Nodes);
        if self.present.filter {
            let (kernels, shape) = (self.kernels, self.settings.shape);
            for round in 2..=self.settings.velocity_update.order() {
                let blocks = &self.grid.blocks;
                let keep = round == 2 && mode == Mode::FilterBefore;
                let tiles = self.grid.tiles.par_iter_mut();
                tiles.for_each_init(Vec::new, |field, tile| {
                    gather_filtered(tile, blocks, field);
                    (kernels.filter)(tile, field, keep, shape);
                });
                let (blocks, tiles) = (&mut self.grid.blocks, &self.grid.tiles);
                (blocks.par_iter_mut()).for_each(|block| block.refine(tiles, &step));
            }
            self.clock.lap(Stage::Filter);
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
        let shared = self.present.cell_mean;
        let fault = (tiles.par_iter_mut())
            .map_init(Scratch::default, |scratch, tile| {
                gather_velocity(tile, blocks, &mut scratch.field);
                (self.kernels.g2p)(tile, scratch, scale, self.settings.shape);
                if shared {
                    share_rate(tile, scratch, lattice.axes());
                }
                let gradient = &scratch.gradient;
                (self.flow).update(&mut tile.points, gradient, &self.stress, dt as Real);
                move_points(tile, &mut scratch.shift, lattice, &bodies)
            })
            .reduce(|| None, first_fault);
        self.grid.tiles = tiles;
        for tile in &self.grid.tiles {
            self.state.lost += tile.lost;
            self.state.corrections.stopped += tile.hits.count;
            self.state.corrections.trapped += tile.hits.trapped;
        }
        match fault {
            Some(id) => Err(Failure(format!(
                "step {}: liquid point {id} would move by more than 0.9 of a cell, or its velocity is not finite: {}",
                self.state.step + 1,
                self.unstable(id)
            ))),
            None => Ok(()),
        }
    }

    fn report(&self, dt: f64, speed: f64) -> StepReport {
        let pressure = |body: Option<usize>| body.map_or(0.0, |b| self.push(b, dt));
        StepReport {
            dt_s: dt,
            closing_speed: speed,
            travel_m: self.state.travel_m,
            pressure_bottom: -pressure(self.scene.bottom),
            pressure_top: pressure(self.scene.top),
            lost: self.state.lost,
            iterations: 0,
        }
    }

    /// Impulse on a body along y in a step of `dt` (s) as pressure over the bond area, Pa.
    fn push(&self, body: usize, dt: f64) -> f64 {
        let (cell, density) = (self.scene.grid.cell_m, self.scene.liquid.density);
        let nodes: f64 = (self.grid.blocks.iter())
            .map(|block| block.reaction[body][1])
            .sum();
        let points: f64 = (self.grid.tiles.iter())
            .map(|tile| tile.push[body][1])
            .sum();
        (nodes + points) * density * cell.powi(3) / (dt * self.scene.grid.area_m2())
    }

    /// Clamp control on the pressure that the body it drives feels (the paper's section 2.2: the contact
    /// forces on one side of the bond).
    fn steer(&mut self, dt: f64) {
        if let (Some(body), Some(mut control)) = (self.scene.clamped(), self.control) {
            control.observe(self.push(body, dt), dt);
            self.control = Some(control);
        }
    }

    /// Density projection after a step of `dt` (s) if it is due.
    fn project(&mut self, dt: f64) -> Result<(), Failure> {
        let cell = self.scene.grid.cell_m;
        if !(self.projection.as_mut()).is_some_and(|projection| projection.due(dt / cell)) {
            return Ok(());
        }
        let mut tiles = std::mem::take(&mut self.grid.tiles);
        let here = &self.state.displacement;
        let velocities: Vec<[Real; 3]> = (self.body_velocities(0.0).iter())
            .map(|v| v.map(|v| v as Real))
            .collect();
        let bodies = self.obstacles(here, here, &velocities);
        let fault = density::project(&mut tiles, &self.grid.lattice, &bodies);
        self.grid.tiles = tiles;
        self.state.lost += self.grid.tiles.iter().map(|tile| tile.lost).sum::<u64>();
        self.grid.deliver();
        match fault {
            Some(id) => Err(Failure(format!(
                "step {}: the density projection moved liquid point {id} to a place that is not a number: the run is unstable",
                self.state.step
            ))),
            None => Ok(()),
        }
    }
}
