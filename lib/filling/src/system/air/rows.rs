//! The rows of the pockets in G: what flows out of each.

use super::super::couplings::Rows;
use super::super::fluxes::Areas;
use super::super::terms::Velocity;
use crate::geometry::Aperture;
use crate::system::Operator;
use crate::system::dofs::NONE;

/// Appends the fluxes out of the pockets that have a pressure to those of the liquid cells. Of a liquid cell
/// that is not full they are what its own row lacks, so that one pressure everywhere pushes nothing.
pub(crate) fn append(operator: &Operator, areas: &Areas, rows: &mut Rows) {
    let Some(pockets) = operator.pockets else {
        return;
    };
    let mut entries: Vec<Vec<(u32, f64)>> = vec![Vec::new(); pockets.wet];
    let dry = (pockets.of.iter().copied().enumerate()).map(|(cell, pocket)| (cell, pocket, 1.0));
    let partly = (pockets.edge.iter()).map(|&(cell, pocket)| {
        let cell = cell as usize;
        let void = 1.0 - f64::from(operator.volumes.fraction[cell]);
        (cell, pocket, void)
    });
    for (cell, pocket, void) in dry.chain(partly) {
        if let Some(row) = entries.get_mut(pocket as usize) {
            operator.flux_of_void(areas, cell, void, row);
        }
    }
    for mut row in entries {
        row.sort_by_key(|entry| entry.0);
        row.dedup_by(|next, sum| {
            let same = next.0 == sum.0;
            if same {
                sum.1 += next.1;
            }
            same
        });
        row.retain(|entry| entry.1.abs() > ROUNDING);
        rows.push(&row);
    }
}

/// Areas below which what flows into a pocket and out of it is the same.
const ROUNDING: f64 = 1e-9;

impl Operator<'_> {
    /// Adds the flux out of the part `void` of a cell to a row of a pocket.
    fn flux_of_void(&self, areas: &Areas, index: usize, void: f64, row: &mut Vec<(u32, f64)>) {
        let (window, faces) = (&self.lattice.window, self.dofs.faces.len() as u32);
        let Some(pockets) = self.pockets else { return };
        let home = |cell: usize| window.index(window.home(window.coordinates(cell)));
        for axis in 0..window.domain.axes {
            let stride = window.stride(axis);
            let sides = [
                (-1.0, index, index - stride),
                (1.0, index + stride, index + stride),
            ];
            for (sign, face, next) in sides {
                // What leaves one cell of a pocket for another stays in it.
                if pockets.of[index] != NONE && pockets.of[index] == pockets.of[home(next)] {
                    continue;
                }
                let Some(velocity) = self.velocity(axis, face) else {
                    continue;
                };
                let aperture: Aperture = match areas.at(axis, face) {
                    Some(aperture) => *aperture,
                    None => self.lattice.aperture(axis, window.coordinates(face)),
                };
                if let Velocity::Face(number) = velocity {
                    row.push((number, sign * void * aperture.open));
                }
                for &(body, area) in aperture.bodies.iter().filter(|b| b.1 != 0.0) {
                    if let Velocity::Body(component) = Velocity::of_body(body, axis) {
                        row.push((faces + component, sign * void * area));
                    }
                }
            }
        }
    }
}
