//! The case of a tube of voxels that dips into a pool.

use super::capillary::{ANGLE, DENSITY, GRAVITY, TENSION, Tube, VISCOSITY};
use crate::Result;
use crate::case_text::{Body, CaseText, Viscosity};
use crate::outputs::{Run, points};
use crate::verification::lumen::Section;

/// Cells that the pool is long and wide.
pub(super) const POOL: [f64; 2] = [160.0, 8.0];
/// Cells that the tube dips.
pub(super) const DIP: f64 = 1.0;
/// States written on the way.
const STATES: u32 = 200;

/// A quarter of a tube of voxels of half a cell in a block that dips into a pool; the pool goes on along x, between mirrors, so that
/// its surface meets the wall of the block alone.
pub(super) struct Voxels {
    tube: Tube,
    cells: u32,
    /// Edge of a cell, m.
    pub(super) cell: f64,
    /// Width of each row of half a cell of the bore, cells.
    bore: Vec<f64>,
}

impl Voxels {
    /// Those of a tube with so many cells across.
    pub(super) fn new(tube: Tube, cells: u32) -> Self {
        let rows = Section::Round(2).rows(cells).into_iter();
        Self {
            tube,
            cells,
            cell: 2.0 * tube.radius / f64::from(cells),
            bore: rows.map(|width| f64::from(cells) * width).collect(),
        }
    }

    /// Area of the quarter of the bore, square cells.
    fn area(&self) -> f64 {
        0.5 * self.bore.iter().sum::<f64>()
    }

    /// What the pool falls by while the tube fills by a length, over that.
    pub(super) fn falls(&self) -> f64 {
        self.area() / (POOL[0] * POOL[1])
    }

    /// How deep the pool is under the tube, cells: two radii, or it would hold the liquid up on its way to the mouth.
    fn under(&self) -> f64 {
        f64::from(self.cells)
    }

    /// Where the block ends along x, cells.
    fn wall(&self) -> f64 {
        0.5 * f64::from(self.cells) + 1.0
    }

    pub(super) fn case(&self) -> CaseText {
        let m = |at: [f64; 3]| at.map(|x| x * self.cell);
        let (wall, under) = (self.wall(), self.under());
        let level = under + DIP;
        let top = level + (self.tube.jurin() / self.cell).ceil() + 4.0;
        let far = [wall + POOL[0], top, POOL[1]];
        let mut bodies = vec![
            Body::liquid([0.0; 3], m([far[0], under, far[2]])),
            Body::liquid(m([wall, under, 0.0]), m([far[0], level, far[2]])),
        ];
        let beside = 0.5 * f64::from(self.cells);
        bodies.push(Body::wall(m([0.0, under, beside]), m([wall, top, far[2]])));
        for (row, &width) in self.bore.iter().enumerate() {
            let [from, to] = [row, row + 1].map(|edge| 0.5 * edge as f64);
            bodies.push(Body::wall(m([width, under, from]), m([wall, top, to])));
            bodies.push(Body::liquid(m([0.0, under, from]), m([width, level, to])));
        }
        let end = self.tube.end();
        CaseText {
            density: DENSITY,
            viscosity: Viscosity::Newtonian(VISCOSITY),
            wetting: Some([TENSION, ANGLE]),
            gravity: [0.0, -GRAVITY, 0.0],
            stop: Some(end),
            history_every: end / 100.0,
            snapshots: STATES,
            bodies,
            title: format!(
                "Glycerol in a glass tube of {} mm radius, a quarter of it, {} cells across.",
                1e3 * self.tube.radius,
                self.cells
            ),
            ..CaseText::new(self.cell, 3, m(far))
        }
    }

    /// Times (s) and heights over the pool (m) of the states of a run.
    pub(super) fn heights(&self, run: &Run) -> Result<Vec<[f64; 2]>> {
        let (h, area) = (self.cell, self.area());
        let within = [self.wall() * h, self.under() * h];
        let height = |state: &particle_file::ParticleFile| {
            let points = points(state)?;
            let inside = points
                .iter()
                .filter(|p| p.at[0] < within[0] && p.at[1] > within[1]);
            let held: f64 = inside.map(|p| p.volume).sum();
            let risen = held / (area * h.powi(2)) - DIP * h;
            Ok([state.header().time_s, risen * (1.0 + self.falls())])
        };
        run.states()?.iter().map(height).collect()
    }
}
