//! The liquid as points, as states and metrics take it: one in each voxel of a pore with liquid.

use physics::LiquidState;
use rayon::prelude::*;

use super::deposit::Place;
use super::profile::Profile;
use crate::geometry::Mesh;

/// Volume, cells, that counts as none: what rounding leaves behind a front.
pub(crate) const TRACE: f64 = 1e-9;

/// What is shown of the liquid, in cells and the scheme's units.
pub(crate) struct Shown<'a> {
    pub(crate) volumes: &'a [f64],
    pub(crate) profile: Profile<'a>,
    /// Pressure of each pore, Pa.
    pub(crate) pressure: &'a dyn Fn(usize) -> f64,
    /// Shear rate of each pore, 1/s.
    pub(crate) rate: &'a dyn Fn(usize) -> f64,
    /// Solids content of each pore by mass, of a liquid that loses water.
    pub(crate) solids: &'a dyn Fn(usize) -> Option<f64>,
}

/// The points of the liquid.
pub(crate) fn points(mesh: &Mesh, place: Place, shown: &Shown) -> LiquidState {
    let mut state = LiquidState::default();
    let mut shown_pores = Vec::new();
    let k = mesh.k;
    for pore in 0..mesh.pores.len() {
        let n = f64::from(mesh.pores[pore].voxels.count_ones());
        let volume = shown.volumes[pore] / n;
        if volume < TRACE {
            continue;
        }
        shown_pores.push(pore);
        let cell = mesh.cell(pore);
        let at = mesh.place(cell);
        let low = [
            at[0] as f64 - mesh.beyond[0] as f64,
            mesh.rows().low(mesh.row(cell)),
            at[2] as f64 - mesh.beyond[2] as f64,
        ];
        for voxel in mesh.voxels(pore) {
            state.position.push(std::array::from_fn(|a| {
                let cells = low[a] + mesh.edge(pore, a) * (voxel[a] as f64 + 0.5) / k as f64;
                (place.origin_m[a] + place.cell_m * cells) as f32
            }));
            state.volume.push((volume * place.cell_m.powi(3)) as f32);
            state.pressure.push((shown.pressure)(pore) as f32);
            state.shear_rate.push((shown.rate)(pore) as f32);
            (state.solids).extend((shown.solids)(pore).map(|solids| solids as f32));
        }
    }
    let profile = &shown.profile;
    let velocities = |&pore: &usize| {
        let velocities = profile.of_pore(pore).into_iter();
        velocities.map(|velocity| velocity.map(|v| (v * place.cell_m) as f32))
    };
    state.velocity = shown_pores.par_iter().flat_map_iter(velocities).collect();
    state
}
