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
//! threads. Lengths inside this crate are micrometres.

mod adherend;
mod anatomy;
mod cells;
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

pub use anatomy::Anatomy;
pub use cells::{ADHESIVE, VOID, WOOD};
pub use lumens::lumen_diameters;
pub use recipe::{AdhesiveSystem, Recipe, RecipeError};
pub use species::{Species, Target};

use adherend::{Adherend, Counts, Sample};
use cells::{Cells, State};
use recipe::Plan;
use surface::Face;

/// A synthetic label volume and what was measured on it; a quarter of a byte a voxel.
#[derive(Clone, Debug)]
pub struct Specimen {
    size: [usize; 3],
    cells: Cells,
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
        let faces: Vec<Face> = match plan.adhesive {
            Some(_) => [0, 1].map(|side| Face::new(&plan, side)).into(),
            None => Vec::new(),
        };
        let adherends = Adherend::all(&plan);
        let pieces = Pieces {
            plan,
            adherends,
            faces,
        };
        let plan = &pieces.plan;
        let mut cells = Cells::new(plan.size);
        let counts: Vec<Page> = (cells.pages_mut().enumerate())
            .map(|(page, bytes)| pieces.carve(page, bytes))
            .collect();
        let [gap, tube]: [usize; 2] =
            [|page: &Page| page.gap, |page: &Page| page.tube].map(|of| counts.iter().map(of).sum());
        let wood = match plan.adhesive {
            Some(_) => {
                let is_gap = |place| pieces.is_gap(place);
                let radius = |place| pieces.radius(place);
                penetration::fill(&mut cells, plan, gap + tube, is_gap, radius)?
            }
            None => 0,
        };
        let page = cells.labels(plan.size[2] / 2);
        let counts = counts.into_iter().map(|page| page.wood).sum();
        let adhesive = [gap, wood, tube];
        let anatomy = Anatomy::measure(plan, &pieces.adherends, counts, adhesive, &page);
        Ok(Self {
            size: plan.size,
            cells,
            anatomy,
        })
    }

    /// Voxels along x, y and z.
    pub fn size(&self) -> [usize; 3] {
        self.size
    }

    /// Labels of each page in turn, x fastest.
    pub fn pages(&self) -> impl Iterator<Item = Vec<u8>> {
        (0..self.size[2]).map(|page| self.cells.labels(page))
    }

    /// All labels, x fastest, then y, then z: a byte a voxel.
    pub fn labels(&self) -> Vec<u8> {
        self.pages().flatten().collect()
    }

    /// What was measured on this volume.
    pub fn anatomy(&self) -> &Anatomy {
        &self.anatomy
    }
}

/// All that says what is where before the adhesive goes in.
struct Pieces {
    plan: Plan,
    adherends: Vec<Adherend>,
    /// Of both adherends; none of undamaged wood.
    faces: Vec<Face>,
}

/// What one page holds: tissues of both adherends, voxels of the gap and of the isolated tube.
#[derive(Default)]
struct Page {
    wood: Counts,
    gap: usize,
    tube: usize,
}

impl Pieces {
    /// Writes the states of one page and counts what is on it.
    fn carve(&self, page: usize, bytes: &mut [u8]) -> Page {
        let mut counts = Page::default();
        let [nx, ny, _] = self.plan.size;
        for index in 0..nx * ny {
            let place = [index % nx, index / nx, page];
            let state = if self.is_gap(place) {
                counts.gap += 1;
                State::Adhesive
            } else {
                let sample = self.sample(place);
                counts.wood.add(&sample);
                match sample {
                    Sample::Wall(_) => State::Wood,
                    Sample::Lumen(..) => State::Open,
                    Sample::Tube => {
                        counts.tube += 1;
                        State::Adhesive
                    }
                }
            };
            cells::put(bytes, index, state);
        }
        counts
    }

    /// The bottom piece or the top one; undamaged wood is one.
    fn side(&self, position: [f32; 3]) -> usize {
        usize::from(self.adherends.len() > 1 && position[1] > 0.0)
    }

    fn sample(&self, place: [usize; 3]) -> Sample {
        let position = self.plan.centre(place);
        self.adherends[self.side(position)].at(position)
    }

    fn is_gap(&self, place: [usize; 3]) -> bool {
        let position = self.plan.centre(place);
        let face = self.faces.get(self.side(position));
        face.is_some_and(|face| position[1].abs() < face.recess(place[0], place[2]))
    }

    /// Radius (um) of the lumen that an open voxel belongs to.
    fn radius(&self, place: [usize; 3]) -> f32 {
        match self.sample(place) {
            Sample::Lumen(_, radius) => radius,
            Sample::Wall(_) | Sample::Tube => unreachable!("open voxels are lumens"),
        }
    }
}
