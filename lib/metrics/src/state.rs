//! Wood and adhesive of a file, for measurement.

use bondline::{PlacedVoxels, Specimen};
use particle_file::{Kind, Material, ParticleFile, limits};
use units::Axis;

use crate::Error;

/// A bond line at one moment: a specimen, a bond before pressing or a state of a run.
#[derive(Clone, Debug)]
pub struct State<'a> {
    /// Axis across the bond.
    pub normal: Axis,
    /// Edge of a voxel of the specimen, m.
    pub voxel_m: f64,
    /// Low corner of the box, m. Across the bond its walls bound the bond area.
    pub box_min_m: [f64; 3],
    /// High corner of the box, m.
    pub box_max_m: [f64; 3],
    /// The wood.
    pub wood: Wood<'a>,
    /// The adhesive.
    pub adhesive: Adhesive<'a>,
}

/// The wood of a [`State`].
#[derive(Clone, Copy, Debug)]
pub enum Wood<'a> {
    /// No adherends (verification scenes).
    None,
    /// Both adherends in one stack, as scanned.
    Whole(PlacedVoxels<'a>),
    /// The adherends, each at its current place.
    Parted {
        /// Low-coordinate side.
        bottom: PlacedVoxels<'a>,
        /// High-coordinate side.
        top: PlacedVoxels<'a>,
    },
}

/// The adhesive of a [`State`].
#[derive(Clone, Copy, Debug)]
pub enum Adhesive<'a> {
    /// Full voxels.
    Voxels(PlacedVoxels<'a>),
    /// Material points of a run.
    Points {
        /// Positions, m.
        position: &'a [[f32; 3]],
        /// Current volumes, m3.
        volume: &'a [f32],
    },
}

/// The columns of voxels over the bond area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Across {
    /// The two axes in the order x, y, z.
    pub axes: [Axis; 2],
    /// Low corner along them, m.
    pub min_m: [f64; 2],
    /// Number of columns along them.
    pub columns: [usize; 2],
    /// Width of a column, m.
    pub width_m: f64,
}

impl Across {
    /// Index of the column that contains `point`; a point on or beyond a side of the box counts to the outermost column.
    pub fn column(&self, point: [f64; 3]) -> usize {
        let [u, v] = [0, 1].map(|a| {
            let column = (point[self.axes[a].index()] - self.min_m[a]) / self.width_m;
            (column.max(0.0) as usize).min(self.columns[a] - 1)
        });
        v * self.columns[0] + u
    }

    /// Centre of a column along the two axes, m.
    pub fn centre_m(&self, column: usize) -> [f64; 2] {
        let index = [column % self.columns[0], column / self.columns[0]];
        [0, 1].map(|a| self.min_m[a] + (index[a] as f64 + 0.5) * self.width_m)
    }
}

impl<'a> State<'a> {
    /// The state in a particle file.
    ///
    /// # Errors
    /// A checkpoint, damaged arrays, material points without position or volume.
    pub fn of_file(file: &'a ParticleFile) -> Result<Self, Error> {
        let header = file.header();
        if header.kind == Kind::Checkpoint {
            let what =
                "a checkpoint is for mpm-run --resume only; a specimen, bond or state is needed";
            return Err(Error::Usage(what.into()));
        }
        check_columns(file)?;
        let block = |name| file.block_named(name).map(PlacedVoxels::of_block);
        let has = |name: &str| header.blocks.iter().any(|b| b.name == name);
        let wood = if has("wood-bottom") && has("wood-top") {
            Wood::Parted {
                bottom: block("wood-bottom")?,
                top: block("wood-top")?,
            }
        } else if has("wood") {
            Wood::Whole(block("wood")?)
        } else {
            Wood::None
        };
        let mut materials = header.blocks.iter().map(|block| block.material);
        let adhesive = match materials.position(|material| material == Material::Adhesive) {
            Some(index) => Adhesive::Voxels(PlacedVoxels::of_block(file.block(index)?)),
            None => {
                let (position, volume) = file.liquid()?;
                Adhesive::Points { position, volume }
            }
        };
        let normal = Axis::from_index(header.normal.into())
            .ok_or_else(|| Error::Data("the bond normal is not an axis".into()))?;
        Ok(Self {
            normal,
            voxel_m: header.voxel_m,
            box_min_m: header.box_min_m,
            box_max_m: header.box_max_m,
            wood,
            adhesive,
        })
    }

    /// The state of a scanned specimen.
    pub fn of_specimen(specimen: &Specimen<'a>, normal: Axis) -> Self {
        let wood = specimen.wood();
        Self {
            normal,
            voxel_m: wood.voxel_m,
            box_min_m: wood.origin_m,
            box_max_m: wood.max_m(),
            wood: Wood::Whole(wood),
            adhesive: Adhesive::Voxels(specimen.adhesive()),
        }
    }

    /// The columns of voxels over the bond area.
    pub fn across(&self) -> Across {
        let axes = match self.normal {
            Axis::X => [Axis::Y, Axis::Z],
            Axis::Y => [Axis::X, Axis::Z],
            Axis::Z => [Axis::X, Axis::Y],
        };
        let extent = axes.map(|a| self.box_max_m[a.index()] - self.box_min_m[a.index()]);
        Across {
            axes,
            min_m: axes.map(|a| self.box_min_m[a.index()]),
            columns: extent.map(|e| ((e / self.voxel_m).round() as usize).max(1)),
            width_m: self.voxel_m,
        }
    }

    /// Bond area, m2.
    pub fn area_m2(&self) -> f64 {
        let [u, v] = self.across().axes.map(Axis::index);
        (self.box_max_m[u] - self.box_min_m[u]) * (self.box_max_m[v] - self.box_min_m[v])
    }

    /// Calls `visit` with position (m) and volume (m3) of every material point or adhesive voxel, in storage order.
    pub fn for_each_parcel(&self, mut visit: impl FnMut([f64; 3], f64)) {
        match self.adhesive {
            Adhesive::Points { position, volume } => position
                .iter()
                .zip(volume)
                .for_each(|(p, &v)| visit(p.map(f64::from), f64::from(v))),
            Adhesive::Voxels(voxels) => {
                let volume = voxels.voxel_m.powi(3);
                voxels
                    .bits
                    .for_each(|index| visit(voxels.centre_m(index), volume));
            }
        }
    }

    /// The wood, block by block.
    pub fn wood_blocks(&self) -> impl Iterator<Item = PlacedVoxels<'a>> + use<'a> {
        let blocks = match self.wood {
            Wood::None => [None, None],
            Wood::Whole(wood) => [Some(wood), None],
            Wood::Parted { bottom, top } => [Some(bottom), Some(top)],
        };
        blocks.into_iter().flatten()
    }
}

/// Refuses a file whose box has too many columns across the bond for the size of the file; the number of layers along the
/// normal is limited for every file.
fn check_columns(file: &ParticleFile) -> Result<(), Error> {
    /// Bytes of a row of the map, the largest output per column; half of them are in memory.
    const ROW: u64 = 64;
    let span = file.header().span();
    let columns = limits::volume(span) / span[usize::from(file.header().normal)].max(1);
    let (bytes, what) = (columns.saturating_mul(ROW), "the measures of each column");
    file.is_worth(bytes, what)?;
    Ok(file.fits(bytes / 2, what)?)
}
