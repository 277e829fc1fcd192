//! The water balance of a run: water in the liquid, in the walls, and gone with the outflow.

use physics::{Array, Saved, WaterState};

use super::exchange::WaterExchange;
use super::setup::Setup;
use super::trial::Solved;
use super::{Implicit, LN_VISCOSITY_STEP};
use crate::geometry::DRIFT;

/// Names of the checkpoint arrays of the water in the liquid and in the walls of each pore, and of the totals.
const WATER: &str = "water";
const SOAKED: &str = "water_in_walls";
const ACCOUNT: &str = "water_account";

/// The water balance of a liquid that loses water.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct WaterBalance {
    /// Water in the liquid of each pore, and in the walls of each pore, cells.
    pub(super) water: Vec<f64>,
    pub(super) soaked: Vec<f64>,
    /// Totals, cells: water at the start, in the walls, and gone from the domain with the liquid.
    start: f64,
    in_walls: f64,
    pub(super) left: f64,
    /// Rate of change of ln(viscosity) by loss of water in the last step, 1/s.
    ln_viscosity_rate: f64,
    /// Mean over the liquid of 1/(factor on the viscosity).
    pub(super) fluidity: f64,
}

impl WaterBalance {
    /// Step length at which loss of water changes ln(viscosity) by the target, s.
    pub(super) fn steady_time(&self) -> f64 {
        LN_VISCOSITY_STEP / self.ln_viscosity_rate
    }

    /// Error of the balance: water that is unaccounted for, over that at the start.
    fn missing(&self) -> f64 {
        let in_liquid = self.water.iter().sum::<f64>();
        (self.start - in_liquid - self.in_walls - self.left) / self.start
    }

    /// Applies the water exchange of a step of `dt` (s) to the balance and to the liquid `volumes`.
    pub(super) fn give_off(&mut self, exchange: &WaterExchange, dt: f64, volumes: &mut [f64]) {
        for (pore, (&gained, &taken)) in exchange.gained.iter().zip(&exchange.taken).enumerate() {
            self.water[pore] += gained;
            volumes[pore] += gained;
            self.soaked[pore] += taken;
        }
        self.in_walls += exchange.taken.iter().sum::<f64>();
        self.ln_viscosity_rate = exchange.change / dt;
        self.fluidity = exchange.fluidity;
    }
}

impl Solved {
    /// If the liquid dries too fast in this step: the length to repeat it with, s.
    pub(super) fn dries_too_fast(&self) -> Option<f64> {
        let middle = &self.trial.middle;
        let change = middle.water_loss.as_ref()?.change;
        // A tolerance of one half on the target, so that few steps are repeated.
        (change > 1.5 * LN_VISCOSITY_STEP).then(|| middle.dt * LN_VISCOSITY_STEP / change)
    }
}

impl Setup {
    /// The water balance at the start, for liquid `volumes`.
    pub(super) fn initial_water(&self, volumes: &[f64]) -> Option<WaterBalance> {
        let start = self.liquid.water.as_ref()?.start();
        let water: Vec<f64> = volumes
            .iter()
            .map(|volume| volume * start / (1.0 + start))
            .collect();
        Some(WaterBalance {
            start: water.iter().sum(),
            soaked: vec![0.0; water.len()],
            water,
            in_walls: 0.0,
            left: 0.0,
            ln_viscosity_rate: 0.0,
            fluidity: 1.0,
        })
    }
}

impl Implicit {
    /// The water balance for diagnostics.
    pub(super) fn water_state(&self) -> Option<WaterState> {
        let (water, balance) = (
            self.setup.liquid.water.as_ref()?,
            self.state.water.as_ref()?,
        );
        let in_liquid = balance.water.iter().sum::<f64>();
        let solids = self.state.volumes.iter().sum::<f64>() - in_liquid;
        let volume = self.setup.units.volume();
        Some(WaterState {
            given_off_m3: (solids * water.start() - in_liquid) * volume,
            in_walls_m3: balance.in_walls * volume,
            missing: balance.missing(),
            solids: water.solids(in_liquid / solids),
        })
    }

    /// Solids content of a pore by mass; `None` where the liquid loses no water.
    pub(super) fn solids_of(&self, pore: usize) -> Option<f64> {
        let (water, balance) = (
            self.setup.liquid.water.as_ref()?,
            self.state.water.as_ref()?,
        );
        let in_liquid = balance.water[pore];
        Some(water.solids(in_liquid / (self.state.volumes[pore] - in_liquid)))
    }

    /// The water's checkpoint arrays.
    pub(super) fn save_water(&self) -> Vec<(&'static str, Array)> {
        let Some(balance) = &self.state.water else {
            return Vec::new();
        };
        let account = [
            balance.start,
            balance.in_walls,
            balance.left,
            balance.ln_viscosity_rate,
            balance.fluidity,
        ];
        vec![
            (WATER, Array::F64(balance.water.clone())),
            (SOAKED, Array::F64(balance.soaked.clone())),
            (ACCOUNT, Array::F64(account.to_vec())),
        ]
    }

    /// The water balance of a checkpoint whose pores hold liquid `volumes`.
    ///
    /// # Errors
    /// Where the arrays do not belong to this scene or do not balance.
    pub(super) fn restored_water(
        &self,
        saved: &Saved,
        volumes: &[f64],
    ) -> Result<Option<WaterBalance>, String> {
        let Some(balance) = &self.state.water else {
            return Ok(None);
        };
        let (water, soaked) = (saved.f64s(WATER)?, saved.f64s(SOAKED)?);
        let account = saved.f64s(ACCOUNT)?;
        let &[start, in_walls, left, ln_viscosity_rate, fluidity] = account else {
            return Err("the checkpoint's account of water is not that of this scheme".into());
        };
        let found = WaterBalance {
            water: water.to_vec(),
            soaked: soaked.to_vec(),
            start,
            in_walls,
            left,
            ln_viscosity_rate,
            fluidity,
        };
        let counts = |x: &f64| (0.0..=f64::MAX).contains(x);
        let is_bounded =
            |(&water, &volume): (&f64, &f64)| (-DRIFT..=volume + DRIFT).contains(&water);
        let sound = [water.len(), soaked.len()] == [volumes.len(); 2]
            && water.iter().zip(volumes).all(is_bounded)
            && soaked
                .iter()
                .chain(&[in_walls, left, ln_viscosity_rate])
                .all(counts)
            && start == balance.start
            && fluidity > 0.0
            && fluidity <= 1.0
            && found.missing().abs() <= DRIFT;
        match sound {
            true => Ok(Some(found)),
            false => Err("the checkpoint's water is not that of its liquid and walls".into()),
        }
    }
}
