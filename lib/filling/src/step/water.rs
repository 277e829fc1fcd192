//! What a step does about the loss of water: before the solve what the walls take, after it what the points
//! hold.

use physics::{Array, SET, Saved, WaterState};

use super::length::Fit;
use super::{Implicit, Part, Trial};
use crate::water::{Exchange, Medium, give_off};

/// Change of ln(viscosity), where the liquid dries, that a step aims at; its viscosity is that of its
/// middle.
pub(crate) const DRIED: f64 = 0.2;
/// The same from which a step is taken again, shorter.
const MOST_DRIED: f64 = 0.3;
/// Names of the arrays that hold what the points are made of and the account.
const PARTS: &str = "solids_and_water";
const ACCOUNT: &str = "water";
const SOAKED: &str = "water_in_walls";
/// Part of a ratio that rounding may move.
const ROUNDING: f64 = 1e-6;

/// Water that a piece of wall asks for per area in a step of so much uptake, cells, if what walls of this
/// capacity hold is `soaked`.
fn depth(piece: u32, uptake: f64, capacity: f64, soaked: &[f32]) -> f64 {
    let held = soaked
        .get(piece as usize)
        .map_or(0.0, |&held| f64::from(held));
    uptake.min((capacity - held).max(0.0))
}

impl Implicit {
    /// Pieces of wall that are full some time.
    pub(super) fn pieces_that_fill(&self) -> usize {
        let fills = (self.setup.liquid.water.as_ref()).is_some_and(|w| w.capacity().is_some());
        match &self.setup.surface {
            Some(surface) if fills => surface.len(),
            _ => 0,
        }
    }

    /// Ends stage 3: what the walls take in the step, and where the water goes that is left.
    pub(super) fn dry(&mut self, trial: &mut Trial) -> Fit {
        let (Some(water), Some(surface)) = (&self.setup.liquid.water, &self.setup.surface) else {
            return Fit::Good;
        };
        let h = self.setup.units.h;
        let medium = Medium {
            water,
            diffusion: trial.dt * water.diffusivity() / (h * h),
        };
        let (lattice, particles) = (&trial.lattice, &self.state.particles);
        let (fractions, bins) = (&self.workspace.fractions, &self.workspace.bins);
        let phi = &fractions.liquid;
        let (uptake, soaked) = (trial.dt * water.uptake() / h, &self.state.soaked);
        let capacity = water.capacity().map_or(f64::INFINITY, |length| length / h);
        let (wetted, exchange) = self.workspace.clock.time(Part::Water, || {
            let mut wetted = surface.wetted(&lattice.solids, &lattice.window, &lattice.open, phi);
            for wet in &mut wetted {
                let touching = fractions.touching(wet.cell as usize);
                (wet.area, wet.part) = (wet.area * touching, wet.part * touching);
            }
            let mut asked = vec![0.0; lattice.window.len()];
            for wet in &wetted {
                let depth = depth(wet.piece, uptake, capacity, soaked);
                asked[wet.cell as usize] += depth * f64::from(wet.area);
            }
            let exchange = Exchange::new(&medium, lattice, phi, particles, bins, &asked);
            (wetted, exchange)
        });
        let Some(exchange) = exchange else {
            // The shorter the step, the nearer its balance is to the one before.
            return Fit::Dried(0.5);
        };
        let change = exchange.change;
        trial.exchange = Some(exchange);
        trial.wetted = wetted;
        match change > MOST_DRIED {
            true => Fit::Dried(DRIED / change),
            false => Fit::Good,
        }
    }

    /// For how long the loss of water leaves the viscosity as it is, s.
    pub(super) fn moist(&self) -> f64 {
        let pace = self.state.water.map_or(0.0, |account| account.pace);
        DRIED / pace
    }

    /// The points give off, or take up, what the step moved.
    pub(super) fn give_off(&mut self, trial: &Trial, dt: f64) {
        let Some(exchange) = &trial.exchange else {
            return;
        };
        let (Some(water), Some(account)) = (&self.setup.liquid.water, &mut self.state.water) else {
            return;
        };
        give_off(
            &mut self.state.particles,
            &self.workspace.bins,
            exchange,
            water,
        );
        account.in_walls += exchange.taken;
        if let Some(capacity) = water.capacity() {
            let h = self.setup.units.h;
            let (uptake, capacity) = (trial.dt * water.uptake() / h, capacity / h);
            for wet in &trial.wetted {
                let part = f64::from(wet.part * exchange.granted[wet.cell as usize]);
                let depth = depth(wet.piece, uptake, capacity, &self.state.soaked);
                self.state.soaked[wet.piece as usize] += (part * depth) as f32;
            }
        }
        account.pace = exchange.change / dt;
        account.fluidity = exchange.fluidity;
    }

    /// What of the water in the points, `before` (cells), has left the domain with them.
    pub(super) fn let_go(&mut self, before: f64) {
        let held = self.state.particles.water();
        if let Some(account) = &mut self.state.water {
            account.left += before - held;
        }
    }

    /// Whether the liquid is as thick by its loss of water, with cure, as one that has set.
    pub(super) fn has_dried(&self) -> bool {
        let cure = self.setup.liquid.cure.as_ref();
        let cured = cure.map_or(1.0, |cure| cure.factor(self.state.time) / cure.factor(0.0));
        (self.state.water).is_some_and(|account| account.fluidity / cured <= 1.0 / SET)
    }

    /// Where the water is.
    pub(super) fn water_state(&self) -> Option<WaterState> {
        let (water, account) = (self.setup.liquid.water.as_ref()?, self.state.water?);
        let parts = &self.state.particles.parts;
        let (solids, held) =
            (parts.iter()).fold((0.0, 0.0), |(s, w), part| (s + part[0], w + part[1]));
        let volume = self.setup.units.volume();
        Some(WaterState {
            given_off_m3: (solids * water.start() - held) * volume,
            in_walls_m3: account.in_walls * volume,
            missing: account.missing(held),
            solids: water.solids(held / solids),
        })
    }
}

impl Implicit {
    /// Solids content by mass of these particles; nothing where no water is lost.
    pub(super) fn solids(&self, order: &[u32]) -> Vec<f32> {
        let Some(water) = &self.setup.liquid.water else {
            return Vec::new();
        };
        let parts = order
            .iter()
            .map(|&p| self.state.particles.parts[p as usize]);
        parts
            .map(|[solids, held]| water.solids(held / solids) as f32)
            .collect()
    }

    /// The arrays of a checkpoint.
    pub(super) fn save_water(&self) -> Vec<(String, Array)> {
        let Some(account) = &self.state.water else {
            return Vec::new();
        };
        let parts = self.state.particles.parts.as_flattened().to_vec();
        vec![
            (PARTS.into(), Array::F64(parts)),
            (ACCOUNT.into(), Array::F64(account.save())),
            (SOAKED.into(), Array::F32(self.state.soaked.clone())),
        ]
    }

    /// Takes over the arrays of a checkpoint whose points have these volumes.
    ///
    /// # Errors
    /// What no run of this scene saves.
    pub(super) fn restore_water(&mut self, saved: &Saved, volume: &[f32]) -> Result<(), String> {
        let (Some(water), Some(account)) = (&self.setup.liquid.water, &self.state.water) else {
            return Ok(());
        };
        let (parts, rest) = saved.f64s(PARTS)?.as_chunks::<2>();
        let account = account.restore(saved.f64s(ACCOUNT)?)?;
        let [least, start] = [
            water.least() * (1.0 - ROUNDING),
            water.start() * (1.0 + ROUNDING),
        ];
        let sound = |(&[solids, held], &volume): (&[f64; 2], &f32)| {
            solids > 0.0
                && (least..=start).contains(&(held / solids))
                && (solids + held) as f32 == volume
        };
        if parts.len() != volume.len() || !rest.is_empty() || !parts.iter().zip(volume).all(sound) {
            return Err(
                "the solids and the water of the checkpoint's points are not those of their volumes"
                    .into(),
            );
        }
        let held = parts.iter().map(|part| part[1]).sum();
        if account.missing(held).abs() > ROUNDING {
            return Err(
                "the checkpoint's points, walls and account do not hold the water of the start"
                    .into(),
            );
        }
        let soaked = saved.f32s(SOAKED)?;
        let capacity = water.capacity().unwrap_or(0.0) / self.setup.units.h * (1.0 + ROUNDING);
        let held = |held: &f32| (0.0..=capacity).contains(&f64::from(*held));
        if soaked.len() != self.state.soaked.len() || !soaked.iter().all(held) {
            return Err("the walls of the checkpoint hold water as no run makes them".into());
        }
        self.state.soaked = soaked.to_vec();
        self.state.particles.parts = parts.to_vec();
        self.state.water = Some(account);
        Ok(())
    }
}
