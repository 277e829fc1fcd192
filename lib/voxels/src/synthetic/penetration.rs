//! The synthetic "experimental" adhesive: distance- and connectivity-limited filling.
//!
//! The gap is full. From it the adhesive enters every void it is connected with, in the order
//! of travelled length over lumen radius: a constant pressure drives a viscous liquid into a
//! tube of radius r to the depth r sqrt(p t / (2 eta)) (Washburn 1921, doi:10.1103/PhysRev.17.273,
//! for imbibition; Poiseuille's law at constant pressure), so equal L/r means equal time. The
//! filling stops when the volume is that of the slab. No flow equation of the solvers is used.

use super::adherend::Sample;
use super::recipe::{Plan, RecipeError};

/// Cell codes: 0 is wood, below [`TUBE`] the radius of a lumen in um.
const TUBE: u8 = 253;
/// Void between the faces.
pub(super) const GAP: u8 = 254;
/// Adhesive; only after [`fill`].
pub(super) const FILLED: u8 = 255;
/// Cost of one voxel at radius 1 um; a voxel at radius r costs this over r.
const COST: u16 = 800;

/// How much adhesive went where, voxels.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Filled {
    pub(super) gap: usize,
    pub(super) wood: usize,
    pub(super) tube: usize,
}

pub(super) fn lumen_code(sample: &Sample) -> u8 {
    match sample {
        Sample::Wall(_) => 0,
        Sample::Lumen(_, radius) => radius.clamp(1.0, 250.0) as u8,
        Sample::Tube => TUBE,
    }
}

/// Turns cells into [`FILLED`] until the plan's adhesive volume is reached exactly.
pub(super) fn fill(cells: &mut [u8], plan: &Plan) -> Result<Filled, RecipeError> {
    let asked = plan.adhesive_voxels();
    let mut filled = Filled {
        gap: 0,
        wood: 0,
        tube: 0,
    };
    let mut front = Front::new(plan.size);
    for (index, cell) in cells.iter_mut().enumerate() {
        match *cell {
            TUBE => {
                *cell = FILLED;
                filled.tube += 1;
            }
            GAP => {
                *cell = FILLED;
                filled.gap += 1;
                front.buckets[0].push(index);
            }
            _ => {}
        }
    }
    let for_wood = asked.saturating_sub(filled.gap + filled.tube);
    filled.wood = front.advance(cells, for_wood);
    let held = filled.gap + filled.wood + filled.tube;
    if held == asked {
        return Ok(filled);
    }
    let per_area = |voxels: usize| {
        let area = (plan.size[0] * plan.size[2]) as f64;
        voxels as f64 / area * f64::from(plan.voxel)
    };
    Err(RecipeError::Overfull {
        held: per_area(held),
        asked: per_area(asked),
    })
}

/// Dijkstra's front with the cost on the entered voxel: the first neighbour to be reached is
/// then the cheapest way in, so one visit per voxel and a ring of buckets are enough.
struct Front {
    size: [usize; 3],
    buckets: Vec<Vec<usize>>,
}

impl Front {
    fn new(size: [usize; 3]) -> Self {
        Self {
            size,
            buckets: vec![Vec::new(); usize::from(COST) + 1],
        }
    }

    /// Fills lumens in the order of cost until `count` are filled or none is left; gives how
    /// many were filled.
    fn advance(&mut self, cells: &mut [u8], count: usize) -> usize {
        // Bit set: queued already. Kept apart from the codes, which the order needs.
        let mut queued = vec![false; cells.len()];
        let mut done = 0;
        let mut empty = 0;
        let mut cost = 0;
        while empty < self.buckets.len() && done < count {
            let slot = cost % self.buckets.len();
            let reached = std::mem::take(&mut self.buckets[slot]);
            empty = if reached.is_empty() { empty + 1 } else { 0 };
            for index in reached {
                if cells[index] != FILLED {
                    if done == count {
                        break;
                    }
                    cells[index] = FILLED;
                    done += 1;
                }
                self.enter_neighbours(index, cost, cells, &mut queued);
            }
            cost += 1;
        }
        done
    }

    fn enter_neighbours(&mut self, index: usize, cost: usize, cells: &[u8], queued: &mut [bool]) {
        let [nx, ny, nz] = self.size;
        let (x, y, z) = (index % nx, index / nx % ny, index / (nx * ny));
        let neighbours = [
            (x > 0, index.wrapping_sub(1)),
            (x + 1 < nx, index + 1),
            (y > 0, index.wrapping_sub(nx)),
            (y + 1 < ny, index + nx),
            (z > 0, index.wrapping_sub(nx * ny)),
            (z + 1 < nz, index + nx * ny),
        ];
        for (_, next) in neighbours.into_iter().filter(|(inside, _)| *inside) {
            let code = cells[next];
            if code == 0 || code >= TUBE || queued[next] {
                continue;
            }
            queued[next] = true;
            let slot = (cost + usize::from(COST / u16::from(code))) % self.buckets.len();
            self.buckets[slot].push(next);
        }
    }
}
