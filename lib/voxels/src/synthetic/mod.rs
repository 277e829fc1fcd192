//! Seeded synthetic wood for work without a scan: hybrid poplar with a bond line, or one piece
//! of undamaged wood of a [`Species`].
//!
//! Two adherends with different cuts face each other across a rough gap normal to y; the
//! fibres run nearly along z. Undamaged wood fills the box, cut as a peeled veneer is, its rays
//! nearly along y. Anatomy: [`Species::targets`] and the modules of each tissue.
//! The "experimental" adhesive is made by `penetration`, which shares nothing with the flow
//! solvers. Everything here is synthetic and must be labelled so wherever it is shown.
//!
//! All randomness comes from ChaCha8 streams keyed by seed, adherend and feature, and every
//! voxel is a function of its position, so a recipe gives the same bytes for any number of
//! threads. Lengths inside this module are micrometres.

mod adherend;
mod anatomy;
mod cross_section;
mod cut;
mod fibres;
mod lumens;
mod penetration;
mod random;
mod rays;
mod recipe;
mod species;
mod surface;
#[cfg(test)]
mod tests;
mod tracheids;
mod vessels;

use rayon::prelude::*;

pub use anatomy::{Anatomy, Target};
pub use recipe::{AdhesiveSystem, Recipe, RecipeError};
pub use species::Species;

use adherend::{Adherend, Counts};
use lumens::Lumens;
use penetration::Filled;
use recipe::Plan;
use surface::Face;

/// Label of void voxels.
pub const VOID: u8 = 0;
/// Label of wood voxels.
pub const WOOD: u8 = 128;
/// Label of adhesive voxels.
pub const ADHESIVE: u8 = 255;

/// A synthetic label volume and what was measured on it.
#[derive(Clone, Debug)]
pub struct Specimen {
    size: [usize; 3],
    labels: Vec<u8>,
    anatomy: Anatomy,
}

impl Specimen {
    /// Grows the specimen of `recipe`.
    ///
    /// # Errors
    /// A size, voxel or slab that the anatomy cannot be resolved in, or a volume whose
    /// reachable void does not hold the adhesive.
    pub fn grow(recipe: &Recipe) -> Result<Self, RecipeError> {
        let plan = Plan::new(recipe)?;
        let adherends = Adherend::all(&plan);
        let faces: Vec<Face> = match plan.adhesive {
            Some(_) => [0, 1].map(|side| Face::new(&plan, side)).into(),
            None => Vec::new(),
        };
        let [nx, ny, _] = plan.size;
        let mut cells = vec![0_u8; plan.voxels()];
        let counts: Vec<[Counts; 2]> = cells
            .par_chunks_mut(nx * ny)
            .enumerate()
            .map(|(page, cells)| carve(&plan, &adherends, &faces, page, cells))
            .collect();
        let adhesive = match plan.adhesive {
            Some(_) => penetration::fill(&mut cells, &plan)?,
            None => Filled::default(),
        };
        cells.par_iter_mut().for_each(|cell| {
            *cell = match *cell {
                0 => WOOD,
                penetration::FILLED => ADHESIVE,
                _ => VOID,
            }
        });
        let middle = plan.size[2] / 2 * nx * ny;
        let lumens = Lumens::measure(&cells[middle..middle + nx * ny], &plan);
        let anatomy = Anatomy::measure(&plan, &adherends, &counts, &adhesive, lumens);
        Ok(Self {
            size: plan.size,
            labels: cells,
            anatomy,
        })
    }

    /// Voxels along x, y and z.
    pub fn size(&self) -> [usize; 3] {
        self.size
    }

    /// Labels of each page in turn, x fastest.
    pub fn pages(&self) -> impl Iterator<Item = &[u8]> {
        self.labels.chunks(self.size[0] * self.size[1])
    }

    /// All labels, x fastest, then y, then z.
    pub fn labels(&self) -> &[u8] {
        &self.labels
    }

    /// What was measured on this volume.
    pub fn anatomy(&self) -> &Anatomy {
        &self.anatomy
    }
}

/// Writes one page of lumen codes (0 wood, else the lumen's radius class; see
/// [`penetration`]) and counts the tissues of both adherends on it.
fn carve(
    plan: &Plan,
    adherends: &[Adherend],
    faces: &[Face],
    page: usize,
    cells: &mut [u8],
) -> [Counts; 2] {
    let mut counts = [Counts::default(); 2];
    let nx = plan.size[0];
    for (row, cells) in cells.chunks_mut(nx).enumerate() {
        for (column, cell) in cells.iter_mut().enumerate() {
            let position = plan.centre(column, row, page);
            let side = match adherends {
                [_] => 0,
                _ => usize::from(position[1] > 0.0),
            };
            let face = faces.get(side);
            if face.is_some_and(|face| position[1].abs() < face.recess(column, page)) {
                *cell = penetration::GAP;
                continue;
            }
            let sample = adherends[side].at(position);
            counts[side].add(&sample);
            *cell = penetration::lumen_code(&sample);
        }
    }
    counts
}
