//! Between SI and the units of the solver: cells, m/s, eta_0/h.

use physics::{GridBox, Liquid};

/// Scales of a scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Units {
    /// Cell, m.
    pub(super) h: f64,
    /// Low corner of the domain, m.
    pub(super) low: [f64; 3],
    /// Viscosity that those by the law are divided by, Pa s.
    pub(super) eta: f64,
    /// What cure multiplies both by in the step.
    pub(super) cured: f64,
}

impl Units {
    /// Units for a liquid whose viscosity is scaled by that at the shear rate of a lumen of six
    /// cells at `speed` (m/s).
    pub(super) fn new(grid: &GridBox, liquid: &Liquid, speed: f64) -> Self {
        Self {
            h: grid.cell_m,
            low: grid.min_m,
            eta: liquid.viscosity.at(8.0 * speed / (6.0 * grid.cell_m)),
            cured: 1.0,
        }
    }

    /// Reference viscosity eta_0, Pa s.
    pub(super) fn viscosity(&self) -> f64 {
        self.eta * self.cured
    }

    /// Pressure unit, Pa per unit of the solver.
    pub(super) fn pressure(&self) -> f64 {
        self.viscosity() / self.h
    }

    /// Force unit, N.
    pub(super) fn force(&self) -> f64 {
        self.viscosity() * self.h
    }

    /// A volume, m3 per cell.
    pub(super) fn volume(&self) -> f64 {
        self.h.powi(3)
    }

    pub(super) fn to_cells(self, x: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|a| (x[a] - self.low[a]) / self.h)
    }

    pub(super) fn to_metres(self, x: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|a| self.low[a] + x[a] * self.h)
    }
}
