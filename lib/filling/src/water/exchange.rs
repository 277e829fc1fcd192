//! What a step moves of the water: by diffusion between the cells and at a given rate into their walls, until a
//! cell holds no more than walls leave.
//!
//! X, water over solids by volume, obeys in each cell V_s (X - X_0) = sum K (X_n - X) - q, X >= X_min, where V_s
//! is the solids' volume, K = D dt/h^2 A (1 - f), f the part of water and A the liquid area between two
//! cells, and q what the wetted walls take in the step, all of what they ask for where X > X_min. Velocities
//! are those of the solids, against which water diffuses at D (1 - f) grad X.

use physics::Water;

use super::nodes::nodes;
use super::solve::solve;
use crate::geometry::{Lattice, Window};
use crate::liquid::{Bins, Particles};

/// What holds for a step.
pub(crate) struct Medium<'a> {
    pub(crate) water: &'a Water,
    /// Length of the step times diffusivity over the square of a cell.
    pub(crate) diffusion: f64,
}

/// What a step moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Exchange {
    /// Cells of the window that hold points, and the water that each gains, cells.
    pub(crate) gained: Vec<(u32, f64)>,
    /// Water that goes into walls, cells.
    pub(crate) taken: f64,
    /// Factor of the viscosity in the middle of the step, of each cell of the window.
    pub(crate) factor: Vec<f32>,
    /// Mean of the change of ln(viscosity), weighted by the water that cells give off or take up.
    pub(crate) change: f64,
    /// Mean of 1/factor over the liquid at the end of the step.
    pub(crate) fluidity: f64,
    /// Part of what the walls of each cell of the window ask for that they get.
    pub(crate) granted: Vec<f32>,
}

impl Exchange {
    /// That of a step in `medium` for the points in `bins`, the liquid `phi` of the sub-cells and what the walls
    /// of each cell ask for, cells; `None` where no balance of the water was found.
    pub(crate) fn new(
        medium: &Medium,
        lattice: &Lattice,
        phi: &[f32],
        particles: &Particles,
        bins: &Bins,
        asked: &[f64],
    ) -> Option<Self> {
        let nodes = nodes(medium, lattice, phi, particles, bins, asked);
        let (ratio, at_limit) = solve(&nodes, medium.water.least())?;
        let mut found = Self {
            factor: vec![1.0; lattice.window.len()],
            granted: vec![0.0; lattice.window.len()],
            ..Self::default()
        };
        let (mut moved, mut changed, mut fluid, mut volume) = (0.0, 0.0, 0.0, 0.0);
        for (n, node) in nodes.iter().enumerate() {
            let flow = node.inflow(&ratio, n);
            let gained = match (node.solids > 0.0, at_limit[n]) {
                (false, _) => 0.0,
                // Walls give nothing back.
                (true, true) => (node.solids * (ratio[n] - node.ratio)).min(flow),
                (true, false) => flow - node.asked,
            };
            found.taken += flow - gained;
            if node.asked > 0.0 {
                found.granted[node.cell as usize] = ((flow - gained) / node.asked) as f32;
            }
            let end = medium.water.factor(ratio[n]);
            let begin = match node.solids > 0.0 {
                true => medium.water.factor(node.ratio),
                false => end,
            };
            found.factor[node.cell as usize] = (begin * end).sqrt() as f32;
            if node.solids > 0.0 {
                found.gained.push((node.cell, gained));
                moved += gained.abs();
                changed += gained.abs() * (end / begin).ln().abs();
                let held = node.solids * (1.0 + ratio[n]);
                (fluid, volume) = (fluid + held / end, volume + held);
            }
        }
        images(&lattice.window, &mut found.factor);
        found.change = if moved > 0.0 { changed / moved } else { 0.0 };
        found.fluidity = if volume > 0.0 { fluid / volume } else { 1.0 };
        Some(found)
    }

    /// Adds the volume that each cell loses in the step, times `pace`, by the numbers that `number` gives the cells of the window.
    pub(crate) fn add_lost(&self, number: &[u32], pace: f64, lost: &mut [f64]) {
        for &(cell, gained) in &self.gained {
            if let Some(lost) = lost.get_mut(number[cell as usize] as usize) {
                *lost -= pace * gained;
            }
        }
    }
}

/// Gives images beyond periodic sides the value of their cell.
fn images(window: &Window, values: &mut [f32]) {
    if (0..window.domain.axes).any(|a| window.domain.periodic(a)) {
        for index in 0..values.len() {
            values[index] = values[window.index(window.home(window.coordinates(index)))];
        }
    }
}

#[cfg(test)]
mod tests;
