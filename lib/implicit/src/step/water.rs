//! Loss of water: what walls take in a step, and what the liquid is left with.

use physics::{Array, SET, Saved, Saving, WaterState};

use super::setup::Setup;
use super::solve::Solved;
use super::{Implicit, THICKENS};
use crate::geometry::DRIFT;
use crate::water::{Account, Exchange, Medium};

/// Names of the arrays that hold the water in the liquid, in the walls of each pore, and the account.
const WATER: &str = "water";
const SOAKED: &str = "water_in_walls";
const ACCOUNT: &str = "water_account";

/// The water of a liquid that loses it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wet {
    /// Water in the liquid of each pore, and in its walls, cells.
    pub(super) water: Vec<f64>,
    pub(super) soaked: Vec<f64>,
    pub(super) account: Account,
}

impl Wet {
    /// For how long the loss of water leaves the viscosity as it is, s.
    pub(super) fn steady(&self) -> f64 {
        THICKENS / self.account.pace
    }

    /// Takes what a step of `dt` (s) moves out of the liquid.
    pub(super) fn give_off(&mut self, exchange: &Exchange, dt: f64, volumes: &mut [f64]) {
        for (pore, (&gained, &taken)) in exchange.gained.iter().zip(&exchange.taken).enumerate() {
            self.water[pore] += gained;
            volumes[pore] += gained;
            self.soaked[pore] += taken;
        }
        self.account.in_walls += exchange.taken.iter().sum::<f64>();
        self.account.pace = exchange.change / dt;
        self.account.fluidity = exchange.fluidity;
    }
}

impl Solved {
    /// How long a step may be at most, s, where the liquid dries too fast in this one.
    pub(super) fn dries_too_fast(&self) -> Option<f64> {
        let change = self.exchange.as_ref()?.change;
        // Half above what steps aim at, so few are taken again.
        (change > 1.5 * THICKENS).then(|| self.dt * THICKENS / change)
    }
}

impl Setup {
    /// The water of liquid `volumes` at the start.
    pub(super) fn wet(&self, volumes: &[f64]) -> Option<Wet> {
        let start = self.liquid.water.as_ref()?.start();
        let water: Vec<f64> = volumes
            .iter()
            .map(|volume| volume * start / (1.0 + start))
            .collect();
        Some(Wet {
            account: Account {
                start: water.iter().sum(),
                fluidity: 1.0,
                ..Account::default()
            },
            soaked: vec![0.0; water.len()],
            water,
        })
    }
}

impl Implicit {
    /// What a step of `dt` (s) moves of the water, in pores filled to `fractions` in its middle.
    pub(super) fn exchange(&self, dt: f64, fractions: &[f64]) -> Result<Option<Exchange>, String> {
        let (Some(water), Some(walls), Some(wet)) =
            (&self.setup.liquid.water, &self.walls, &self.state.wet)
        else {
            return Ok(None);
        };
        let h = self.setup.units.cell_m;
        let medium = Medium {
            mesh: &self.mesh,
            walls,
            water,
            fractions,
            diffusion: dt * water.diffusivity() / (h * h),
            uptake: dt * water.uptake() / h,
            capacity: water.capacity().map_or(f64::INFINITY, |length| length / h),
        };
        match Exchange::new(&medium, &self.state.volumes, &wet.water, &wet.soaked) {
            Some(exchange) => Ok(Some(exchange)),
            None => Err(
                "no balance of the water was found: a smaller uptake, a larger diffusivity or a \
                 flatter viscosity_by_solids is needed"
                    .into(),
            ),
        }
    }

    /// Whether the liquid is as thick by its loss of water, with cure, as one that has set.
    pub(super) fn has_dried(&self) -> bool {
        let cure = self.setup.liquid.cure.as_ref();
        let cured = cure.map_or(1.0, |cure| cure.factor(self.state.time) / cure.factor(0.0));
        (self.state.wet.as_ref()).is_some_and(|wet| wet.account.fluidity / cured <= 1.0 / SET)
    }

    /// Where the water is.
    pub(super) fn water_state(&self) -> Option<WaterState> {
        let (water, wet) = (self.setup.liquid.water.as_ref()?, self.state.wet.as_ref()?);
        let held = wet.water.iter().sum::<f64>();
        let solids = self.state.volumes.iter().sum::<f64>() - held;
        let volume = self.setup.units.volume();
        Some(WaterState {
            given_off_m3: (solids * water.start() - held) * volume,
            in_walls_m3: wet.account.in_walls * volume,
            missing: wet.account.missing(held),
            solids: water.solids(held / solids),
        })
    }

    /// Solids content of a pore by mass; none where no water is lost.
    pub(super) fn solids_of(&self, pore: usize) -> Option<f64> {
        let (water, wet) = (self.setup.liquid.water.as_ref()?, self.state.wet.as_ref()?);
        let held = wet.water[pore];
        Some(water.solids(held / (self.state.volumes[pore] - held)))
    }

    /// The arrays of a checkpoint.
    pub(super) fn save_water(&self) -> Vec<(String, Saving<'_>)> {
        let Some(wet) = &self.state.wet else {
            return Vec::new();
        };
        let arrays = [
            (WATER, wet.water.clone()),
            (SOAKED, wet.soaked.clone()),
            (ACCOUNT, wet.account.save()),
        ];
        (arrays.into_iter())
            .map(|(name, array)| (name.to_owned(), Saving::Whole(Array::F64(array))))
            .collect()
    }

    /// The water of a checkpoint whose pores hold liquid `volumes`.
    ///
    /// # Errors
    /// What no run of this scene saves.
    pub(super) fn restored_water(
        &self,
        saved: &Saved,
        volumes: &[f64],
    ) -> Result<Option<Wet>, String> {
        let Some(wet) = &self.state.wet else {
            return Ok(None);
        };
        let (water, soaked) = (saved.f64s(WATER)?, saved.f64s(SOAKED)?);
        let n = volumes.len();
        let sound = |(&water, &volume): (&f64, &f64)| (-DRIFT..=volume + DRIFT).contains(&water);
        if water.len() != n
            || soaked.len() != n
            || !water.iter().zip(volumes).all(sound)
            || !soaked
                .iter()
                .all(|soaked| (0.0..=f64::MAX).contains(soaked))
        {
            return Err("the checkpoint's water is not that of its liquid and walls".into());
        }
        let held = water.iter().sum();
        Ok(Some(Wet {
            account: wet.account.restore(saved.f64s(ACCOUNT)?, held)?,
            water: water.to_vec(),
            soaked: soaked.to_vec(),
        }))
    }
}
