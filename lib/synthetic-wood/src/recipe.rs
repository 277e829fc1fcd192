//! The recipe of a specimen.

use super::cells::Cells;
use super::species::{Species, Timber};

/// The adhesive of a synthetic specimen: sets the slab volume and, for PF, the isolated tube.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AdhesiveSystem {
    /// Phenol formaldehyde. The volume holds one large tube of adhesive that is not connected
    /// to the bond line, which is how the paper explains its PF mismatch (its section 3).
    Pf,
    /// Polyvinyl acetate / phenol formaldehyde blend.
    PvaPf,
}

impl AdhesiveSystem {
    /// Slab thickness of the paper's full-size specimen, m (section 3: 55.1 um, 78.3 um).
    fn paper_slab(self) -> f64 {
        match self {
            Self::Pf => 55.1e-6,
            Self::PvaPf => 78.3e-6,
        }
    }

    /// Share of the slab that stays between the faces when the specimen is closed; the rest
    /// is in the wood. The paper's penetration over that of its slab (Table 2: 25.3 over 22.6
    /// um for PVA-PF, 31.6 over 15.9 um for PF's top side) says that the blend stays out of
    /// the wood more.
    fn gap_share(self) -> f32 {
        match self {
            Self::Pf => 0.25,
            Self::PvaPf => 0.5,
        }
    }
}

/// What to grow.
#[derive(Clone, Debug)]
pub struct Recipe {
    /// Voxels along x, y (bond normal) and z (near the fibres).
    pub size: [usize; 3],
    /// Voxel edge, m.
    pub voxel: f64,
    /// Which wood; a bonded specimen is of hybrid poplar.
    pub species: Species,
    /// Which adhesive; `None` is one piece of undamaged wood.
    pub adhesive: Option<AdhesiveSystem>,
    /// Adhesive volume per bond area, m; `None` takes the paper's, but at most a sixth of the
    /// box height, rounded to whole cells of two voxels. Undamaged wood has none.
    pub slab: Option<f64>,
    /// Angle of the fibres against the bond plane, rad; `None` draws 3 to 6 degrees for each adherend. Up or down is drawn.
    pub grain_angle: Option<f64>,
    /// Seed of all random choices.
    pub seed: u64,
}

/// Memory that is taken whatever the size, bytes: the program, and the anatomy of a small box.
const PROGRAM: u64 = 8 << 20;
/// And for each column along the bond normal, of a bonded specimen: its faces, and the front of the adhesive.
const COLUMN: u64 = 32;
/// And for each voxel of a page across the fibres: what is measured on it, and the anatomy.
const PAGE_VOXEL: u64 = 12;

impl Recipe {
    /// Memory that [`super::Specimen::grow`] and writing its pages take, bytes: never less than was
    /// measured, and at most a quarter more from fifty million voxels on (`the_forecast_is_what_was_measured`).
    ///
    /// # Errors
    /// What cannot be grown at all.
    pub fn memory_bytes(&self) -> Result<u64, RecipeError> {
        let plan = Plan::new(self)?;
        let [nx, ny, nz] = plan.size.map(|n| n as u64);
        let columns = match plan.adhesive {
            Some(_) => COLUMN * nx * nz,
            None => 0,
        };
        Ok(Cells::bytes(plan.size) as u64 + columns + PAGE_VOXEL * nx * ny + PROGRAM)
    }
}

impl Default for Recipe {
    fn default() -> Self {
        Self {
            size: [48, 96, 48],
            voxel: 1.45e-6,
            species: Species::HybridPoplar,
            adhesive: None,
            slab: None,
            grain_angle: None,
            seed: 1,
        }
    }
}

/// Why a recipe cannot be grown; a sentence each.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RecipeError {
    /// What no seed helps.
    #[error("{0}")]
    Refused(String),
    /// Adhesive that does not fit into what the bond line reaches.
    #[error("{0}")]
    Overfull(String),
}

fn refused<T>(why: impl Into<String>) -> Result<T, RecipeError> {
    Err(RecipeError::Refused(why.into()))
}

/// A recipe in micrometres with its defaults filled in and its limits checked.
#[derive(Clone)]
pub(crate) struct Plan {
    pub(crate) size: [usize; 3],
    pub(crate) voxel: f32,
    pub(crate) species: Species,
    pub(crate) timber: &'static Timber,
    pub(crate) adhesive: Option<AdhesiveSystem>,
    /// Adhesive volume per bond area, um; 0 of undamaged wood.
    pub(crate) slab: f64,
    /// Angle of the fibres against the bond plane, rad, where it is given.
    pub(crate) grain_angle: Option<f32>,
    pub(crate) seed: u64,
}

impl Plan {
    pub(crate) fn new(recipe: &Recipe) -> Result<Self, RecipeError> {
        let [nx, ny, nz] = recipe.size;
        let least = if recipe.adhesive.is_some() { 48 } else { 24 };
        let accepted =
            (24..=4096).contains(&nx) && (least..=4096).contains(&ny) && (24..=4096).contains(&nz);
        if !accepted {
            return refused(format!(
                "size {nx}x{ny}x{nz} is not accepted: x and z need 24 to 4096 voxels and y {least} to 4096"
            ));
        }
        // As it was said, to a millionth of a micrometre.
        let voxel = (recipe.voxel * 1e12).round() / 1e6;
        if !(0.2..=2.0).contains(&voxel) {
            return refused(format!(
                "voxel of {voxel:.3} um is not accepted: walls of 4 um need a voxel of 0.2 to 2 um"
            ));
        }
        // As it was said: degrees come back from radians with rounding.
        let degrees = |angle: f64| (1e9 * angle.to_degrees()).round() / 1e9;
        let steep = (recipe.grain_angle.map(degrees)).filter(|angle| !(0.0..=30.0).contains(angle));
        if let Some(angle) = steep {
            return refused(format!(
                "grain angle of {angle} degrees is not accepted: 0 to 30 degrees are"
            ));
        }
        let slab = match recipe.adhesive {
            Some(_) if recipe.species != Species::HybridPoplar => {
                return refused(format!(
                    "a synthetic bond line is of hybrid poplar, whose penetration is known; {} is grown without adhesive, and bonded by build-bondline --slab",
                    recipe.species.name()
                ));
            }
            Some(adhesive) => slab(recipe, adhesive, ny as f64 * voxel, 2.0 * voxel)?,
            None if recipe.slab.is_some() => {
                return refused(
                    "undamaged wood has no slab: its adhesive is given to build-bondline",
                );
            }
            None => 0.0,
        };
        Ok(Self {
            size: recipe.size,
            voxel: voxel as f32,
            species: recipe.species,
            timber: recipe.species.timber(),
            adhesive: recipe.adhesive,
            slab,
            grain_angle: recipe.grain_angle.map(|angle| angle as f32),
            seed: recipe.seed,
        })
    }

    /// Edges of the box along x, y and z, um.
    pub(crate) fn edges(&self) -> [f32; 3] {
        self.size.map(|n| n as f32 * self.voxel)
    }

    /// Centre of the voxel of a column, row and page, um from the middle of the bond plane.
    pub(crate) fn centre(&self, place: [usize; 3]) -> [f32; 3] {
        let half = self.edges().map(|edge| 0.5 * edge);
        [0, 1, 2].map(|i| (place[i] as f32 + 0.5) * self.voxel - half[i])
    }

    /// Corners of the half of the box that belongs to adherend `side` (0 bottom, 1 top);
    /// undamaged wood has all of it.
    pub(crate) fn half_box(&self, side: usize) -> [[f32; 3]; 2] {
        let [x, y, z] = self.edges().map(|edge| 0.5 * edge);
        match side {
            _ if self.adhesive.is_none() => [[-x, -y, -z], [x, y, z]],
            0 => [[-x, -y, -z], [x, 0.0, z]],
            _ => [[-x, 0.0, -z], [x, y, z]],
        }
    }

    /// Mean distance of a face from the bond plane, um.
    pub(crate) fn mean_recess(&self) -> f32 {
        let gap_share = self.adhesive.map_or(0.0, AdhesiveSystem::gap_share);
        0.5 * gap_share * self.slab as f32
    }

    /// Voxels of adhesive that make the slab.
    pub(crate) fn adhesive_voxels(&self) -> usize {
        let area = self.size[0] * self.size[2];
        (self.slab / f64::from(self.voxel) * area as f64).round() as usize
    }
}

/// Slab thickness (um) of a bonded specimen in a box of this height with cells of this edge.
fn slab(
    recipe: &Recipe,
    adhesive: AdhesiveSystem,
    height: f64,
    cell: f64,
) -> Result<f64, RecipeError> {
    let slab = match recipe.slab {
        Some(slab) => slab * 1e6,
        None => (adhesive.paper_slab() * 1e6).min((height / 6.0 / cell).round() * cell),
    };
    let (lowest, highest) = (4.0 * cell, height / 3.0);
    if !(lowest..=highest).contains(&slab) {
        return refused(format!(
            "slab of {slab:.2} um is not accepted: this box takes {lowest:.2} to {highest:.2} um"
        ));
    }
    Ok(slab)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Peaks of `synth-xct`, kB as /usr/bin/time says, on x86-64 by one and two threads.
    const MEASURED: [([usize; 3], Option<AdhesiveSystem>, u64); 9] = [
        ([48, 96, 48], Some(AdhesiveSystem::Pf), 3792),
        ([200, 200, 200], None, 6766),
        ([24, 4096, 24], Some(AdhesiveSystem::Pf), 5784),
        ([2000, 48, 24], Some(AdhesiveSystem::Pf), 6700),
        ([1500, 1500, 24], Some(AdhesiveSystem::Pf), 42_924),
        ([1500, 1500, 24], None, 41_424),
        ([1000, 24, 1000], None, 10_764),
        ([2000, 48, 700], Some(AdhesiveSystem::PvaPf), 57_768),
        ([600, 394, 600], Some(AdhesiveSystem::Pf), 48_432),
    ];

    #[test]
    fn the_forecast_is_what_was_measured() {
        for (size, adhesive, measured) in MEASURED {
            let recipe = Recipe {
                size,
                adhesive,
                ..Recipe::default()
            };
            let forecast = recipe.memory_bytes().unwrap() as f64;
            let over = forecast / (1024 * measured) as f64;
            let mb = forecast / 1e6;
            println!("{size:?}: {mb:.1} MB, {over:.2} of what was measured");
            assert!(over >= 1.0, "{size:?}: {over}");
            let large = size.iter().product::<usize>() > 50_000_000;
            assert!(!large || over < 1.25, "{size:?}: {over}");
        }
    }
}
