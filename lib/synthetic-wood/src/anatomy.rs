//! Anatomy of a grown specimen beside that of the literature.

use super::adherend::{Adherend, Counts, Tissue};
use super::lumens;
use super::recipe::Plan;

/// What was measured on a synthetic specimen.
#[derive(Clone, Debug, PartialEq)]
pub struct Anatomy {
    /// The numbers of [`Anatomy::NAMES`].
    pub values: [f64; 11],
    /// Adhesive volume, m3.
    pub adhesive_volume: f64,
    /// Adhesive volume over bond area, m.
    pub slab: f64,
    /// Adhesive voxels in the gap, in wood reached from it, and in the isolated tube.
    pub adhesive_voxels: [usize; 3],
}

impl Anatomy {
    /// What is measured, with its unit: open share of the wood, faces excluded; volume shares with walls; what lines along
    /// the growth ring and the labels of the middle page show. A box of a few cells cannot average them: they mean
    /// something in boxes of some tenths of a millimetre.
    pub const NAMES: [&'static str; 11] = [
        "porosity",
        "vessel volume share",
        "fibre volume share",
        "ray volume share",
        "vessels per mm2",
        "rays per mm",
        "vessel lumen um",
        "fibre lumen um",
        "double wall um",
        "late lumen um",
        "early lumen um",
    ];

    pub(crate) fn measure(
        plan: &Plan,
        adherends: &[Adherend],
        counts: Counts,
        adhesive_voxels: [usize; 3],
        page: &[u8],
    ) -> Self {
        let wood = counts.all.iter().sum::<u64>().max(1) as f64;
        let open = counts.open.iter().sum::<u64>() as f64;
        let volume = adhesive_voxels.iter().sum::<usize>() as f64 * f64::from(plan.voxel).powi(3);
        let [width, _, length] = plan.edges().map(f64::from);
        let sides = || adherends.iter().enumerate();
        let met = sides().map(|(s, wood)| rays_met(plan, wood, s));
        let met = met.fold((0, 0.0), |(n, length), (m, more)| (n + m, length + more));
        let [vessels, fibres, rays] = counts.all.map(|tissue| tissue as f64 / wood);
        let rays_per_mm = met.0 as f64 / (met.1 * 1e-3);
        let [per_mm2, vessel, fibre, wall, late, early] = lumens::measure(page, plan);
        let values = [
            open / wood,
            vessels,
            fibres,
            rays,
            per_mm2,
            rays_per_mm,
            vessel,
            fibre,
            wall,
            late,
            early,
        ];
        Self {
            values,
            adhesive_volume: volume * 1e-18,
            slab: volume / (width * length) * 1e-6,
            adhesive_voxels,
        }
    }
}

/// Rays entered along lines of voxels across the middle page, and the length of those lines
/// along the ring, um. The lines run along x or y, whichever is nearer to the ring direction.
fn rays_met(plan: &Plan, adherend: &Adherend, side: usize) -> (usize, f64) {
    let along = usize::from(adherend.cut.ring_along(1).abs() > adherend.cut.ring_along(0).abs());
    let [low, high] = plan.half_box(side);
    let count = |axis: usize| ((high[axis] - low[axis]) / plan.voxel) as usize;
    let (steps, lines) = (count(along), count(1 - along) / LINE_EVERY);
    let mut met = 0;
    for line in 0..lines {
        let mut inside = false;
        for step in 0..steps {
            let mut position = [0.0; 3];
            position[along] = low[along] + (step as f32 + 0.5) * plan.voxel;
            position[1 - along] = low[1 - along] + ((line * LINE_EVERY) as f32 + 0.5) * plan.voxel;
            let is_ray = adherend.at(position).tissue() == Tissue::Ray;
            met += usize::from(is_ray && !inside);
            inside = is_ray;
        }
    }
    let length = (lines * steps) as f32 * plan.voxel * adherend.cut.ring_along(along).abs();
    (met, f64::from(length))
}

const LINE_EVERY: usize = 4;
