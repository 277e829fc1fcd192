//! The species that can be grown: what their tissues are made of. Sources: docs/wood.md.

/// What the literature says of an anatomical number (docs/wood.md has the sources).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// The usual value.
    pub value: f64,
    /// Lowest and highest value met.
    pub range: [f64; 2],
}

/// A species of wood.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Species {
    /// Hybrid poplar, *Populus* x: diffuse-porous, thin walls, uniseriate rays.
    HybridPoplar,
    /// European beech, *Fagus sylvatica*: many small vessels, thick walls, some broad rays.
    Beech,
    /// Silver birch, *Betula pendula*: few larger vessels, rays of one to four cells.
    Birch,
    /// Norway spruce, *Picea abies*: tracheids in radial files, early and late wood.
    Spruce,
}

impl Species {
    /// As it is called in prose.
    pub fn name(self) -> &'static str {
        ["hybrid poplar", "beech", "birch", "spruce"][self as usize]
    }

    /// What the literature says, in the order of [`super::Anatomy::NAMES`]; `None` where a
    /// species lacks something or no value was found.
    pub fn targets(self) -> [Option<Target>; 11] {
        let t = |value, low, high| {
            let range = [low, high];
            Some(Target { value, range })
        };
        match self {
            Self::HybridPoplar => [
                t(0.72, 0.64, 0.75),
                t(0.33, 0.26, 0.40),
                t(0.55, 0.48, 0.62),
                t(0.12, 0.09, 0.15),
                t(45.0, 25.0, 150.0),
                t(10.5, 8.0, 13.0),
                t(65.0, 40.0, 95.0),
                t(17.0, 14.0, 20.0),
                t(5.5, 4.0, 7.0),
                None,
                None,
            ],
            Self::Beech => [
                t(0.55, 0.45, 0.65),
                t(0.31, 0.25, 0.42),
                t(0.42, 0.35, 0.55),
                t(0.27, 0.10, 0.30),
                t(125.0, 80.0, 160.0),
                None,
                t(60.0, 45.0, 80.0),
                None,
                t(6.0, 3.8, 15.6),
                None,
                None,
            ],
            Self::Birch => [
                t(0.61, 0.52, 0.70),
                t(0.25, 0.20, 0.32),
                t(0.65, 0.58, 0.72),
                t(0.10, 0.08, 0.15),
                t(50.0, 35.0, 65.0),
                None,
                t(80.0, 50.0, 130.0),
                t(11.9, 9.0, 16.0),
                t(5.5, 3.8, 8.0),
                None,
                None,
            ],
            Self::Spruce => [
                t(0.71, 0.64, 0.77),
                None,
                t(0.95, 0.92, 0.97),
                t(0.05, 0.03, 0.08),
                None,
                None,
                None,
                None,
                None,
                t(8.0, 4.0, 12.0),
                t(32.0, 28.0, 40.0),
            ],
        }
    }

    pub(crate) fn timber(self) -> &'static Timber {
        match self {
            Self::HybridPoplar => &HYBRID_POPLAR,
            Self::Beech => &BEECH,
            Self::Birch => &BIRCH,
            Self::Spruce => &SPRUCE,
        }
    }
}

/// The tissues of a species. Lengths are micrometres.
pub(crate) struct Timber {
    pub(crate) vessels: Option<VesselTraits>,
    pub(crate) rays: RayTraits,
    pub(crate) grain: Grain,
}

pub(crate) struct VesselTraits {
    /// Share of the cross-section that vessels with their walls take.
    pub(crate) share: f32,
    /// Lumen diameter.
    pub(crate) diameter: [f32; 2],
    /// Chances that a group has 1, 2, 3 or 4 vessels, cumulated.
    pub(crate) groups: [f32; 4],
    /// Diameter of inter-vessel pits.
    pub(crate) pit: [f32; 2],
}

pub(crate) struct RayTraits {
    /// Mean distance of ray columns along the ring, beside what is wider than one cell.
    pub(crate) spacing: f32,
    /// Width of a ray of one cell with its walls, and of each cell more.
    pub(crate) width: [f32; 2],
    pub(crate) more: f32,
    /// Height of a row of ray cells along l and length of a cell along r.
    pub(crate) cell: [f32; 2],
    /// The columns there are, with the cumulated chance of each.
    pub(crate) kinds: &'static [RayKind],
}

pub(crate) struct RayKind {
    pub(crate) chance: f32,
    /// Least and most cells across.
    pub(crate) cells: [u32; 2],
    /// Height of a ray along the fibres.
    pub(crate) height: [f32; 2],
    /// Distance along the fibres between a ray and the next of its column.
    pub(crate) between: [f32; 2],
}

/// What runs along the grain between vessels and rays.
pub(crate) enum Grain {
    Fibres(FibreTraits),
    Tracheids(TracheidTraits),
}

#[derive(Clone, Copy)]
pub(crate) struct FibreTraits {
    /// Distance of fibre axes.
    pub(crate) pitch: f32,
    /// Half of the wall between two fibres.
    pub(crate) half_wall: [f32; 2],
    pub(crate) length: [f32; 2],
}

#[derive(Clone, Copy)]
pub(crate) struct TracheidTraits {
    /// Width of a growth ring.
    pub(crate) ring: f32,
    /// Where in the ring earlywood ends and latewood begins, shares.
    pub(crate) transition: [f32; 2],
    /// Radial distance of cells in early and late wood, walls included.
    pub(crate) radial: [f32; 2],
    /// Tangential distance of cells.
    pub(crate) tangential: f32,
    /// Half of the wall between two cells in early and late wood.
    pub(crate) half_wall: [f32; 2],
    pub(crate) length: f32,
}

/// Grown since the first version: its numbers are part of what a seed means.
static HYBRID_POPLAR: Timber = Timber {
    vessels: Some(VesselTraits {
        share: 0.33,
        diameter: [50.0, 92.0],
        groups: [0.45, 0.75, 0.92, 1.0],
        pit: [5.0, 13.0],
    }),
    rays: RayTraits {
        // 8 to 12 rays per mm are met, because vessels interrupt rays and rays end.
        spacing: 63.0,
        width: [11.2, 12.0],
        more: 0.0,
        cell: [17.0, 75.0],
        kinds: &[RayKind {
            chance: 1.0,
            cells: [1, 1],
            height: [100.0, 500.0],
            between: [6.0, 20.0],
        }],
    },
    grain: Grain::Fibres(FibreTraits {
        pitch: 19.5,
        half_wall: [2.0, 3.0],
        length: [800.0, 1200.0],
    }),
};

static BEECH: Timber = Timber {
    vessels: Some(VesselTraits {
        share: 0.32,
        diameter: [45.0, 75.0],
        groups: [0.55, 0.85, 0.97, 1.0],
        pit: [5.0, 7.0],
    }),
    rays: RayTraits {
        spacing: 60.0,
        width: [10.4, 11.2],
        more: 8.5,
        cell: [14.0, 60.0],
        kinds: &[
            RayKind {
                chance: 0.86,
                cells: [1, 4],
                height: [100.0, 500.0],
                between: [10.0, 60.0],
            },
            // The broad rays, several mm high: in a small box they have no end.
            RayKind {
                chance: 1.0,
                cells: [10, 20],
                height: [3000.0, 5000.0],
                between: [10.0, 60.0],
            },
        ],
    },
    grain: Grain::Fibres(FibreTraits {
        pitch: 16.0,
        half_wall: [3.0, 3.8],
        length: [540.0, 910.0],
    }),
};

static BIRCH: Timber = Timber {
    vessels: Some(VesselTraits {
        share: 0.25,
        diameter: [60.0, 100.0],
        groups: [0.5, 0.8, 0.95, 1.0],
        // Minute in nature, 2 to 4 um; the least that voxels of 1.45 um leave open.
        pit: [4.0, 4.5],
    }),
    rays: RayTraits {
        spacing: 82.0,
        width: [10.0, 10.8],
        more: 6.5,
        cell: [14.0, 60.0],
        kinds: &[RayKind {
            chance: 1.0,
            cells: [1, 4],
            height: [120.0, 350.0],
            between: [20.0, 100.0],
        }],
    },
    grain: Grain::Fibres(FibreTraits {
        pitch: 16.5,
        half_wall: [2.0, 2.8],
        length: [800.0, 1600.0],
    }),
};

static SPRUCE: Timber = Timber {
    vessels: None,
    rays: RayTraits {
        spacing: 125.0,
        width: [10.4, 11.2],
        more: 0.0,
        cell: [20.0, 120.0],
        kinds: &[RayKind {
            chance: 1.0,
            cells: [1, 1],
            height: [100.0, 350.0],
            between: [60.0, 160.0],
        }],
    },
    grain: Grain::Tracheids(TracheidTraits {
        ring: 800.0,
        transition: [0.52, 0.95],
        radial: [40.5, 12.0],
        tangential: 30.0,
        half_wall: [1.7, 3.4],
        length: 3000.0,
    }),
};
