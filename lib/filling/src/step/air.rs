//! Pockets of air in a step: their pressures are unknowns, found by Newton's method about those of their
//! volumes in its middle.

use physics::{Array, Failure, Saved, restored};

use super::controlled::Solved;
use super::solution::{Unknowns, Viscous};
use super::{Implicit, Part, Trial};
use crate::system::air::{Held, Measure, Pockets};
use crate::system::{Before, Operator};

/// Most solves of a step for the pressures of its air.
const PASSES: usize = 6;

/// Air that is closed off in a step.
pub(super) struct Air {
    pub(super) pockets: Pockets,
    pub(super) held: Held,
    /// Part of each pocket that was not closed off before.
    pub(super) fresh: Vec<f64>,
}

impl Implicit {
    /// The pockets of a step and the air in them, where air has pressures.
    pub(super) fn closed_off(&mut self, operator: &Operator) -> Option<Air> {
        let (gas, outside) = self.setup.air?;
        let (lattice, before) = (operator.lattice, &self.state.air);
        Some(self.workspace.clock.time(Part::Fractions, || {
            let pockets = Pockets::find(lattice, operator.volumes, &operator.dofs, outside);
            let (held, fresh) = before.followed(&pockets, &lattice.window, gas.outside);
            Air {
                pockets,
                held,
                fresh,
            }
        }))
    }

    /// Stages 4 to 6, until the air has the pressures of its volumes; what leaks in the step leaves it. The last
    /// result is what the pockets beside liquid grow by, cells.
    pub(super) fn solve_with_air(
        &mut self,
        operator: &mut Operator,
        before: Before,
        air: (&Pockets, &mut Held, &[f64]),
        trial: &Trial,
        now: &mut Unknowns,
    ) -> Result<(Solved, Option<Viscous>, Vec<f64>), Failure> {
        let Some((gas, _)) = self.setup.air else {
            let (solved, viscous) = self.solve_once(operator, before, now)?;
            return Ok((solved, viscous, Vec::new()));
        };
        let measure = Measure {
            dt: trial.dt,
            pressure: self.setup.units.pressure(),
            cell: self.setup.units.h,
        };
        let (pockets, held, fresh) = air;
        let mut tangents = gas.tangents(held.contents(pockets.wet), measure);
        now.p.extend(tangents.iter().map(|t| t.pressure));
        let liquid = operator.dofs.cells.len();
        let mut pass = 1;
        let (solved, viscous) = loop {
            let before = Before {
                air: &tangents,
                ..before
            };
            let solved = self.solve_once(operator, before, now)?;
            let (system, p) = (&solved.0.0, &now.p[liquid..]);
            if pass == 1 {
                let half = 0.5 * trial.dt / measure.cell;
                let growth = system.growth(liquid, before.velocity, &trial.bodies);
                held.begin(
                    fresh,
                    growth.iter().map(|growth| half * growth),
                    gas.outside,
                );
            }
            let front = system.front(liquid);
            match gas.nearer(&tangents, p, held.contents(pockets.wet), front, measure) {
                Some(next) if pass < PASSES => tangents = next,
                left => {
                    held.astray += u64::from(left.is_some());
                    break solved;
                }
            }
            pass += 1;
        };
        let p = &now.p[liquid..];
        let wet = ..pockets.wet;
        held.passed[1] += gas.leak(&mut held.mass[wet], p, measure);
        let mut growth = gas.volumes(&tangents, p, measure);
        for (end, start) in growth.iter_mut().zip(&held.volume) {
            *end -= start;
        }
        Ok((solved, viscous, growth))
    }

    /// What a summary counts of the air, where it has pressures.
    pub(super) fn air_counts(&self) -> Vec<(&'static str, u64)> {
        let held = &self.state.air;
        let vanished = held.mass.get(held.vanished..);
        let Some(vanished) = vanished.filter(|_| self.setup.air.is_some()) else {
            return Vec::new();
        };
        let part = vanished.iter().sum::<f64>() / held.passed[0].max(f64::MIN_POSITIVE);
        vec![
            ("pockets of air", held.vanished as u64),
            (
                "pockets of air that vanished under liquid",
                vanished.len() as u64,
            ),
            (
                "millionths of the air closed off that vanished with them",
                (1e6 * part).round() as u64,
            ),
            ("steps whose air did not come to its pressure", held.astray),
        ]
    }

    /// The air as arrays of a checkpoint.
    pub(super) fn save_air(&self) -> Vec<(String, Array)> {
        if self.setup.air.is_none() {
            return Vec::new();
        }
        let Held {
            of,
            mass,
            volume,
            vanished,
            passed: [closed, freed],
            astray,
        } = &self.state.air;
        vec![
            ("air_pocket".into(), Array::U32(of.clone())),
            ("air_mass".into(), Array::F64(mass.clone())),
            ("air_volume".into(), Array::F64(volume.clone())),
            (
                "air_sums".into(),
                Array::F64(vec![*vanished as f64, *closed, *freed, *astray as f64]),
            ),
        ]
    }

    /// Goes back to the air of a checkpoint.
    ///
    /// # Errors
    /// Where it is absent, or of no run of this scene.
    pub(super) fn restore_air(&mut self, saved: &Saved) -> Result<(), String> {
        if self.setup.air.is_none() {
            return Ok(());
        }
        let (of, mass) = (saved.u32s("air_pocket")?, saved.f64s("air_mass")?);
        let (volume, sums) = (saved.f64s("air_volume")?, saved.f64s("air_sums")?);
        restored::check_finite(mass, "air_mass")?;
        restored::check_finite(volume, "air_volume")?;
        restored::check_finite(sums, "air_sums")?;
        let &[vanished, closed, freed, astray] = sums else {
            return Err(format!("the checkpoint's sums of air are none: {sums:?}"));
        };
        let cells = self.setup.window_of_all().len();
        let count = |n: f64, most: f64| (0.0..=most).contains(&n) && n.fract() == 0.0;
        let counted = count(vanished, mass.len() as f64) && count(astray, self.state.steps as f64);
        let numbered = |&number: &u32| (number as usize) < mass.len() || Held::is_no_pocket(number);
        let whole = (of.len() == cells || of.is_empty() && mass.is_empty())
            && volume.len() == mass.len()
            && volume.iter().all(|&v| v > 0.0);
        if !(counted && whole && of.iter().all(numbered) && mass.iter().all(|&m| m >= 0.0)) {
            return Err("the checkpoint's air is not that of this scene".into());
        }
        self.state.air = Held {
            of: of.to_vec(),
            mass: mass.to_vec(),
            volume: volume.to_vec(),
            vanished: vanished as usize,
            passed: [closed, freed],
            astray: astray as u64,
        };
        Ok(())
    }
}

#[cfg(test)]
mod tests;
