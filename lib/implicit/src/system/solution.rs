//! Solution of the equations of a step, and forces on the bodies.

use std::time::Instant;

use saddle_point::{Load, SaddleSolver, SolveError};

use super::assembly::Problem;
use super::equations::Equations;
use super::stretching::stretching;
use crate::clock::{Clock, Stage};
use crate::geometry::{MIRROR, OPEN};

/// How the moving body is driven.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Drive {
    /// At a prescribed speed, cells/s.
    Speed(f64),
    /// By a force over the unit of viscosity, at an unknown speed that is estimated as `start_speed`; `scale` is that of
    /// errors in the force.
    Force {
        force: f64,
        scale: f64,
        start_speed: f64,
    },
}

impl Drive {
    /// The closing speed, or its estimate.
    pub(super) fn speed(self) -> f64 {
        match self {
            Self::Speed(speed)
            | Self::Force {
                start_speed: speed, ..
            } => speed,
        }
    }
}

/// The flow in a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Flow {
    /// Velocity of each face relative to the grid, cells/s.
    pub(crate) velocity: Vec<f64>,
    /// Pressure of each pore over the unit of viscosity.
    pub(crate) pressure: Vec<f64>,
    /// Closing speed, cells/s.
    pub(crate) speed: f64,
    /// Force of the liquid on the moving body, positive against its motion.
    pub(crate) force: f64,
    /// Viscous dissipation, over the unit of viscosity.
    pub(crate) dissipation: f64,
    pub(crate) iterations: u32,
}

impl Flow {
    /// The flow scaled to another closing speed, which it has then in any case; by a factor of four at most, as farther off it
    /// tells nothing.
    pub(crate) fn at_speed(&self, speed: f64) -> Self {
        let mut flow = self.clone();
        flow.scale_to_speed(speed.clamp(-4.0 * self.speed.abs(), 4.0 * self.speed.abs()));
        flow.speed = speed;
        flow
    }

    /// Scales the flow to another closing speed; does nothing unless the ratio of the speeds is positive and finite.
    pub(crate) fn scale_to_speed(&mut self, speed: f64) {
        let factor = speed / self.speed;
        if !(factor > 0.0 && factor.is_finite()) || factor == 1.0 {
            return;
        }
        let values = self.velocity.iter_mut().chain(&mut self.pressure);
        values.for_each(|value| *value *= factor);
        self.speed = speed;
    }
}

/// Solves a problem from the flow `start`, whose velocities are freed, for memory peaks in the solver. `excess_rate` is the
/// excess of the liquid in each pore with a pressure over the pore's volume, per time.
pub(crate) fn solve(
    problem: &Problem,
    excess_rate: Vec<f64>,
    drive: Drive,
    start: &mut Flow,
    solver: &SaddleSolver,
    clock: &Clock,
) -> Result<Flow, SolveError> {
    let begun = Instant::now();
    let unknowns = problem.unknowns;
    let equations = Equations::new(problem, excess_rate, drive)?;
    let system = equations.system(problem);
    let mut u: Vec<f64> = (unknowns.faces.iter())
        .map(|&face| start.velocity[face as usize])
        .collect();
    start.velocity = Vec::new();
    let mut p: Vec<f64> = (unknowns.pores.iter())
        .map(|&pore| start.pressure[pore as usize])
        .chain(problem.pockets.iter().map(|_| 0.0))
        .collect();
    let mut speed = drive.speed();
    clock.add(Stage::Assembly, begun);
    let begun = Instant::now();
    let solved = match drive {
        Drive::Speed(_) => solver.solve(&system, &mut u, &mut p),
        Drive::Force { force, scale, .. } => {
            let load = Load {
                momentum: equations.closing.clone(),
                source: equations.source.clone(),
                resistance: problem.resistance(),
                force: force - equations.known_body_force,
                scale: scale.max(f64::MIN_POSITIVE),
            };
            solver.solve_loaded(&system, &load, &mut u, &mut p, &mut speed)
        }
    };
    clock.add(Stage::Solve, begun);
    let iterations = match solved {
        Ok(report) => report.iterations() as u32,
        Err(SolveError::NotConverged { iterations, .. }) => iterations as u32,
        Err(error) => return Err(error),
    };
    Ok(Flow {
        iterations,
        ..equations.flow(problem, [&u, &p], speed)
    })
}

/// Forces on the bodies along y, over the unit of viscosity: pressure and viscous normal stress on walls normal to y, friction
/// on those parallel to it.
pub(crate) fn forces(problem: &Problem, flow: &Flow, bodies: usize) -> Vec<f64> {
    let mesh = problem.mesh;
    let mut forces = vec![0.0; bodies];
    let mut add_force = |code: u8, force: f64| {
        if code != OPEN && code != MIRROR {
            forces[usize::from(code - 1)] += force;
        }
    };
    let part = 1.0 / (mesh.k * mesh.k) as f64;
    let pocket_pores = problem.pockets.iter().flat_map(|pocket| &pocket.pores);
    for &pore in problem.unknowns.pores.iter().chain(pocket_pores) {
        let pore = pore as usize;
        let p = flow.pressure[pore];
        for voxel in mesh.voxels(pore) {
            for (up, sign) in [(false, -1.0), (true, 1.0)] {
                if let Some((cell, voxel)) = mesh.next_voxel(mesh.cell(pore), voxel, 1, up) {
                    add_force(mesh.code(cell, voxel), sign * p * part);
                }
            }
        }
    }
    for &face in &problem.unknowns.faces {
        let face = face as usize;
        if mesh.faces[face].axis == 1 {
            let (coupling, weights) = problem.walls(face);
            let drag: f64 = (0..2)
                .map(|half| {
                    let wall = coupling.sliding[half][0] + flow.speed * coupling.sliding[half][1];
                    weights[half] * (coupling.friction[half] * flow.velocity[face] - wall)
                })
                .sum();
            add_force(coupling.body, drag);
            for (pore, up) in problem.face_pores(face).into_iter().zip([false, true]) {
                stretching(mesh, face, up, |term| {
                    if term.other.is_none() {
                        let against = flow.velocity[face] - term.closing * flow.speed;
                        let tension = problem.stiffness(pore) * term.weight * against;
                        add_force(mesh.wall_code(pore, up), tension);
                    }
                });
            }
        }
    }
    problem.piston_friction(|friction| {
        add_force(friction.walls, flow.speed * friction.force);
        add_force(friction.piston, -flow.speed * friction.force);
    });
    forces
}
