//! Boundary conditions at the liquid's surface in a step: menisci, pockets of air, liquid torn by tension; and the air's state.

use physics::{Array, Boundary, Saved, restored};

use super::Implicit;
use super::mid_step::MidStep;
use crate::air::{Air, Gas};
use crate::geometry::DRIFT;
use crate::system::{FULL, Flow, Fronts, Unknowns, Wetting};

/// Names of the checkpoint arrays of the gas in each pore, and of its counts.
const AIR: &str = "air";
const COUNTS: &str = "air_counts";

/// The air's state between steps.
#[derive(Clone, Debug, Default)]
pub(super) struct AirState {
    /// Gas in each pore, as absolute pressure (over the unit of viscosity) times volume; empty where all air is ambient.
    pub(super) mass: Vec<f64>,
    /// Pockets of the last step, and the gas covered by liquid, without a pressure, in millionths of all that is closed off.
    pockets: u64,
    covered: u64,
    /// Steps at whose end a pocket did not obey the gas law.
    pub(super) unsettled: u64,
}

impl Implicit {
    /// Empty volume of each pore between steps, cells.
    fn void(&self) -> Vec<f64> {
        let pores = self.state.volumes.iter().enumerate();
        pores
            .map(|(pore, volume)| (self.mesh.volume(pore) - volume).max(0.0))
            .collect()
    }

    /// The air at the start: all has ambient pressure.
    pub(super) fn first_air(&self) -> AirState {
        let outside = |gas: Gas| self.void().iter().map(|void| gas.outside * void).collect();
        AirState {
            mass: self.setup.gas.map_or(Vec::new(), outside),
            ..AirState::default()
        }
    }

    /// The pockets of a step of `dt` (s), linearised about their volumes at its start; `None` where all air is ambient.
    pub(super) fn air_pockets(
        &self,
        unknowns: &Unknowns,
        fractions: &[f64],
        dt: f64,
    ) -> Option<Air> {
        let gas = self.setup.gas?;
        let mut air = Air::new(
            &self.mesh,
            |pore| unknowns.has_pressure(pore),
            |pore| fractions[pore] >= FULL,
            &self.void(),
            &self.state.air.mass,
            // Under a clamp both sides normal to y are outside (docs/methods.md section 3.13).
            self.setup.clamp.is_some() || self.setup.lattice.boundary[1] == Boundary::Open,
        );
        for pocket in air.pockets.iter_mut().chain(&mut air.dry) {
            pocket.tangent = gas.tangent(pocket.mass, pocket.volume, dt);
        }
        Some(air)
    }

    /// The boundary conditions at the surface of the liquid.
    pub(super) fn fronts(
        &self,
        unknowns: &Unknowns,
        torn: &[bool],
        air: Option<&Air>,
        middle: &MidStep,
    ) -> Fronts {
        let (setup, dt) = (&self.setup, middle.dt);
        let (tension, wetting) = (setup.liquid.cavitation_pressure, setup.liquid.wetting);
        if air.is_none() && tension.is_none() && wetting.is_none() {
            return Fronts::default();
        }
        let lowest = -tension.unwrap_or_default() / setup.units.viscosity;
        let mut around = vec![0.0; self.mesh.pores.len()];
        for (around, _) in around.iter_mut().zip(torn).filter(|of| *of.1) {
            *around = lowest;
        }
        for pocket in air.iter().flat_map(|air| &air.pockets) {
            for &pore in &pocket.pores {
                around[pore as usize] = pocket.tangent.pressure;
            }
        }
        let wetting = wetting.map(|wetting| Wetting {
            tension: wetting.tension / (setup.units.viscosity * setup.units.cell_m),
            cosine: wetting.contact_angle.cos(),
            dynamic_coefficient: setup.settings.dynamic_angle * middle.viscosity,
            dt,
            step_ratio: match self.state.steps {
                0 => 1.0,
                _ => (self.state.dt / dt).min(1.0),
            },
        });
        let geometry = (&setup.lattice, &setup.chords, &middle.mesh);
        let before = &self.state.flow.velocity;
        Fronts::new(geometry, (unknowns, torn), around, wetting, before)
    }

    /// Updates which pores are `torn`, that is, have liquid under more tension than it bears (docs/methods.md section 3.10).
    /// Returns whether any changed.
    pub(super) fn tear(
        &self,
        unknowns: &Unknowns,
        flow: &Flow,
        middle: &MidStep,
        torn: &mut [bool],
    ) -> bool {
        let Some(tension) = self.setup.liquid.cavitation_pressure else {
            return false;
        };
        let lowest = -tension / self.setup.units.viscosity;
        let mesh = &middle.mesh;
        let outflow = |face: usize| mesh.area(face) * flow.velocity[face];
        let mut changed = false;
        for (pore, torn) in torn.iter_mut().enumerate() {
            let now = match *torn {
                true => mesh.net_outflow(pore, outflow) * middle.dt > DRIFT,
                false => unknowns.has_pressure(pore) && flow.pressure[pore] < lowest,
            };
            changed |= now != *torn;
            *torn = now;
        }
        changed
    }

    /// Stores the air at the end of a step of `dt` (s) with the `flow` of its middle; `settled` says whether it obeys the gas law.
    pub(super) fn store_air(
        &mut self,
        gas: Gas,
        mut air: Air,
        settled: bool,
        flow: &Flow,
        dt: f64,
    ) {
        for pocket in air.pockets.iter_mut() {
            let pressure = flow.pressure[pocket.pores[0] as usize];
            let volume = pocket.tangent.volume_at(pressure);
            pocket.mass -= gas.leaked(pocket.mass, volume, pressure, dt);
        }
        for pocket in &mut air.dry {
            let tangent = &pocket.tangent;
            pocket.mass -= gas.leaked(pocket.mass, tangent.volume, tangent.pressure, dt);
        }
        let all = air.pockets.iter().chain(&air.dry);
        let all: f64 = all.map(|pocket| pocket.mass).sum::<f64>() + air.covered;
        self.state.air = AirState {
            pockets: (air.pockets.len() + air.dry.len()) as u64,
            covered: (1e6 * air.covered / all.max(f64::MIN_POSITIVE)).round() as u64,
            unsettled: self.state.air.unsettled + u64::from(!settled),
            mass: air.mass_after_step(&self.void(), gas.outside),
        };
    }

    /// Counts of the air for the summary.
    pub(super) fn air_counts(&self) -> Vec<(&'static str, u64)> {
        let air = &self.state.air;
        match self.setup.gas {
            None => Vec::new(),
            Some(_) => vec![
                ("pockets of air", air.pockets),
                (
                    "millionths of the enclosed air that are covered by liquid",
                    air.covered,
                ),
                (
                    "steps in which the air pressure did not converge",
                    air.unsettled,
                ),
            ],
        }
    }

    /// The air's checkpoint arrays.
    pub(super) fn save_air(&self) -> Vec<(&'static str, Array)> {
        let air = &self.state.air;
        let counts = [air.pockets, air.covered, air.unsettled].map(|count| count as f64);
        match self.setup.gas {
            None => Vec::new(),
            Some(_) => vec![
                (AIR, Array::F64(air.mass.clone())),
                (COUNTS, Array::F64(counts.to_vec())),
            ],
        }
    }

    /// The air's state from a checkpoint with this number of pores.
    ///
    /// # Errors
    /// Where it is absent or does not belong to this scene.
    pub(super) fn restored_air(&self, saved: &Saved, pores: usize) -> Result<AirState, String> {
        if self.setup.gas.is_none() {
            return Ok(AirState::default());
        }
        let (of, counts) = (saved.f64s(AIR)?, saved.f64s(COUNTS)?);
        restored::check_finite(of, AIR)?;
        restored::check_finite(counts, COUNTS)?;
        let least = of.iter().chain(counts).copied().fold(0.0, f64::min);
        match counts {
            &[pockets, covered, unsettled] if of.len() == pores && least >= 0.0 => Ok(AirState {
                mass: of.to_vec(),
                pockets: pockets as u64,
                covered: covered as u64,
                unsettled: unsettled as u64,
            }),
            _ => Err("the checkpoint's air is not that of this scene".into()),
        }
    }
}
