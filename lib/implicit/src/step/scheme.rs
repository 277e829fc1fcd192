//! `physics::Scheme` for the implicit scheme: diagnostics, output, checkpoints, objections.

use physics::{
    Array, Diagnostics, Failure, LiquidState, PressRun, SET, Saved, Saving, Scheme, StageTime,
    StepLimit, StepReport, restored,
};

use super::{FlowOf, Implicit};
use crate::geometry::{Mesh, Region, Rows};
use crate::liquid::FaceMap;

/// Name of the checkpoint array of the press programme's state.
const PROGRAMME: &str = "programme";

impl Scheme for Implicit {
    fn advance(&mut self, limit: StepLimit) -> Result<StepReport, Failure> {
        self.step(limit)
    }

    fn diagnostics(&self) -> Diagnostics {
        let (mesh, units) = (&self.mesh, self.setup.units);
        let (mut volume, mut energy) = (0.0, 0.0);
        let flow = self.field((&self.mesh, &self.couplings), &self.state.flow);
        for pore in 0..mesh.pores.len() {
            let amount = self.state.volumes[pore];
            if amount > 0.0 {
                let velocity = flow.mean(&self.setup.lattice, pore);
                let speed = velocity.iter().map(|v| v * v).sum::<f64>();
                volume += amount * self.compressed(pore);
                energy += 0.5 * amount * speed;
            }
        }
        Diagnostics {
            kinetic_energy: energy
                * self.setup.liquid.density
                * units.volume()
                * units.cell_m.powi(2),
            viscous_power: self.state.flow.dissipation * units.force() * units.cell_m,
            volume: volume * units.volume(),
            max_speed: self.state.courant_speed * units.cell_m,
            capped_fraction: 0.0,
            water: self.water_state(),
        }
    }

    fn liquid(&self) -> LiquidState {
        self.points()
    }

    fn filling(&self) -> LiquidState {
        self.filled_voxels().0
    }

    fn displacements(&self) -> Vec<[f64; 3]> {
        self.state.displacement.clone()
    }

    fn saving(&self) -> Vec<(String, Saving<'_>)> {
        let state = &self.state;
        let mut scalars = vec![
            self.height(),
            state.travel,
            state.time,
            state.steps as f64,
            state.courant_speed,
            state.growth,
            state.lost,
            state.flow.dissipation,
            state.unsettled as f64,
            state.flow.speed,
            state.flow.force,
            state.dt,
        ];
        scalars.extend(state.drive.state());
        scalars.extend([f64::from(state.flow_of as u8), state.trend]);
        scalars.extend(state.pressures);
        let rows = [
            self.mesh.rows().gap,
            self.mesh.range.start,
            self.mesh.range.end,
        ];
        let mut arrays = vec![
            ("scalars", Array::F64(scalars)),
            ("rows", Array::U32(rows.map(|row| row as u32).to_vec())),
            ("region", Array::U32(self.mesh.region.bits())),
            ("volumes", Array::F64(state.volumes.clone())),
            ("velocities", Array::F64(state.flow.velocity.clone())),
            ("pressures", Array::F64(state.flow.pressure.clone())),
            (
                "displacement",
                Array::F64(state.displacement.as_flattened().to_vec()),
            ),
        ];
        let programme = state.drive.programme.as_ref().map(PressRun::state);
        arrays.extend(programme.map(|state| (PROGRAMME, Array::F64(state))));
        arrays.extend(self.save_air());
        arrays.extend(self.save_water());
        (arrays.into_iter())
            .map(|(name, array)| (name.to_owned(), Saving::Whole(array)))
            .collect()
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), String> {
        let scalars = saved.f64s("scalars")?;
        restored::check_finite(scalars, "scalars")?;
        let &[
            height,
            travel,
            time,
            steps,
            courant_speed,
            growth,
            lost,
            dissipation,
            unsettled,
            speed,
            force,
            dt,
            ref drive @ ..,
        ] = scalars
        else {
            return Err("the checkpoint's scalars are not those of this scheme".into());
        };
        let Some((drive, &[flow_of, trend, ref pressures @ ..])) = drive.split_at_checked(7) else {
            return Err("the checkpoint's clamp state is not that of this scheme".into());
        };
        let (Ok(drive), Ok(pressures)) =
            (<[f64; 7]>::try_from(drive), <[f64; 3]>::try_from(pressures))
        else {
            return Err("the checkpoint's clamp state is not that of this scheme".into());
        };
        if [
            height,
            time,
            steps,
            courant_speed,
            growth,
            lost,
            unsettled,
            dt,
        ]
        .iter()
        .any(|&x| x < 0.0)
        {
            return Err("a scalar of the checkpoint is negative where none can be".into());
        }
        let mesh = self.saved_mesh(saved, height)?;
        let array = |name: &str, n: usize| -> Result<Vec<f64>, String> {
            let values = saved.f64s(name)?;
            restored::check_finite(values, name)?;
            match values.len() == n {
                true => Ok(values.to_vec()),
                false => Err(format!(
                    "array '{name}' of the checkpoint has {} values where this scene has {n}",
                    values.len()
                )),
            }
        };
        let volumes = array("volumes", mesh.pores.len())?;
        if volumes.iter().any(|&volume| volume < 0.0) {
            return Err("a volume of the checkpoint is negative".into());
        }
        let balance = self.restored_water(saved, &volumes)?;
        let velocity = array("velocities", mesh.faces.len())?;
        let pressure = array("pressures", mesh.pores.len())?;
        let air = self.restored_air(saved, mesh.pores.len())?;
        let displacement = array("displacement", 3 * self.state.displacement.len())?;
        let displacement = displacement.as_chunks::<3>().0.to_vec();
        let (motions, cell_m) = (&self.setup.motions, self.setup.units.cell_m);
        restored::check_bodies(motions, &displacement, travel, cell_m)?;
        if let Some(programme) = &mut self.state.drive.programme {
            let state = saved.f64s(PROGRAMME)?;
            restored::check_finite(state, PROGRAMME)?;
            programme.set_state(state)?;
        }
        self.state.drive.set_state(drive);
        let state = &mut self.state;
        (state.travel, state.time, state.steps) = (travel, time, steps as u64);
        (state.courant_speed, state.growth) = (courant_speed, growth);
        (state.lost, state.unsettled) = (lost, unsettled as u64);
        (state.volumes, state.air, state.water) = (volumes, air, balance);
        (state.flow.velocity, state.flow.pressure) = (velocity, pressure);
        (state.flow.speed, state.flow.force, state.dt) = (speed, force, dt);
        state.flow.dissipation = dissipation;
        state.flow_of = match flow_of {
            0.0 => FlowOf::Earlier,
            1.0 => FlowOf::LastStep,
            _ => FlowOf::Now,
        };
        (state.trend, state.pressures) = (trend, pressures);
        state.displacement = displacement;
        self.mesh = mesh;
        self.rebuild_walls(&FaceMap::default());
        Ok(())
    }

    fn has_set(&self) -> bool {
        // Set if loss of water and cure together reach the viscosity of a set liquid.
        let cure = self.setup.liquid.cure.as_ref();
        let cured = cure.map_or(1.0, |cure| cure.factor(self.state.time) / cure.factor(0.0));
        (self.state.water.as_ref()).is_some_and(|balance| balance.fluidity / cured <= 1.0 / SET)
    }

    fn stage_times(&self) -> Vec<StageTime> {
        self.clock.report(self.setup.liquid.water.is_some())
    }

    fn counts(&self) -> Vec<(&'static str, u64)> {
        let mut counts = self.air_counts();
        if self
            .setup
            .clamp
            .is_some_and(|clamp| clamp.max_pressure.is_some())
        {
            counts.push((
                "steps above the pressure limit",
                self.state.drive.violations.0,
            ));
        }
        counts.push(("steps that did not converge", self.state.unsettled));
        counts
    }

    fn programme(&self) -> Option<&PressRun> {
        self.state.drive.programme.as_ref()
    }

    fn follows_points(&self) -> bool {
        false
    }

    fn objection(&self) -> Option<String> {
        /// Accepted share of such steps: a few converge late in sound runs.
        const MOST: f64 = 0.1;
        let steps = self.state.steps;
        let (above, pressure) = self.state.drive.violations;
        let mut objections: Vec<String> = [
            (
                self.state.unsettled,
                "the iterations for viscosity, compression or cavitation did not converge: a lower closing_speed or a smaller integrator.cfl may help",
            ),
            (
                self.state.air.unsettled,
                "the iteration for the pressure of the enclosed air did not converge",
            ),
            (
                above,
                "enclosed liquid pressed on the clamp's body with more than max_pressure: a smaller integrator.cfl or a lower closing_speed may help",
            ),
        ]
        .into_iter()
        .filter(|&(count, _)| count as f64 > MOST * steps as f64)
        .map(|(count, what)| format!("in {count} of {steps} steps {what}"))
        .collect();
        if pressure > 0.0 {
            objections.push(physics::broken(pressure));
        }
        (!objections.is_empty()).then(|| objections.join("; "))
    }
}

impl Implicit {
    /// The mesh of a checkpoint with a gap of `height` cells.
    fn saved_mesh(&self, saved: &Saved, height: f64) -> Result<Mesh, String> {
        let &[gap, start, end] = saved.u32s("rows")? else {
            return Err("the checkpoint's rows are not those of this scheme".into());
        };
        let rows = Rows {
            gap: gap as usize,
            height,
            ..*self.mesh.rows()
        };
        let range = start as usize..end as usize;
        let most = self.setup.lattice.rows().gap;
        if gap as usize > most
            || range.is_empty()
            || range.end > rows.len()
            || gap == 0 && height > 0.0
        {
            return Err(format!(
                "the checkpoint has rows {start} to {end} with {gap} in the gap, which this scene does not have"
            ));
        }
        let lattice = &self.setup.lattice;
        let size = Mesh::size_of(lattice, &range);
        let region = Region::of_bits(size, saved.u32s("region")?)
            .ok_or("the checkpoint's region is not one of its rows")?;
        Ok(Mesh::new(lattice, rows, range, region))
    }
}
