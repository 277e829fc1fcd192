use super::adherend::{Adherend, Counts, Tissue};
use super::penetration::Filled;
use super::recipe::Plan;

/// What was measured on a synthetic specimen.
#[derive(Clone, Debug, PartialEq)]
pub struct Anatomy {
    /// Open share of the wood, both adherends (faces excluded).
    pub porosity: f64,
    /// Volume shares of vessels, fibres and rays, walls included.
    pub shares: [f64; 3],
    /// Vessels per mm2 of cross-section, at the middle page.
    pub vessels_per_mm2: f64,
    /// Rays per mm along the growth ring, at the middle page.
    pub rays_per_mm: f64,
    /// Adhesive volume, m3.
    pub adhesive_volume: f64,
    /// Adhesive volume over bond area, m.
    pub slab: f64,
    /// Adhesive voxels in the gap, in wood reached from it, and in the isolated tube.
    pub adhesive_voxels: [usize; 3],
}

/// The range an anatomical number of hybrid poplar should be in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// What it is, with its unit.
    pub name: &'static str,
    /// Lowest and highest value of the literature.
    pub range: [f64; 2],
}

const fn target(name: &'static str, low: f64, high: f64) -> Target {
    Target {
        name,
        range: [low, high],
    }
}

impl Anatomy {
    /// Ranges of hybrid poplar; the volume shares are about 0.33, 0.55 and 0.12. A box of a
    /// few cells cannot average them: they hold for boxes of some tenths of a millimetre.
    pub const TARGETS: [Target; 6] = [
        target("porosity", 0.64, 0.75),
        target("vessel volume share", 0.26, 0.40),
        target("fibre volume share", 0.48, 0.62),
        target("ray volume share", 0.09, 0.15),
        target("vessels per mm2", 40.0, 150.0),
        target("rays per mm", 8.0, 12.0),
    ];

    /// The measured numbers in the order of [`Anatomy::TARGETS`].
    pub fn values(&self) -> [f64; 6] {
        let [vessels, fibres, rays] = self.shares;
        [
            self.porosity,
            vessels,
            fibres,
            rays,
            self.vessels_per_mm2,
            self.rays_per_mm,
        ]
    }

    pub(super) fn measure(
        plan: &Plan,
        adherends: [&Adherend; 2],
        pages: &[[Counts; 2]],
        filled: &Filled,
    ) -> Self {
        let mut counts = Counts::default();
        pages.iter().flatten().for_each(|page| counts += page);
        let wood = counts.all.iter().sum::<u64>().max(1) as f64;
        let open = counts.open.iter().sum::<u64>() as f64;
        let voxels = [filled.gap, filled.wood, filled.tube];
        let volume = voxels.iter().sum::<usize>() as f64 * f64::from(plan.voxel).powi(3);
        let [width, height, length] = plan.edges().map(f64::from);
        let vessels: usize = (0..2).map(|s| vessels_inside(plan, adherends[s], s)).sum();
        let met = [0, 1].map(|side| rays_met(plan, adherends[side], side));
        Self {
            porosity: open / wood,
            shares: counts.all.map(|tissue| tissue as f64 / wood),
            vessels_per_mm2: vessels as f64 / (width * height * 1e-6),
            rays_per_mm: (met[0].0 + met[1].0) as f64 / ((met[0].1 + met[1].1) * 1e-3),
            adhesive_volume: volume * 1e-18,
            slab: volume / (width * length) * 1e-6,
            adhesive_voxels: voxels,
        }
    }
}

/// Vessels whose axis crosses the middle page within this adherend's half of the box.
fn vessels_inside(plan: &Plan, adherend: &Adherend, side: usize) -> usize {
    let [low, high] = plan.half_box(side);
    let crosses = |r: f32, t: f32| {
        let place = adherend.cut.crossing(r, t);
        (0..2).all(|i| (low[i]..high[i]).contains(&place[i]))
    };
    let members = adherend.vessels.members().iter();
    members.filter(|v| crosses(v.r, v.t)).count()
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

/// Every how many voxels a test line runs.
const LINE_EVERY: usize = 4;
