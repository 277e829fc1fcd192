//! What full cells take up in a step behind a front, where liquid rolls over the walls.
//!
//! Solved as if they were full they would let all that comes pass on to the front, whose tip then runs ahead of its contact
//! lines, the farther the shorter the steps.

use super::Operator;
use super::dofs::NONE;
use crate::liquid::nearest_air;

/// How often a cell that lacks liquid could be filled while the flow there passes a cell: what steps of less than its inverse
/// leave of it, the front runs ahead by.
const SWIFT: f64 = 4.0;

impl Operator<'_> {
    /// Volume (cells^2 m/s) that each pressure unknown, pockets of air behind the cells, loses in a time to the filling of
    /// cells, with the velocities `u` before the step and `bodies` in it; what is so kept from the front at a pocket is none
    /// that the pocket loses to it. Empty where no cell lacks any.
    ///
    /// A cell fills as the flow there, or a body, passes a part of a cell, or within the step.
    pub(crate) fn filling(&self, u: &[f64], bodies: &[[f64; 3]]) -> Vec<f64> {
        let cells = self.dofs.cells.len();
        let pockets = self.pockets.map_or(0, |pockets| pockets.wet);
        let mut lost = Vec::new();
        let closes = (bodies.as_flattened().iter()).fold(0.0, |most: f64, v| most.max(v.abs()));
        for (number, &cell) in self.dofs.cells.iter().enumerate() {
            let lack = f64::from(self.volumes.lack(cell as usize));
            if lack == 0.0 {
                continue;
            }
            let Some((air, speed)) = self.nearest_air(cell as usize, u) else {
                continue;
            };
            let filling = lack * (SWIFT * speed.max(closes)).min(self.scales.cell_per_step);
            lost.resize(cells + pockets, 0.0);
            lost[number] = filling;
            let pocket = self.pockets.map_or(NONE, |pockets| pockets.of[air]);
            if let Some(pocket) = lost[cells..].get_mut(pocket as usize) {
                *pocket -= filling;
            }
        }
        lost
    }

    /// The cell of air that is the fewest faces with velocities away from a liquid one, if it is near, and the fastest velocity
    /// (m/s) of those looked at.
    fn nearest_air(&self, cell: usize, u: &[f64]) -> Option<(usize, f64)> {
        let mut speed = 0.0_f64;
        let beyond = |from: usize, next: &mut Vec<usize>| {
            for (face, to) in self.sides(from) {
                if let Some(u) = u.get(face as usize) {
                    speed = speed.max(u.abs());
                    next.push(to);
                }
            }
        };
        let air = nearest_air(cell, beyond, |to| self.dofs.cell[to] == NONE)?;
        Some((air, speed))
    }

    /// The numbers of the faces of a cell, and the cells beyond them.
    fn sides(&self, cell: usize) -> impl Iterator<Item = (u32, usize)> {
        let window = &self.lattice.window;
        (0..window.domain.axes).flat_map(move |axis| {
            let stride = window.stride(axis);
            [(cell, cell - stride), (cell + stride, cell + stride)].map(|(face, beyond)| {
                let home = window.home(window.coordinates(beyond));
                (self.dofs.face[axis][face], window.index(home))
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::tests::{domain, lattice};
    use crate::liquid::{Volumes, sub_cells};
    use crate::system::Scales;
    use crate::system::air::{Outside, Pockets};

    /// Liquid up to x = `wet` in a box of 12 x 3 cells, 0.3 of which lack in the cell at `x`, and the velocity `speed` everywhere: the
    /// volume in a time that the cell and the pocket of air lose, and that of all.
    fn filling(wet: usize, x: usize, speed: f64, cell_per_step: f64) -> [f64; 3] {
        beside(&[], wet, x, speed, cell_per_step)
    }

    /// The same beside bodies of these velocities.
    fn beside(
        bodies: &[[f64; 3]],
        wet: usize,
        x: usize,
        speed: f64,
        cell_per_step: f64,
    ) -> [f64; 3] {
        let lattice = lattice(domain([12, 3, 1], 2), vec![]);
        let window = &lattice.window;
        let mut phi = vec![0.0; window.sub_len()];
        let mut lack = vec![0.0; window.len()];
        let mut cell = 0;
        for (index, lack) in lack.iter_mut().enumerate() {
            let at = [0, 1].map(|a| window.coordinates(index)[a] as i64 + window.low[a]);
            if at[0] < wet as i64 {
                sub_cells(window, index).for_each(|sub| phi[sub] = 1.0);
            }
            if at == [x as i64, 1] {
                (*lack, cell) = (0.3, index);
            }
        }
        let volumes = Volumes::new(&lattice, &phi).lacking(&lack);
        let scales = Scales {
            cell_per_step,
            ..Scales::plain()
        };
        let mut operator = Operator::new(&lattice, &volumes, scales);
        let pockets = Pockets::find(&lattice, &volumes, &operator.dofs, Outside::default());
        operator.pockets = Some(&pockets);
        let lost = operator.filling(&vec![speed; operator.dofs.faces.len()], bodies);
        let of = |number: usize| lost.get(number).copied().unwrap_or_default();
        let cells = operator.dofs.cells.len();
        [
            of(operator.dofs.cell[cell] as usize),
            of(cells),
            lost.iter().sum(),
        ]
    }

    #[test]
    fn a_full_cell_takes_up_what_it_lacks_from_the_front_near_it() {
        let near = |found: [f64; 3], expected: f64| {
            let off = [found[0] - expected, found[1] + expected, found[2]];
            assert!(off.iter().all(|off| off.abs() < 1e-7), "{found:?}");
        };
        // 0.3 cells, as the flow passes a quarter of a cell, or in the step where that is longer.
        near(filling(6, 5, 0.1, 9.0), 0.3 * 0.4);
        near(filling(6, 5, -0.1, 0.25), 0.3 * 0.25);
        near(filling(6, 2, 0.1, 9.0), 0.3 * 0.4);
        near(filling(6, 1, 0.1, 9.0), 0.0);
        near(filling(6, 5, 0.0, 9.0), 0.0);
        near(beside(&[[0.0, -0.2, 0.1]], 6, 5, 0.0, 9.0), 0.3 * 0.8);
        // Air, and liquid that is closed in.
        near(filling(6, 6, 0.1, 9.0), 0.0);
        near(filling(12, 5, 0.1, 9.0), 0.0);
    }
}
