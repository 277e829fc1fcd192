//! The species that can be grown, and what species.toml says of them. Sources: docs/wood.md.

use std::collections::HashMap;
use std::sync::LazyLock;

use serde::Deserialize;

use super::anatomy::Anatomy;

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

    /// What the literature says, in the order of [`Anatomy::NAMES`]; `None` where a
    /// species lacks something or no value was found.
    pub fn targets(self) -> [Option<Target>; 11] {
        let of = |name| {
            let &[value, low, high] = self.timber().targets.get(name)?;
            let range = [low, high];
            Some(Target { value, range })
        };
        Anatomy::NAMES.map(of)
    }

    pub(crate) fn timber(self) -> &'static Timber {
        static TIMBERS: LazyLock<HashMap<String, Timber>> = LazyLock::new(|| {
            toml::from_str(include_str!("species.toml")).expect("part of the program")
        });
        &TIMBERS[&self.name().replace(' ', "-")]
    }
}

/// The tissues of a species. Lengths are micrometres.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Timber {
    /// By their names in [`Anatomy::NAMES`]: usual, lowest and highest value.
    pub(crate) targets: HashMap<String, [f64; 3]>,
    pub(crate) vessels: Option<VesselTraits>,
    pub(crate) rays: RayTraits,
    pub(crate) grain: Grain,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
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

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RayTraits {
    /// Mean distance of ray columns along the ring, beside what is wider than one cell.
    pub(crate) spacing: f32,
    /// Width of a ray of one cell with its walls, and of each cell more.
    pub(crate) width: [f32; 2],
    pub(crate) more: f32,
    /// Height of a row of ray cells along l and length of a cell along r.
    pub(crate) cell: [f32; 2],
    /// The columns there are, with the cumulated chance of each.
    pub(crate) kinds: Vec<RayKind>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
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
#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Grain {
    Fibres(FibreTraits),
    Tracheids(TracheidTraits),
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FibreTraits {
    /// Distance of fibre axes.
    pub(crate) pitch: f32,
    /// Half of the wall between two fibres.
    pub(crate) half_wall: [f32; 2],
    pub(crate) length: [f32; 2],
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
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
