//! Solution of the equations of a step, and the forces on the bodies.

use std::time::Instant;

use rayon::prelude::*;
use saddle_point::{Load, SaddleSolver, SaddleSystem, SolveError};

use super::assembly::{Problem, Sides};
use super::stretching::stretching;
use crate::air::Pocket;
use crate::clock::{Clock, Stage};
use crate::geometry::{MIRROR, OPEN};

/// How the body that closes the gap is driven.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Drive {
    /// At this speed, cells/s.
    Speed(f64),
    /// By a force over the unit of viscosity, of which errors are measured by `scale`, at a speed near `guess`.
    Force { force: f64, scale: f64, guess: f64 },
}

/// What flows in a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Flow {
    /// Velocity of each face against the grid, cells/s.
    pub(crate) velocity: Vec<f64>,
    /// Pressure of each pore over the unit of viscosity.
    pub(crate) pressure: Vec<f64>,
    /// Closing speed, cells/s.
    pub(crate) speed: f64,
    /// Force on the body that closes the gap, against it.
    pub(crate) force: f64,
    /// Viscous dissipation, over the unit of viscosity.
    pub(crate) dissipation: f64,
    pub(crate) iterations: u32,
}

impl Flow {
    /// The same flow at another closing speed, if there is one.
    pub(crate) fn speed_up(&mut self, speed: f64) {
        let factor = speed / self.speed;
        if !(factor > 0.0 && factor.is_finite()) || factor == 1.0 {
            return;
        }
        let values = self.velocity.iter_mut().chain(&mut self.pressure);
        values.for_each(|value| *value *= factor);
        self.speed = speed;
    }
}

/// Solves a problem. `carried` is the volume, over the time step, that each pore with a pressure holds more than its
/// volume at no pressure, and `guess` a flow to start from.
pub(crate) fn solve(
    problem: &Problem,
    carried: &[f64],
    drive: Drive,
    guess: &Flow,
    solver: &mut SaddleSolver,
    clock: &mut Clock,
) -> Result<Flow, SolveError> {
    let begun = Instant::now();
    let unknowns = problem.unknowns;
    let (a, g) = (problem.velocity_block()?, problem.outflow()?);
    let Sides {
        mut known,
        closing,
        mut standing,
        clinging,
        carried: mut carried_force,
    } = problem.momenta();
    let scales = &problem.scales;
    let mut source: Vec<f64> = (unknowns.pores.iter())
        .map(|&pore| problem.closing(pore as usize))
        .collect();
    let mut c: Vec<f64> = (unknowns.pores.iter())
        .map(|&pore| {
            let end = problem.mesh.volume_at(pore as usize, problem.end_height);
            end * scales.compressibility / scales.dt
        })
        .collect();
    let friction: Vec<f64> = (unknowns.faces.par_iter())
        .map(|&face| resistance(problem, face as usize))
        .collect();
    let mut two_eta: Vec<f64> = (unknowns.pores.iter())
        .map(|&pore| 2.0 * problem.viscosities.pores[pore as usize])
        .collect();
    let mut carried = carried.to_vec();
    // The unknown of a pocket is its pressure less that of its tangent, by which fronts are pushed: what softens a pocket much
    // would outweigh all else.
    let thickest = two_eta.iter().copied().fold(1.0, f64::max);
    for Pocket {
        pores,
        volume,
        tangent,
        ..
    } in problem.pockets
    {
        let closing = pores
            .iter()
            .map(|&pore| problem.closing(pore as usize))
            .sum();
        source.push(closing);
        carried_force += closing * tangent.pressure;
        c.push(tangent.yielding / scales.dt);
        carried.push((tangent.volume - volume) / scales.dt);
        two_eta.push(thickest);
    }
    let speed = match drive {
        Drive::Speed(speed) | Drive::Force { guess: speed, .. } => speed,
    };
    let mut volume_source = vec![0.0; source.len()];
    if let Drive::Speed(speed) = drive {
        for (known, closing) in known.iter_mut().zip(&closing) {
            *known += speed * closing;
        }
        for (moved, source) in volume_source.iter_mut().zip(&source) {
            *moved = speed * source;
        }
    }
    let mut clinging: Vec<f64> = (clinging[0].iter().zip(&clinging[1]))
        .map(|(known, closing)| known + speed * closing)
        .collect();
    for (standing, clinging) in standing.iter_mut().zip(&clinging) {
        *standing += clinging;
    }
    for forces in [&mut standing, &mut clinging] {
        if forces.iter().all(|&force| force == 0.0) {
            forces.clear();
        }
    }
    let system = SaddleSystem {
        a: &a,
        g: &g,
        pockets: problem.pockets.len(),
        c: &c,
        friction: &friction,
        two_eta: &two_eta,
        b: &known,
        standing: &standing,
        clinging: &clinging,
        slow: scales.slow,
        volume_source: &volume_source,
        carried: &carried,
    };
    let mut u: Vec<f64> = (unknowns.faces.iter())
        .map(|&face| guess.velocity[face as usize])
        .collect();
    let mut p: Vec<f64> = (unknowns.pores.iter())
        .map(|&pore| guess.pressure[pore as usize])
        .chain(problem.pockets.iter().map(|_| 0.0))
        .collect();
    let mut flow = Flow {
        velocity: vec![0.0; problem.mesh.faces.len()],
        pressure: vec![0.0; problem.mesh.pores.len()],
        speed,
        ..Flow::default()
    };
    let drag = problem.resistance();
    clock.add(Stage::Assembly, begun);
    let begun = Instant::now();
    let solved = match drive {
        Drive::Speed(_) => solver.solve(&system, &mut u, &mut p),
        Drive::Force { force, scale, .. } => {
            let load = Load {
                momentum: closing.clone(),
                source: source.clone(),
                resistance: drag,
                force: force - carried_force,
                scale: scale.max(f64::MIN_POSITIVE),
            };
            solver.solve_loaded(&system, &load, &mut u, &mut p, &mut flow.speed)
        }
    };
    clock.add(Stage::Solve, begun);
    flow.iterations = match solved {
        Ok(report) => report.iterations() as u32,
        Err(SolveError::NotConverged { iterations, .. }) => iterations as u32,
        Err(error) => return Err(error),
    };
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    flow.force = dot(&source, &p) - dot(&closing, &u) + drag * flow.speed + carried_force;
    let mut au = vec![0.0; u.len()];
    a.multiply(&u, &mut au);
    let viscous = problem.viscous_parts(&u, flow.speed);
    flow.dissipation =
        dot(&u, &au) - 2.0 * flow.speed * dot(&closing, &u) + drag * flow.speed.powi(2) + viscous;
    for (&face, &u) in unknowns.faces.iter().zip(&u) {
        flow.velocity[face as usize] = u;
    }
    for (&pore, &p) in unknowns.pores.iter().zip(&p) {
        flow.pressure[pore as usize] = p;
    }
    for (pocket, p) in problem.pockets.iter().zip(&p[unknowns.pores.len()..]) {
        for &pore in &pocket.pores {
            flow.pressure[pore as usize] = pocket.tangent.pressure + p;
        }
    }
    Ok(flow)
}

/// `D_B` of the preconditioner: inertia and the friction of the channel that a face lies in (docs/methods.md section 3.6).
pub(crate) fn resistance(problem: &Problem, face: usize) -> f64 {
    let link = problem.links.of(face);
    let slip = problem.scales.influence_length;
    let narrow = match slip.is_finite() {
        true => 12.0 * link.narrowness / (1.0 + 6.0 * slip * link.narrowness.sqrt()),
        false => 0.0,
    };
    let f = problem.mesh.faces[face];
    let eta =
        problem.viscosities.pores[f.low as usize].max(problem.viscosities.pores[f.high as usize]);
    let least = 1e-6;
    (problem.masses[face] * (problem.scales.inertia + eta * narrow)).max(least)
}

/// Forces on the bodies along y, over the unit of viscosity: pressure and viscous tension on walls across y, friction on
/// those along it.
pub(crate) fn forces(problem: &Problem, flow: &Flow, bodies: usize) -> Vec<f64> {
    let (mesh, lattice) = (problem.mesh, problem.lattice);
    let mut forces = vec![0.0; bodies];
    let mut push = |code: u8, force: f64| {
        if code != OPEN && code != MIRROR {
            forces[usize::from(code - 1)] += force;
        }
    };
    let part = 1.0 / (mesh.k * mesh.k) as f64;
    let closed_in = problem.pockets.iter().flat_map(|pocket| &pocket.pores);
    for &pore in problem.unknowns.pores.iter().chain(closed_in) {
        let pore = pore as usize;
        let (p, cell) = (flow.pressure[pore], mesh.pores[pore].cell as usize);
        for bit in (0..8).filter(|bit| mesh.pores[pore].voxels >> bit & 1 == 1) {
            for (up, sign) in [(false, -1.0), (true, 1.0)] {
                if let Some((cell, voxel)) = mesh.next_voxel(cell, mesh.voxel(bit), 1, up) {
                    push(mesh.code(lattice, cell, voxel), sign * p * part);
                }
            }
        }
    }
    for &face in &problem.unknowns.faces {
        let face = face as usize;
        let link = problem.links.of(face);
        if mesh.faces[face].axis == 1 {
            let weights = problem.wall_weights(face);
            let drag: f64 = (0..2)
                .map(|half| {
                    let wall = link.sliding[half][0] + flow.speed * link.sliding[half][1];
                    weights[half] * (link.friction[half] * flow.velocity[face] - wall)
                })
                .sum();
            push(link.body, drag);
            let f = mesh.faces[face];
            for (pore, up) in [(f.low as usize, false), (f.high as usize, true)] {
                stretching(mesh, face, up, |pull| {
                    if pull.other.is_none() {
                        let against = flow.velocity[face] - pull.closing * flow.speed;
                        let tension = problem.stiffness(pore) * pull.weight * against;
                        push(wall_ahead(problem, pore, up), tension);
                    }
                });
            }
        }
    }
    forces
}

/// Code of the body whose wall bounds a pore on its high (`up`) or low side along y.
fn wall_ahead(problem: &Problem, pore: usize, up: bool) -> u8 {
    let (mesh, cell) = (problem.mesh, problem.mesh.pores[pore].cell as usize);
    (0..8)
        .filter(|bit| mesh.pores[pore].voxels >> bit & 1 == 1)
        .filter_map(|bit| mesh.next_voxel(cell, mesh.voxel(bit), 1, up))
        .map(|(cell, voxel)| mesh.code(problem.lattice, cell, voxel))
        .find(|&code| code != OPEN)
        .unwrap_or(OPEN)
}
