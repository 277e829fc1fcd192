//! Pockets of air: which pores belong to each, and the gas in them.

use super::law::{Gas, Tangent};
use crate::geometry::Mesh;

/// A pocket: connected pores that are not full and have no connection to the outside.
#[derive(Clone, Debug)]
pub(crate) struct Pocket {
    pub(crate) pores: Vec<u32>,
    /// Amount of gas, as absolute pressure times volume, at the start of the step.
    pub(crate) mass: f64,
    /// Volume at the start of the step, cells.
    pub(crate) volume: f64,
    pub(crate) tangent: Tangent,
}

/// Air of a step.
#[derive(Clone, Debug)]
pub(crate) struct Air {
    /// Pockets that border on pores with a pressure, each with an unknown pressure of its own, and the `dry` others.
    pub(crate) pockets: Vec<Pocket>,
    pub(crate) dry: Vec<Pocket>,
    /// Gas in each pore, as absolute pressure times volume; in pockets that at the start of the step.
    pub(crate) mass: Vec<f64>,
    /// Pores whose air is connected to the outside.
    outside: Vec<u32>,
    /// Gas in full pores whose neighbours are all full too: it has no pressure until one of them empties.
    pub(crate) covered: f64,
}

impl Air {
    /// The pockets into which pores that are `full` divide the air. `mass` is the gas in each pore, `void` its empty volume.
    /// Air escapes through open sides of the domain, and through the sides normal to y if `along_y`.
    pub(crate) fn new(
        mesh: &Mesh,
        has_pressure: impl Fn(usize) -> bool,
        full: impl Fn(usize) -> bool,
        void: &[f64],
        mass: &[f64],
        along_y: bool,
    ) -> Self {
        let mut air = Self {
            pockets: Vec::new(),
            dry: Vec::new(),
            mass: mass.to_vec(),
            outside: Vec::new(),
            covered: 0.0,
        };
        air.release_covered(mesh, &full, void);
        let reaches_out = |pore: usize| {
            let row = mesh.row_of(pore);
            let at_end = row == 0 || row + 1 == mesh.rows().len();
            mesh.is_ghost(mesh.cell(pore)) || along_y && at_end
        };
        for mut pores in mesh.components(|pore| !full(pore)) {
            let each = || pores.iter().map(|&pore| pore as usize);
            if each().any(reaches_out) {
                air.outside.append(&mut pores);
                continue;
            }
            let wet = each().any(|pore| {
                mesh.neighbours(pore)
                    .any(|neighbour| has_pressure(neighbour.pore))
            });
            pores.sort_unstable();
            let sum = |of: &[f64]| pores.iter().map(|&pore| of[pore as usize]).sum::<f64>();
            let pocket = Pocket {
                mass: sum(&air.mass),
                volume: sum(void),
                tangent: Tangent::default(),
                pores,
            };
            match wet {
                true => air.pockets.push(pocket),
                false => air.dry.push(pocket),
            }
        }
        air
    }

    /// Moves the gas of full pores to their neighbours that are not full, in proportion to the empty volume of these.
    fn release_covered(&mut self, mesh: &Mesh, full: &impl Fn(usize) -> bool, void: &[f64]) {
        for pore in (0..mesh.pores.len()).filter(|&pore| full(pore)) {
            if self.mass[pore] == 0.0 {
                continue;
            }
            let open: Vec<usize> = mesh
                .neighbours(pore)
                .map(|neighbour| neighbour.pore)
                .filter(|&beside| !full(beside))
                .collect();
            let all: f64 = open.iter().map(|&beside| void[beside]).sum();
            if all == 0.0 {
                self.covered += self.mass[pore];
                continue;
            }
            let mass = std::mem::take(&mut self.mass[pore]);
            for beside in open {
                self.mass[beside] += mass * void[beside] / all;
            }
        }
    }

    /// Whether the pressures found for a step of `dt` (s) obey the gas law in all pockets. If not, linearises the law anew
    /// about the volumes found.
    pub(crate) fn update_tangents(&mut self, gas: Gas, pressures: &[f64], dt: f64) -> bool {
        let pressure = |pocket: &Pocket| pressures[pocket.pores[0] as usize];
        let agrees =
            |pocket: &Pocket| gas.obeys_law(pocket.mass, &pocket.tangent, pressure(pocket), dt);
        if self.pockets.iter().all(agrees) {
            return true;
        }
        for pocket in &mut self.pockets {
            let volume = pocket.tangent.volume_at(pressure(pocket));
            pocket.tangent = gas.tangent(pocket.mass, volume, dt);
        }
        false
    }

    /// The gas in each pore after the step, by the empty volumes `void` then: a pocket has one pressure throughout, outside
    /// air the pressure `outside`.
    pub(crate) fn mass_after_step(mut self, void: &[f64], outside: f64) -> Vec<f64> {
        for pocket in self.pockets.iter().chain(&self.dry) {
            let all: f64 = pocket.pores.iter().map(|&pore| void[pore as usize]).sum();
            for &pore in &pocket.pores {
                let share = match all > 0.0 {
                    true => void[pore as usize] / all,
                    false => 1.0 / pocket.pores.len() as f64,
                };
                self.mass[pore as usize] = pocket.mass * share;
            }
        }
        for &pore in &self.outside {
            self.mass[pore as usize] = outside * void[pore as usize];
        }
        self.mass
    }
}
