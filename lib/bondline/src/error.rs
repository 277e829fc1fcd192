//! Why there is no bond line.

/// Why there is no bond line to build or to find; one sentence each.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// The specimen holds no adhesive voxel.
    #[error(
        "the specimen has no adhesive voxel: a bonded specimen is needed, or, to bond wood alone, build-bondline with --slab or --spread"
    )]
    NoAdhesive,
    /// No wood on one side of the bond line.
    #[error(
        "there is no wood {side} {of}: a specimen with an adherend on each side is needed, or another --normal"
    )]
    NoWood {
        /// "below" or "above".
        side: &'static str,
        /// What it is below or above of.
        of: String,
    },
    /// Wood outweighs adhesive in every layer.
    #[error(
        "no layer normal to {normal} looks like a bond line: at best adhesive covers {:.1} % of a layer less than wood does; give the plane by hand or another --normal",
        -100.0 * contrast
    )]
    NoBondLine {
        /// The axis looked along.
        normal: units::Axis,
        /// Best adhesive less wood area fraction.
        contrast: f64,
    },
    /// The bond lies across another axis.
    #[error(
        "the bond lies across {fits}, not across {normal}: adhesive covers up to {:.1} % of the area more than wood in layers normal to {fits}, and {:.1} % in those normal to {normal}; give --normal {fits}, or the plane by hand",
        100.0 * best, 100.0 * contrast
    )]
    OtherNormal {
        /// The axis looked along.
        normal: units::Axis,
        /// Best adhesive less wood area fraction along it.
        contrast: f64,
        /// The axis that fits.
        fits: units::Axis,
        /// That along the axis that fits.
        best: f64,
    },
    /// The blocks of the specimen are not voxels of one stack.
    #[error("the wood and the adhesive of the specimen are not voxels of the same stack")]
    Mismatch,
    /// A plane given by hand is outside.
    #[error(
        "the bond plane at {:.3} um is outside the specimen, which reaches from {:.3} to {:.3} um along {normal}",
        1e6 * plane_m, 1e6 * low_m, 1e6 * high_m
    )]
    PlaneOutside {
        /// The plane asked for, m.
        plane_m: f64,
        /// Low face of the specimen, m.
        low_m: f64,
        /// High face of the specimen, m.
        high_m: f64,
        /// The bond normal.
        normal: units::Axis,
    },
    /// Rounding to whole cells changes the volume of the adhesive too much.
    #[error(
        "the adhesive would make a slab of {:.4} cells of {:.3} um; rounded to {cells} its volume changes by {:+.2} %, more than the tolerance of {:.2} %: use fewer voxels per cell or a larger --tolerance",
        exact_cells, 1e6 * cell_m, 100.0 * change, 100.0 * tolerance
    )]
    Rounding {
        /// Slab thickness in cells before rounding.
        exact_cells: f64,
        /// After rounding.
        cells: u64,
        /// Edge of a cell, m.
        cell_m: f64,
        /// Relative change of volume.
        change: f64,
        /// Largest relative change accepted.
        tolerance: f64,
    },
    /// The slab does not fit between the adherends at the gap asked for.
    #[error(
        "a gap of {:.3} um leaves no room for the adhesive slab of {:.3} um between the adherends: at least {:.3} um is needed",
        1e6 * gap_m, 1e6 * slab_m, 1e6 * least_m
    )]
    GapTooSmall {
        /// The gap asked for, m.
        gap_m: f64,
        /// Thickness of the slab, m.
        slab_m: f64,
        /// The smallest gap that has room, m.
        least_m: f64,
    },
    /// A piece of undamaged wood without wood.
    #[error("the {piece} piece holds no wood")]
    NoWoodIn {
        /// "bottom" or "top".
        piece: &'static str,
    },
    /// Two pieces scanned at different resolutions.
    #[error(
        "the voxels of the bottom piece have edges of {:.6} um and those of the top piece {:.6} um: both must be the same, so scale one stack to the other's",
        1e6 * bottom_m, 1e6 * top_m
    )]
    Voxels {
        /// Edge of the bottom piece's voxels, m.
        bottom_m: f64,
        /// Edge of the top piece's voxels, m.
        top_m: f64,
    },
    /// Two pieces of unequal width.
    #[error(
        "the bottom piece is {} x {} voxels wide along {} and {} and the top piece, as it lies, {} x {}: crop them to be the same, or give --crop-to-fit for what they share from their low corners",
        bottom[0], bottom[1], axes[0], axes[1], top[0], top[1]
    )]
    CrossSections {
        /// The axes across the bond.
        axes: [units::Axis; 2],
        /// Voxels of the bottom piece along them.
        bottom: [usize; 2],
        /// Voxels of the top piece along them, after its turn.
        top: [usize; 2],
    },
    /// The void of both closed pieces is less than the slab.
    #[error(
        "a slab of {:.3} um is more than all void of the closed pieces, {:.3} um over the bond area: they could never close; take thicker pieces or less adhesive",
        1e6 * slab_m, 1e6 * void_m
    )]
    NoRoom {
        /// Thickness of the slab, m.
        slab_m: f64,
        /// Void of the closed pieces over the bond area, m.
        void_m: f64,
    },
    /// Nowhere does wood of one piece face wood of the other.
    #[error(
        "nowhere along the normal does wood of the top piece come to rest on wood of the bottom piece"
    )]
    NeverMeet,
}

impl Error {
    /// Whether the specimen itself is unfit, whatever the options.
    pub fn is_unfit_data(&self) -> bool {
        matches!(
            self,
            Error::NoAdhesive | Error::Mismatch | Error::NoWoodIn { .. }
        )
    }
}
