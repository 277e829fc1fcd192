//! `physics::Scheme` of the implicit scheme: what it shows, saves and restores.

use physics::restored;
use physics::{
    Array, Diagnostics, Failure, LiquidState, PressRun, Saved, Saving, Scheme, StageTime,
    StepLimit, StepReport,
};
use rayon::prelude::*;

use super::length::{TREND, Trend};
use super::solution::{LINES, PASSES};
use super::{Implicit, LastFlow, Rates};
use crate::transport;

/// Name of the array that holds where the press programme is.
const PROGRAMME: &str = "programme";
/// Name of the array that holds the steps whose contact lines did not settle.
const LINES_LEFT: &str = "contact_lines";

impl Scheme for Implicit {
    fn advance(&mut self, limit: StepLimit) -> Result<StepReport, Failure> {
        self.step(limit)
    }

    fn diagnostics(&self) -> Diagnostics {
        let square = |v: [f32; 3]| v.iter().map(|&c| f64::from(c).powi(2)).sum::<f64>();
        let particles = &self.state.particles;
        let parts: Vec<(f64, f64)> = (particles.velocity.par_chunks(1 << 14))
            .zip(particles.volume.par_chunks(1 << 14))
            .map(|(velocities, volumes)| {
                let mut sum = (0.0, 0.0_f64);
                for (&v, &volume) in velocities.iter().zip(volumes) {
                    let square = square(v);
                    sum = (sum.0 + square * f64::from(volume), sum.1.max(square));
                }
                sum
            })
            .collect();
        let (energy, fastest) = (parts.iter()).fold((0.0, 0.0_f64), |sum, part| {
            (sum.0 + part.0, sum.1.max(part.1))
        });
        Diagnostics {
            kinetic_energy: 0.5 * self.setup.liquid.density * energy * self.setup.units.volume(),
            viscous_power: self.state.power,
            volume: particles.total_volume() * self.setup.units.volume(),
            max_speed: fastest.sqrt(),
            capped_fraction: 0.0,
            water: self.water_state(),
        }
    }

    fn liquid(&self) -> LiquidState {
        let (particles, units) = (&self.state.particles, self.setup.units);
        let rates = self.shear_rates();
        // In the order of the scene's points.
        let mut order: Vec<u32> = (0..particles.len() as u32).collect();
        order.par_sort_unstable_by_key(|&p| particles.id[p as usize]);
        let volume = |p: usize| {
            f64::from(particles.volume[p]) * (1.0 + f64::from(particles.j[p])) * units.volume()
        };
        let tait = self.setup.liquid.tait;
        LiquidState {
            position: of(&order, |p| {
                units.to_metres(particles.position[p]).map(|x| x as f32)
            }),
            velocity: of(&order, |p| particles.velocity[p]),
            volume: of(&order, |p| volume(p) as f32),
            pressure: of(&order, |p| tait.pressure(f64::from(particles.j[p])) as f32),
            shear_rate: of(&order, |p| rates[p]),
            solids: self.solids(&order),
        }
    }

    fn displacements(&self) -> Vec<[f64; 3]> {
        self.state.displacement.clone()
    }

    fn saving(&self) -> Vec<(String, Saving<'_>)> {
        let particles = &self.state.particles;
        let flat = |v: &[[f64; 3]]| v.iter().flatten().copied().collect::<Vec<f64>>();
        let velocity = particles.velocity.iter().flatten().copied().collect();
        let mut scalars = vec![
            self.state.pace,
            self.state.travel,
            self.state.steps as f64,
            self.state.counts.lost as f64,
            self.state.counts.pinched as f64,
            self.state.counts.deflected as f64,
            self.state.counts.unsettled as f64,
            self.state.power,
        ];
        scalars.extend(self.state.drive.state());
        let arrays = [
            ("position", Array::F64(flat(&particles.position))),
            ("velocity", Array::F32(velocity)),
            ("volume", Array::F32(particles.volume.clone())),
            ("volume_change", Array::F32(particles.j.clone())),
            ("shear_rate", Array::F32(self.shear_rates())),
            ("point", Array::U32(particles.id.clone())),
            ("displacement", Array::F64(flat(&self.state.displacement))),
            ("scalars", Array::F64(scalars)),
            (TREND, Array::F64(self.state.trend.state())),
        ];
        let mut arrays: Vec<_> = arrays.map(|(name, array)| (name.to_string(), array)).into();
        arrays.extend((self.state.last.iter()).flat_map(LastFlow::save));
        if self.setup.liquid.cure.is_some() {
            arrays.push(("time".into(), Array::F64(vec![self.state.time])));
        }
        arrays.extend(self.save_water());
        let programme = self.state.drive.programme().map(PressRun::state);
        arrays.extend(programme.map(|state| (PROGRAMME.to_owned(), Array::F64(state))));
        arrays.extend(self.save_air());
        if self.setup.lines_hold() {
            let undecided = self.state.counts.undecided as f64;
            arrays.push((LINES_LEFT.into(), Array::F64(vec![undecided])));
        }
        let arrays = arrays.into_iter();
        arrays
            .map(|(name, array)| (name, Saving::Whole(array)))
            .collect()
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), String> {
        let position = triples(saved.f64s("position")?, "position")?;
        let n = position.len();
        let velocity = triples(saved.f32s("velocity")?, "velocity")?;
        let displacement = triples(saved.f64s("displacement")?, "displacement")?;
        let (volume, j) = (saved.f32s("volume")?, saved.f32s("volume_change")?);
        let (rates, id) = (saved.f32s("shear_rate")?, saved.u32s("point")?);
        let scalars = saved.f64s("scalars")?;
        self.check_saved(saved, &position, &displacement)?;
        let lengths = [velocity.len(), volume.len(), j.len(), rates.len(), id.len()];
        if lengths.iter().any(|&l| l != n) {
            return Err("the arrays of the checkpoint differ in length".into());
        }
        let &[
            pace,
            travel,
            steps,
            lost,
            pinched,
            deflected,
            unsettled,
            power,
            ref drive @ ..,
        ] = scalars
        else {
            return Err("the checkpoint's scalars are not those of the implicit scheme".into());
        };
        let Ok(drive) = <[f64; 7]>::try_from(drive) else {
            return Err("the checkpoint's clamp state is not that of the implicit scheme".into());
        };
        self.state.trend = Trend::restore(saved.f64s(TREND)?)?;
        let keeps = steps > 0.0 && self.setup.present.table;
        self.state.last = match keeps {
            true => Some(LastFlow::restore(saved, self.setup.domain)?),
            false => None,
        };
        if self.setup.liquid.cure.is_some() {
            self.state.time = match saved.f64s("time")? {
                &[time] if time >= 0.0 && time.is_finite() => time,
                other => return Err(format!("the checkpoint's time is none: {other:?}")),
            };
        }
        self.restore_water(saved, volume)?;
        self.state.particles.position = position;
        self.state.particles.velocity = velocity;
        self.state.particles.volume = volume.to_vec();
        self.state.particles.j = j.to_vec();
        self.state.particles.id = id.to_vec();
        self.state.displacement = displacement;
        (self.state.pace, self.state.travel, self.state.power) = (pace, travel, power);
        (self.state.steps, self.state.counts.lost) = (steps as u64, lost as u64);
        (self.state.counts.pinched, self.state.counts.deflected) =
            (pinched as u64, deflected as u64);
        self.state.counts.unsettled = unsettled as u64;
        if self.state.drive.programme().is_some() {
            let state = saved.f64s(PROGRAMME)?;
            restored::check_finite(state, PROGRAMME)?;
            self.state.drive.set_programme(state)?;
        }
        self.restore_air(saved)?;
        if self.setup.lines_hold() {
            self.state.counts.undecided = match saved.f64s(LINES_LEFT)? {
                &[count] if (0.0..=steps).contains(&count) && count.fract() == 0.0 => count as u64,
                other => {
                    return Err(format!(
                        "the checkpoint's contact lines are none: {other:?}"
                    ));
                }
            };
        }
        self.state.drive.set_state(drive);
        self.state.rates = Rates::Restored(rates.to_vec());
        Ok(())
    }

    fn has_set(&self) -> bool {
        self.has_dried()
    }

    fn programme(&self) -> Option<&PressRun> {
        self.state.drive.programme()
    }

    fn stage_times(&self) -> Vec<StageTime> {
        self.workspace.clock.report()
    }

    fn counts(&self) -> Vec<(&'static str, u64)> {
        let mut counts = vec![
            (
                "particles turned back by walls",
                self.state.counts.deflected,
            ),
            (
                "particles pinched between closing walls",
                self.state.counts.pinched,
            ),
            (
                "voxels of voids that no liquid can reach",
                self.setup.sealed,
            ),
        ];
        if self.setup.present.load {
            counts.push(("steps above the pressure limit", self.state.drive.broken.0));
        }
        if self.setup.present.table {
            let unsettled = self.state.counts.unsettled;
            counts.push(("steps whose viscosity did not settle", unsettled));
        }
        if self.setup.lines_hold() {
            let undecided = self.state.counts.undecided;
            counts.push(("steps whose contact lines did not settle", undecided));
        }
        counts.extend(self.air_counts());
        counts
    }

    fn objection(&self) -> Option<String> {
        /// Part of the steps that may be so.
        const MOST_UNSETTLED: f64 = 0.1;
        let (steps, unsettled) = (self.state.steps, self.state.counts.unsettled);
        let often = |count: u64| count as f64 > MOST_UNSETTLED * steps as f64;
        let viscosity = often(unsettled).then(|| {
            format!(
                "in {unsettled} of {steps} steps {PASSES} passes did not find the viscosity of the flow, \
                 which makes their pressures uncertain by more than 1 %; a viscosity_table \
                 whose stress falls with the rate, or whose viscosity rises with it, may be why"
            )
        });
        let astray = self.state.air.astray;
        let air = often(astray).then(|| {
            format!(
                "in {astray} of {steps} steps the air did not come to the pressure of its volume"
            )
        });
        let undecided = self.state.counts.undecided;
        let lines = often(undecided).then(|| {
            format!(
                "in {undecided} of {steps} steps {LINES} solves did not find which contact lines hold and which go"
            )
        });
        let pressure = self.state.drive.broken.1;
        let limit = (pressure > 0.0).then(|| physics::broken(pressure));
        let said: Vec<String> = [viscosity, air, lines, limit]
            .into_iter()
            .flatten()
            .collect();
        (!said.is_empty()).then(|| said.join("; "))
    }
}

impl Implicit {
    /// Shear rate of each particle, 1/s; 0 before the first step.
    fn shear_rates(&self) -> Vec<f32> {
        let particles = &self.state.particles;
        match &self.state.rates {
            Rates::Zero => vec![0.0; particles.len()],
            Rates::Of(flow) => {
                let convention = self.setup.liquid.shear_rate;
                transport::shear_rates(particles, flow, convention, self.setup.units.h)
            }
            Rates::Restored(rates) => rates.clone(),
        }
    }

    /// Refuses what no run of this scene saves.
    fn check_saved(
        &self,
        saved: &Saved,
        position: &[[f64; 3]],
        displacement: &[[f64; 3]],
    ) -> Result<(), String> {
        /// Cells around the domain in which a point is still found, see [`crate::geometry::PAD`].
        const BESIDE: f64 = 1.0;
        let scalars = saved.f64s("scalars")?;
        restored::check_finite(scalars, "scalars")?;
        let scalar = |i: usize| scalars.get(i).copied().unwrap_or(f64::NAN);
        // A clamp that a programme releases may give way beyond its start.
        let opens = |i: usize| i == 1 && self.state.drive.programme().is_some();
        let negative = |(i, &x): (usize, &f64)| x < 0.0 && !opens(i);
        if let Some(i) = scalars.iter().enumerate().take(8).position(negative) {
            return Err(format!(
                "scalar {i} of the checkpoint, {}, is negative",
                scalar(i)
            ));
        }
        for name in ["velocity", "volume", "volume_change", "shear_rate"] {
            restored::check_finite(saved.f32s(name)?, name)?;
        }
        let total = self.state.particles.len() + self.state.counts.lost as usize;
        restored::check_points(saved.u32s("point")?, total, scalar(3) as u64)?;
        restored::check_bodies(
            self.state.drive.motions(),
            displacement,
            scalar(1),
            self.setup.units.h,
        )?;
        let cells = self.setup.domain.cells.map(|n| n as f64 + BESIDE);
        let inside = |x: &[f64; 3]| (0..3).all(|a| (-BESIDE..=cells[a]).contains(&x[a]));
        if let Some(p) = position.iter().position(|x| !inside(x)) {
            return Err(format!(
                "point {p} of the checkpoint is at {:?} in a domain of {:?} cells",
                position[p], self.setup.domain.cells
            ));
        }
        let most = self
            .state
            .particles
            .volume
            .iter()
            .copied()
            .fold(0.0, f32::max);
        let volumes = saved
            .f32s("volume")?
            .iter()
            .zip(saved.f32s("volume_change")?);
        let sound = |&v: &f32, &j: &f32| v > 0.0 && v <= most && j > -1.0;
        match volumes.clone().position(|(v, j)| !sound(v, j)) {
            None => Ok(()),
            Some(p) => Err(format!(
                "point {p} of the checkpoint has a volume that no run gives it: the largest is {most} cells"
            )),
        }
    }
}

fn of<T: Send>(particles: &[u32], value: impl Fn(usize) -> T + Sync) -> Vec<T> {
    particles.par_iter().map(|&p| value(p as usize)).collect()
}

fn triples<T: Copy>(flat: &[T], name: &str) -> Result<Vec<[T; 3]>, String> {
    let (triples, rest) = flat.as_chunks::<3>();
    if rest.is_empty() {
        Ok(triples.to_vec())
    } else {
        Err(format!(
            "array '{name}' of the checkpoint is not made of triples"
        ))
    }
}
