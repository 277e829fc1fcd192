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
    pub fn paper_slab(self) -> f64 {
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
    /// Which adhesive.
    pub adhesive: AdhesiveSystem,
    /// Adhesive volume per bond area, m; `None` takes the paper's, but at most a sixth of the
    /// box height, rounded to whole cells of two voxels.
    pub slab: Option<f64>,
    /// Seed of all random choices.
    pub seed: u64,
}

/// Why a recipe cannot be grown.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RecipeError {
    /// Too few voxels for two adherends with open lumens, or more than memory can address.
    #[error(
        "size {}x{}x{} is not accepted: x and z need 24 to 4096 voxels and y 48 to 4096",
        .0[0], .0[1], .0[2]
    )]
    Size([usize; 3]),
    /// Voxels that cannot resolve the cell walls.
    #[error("voxel of {0:.3} um is not accepted: walls of 4 um need a voxel of 0.2 to 2 um")]
    Voxel(f64),
    /// A slab too thin for a gap of whole voxels or too thick for the box.
    #[error("slab of {slab:.2} um is not accepted: this box takes {lowest:.2} to {highest:.2} um")]
    Slab {
        /// Asked, um.
        slab: f64,
        /// Thinnest accepted, um.
        lowest: f64,
        /// Thickest accepted, um.
        highest: f64,
    },
    /// The adhesive does not fit into what the bond line reaches.
    #[error(
        "the void reached from the bond line holds {held:.2} um of adhesive per bond area and {asked:.2} um are asked: take a thinner slab or another seed"
    )]
    Overfull {
        /// Reachable void over bond area, um.
        held: f64,
        /// Asked, um.
        asked: f64,
    },
}

/// A recipe in micrometres with its defaults filled in and its limits checked.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) size: [usize; 3],
    pub(super) voxel: f32,
    pub(super) adhesive: AdhesiveSystem,
    /// Adhesive volume per bond area, um.
    pub(super) slab: f64,
    pub(super) seed: u64,
}

impl Plan {
    pub(super) fn new(recipe: &Recipe) -> Result<Self, RecipeError> {
        let [nx, ny, nz] = recipe.size;
        let accepted =
            (24..=4096).contains(&nx) && (48..=4096).contains(&ny) && (24..=4096).contains(&nz);
        if !accepted {
            return Err(RecipeError::Size(recipe.size));
        }
        let voxel = recipe.voxel * 1e6;
        if !(0.2..=2.0).contains(&voxel) {
            return Err(RecipeError::Voxel(voxel));
        }
        let height = ny as f64 * voxel;
        let cell = 2.0 * voxel;
        let slab = match recipe.slab {
            Some(slab) => slab * 1e6,
            None => (recipe.adhesive.paper_slab() * 1e6).min((height / 6.0 / cell).round() * cell),
        };
        let (lowest, highest) = (4.0 * cell, height / 3.0);
        if !(lowest..=highest).contains(&slab) {
            return Err(RecipeError::Slab {
                slab,
                lowest,
                highest,
            });
        }
        Ok(Self {
            size: recipe.size,
            voxel: voxel as f32,
            adhesive: recipe.adhesive,
            slab,
            seed: recipe.seed,
        })
    }

    pub(super) fn voxels(&self) -> usize {
        self.size.iter().product()
    }

    /// Edges of the box along x, y and z, um.
    pub(super) fn edges(&self) -> [f32; 3] {
        self.size.map(|n| n as f32 * self.voxel)
    }

    /// Voxel centre, um from the middle of the bond plane.
    pub(super) fn centre(&self, column: usize, row: usize, page: usize) -> [f32; 3] {
        let half = self.edges().map(|edge| 0.5 * edge);
        let index = [column, row, page];
        [0, 1, 2].map(|i| (index[i] as f32 + 0.5) * self.voxel - half[i])
    }

    /// Corners of the half of the box that belongs to adherend `side` (0 bottom, 1 top).
    pub(super) fn half_box(&self, side: usize) -> [[f32; 3]; 2] {
        let [x, y, z] = self.edges().map(|edge| 0.5 * edge);
        match side {
            0 => [[-x, -y, -z], [x, 0.0, z]],
            _ => [[-x, 0.0, -z], [x, y, z]],
        }
    }

    /// Mean distance of a face from the bond plane, um.
    pub(super) fn mean_recess(&self) -> f32 {
        0.5 * self.adhesive.gap_share() * self.slab as f32
    }

    /// Voxels of adhesive that make the slab.
    pub(super) fn adhesive_voxels(&self) -> usize {
        let area = self.size[0] * self.size[2];
        (self.slab / f64::from(self.voxel) * area as f64).round() as usize
    }
}
