//! Conditions where liquid ends in a step: menisci, pockets of air, liquid torn by tension.

use physics::{Array, Boundary, Saved, restored};

use super::Implicit;
use crate::air::{Air, Gas};
use crate::geometry::DRIFT;
use crate::system::{FULL, Flow, Fronts, Unknowns, Wetting};

/// Names of the arrays of a checkpoint that hold the air of each pore, and what is counted of it.
const AIR: &str = "air";
const COUNTS: &str = "air_counts";

/// The air of a run, from step to step.
#[derive(Clone, Debug, Default)]
pub(super) struct AirState {
    /// Absolute pressure over its unit times volume in each pore; empty where air has no pressure.
    pub(super) mass: Vec<f64>,
    /// Pockets of the last step, and millionths of their air that lie under liquid, without a pressure.
    pockets: u64,
    covered: u64,
    /// Steps whose air did not come to its pressure.
    pub(super) unsettled: u64,
}

impl Implicit {
    /// Empty volume of each pore between steps, cells.
    fn void(&self) -> Vec<f64> {
        let pores = self.state.volumes.iter().enumerate();
        pores
            .map(|(pore, volume)| (self.mesh.volume_at(pore, self.height) - volume).max(0.0))
            .collect()
    }

    /// The air at the start: all is outside.
    pub(super) fn first_air(&self) -> AirState {
        let outside = |gas: Gas| self.void().iter().map(|void| gas.outside * void).collect();
        AirState {
            mass: self.setup.gas.map_or(Vec::new(), outside),
            ..AirState::default()
        }
    }

    /// The pockets of a step of `dt` (s), about their volumes at its start, where air has pressures.
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
            // With a clamp, its body leaves room.
            self.setup.clamped || self.setup.lattice.boundary[1] == Boundary::Open,
        );
        for pocket in air.pockets.iter_mut().chain(&mut air.dry) {
            pocket.tangent = gas.tangent(pocket.mass, pocket.volume, dt);
        }
        Some(air)
    }

    /// What the liquid of a step meets where it ends; its `viscosity` is over the unit.
    pub(super) fn fronts(
        &self,
        unknowns: &Unknowns,
        torn: &[bool],
        air: Option<&Air>,
        viscosity: f64,
        dt: f64,
    ) -> Fronts {
        let setup = &self.setup;
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
            dynamic_coefficient: setup.settings.dynamic_angle * viscosity,
            dt,
            step_ratio: match self.state.steps {
                0 => 1.0,
                _ => (self.state.dt / dt).min(1.0),
            },
        });
        let geometry = (&setup.lattice, &setup.chords, &self.mesh);
        let before = &self.state.flow.velocity;
        Fronts::new(geometry, (unknowns, torn), around, wetting, before)
    }

    /// Finds anew which pores are torn, those whose liquid would carry more tension than it can and comes apart; whether they
    /// are others than before.
    pub(super) fn tear(
        &self,
        unknowns: &Unknowns,
        flow: &Flow,
        dt: f64,
        torn: &mut [bool],
    ) -> bool {
        let Some(tension) = self.setup.liquid.cavitation_pressure else {
            return false;
        };
        let lowest = -tension / self.setup.units.viscosity;
        let mesh = &self.mesh;
        let outflow = |pore: usize| -> f64 {
            let each = mesh.neighbours(pore);
            each.map(|neighbour| {
                neighbour.sign() * mesh.area(neighbour.face) * flow.velocity[neighbour.face]
            })
            .sum()
        };
        let mut others = false;
        for (pore, torn) in torn.iter_mut().enumerate() {
            let now = match *torn {
                true => outflow(pore) * dt > DRIFT,
                false => unknowns.has_pressure(pore) && flow.pressure[pore] < lowest,
            };
            others |= now != *torn;
            *torn = now;
        }
        others
    }

    /// Takes in the air of a step of `dt` (s) that is over.
    pub(super) fn store_air(&mut self, gas: Gas, mut air: Air, settled: bool, dt: f64) {
        let flow = &self.state.flow;
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

    /// What a summary counts of the air, where it has pressures.
    pub(super) fn air_counts(&self) -> Vec<(&'static str, u64)> {
        let air = &self.state.air;
        match self.setup.gas {
            None => Vec::new(),
            Some(_) => vec![
                ("pockets of air", air.pockets),
                (
                    "millionths of the air closed off that lie under liquid",
                    air.covered,
                ),
                (
                    "steps whose air did not come to its pressure",
                    air.unsettled,
                ),
            ],
        }
    }

    /// The air as arrays of a checkpoint.
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

    /// The air of a checkpoint of so many pores.
    ///
    /// # Errors
    /// Where it is absent, or of no run of this scene.
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
