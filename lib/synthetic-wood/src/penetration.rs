//! The synthetic "experimental" adhesive: distance- and connectivity-limited filling.
//!
//! The gap is full. From it the adhesive enters every void it is connected with, in the order
//! of travelled length over lumen radius: a constant pressure drives a viscous liquid into a
//! tube of radius r to the depth r sqrt(p t / (2 eta)) (Washburn 1921, doi:10.1103/PhysRev.17.273,
//! for imbibition; Poiseuille's law at constant pressure), so equal L/r means equal time. The
//! filling stops when the volume is that of the slab. No flow equation of the solvers is used.

use super::cells::{Cells, State};
use super::recipe::{Plan, RecipeError};

/// Cost of one voxel at radius 1 um; a voxel at radius r costs this over r.
const COST: u16 = 800;
/// Radii (um) are whole numbers between these.
const RADII: [f32; 2] = [1.0, 250.0];

/// Turns open cells into adhesive until the plan's volume of it is reached exactly, and gives how many. On entry the
/// gap and the isolated tube, of so many voxels together, are adhesive, and nothing else is. `is_gap` tells whether a
/// voxel (column, row and page) lies between the faces, `radius` (um) that of the lumen which an open one belongs to.
pub(crate) fn fill(
    cells: &mut Cells,
    plan: &Plan,
    already: usize,
    is_gap: impl Fn([usize; 3]) -> bool,
    radius: impl Fn([usize; 3]) -> f32,
) -> Result<usize, RecipeError> {
    let asked = plan.adhesive_voxels();
    let mut front = Front {
        cells,
        radius,
        buckets: vec![Vec::new(); usize::from(COST) + 1],
    };
    for index in front.cells.indices() {
        let is_adhesive = front.cells.get(index) == State::Adhesive;
        if is_adhesive && is_gap(front.cells.place(index)) {
            front.enter_neighbours(index, 0);
        }
    }
    let wood = front.advance(asked.saturating_sub(already));
    if already + wood == asked {
        return Ok(wood);
    }
    let area = (plan.size[0] * plan.size[2]) as f64;
    let [held, asked] = [already + wood, asked].map(|n| n as f64 / area * f64::from(plan.voxel));
    Err(RecipeError::Overfull(format!(
        "the void reached from the bond line holds {held:.2} um of adhesive per bond area and {asked:.2} um are asked: take a thinner slab or another seed"
    )))
}

/// Dijkstra's front with the cost on the entered voxel: the first neighbour to be reached is
/// then the cheapest way in, so one visit per voxel and a ring of buckets are enough.
struct Front<'a, R> {
    cells: &'a mut Cells,
    radius: R,
    buckets: Vec<Vec<usize>>,
}

impl<R: Fn([usize; 3]) -> f32> Front<'_, R> {
    /// Fills lumens in the order of cost until `count` are filled or none is left; gives how
    /// many were filled.
    fn advance(&mut self, count: usize) -> usize {
        let mut done = 0;
        let mut empty = 0;
        let mut cost = 1;
        while empty < self.buckets.len() {
            let slot = cost % self.buckets.len();
            let reached = std::mem::take(&mut self.buckets[slot]);
            empty = if reached.is_empty() { empty + 1 } else { 0 };
            for index in reached {
                if done == count {
                    return done;
                }
                self.cells.set(index, State::Adhesive);
                done += 1;
                self.enter_neighbours(index, cost);
            }
            cost += 1;
        }
        done
    }

    fn enter_neighbours(&mut self, index: usize, cost: usize) {
        for next in self.cells.neighbours(index) {
            if self.cells.get(next) != State::Open {
                continue;
            }
            self.cells.set(next, State::Queued);
            let radius = (self.radius)(self.cells.place(next));
            let step = COST / radius.clamp(RADII[0], RADII[1]) as u16;
            let slot = (cost + usize::from(step)) % self.buckets.len();
            self.buckets[slot].push(next);
        }
    }
}
