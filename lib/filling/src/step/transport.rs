//! Stages 7 and 8: the particles follow the flow and keep their density.

use physics::Failure;

use super::{Implicit, Part, Solution};
use crate::geometry::{Lattice, Solids};
use crate::transport::{self, Field, Path, density};

/// Reynolds number of a cell above which what particles carry is limited: inertia feeds on itself
/// from 0.3 on; below, the limit would only damp flows followed in many short steps.
const THIN: f64 = 0.1;

impl Implicit {
    /// Stage 7: particles follow the flow for `dt` (s) while the bodies move to `after`. Returns
    /// that flow.
    pub(super) fn transport(
        &mut self,
        lattice: &Lattice,
        solution: &mut Solution,
        after: &Solids,
        dt: f64,
    ) -> Field {
        let path = Path {
            before: &self.solids_after(&solution.bodies, 0.0),
            after,
            scale: dt / self.setup.units.h,
        };
        let (viscous, influence) = (solution.viscous.take(), self.setup.influence_length());
        self.state.counts.unsettled += u64::from(viscous.as_ref().is_some_and(|v| !v.settled));
        self.state.counts.undecided += u64::from(!solution.decided);
        let (u, face, bodies) = (&solution.u, &solution.dofs.face, &solution.bodies);
        let particles = &mut self.state.particles;
        let (field, moved) = self.workspace.clock.time(Part::Advection, || {
            let known = viscous.map(|v| v.field);
            let field = known.unwrap_or_else(|| Field::new(lattice, face, u, bodies, influence));
            let moved = path.follow(particles, |x, near| field.flow.velocity(x, near));
            (field, moved)
        });
        let counts = &mut self.state.counts;
        counts.deflected += moved.deflected;
        counts.lost += moved.lost;
        counts.pinched += moved.pinched;
        field
    }

    /// Stage 8: moves particles such that the liquid keeps its density, after a step of `dt` (s).
    pub(super) fn project(
        &mut self,
        lattice: &Lattice,
        solution: &Solution,
        after: &Solids,
        dt: f64,
    ) -> Result<(), Failure> {
        let path = Path {
            before: after,
            after,
            scale: 1.0,
        };
        let particles = &mut self.state.particles;
        let projected = self.workspace.clock.time(Part::Density, || {
            let (g, volume) = (&solution.g, &solution.face_volume);
            let fastest = (solution.u.iter()).fold(0.0, |most: f64, u| most.max(u.abs()));
            let way = fastest * dt / self.setup.units.h;
            let (moves, _) =
                density::displacement(g, &g.transpose(), volume, &solution.cells, way)?;
            let field = density::Field::new(&lattice.window, &solution.dofs.face, moves);
            Ok(path.follow(particles, |x, near| field.at(x, near)))
        });
        let moved = projected.map_err(|error| self.unsolved(error))?;
        self.state.counts.lost += moved.lost;
        self.state.counts.pinched += moved.pinched;
        Ok(())
    }

    /// The particles take velocity and pressure where they are.
    pub(super) fn take_up(
        &mut self,
        lattice: &Lattice,
        solution: &Solution,
        Field { value, flow }: &Field,
    ) -> Result<(), Failure> {
        let (liquid, units, pace) = (&self.setup.liquid, self.setup.units, self.state.pace);
        let particles = &mut self.state.particles;
        self.workspace.clock.time(Part::Advection, || {
            let thin = liquid.density * pace * units.h / units.viscosity() > THIN;
            transport::set_velocities(particles, flow, thin.then_some(value));
            let lowest = (liquid.cavitation_pressure).map_or(f64::NEG_INFINITY, |p| -p);
            let (window, pressure) = (&lattice.window, &solution.pressure);
            transport::set_volume_changes(particles, window, pressure, liquid.tait, lowest);
        });
        if self.state.particles.is_empty() {
            return Err(self.failure("all liquid has left the domain"));
        }
        Ok(())
    }
}
