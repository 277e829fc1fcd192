//! The saddle-point system of a step for the linear solver, and the flow from its solution.

use rayon::prelude::*;
use saddle_point::{Csr, SaddleSystem, SolveError, VelocityBlock};

use super::assembly::Problem;
use super::solution::{Drive, Flow};

/// The saddle-point system of a step.
pub(super) struct Equations {
    a: VelocityBlock,
    g: Csr<f64>,
    /// Diagonal of C, the compressibility of each pore and pocket.
    c: Vec<f64>,
    /// `D_B` of each face (docs/methods.md section 3.6).
    friction: Vec<f64>,
    /// Momentum right-hand sides: all of them, those per closing speed, the static ones, and those that only make liquid
    /// follow its walls.
    known: Vec<f64>,
    pub(super) closing: Vec<f64>,
    standing: Vec<f64>,
    clinging: Vec<f64>,
    /// Volumes that pores and pockets lose per closing speed, and those at a prescribed speed (zero if the speed is unknown).
    pub(super) source: Vec<f64>,
    volume_source: Vec<f64>,
    excess_rate: Vec<f64>,
    /// Known force on the moving body.
    pub(super) known_body_force: f64,
}

impl Equations {
    /// The system of a problem with the moving body driven by `drive`. `excess_rate` is the excess of the liquid in each
    /// pore with a pressure over the pore's volume, per time.
    pub(super) fn new(
        problem: &Problem,
        excess_rate: Vec<f64>,
        drive: Drive,
    ) -> Result<Self, SolveError> {
        let (unknowns, coefficients) = (problem.unknowns, &problem.coefficients);
        let (a, g) = (problem.velocity_block()?, problem.outflow()?);
        let [known, closing, mut standing, force_on_body, mut clinging] =
            problem.right_hand_sides(drive.speed());
        for forces in [&mut standing, &mut clinging] {
            if forces.iter().all(|&force| force == 0.0) {
                *forces = Vec::new();
            }
        }
        let of_pores = |of: &dyn Fn(usize) -> f64| -> Vec<f64> {
            let pores = unknowns.pores.iter();
            pores.map(|&pore| of(pore as usize)).collect()
        };
        let mut equations = Self {
            a,
            g,
            c: of_pores(&|pore| {
                let end = problem.mesh.volume_at(pore, problem.end_height);
                end * coefficients.compressibility / coefficients.dt
            }),
            friction: (unknowns.faces.par_iter())
                .map(|&face| resistance(problem, face as usize))
                .collect(),
            known,
            closing,
            standing,
            clinging,
            source: of_pores(&|pore| problem.closing_loss(pore)),
            volume_source: Vec::new(),
            excess_rate,
            known_body_force: force_on_body.iter().sum(),
        };
        equations.add_pockets(problem);
        equations.volume_source = vec![0.0; equations.source.len()];
        if let Drive::Speed(speed) = drive {
            for (known, closing) in equations.known.iter_mut().zip(&equations.closing) {
                *known += speed * closing;
            }
            let moved = equations.volume_source.iter_mut();
            for (moved, source) in moved.zip(&equations.source) {
                *moved = speed * source;
            }
        }
        Ok(equations)
    }

    /// Adds pockets of air. The unknown of a pocket is its pressure less that of its tangent, which the fronts already
    /// apply: with the full pressure as the unknown, the terms of a soft pocket would outweigh all others.
    fn add_pockets(&mut self, problem: &Problem) {
        let dt = problem.coefficients.dt;
        for pocket in problem.pockets {
            let (pores, tangent) = (pocket.pores.iter(), pocket.tangent);
            let closing = pores.map(|&pore| problem.closing_loss(pore as usize)).sum();
            self.source.push(closing);
            self.known_body_force += closing * tangent.pressure;
            self.c.push(tangent.compliance / dt);
            self.excess_rate.push((tangent.volume - pocket.volume) / dt);
        }
    }

    /// The system as the linear solver takes it.
    pub(super) fn system(&self, problem: &Problem) -> SaddleSystem<'_> {
        SaddleSystem {
            a: &self.a,
            g: &self.g,
            pockets: problem.pockets.len(),
            c: &self.c,
            friction: &self.friction,
            b: &self.known,
            standing: &self.standing,
            clinging: &self.clinging,
            slow: problem.coefficients.slow,
            volume_source: &self.volume_source,
            carried: &self.excess_rate,
        }
    }

    /// The flow with the solution u, p at a closing speed.
    pub(super) fn flow(&self, problem: &Problem, [u, p]: [&[f64]; 2], speed: f64) -> Flow {
        let unknowns = problem.unknowns;
        let mut flow = Flow {
            velocity: vec![0.0; problem.mesh.faces.len()],
            pressure: vec![0.0; problem.mesh.pores.len()],
            speed,
            ..Flow::default()
        };
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let (drag, moved) = (problem.resistance(), dot(&self.closing, u));
        flow.force = dot(&self.source, p) - moved + drag * speed + self.known_body_force;
        let mut au = vec![0.0; u.len()];
        self.a.multiply(u, &mut au);
        flow.dissipation = dot(u, &au) - 2.0 * speed * moved
            + drag * speed.powi(2)
            + problem.viscous_parts(u, speed);
        for (&face, &u) in unknowns.faces.iter().zip(u) {
            flow.velocity[face as usize] = u;
        }
        for (&pore, &p) in unknowns.pores.iter().zip(p) {
            flow.pressure[pore as usize] = p;
        }
        for (pocket, p) in problem.pockets.iter().zip(&p[unknowns.pores.len()..]) {
            for &pore in &pocket.pores {
                flow.pressure[pore as usize] = pocket.tangent.pressure + p;
            }
        }
        flow
    }
}

/// `D_B` of the preconditioner: inertia, and Darcy friction of the channel around a face (docs/methods.md section 3.6).
pub(crate) fn resistance(problem: &Problem, face: usize) -> f64 {
    let coupling = problem.couplings.of(face);
    let slip = problem.coefficients.influence_length;
    let narrow = match slip.is_finite() {
        true => {
            12.0 * coupling.inverse_width_squared
                / (1.0 + 6.0 * slip * coupling.inverse_width_squared.sqrt())
        }
        false => 0.0,
    };
    let [low, high] = problem
        .face_pores(face)
        .map(|pore| problem.viscosities.pores[pore]);
    // Keeps the diagonal positive.
    (problem.masses[face] * (problem.coefficients.inertia + low.max(high) * narrow)).max(1e-6)
}
