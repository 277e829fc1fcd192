//! `physics::Scheme` of the implicit scheme: what it shows, saves and restores.

use physics::{
    Array, Diagnostics, Failure, LiquidState, Saved, Saving, Scheme, StageTime, StepLimit, StepReport,
};

use super::Implicit;
use crate::liquid::{Shown, points};

impl Scheme for Implicit {
    fn advance(&mut self, limit: StepLimit) -> Result<StepReport, Failure> {
        self.step(limit)
    }

    fn diagnostics(&self) -> Diagnostics {
        let volume: f64 = (0..self.mesh.pores.len())
            .map(|pore| self.state.volumes[pore].min(self.mesh.volume(pore)))
            .sum();
        Diagnostics {
            kinetic_energy: 0.0,
            viscous_power: self.state.power * self.setup.units.force() * self.setup.units.cell_m,
            volume: volume * self.setup.units.volume(),
            max_speed: self.state.fastest * self.setup.units.cell_m,
            capped_fraction: 0.0,
            water: None,
        }
    }

    fn liquid(&self) -> LiquidState {
        let pressure = |pore: usize| self.state.flow.pressure[pore] * self.setup.units.viscosity;
        let shown = Shown {
            volumes: &self.state.volumes,
            velocity: &|pore| self.pore_velocity(pore),
            pressure: &pressure,
            rate: &|_| 0.0,
        };
        points(&self.mesh, self.setup.place, &shown)
    }

    fn displacements(&self) -> Vec<[f64; 3]> {
        self.state.displacement.clone()
    }

    fn saving(&self) -> Vec<(String, Saving<'_>)> {
        vec![("volumes".into(), Saving::Whole(Array::F64(self.state.volumes.clone())))]
    }

    fn restore(&mut self, _saved: &Saved) -> Result<(), String> {
        Err("not yet".into())
    }

    fn stage_times(&self) -> Vec<StageTime> {
        Vec::new()
    }

    fn counts(&self) -> Vec<(&'static str, u64)> {
        Vec::new()
    }
}

impl Implicit {
    /// Mean velocity of a pore, cells/s.
    fn pore_velocity(&self, pore: usize) -> [f64; 3] {
        let mesh = &self.mesh;
        std::array::from_fn(|axis| {
            let mut sum = 0.0;
            for up in [false, true] {
                let faces: Vec<usize> = mesh.faces_at(pore, axis, up).collect();
                let area: f64 = faces.iter().map(|&face| mesh.area(face)).sum();
                for face in faces {
                    let frame = match axis {
                        1 => mesh.frame(&self.setup.lattice, face) * self.state.flow.speed,
                        _ => 0.0,
                    };
                    sum += 0.5 * (self.state.flow.velocity[face] + frame) * mesh.area(face) / area;
                }
            }
            sum
        })
    }
}
