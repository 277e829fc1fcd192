//! Remeshing: the active cells follow the liquid, and the rows the gap.

use super::Implicit;
use crate::geometry::{Mesh, Rows};
use crate::liquid::{
    FaceMap, remapped_pressures, remapped_region, remapped_velocities, remapped_volumes,
};
use crate::settings::LARGEST_CFL;
use crate::system::{Edges, WallCouplings};
use crate::water::AbsorbingWalls;

/// Active cells around the liquid at remeshing: twice the distance that liquid covers in a step. The mesh is built anew
/// where fewer than half of them are left.
pub(super) const MARGIN: usize = 2 * (LARGEST_CFL as usize + 1);

impl Implicit {
    /// Builds the mesh anew if the number of gap rows changes or the liquid is close to the edge of the active cells.
    pub(super) fn update_mesh(&mut self) {
        let mesh = &self.mesh;
        let rows = Rows::of_gap(mesh.rows().below, mesh.rows().above, self.height());
        let wet = mesh.cells_with(|pore| self.state.volumes[pore] > 0.0);
        let wet_rows = self.wet_rows();
        let is_close =
            |end: usize, side: usize, all: usize| side != all && end.abs_diff(side) < MARGIN / 2;
        if !self.couplings.is_empty()
            && rows.gap == mesh.rows().gap
            && !is_close(wet_rows.start, mesh.range.start, 0)
            && !is_close(wet_rows.end, mesh.range.end, mesh.rows().len())
            && (mesh.region).covers(&wet.grown(MARGIN / 2, mesh.periodic()))
        {
            return;
        }
        let end = (wet_rows.end + rows.gap - mesh.rows().gap).max(wet_rows.start) + MARGIN;
        let range = wet_rows.start.saturating_sub(MARGIN)..end.min(rows.len());
        let lattice = &self.setup.lattice;
        let mesh = match self.setup.gas {
            None => {
                let region = remapped_region(mesh, &wet, (&rows, &range), MARGIN);
                Mesh::new(lattice, rows, range, region)
            }
            // Air may be closed off anywhere.
            Some(_) => Mesh::whole(lattice, rows, 0..rows.len()),
        };
        let old = std::mem::replace(&mut self.mesh, mesh);
        let (state, mesh) = (&mut self.state, &self.mesh);
        state.volumes = remapped_volumes(mesh, &old, &state.volumes);
        if !state.air.mass.is_empty() {
            state.air.mass = remapped_volumes(mesh, &old, &state.air.mass);
        }
        state.flow.velocity = remapped_velocities(mesh, &old, &state.flow.velocity);
        state.flow.pressure = remapped_pressures(mesh, &old, &state.flow.pressure);
        if let Some(balance) = &mut state.water {
            balance.water = remapped_volumes(mesh, &old, &balance.water);
            balance.soaked = remapped_volumes(mesh, &old, &balance.soaked);
        }
        let face_map = match self.couplings.is_empty() {
            true => FaceMap::default(),
            false => FaceMap::new(mesh, &old),
        };
        self.rebuild_walls(&face_map);
    }

    /// Computes wall couplings, edges and absorbing walls of the mesh; `face_map` says which faces keep those of the old mesh.
    pub(super) fn rebuild_walls(&mut self, face_map: &FaceMap) {
        let (setup, mesh) = (&self.setup, &self.mesh);
        let water = setup.liquid.water.as_ref();
        self.absorbing_walls =
            water.map(|_| AbsorbingWalls::new(&setup.lattice, mesh, &setup.absorbs));
        self.couplings = WallCouplings::new(&setup.channels(mesh), face_map, &self.couplings);
        self.edges = Edges::new(mesh, &setup.lattice, face_map, &self.edges);
    }

    /// The range of grid rows that covers the liquid and the gap.
    fn wet_rows(&self) -> std::ops::Range<usize> {
        let mesh = &self.mesh;
        let gap = mesh.rows().below..mesh.rows().below + mesh.rows().gap;
        (0..mesh.pores.len())
            .filter(|&pore| self.state.volumes[pore] > 0.0)
            .map(|pore| mesh.row_of(pore))
            .fold(gap, |range, row| {
                range.start.min(row)..range.end.max(row + 1)
            })
    }
}
