//! What full cells take up in a step behind a front, where liquid rolls over the walls.
//!
//! Solved as if they were full they would let all that comes pass on to the front, whose tip then runs ahead of its contact
//! lines, the farther the shorter the steps.

use super::Operator;
use super::dofs::NONE;

/// Faces between such a cell and the air at most: farther away is no front, and closed-in liquid has no room to take up from.
const REACH: usize = 4;
/// How often a cell that lacks liquid could be filled while the flow there passes a cell: what steps of less than its inverse
/// leave of it, the front runs ahead by.
const SWIFT: f64 = 4.0;

impl Operator<'_> {
    /// Volume (cells^2 m/s) that each pressure unknown, pockets of air behind the cells, loses in a time to the filling of
    /// cells, with the velocities `u` before the step; what is so kept from the front at a pocket is none that the pocket
    /// loses to it. Empty where no cell lacks any.
    ///
    /// A cell fills as the flow there passes a cell, or within the step.
    pub(crate) fn filling(&self, u: &[f64]) -> Vec<f64> {
        let cells = self.dofs.cells.len();
        let pockets = self.pockets.map_or(0, |pockets| pockets.wet);
        let mut lost = Vec::new();
        for (number, &cell) in self.dofs.cells.iter().enumerate() {
            let lack = f64::from(self.volumes.lack(cell as usize));
            if lack == 0.0 {
                continue;
            }
            let Some((air, speed)) = self.nearest_air(cell as usize, u) else {
                continue;
            };
            let filling = lack * (SWIFT * speed).min(self.scales.cell_per_step);
            lost.resize(cells + pockets, 0.0);
            lost[number] = filling;
            let pocket = self.pockets.map_or(NONE, |pockets| pockets.of[air]);
            if let Some(pocket) = lost[cells..].get_mut(pocket as usize) {
                *pocket -= filling;
            }
        }
        lost
    }

    /// The cell of air that is the fewest faces with velocities away from a liquid one, if it is within [`REACH`], and the
    /// fastest velocity (m/s) of those looked at.
    fn nearest_air(&self, cell: usize, u: &[f64]) -> Option<(usize, f64)> {
        let window = &self.lattice.window;
        let (mut known, mut next, mut speed) = (vec![cell], 0, 0.0_f64);
        for _ in 0..REACH {
            let mut found = None;
            for _ in next..known.len() {
                let from = known[next];
                next += 1;
                for axis in 0..window.domain.axes {
                    let stride = window.stride(axis);
                    for (face, to) in [(from, from - stride), (from + stride, from + stride)] {
                        let Some(u) = u.get(self.dofs.face[axis][face] as usize) else {
                            continue;
                        };
                        speed = speed.max(u.abs());
                        let to = window.index(window.home(window.coordinates(to)));
                        if self.dofs.cell[to] == NONE {
                            found = found.or(Some(to));
                        } else if !known.contains(&to) {
                            known.push(to);
                        }
                    }
                }
            }
            if let Some(air) = found {
                return Some((air, speed));
            }
        }
        None
    }
}
