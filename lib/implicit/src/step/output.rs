//! The liquid as material points for states and metrics: one in each voxel of a pore with liquid.

use physics::LiquidState;
use rayon::prelude::*;

use super::Implicit;
use crate::liquid::TRACE;
use crate::system::Profile;

impl Implicit {
    /// The material points of the liquid.
    pub(super) fn points(&self) -> LiquidState {
        let (mut state, shown) = self.filled_voxels();
        // Wall couplings at the current gap height; those at hand belong to the middle of the last step.
        let fractions: Vec<f64> = (self.state.volumes.iter().enumerate())
            .map(|(pore, volume)| volume / self.mesh.volume(pore))
            .collect();
        let channels = self.setup.channels(&self.mesh);
        let couplings = self.couplings.at_height(&channels, &fractions);
        let field = self.field((&self.mesh, &couplings), &self.state.flow);
        let (rates, _) = field.pore_rates(self.setup.liquid.shear_rate);
        let pascal = self.setup.units.viscosity;
        for &pore in &shown {
            let pressure = self.state.flow.pressure[pore] * pascal;
            for _ in 0..self.mesh.pores[pore].voxels.count_ones() {
                state.pressure.push(pressure as f32);
                state.shear_rate.push(rates[pore] as f32);
                (state.solids).extend(self.solids_of(pore).map(|solids| solids as f32));
            }
        }
        let profile = Profile::new(&self.setup.lattice, field);
        let cell_m = self.setup.origin.cell_m;
        let velocities = |&pore: &usize| {
            let velocities = profile.of_pore(pore);
            velocities.map(|velocity| velocity.map(|v| (v * cell_m) as f32))
        };
        state.velocity = shown.par_iter().flat_map_iter(velocities).collect();
        state
    }

    /// Points with positions and volumes only, and the pores that have points.
    pub(super) fn filled_voxels(&self) -> (LiquidState, Vec<usize>) {
        let (mesh, origin) = (&self.mesh, self.setup.origin);
        let mut state = LiquidState::default();
        let mut shown = Vec::new();
        // Rows are counted from the low side of the gap, which a body that moves up takes along.
        let rising = self.setup.lattice.moving.filter(|moving| !moving.down);
        let raised = rising.map_or(0.0, |moving| self.state.displacement[moving.body][1]);
        let origin_m = [
            origin.origin_m[0],
            origin.origin_m[1] + raised,
            origin.origin_m[2],
        ];
        for pore in 0..mesh.pores.len() {
            let n = f64::from(mesh.pores[pore].voxels.count_ones());
            let volume = self.state.volumes[pore] * self.compressed(pore) / n;
            if volume < TRACE {
                continue;
            }
            shown.push(pore);
            let cell = mesh.cell(pore);
            let at = mesh.cell_indices(cell);
            let low = [
                at[0] as f64 - mesh.ghost_layers[0] as f64,
                mesh.rows().low(mesh.row(cell)),
                at[2] as f64 - mesh.ghost_layers[2] as f64,
            ];
            for voxel in mesh.voxels(pore) {
                state.position.push(std::array::from_fn(|a| {
                    let cells =
                        low[a] + mesh.edge(pore, a) * (voxel[a] as f64 + 0.5) / mesh.k as f64;
                    (origin_m[a] + origin.cell_m * cells) as f32
                }));
                state.volume.push((volume * origin.cell_m.powi(3)) as f32);
            }
        }
        (state, shown)
    }

    /// J of a pore by Tait's law: liquid volume over that at zero pressure.
    pub(super) fn compressed(&self, pore: usize) -> f64 {
        let pressure = self.state.flow.pressure[pore] * self.setup.units.viscosity;
        1.0 + self.setup.liquid.tait.volume_change(pressure)
    }
}
