//! Material points of the liquid at the start: counted before they are made.

use physics::{Amount, Points, VoxelBlock};

/// Largest number of material points a run accepts: beyond it the request is a mistake.
const MOST_POINTS: u64 = 2_000_000_000;

/// A regular lattice of points that fills a box with a spacing as near to the one wanted as
/// divides it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lattice {
    low: [f64; 3],
    step: [f64; 3],
    n: [u64; 3],
    velocity: [f64; 3],
}

impl Lattice {
    /// Fills `min`..`max` (m); in plane strain one layer at `depth / 2`.
    pub(super) fn new(
        min: [f64; 3],
        max: [f64; 3],
        spacing: f64,
        plane_strain_depth: Option<f64>,
        velocity: [f64; 3],
    ) -> Self {
        let mut n = [0_u64; 3];
        let mut step = [0.0; 3];
        for a in 0..3 {
            let length = max[a] - min[a];
            n[a] = ((length / spacing).round() as u64).max(1);
            step[a] = length / n[a] as f64;
        }
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
            speed: self.velocity.iter().map(|v| v * v).sum::<f64>().sqrt(),
        }
    }

    fn fill(&self, points: &mut Points) {
        let volume = self.point_volume();
        for k in 0..self.n[2] {
            for j in 0..self.n[1] {
                for i in 0..self.n[0] {
                    points.position.push(self.at([i, j, k]));
                    points.velocity.push(self.velocity);
                    points.volume.push(volume);
                }
            }
        }
    }
}

/// Where the liquid is at the start.
#[derive(Debug)]
pub(super) enum Seeds {
    /// In boxes.
    Boxes(Vec<Lattice>),
    /// In the solid voxels of a block, the same lattice in each.
    Voxels {
        block: VoxelBlock,
        spacing: f64,
        plane_strain_depth: Option<f64>,
    },
}

impl Seeds {
    /// How much liquid it is.
    ///
    /// # Errors
    /// A sentence when there is none or more than any run takes.
    pub(super) fn amount(&self) -> Result<Amount, String> {
        let amount = match self {
            Self::Boxes(boxes) => boxes
                .iter()
                .fold(Amount::default(), |sum, lattice| sum.and(lattice.amount())),
            Self::Voxels { block, .. } => {
                let mut sum = Amount::default();
                self.each_voxel(block, |lattice| sum = sum.and(lattice.amount()));
                sum
            }
        };
        match amount.points {
            0 => Err("the scene holds no adhesive: no material point lies inside the grid".into()),
            1..=MOST_POINTS => Ok(amount),
            n => Err(format!(
                "the adhesive would need {n} material points, more than {MOST_POINTS}: the cell is too small or a body too large"
            )),
        }
    }

    /// The points.
    pub(super) fn points(&self) -> Points {
        let mut points = Points::default();
        match self {
            Self::Boxes(boxes) => boxes.iter().for_each(|lattice| lattice.fill(&mut points)),
            Self::Voxels { block, .. } => {
                self.each_voxel(block, |lattice| lattice.fill(&mut points));
            }
        }
        points
    }

    fn each_voxel(&self, block: &VoxelBlock, mut visit: impl FnMut(Lattice)) {
        let Self::Voxels {
            spacing,
            plane_strain_depth,
            ..
        } = *self
        else {
            return;
        };
        let [nx, ny, nz] = block.dims();
        for k in 0..nz {
            for j in 0..ny {
                for i in (0..nx).filter(|&i| block.solid(i, j, k)) {
                    let index = [i, j, k];
                    let min: [f64; 3] = std::array::from_fn(|a| {
                        block.origin()[a] + index[a] as f64 * block.voxel()[a]
                    });
                    let max = std::array::from_fn(|a| min[a] + block.voxel()[a]);
                    visit(Lattice::new(
                        min,
                        max,
                        spacing,
                        plane_strain_depth,
                        [0.0; 3],
                    ));
                }
            }
        }
    }
}
