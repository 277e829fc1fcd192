//! Material points of the liquid at the start: counted before they are made.

use physics::{Amount, Seed, VoxelBlock, norm};

/// Most material points accepted; more are a mistake in the case.
const MOST_POINTS: u64 = 2_000_000_000;

/// A regular lattice of points that fills a box. Its spacing divides the box and is the nearest to the wanted one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lattice {
    low: [f64; 3],
    step: [f64; 3],
    n: [u64; 3],
    velocity: [f64; 3],
}

impl Lattice {
    /// Fills `min`..`max` (m); in plane strain with one layer at half the depth.
    pub(super) fn new(
        min: [f64; 3],
        max: [f64; 3],
        spacing: f64,
        plane_strain_depth: Option<f64>,
        velocity: [f64; 3],
    ) -> Self {
        let length: [f64; 3] = std::array::from_fn(|a| max[a] - min[a]);
        let mut n = length.map(|length| ((length / spacing).round() as u64).max(1));
        let mut step = std::array::from_fn(|a| length[a] / n[a] as f64);
        let mut low = min;
        if let Some(depth) = plane_strain_depth {
            (n[2], step[2], low[2]) = (1, depth, 0.0);
        }
        Self {
            low,
            step,
            n,
            velocity,
        }
    }

    fn at(&self, index: [u64; 3]) -> [f64; 3] {
        std::array::from_fn(|a| self.low[a] + (index[a] as f64 + 0.5) * self.step[a])
    }

    fn point_volume(&self) -> f64 {
        self.step[0] * self.step[1] * self.step[2]
    }

    fn count(&self) -> u64 {
        (self.n.iter()).fold(1, |total: u64, &n| total.saturating_mul(n))
    }

    pub(super) fn amount(&self) -> Amount {
        Amount {
            points: self.count(),
            volume_m3: self.count() as f64 * self.point_volume(),
            low_m: self.at([0; 3]),
            high_m: self.at(self.n.map(|n| n - 1)),
            speed: norm(self.velocity),
        }
    }

    fn seeds(self) -> impl Iterator<Item = Seed> {
        let [nx, ny, nz] = self.n;
        let indices =
            (0..nz).flat_map(move |k| (0..ny).flat_map(move |j| (0..nx).map(move |i| [i, j, k])));
        indices.map(move |index| Seed {
            position: self.at(index),
            velocity: self.velocity,
            volume: self.point_volume(),
        })
    }
}

/// Place of the liquid at the start.
#[derive(Debug)]
pub(super) enum Seeds {
    /// In boxes.
    Boxes(Vec<Lattice>),
    /// In the solid voxels of a block, with the same lattice in each.
    Voxels {
        block: VoxelBlock,
        spacing: f64,
        plane_strain_depth: Option<f64>,
    },
}

impl Seeds {
    /// The amount of liquid.
    /// Errors: no liquid, or more than [`MOST_POINTS`].
    pub(super) fn amount(&self) -> Result<Amount, String> {
        let amount =
            (self.lattices()).fold(Amount::default(), |sum, lattice| sum.and(lattice.amount()));
        match amount.points {
            0 => Err("the scene holds no adhesive: no material point lies inside the grid".into()),
            1..=MOST_POINTS => Ok(amount),
            n => Err(format!(
                "the adhesive would need {n} material points, more than {MOST_POINTS}: the cell is too small or a body too large"
            )),
        }
    }

    /// The points.
    pub(super) fn points(&self) -> impl Iterator<Item = Seed> {
        self.lattices().flat_map(Lattice::seeds)
    }

    fn lattices(&self) -> Box<dyn Iterator<Item = Lattice> + '_> {
        match self {
            Self::Boxes(boxes) => Box::new(boxes.iter().copied()),
            Self::Voxels {
                block,
                spacing,
                plane_strain_depth,
            } => Box::new(solid_voxels(block).map(|index| {
                let min: [f64; 3] =
                    std::array::from_fn(|a| block.origin()[a] + index[a] as f64 * block.voxel()[a]);
                let max = std::array::from_fn(|a| min[a] + block.voxel()[a]);
                Lattice::new(min, max, *spacing, *plane_strain_depth, [0.0; 3])
            })),
        }
    }
}

/// The solid voxels of a block.
fn solid_voxels(block: &VoxelBlock) -> impl Iterator<Item = [usize; 3]> {
    let [nx, ny, nz] = block.dims();
    let rows = (0..nz).flat_map(move |k| (0..ny).map(move |j| [j, k]));
    rows.flat_map(move |[j, k]| {
        let voxels = (0..nx).filter(move |&i| block.solid(i, j, k));
        voxels.map(move |i| [i, j, k])
    })
}
