//! Labels of the content of a particle file on one lattice of voxels.

use std::io::{self, Write};

use particle_file::{BitGrid, BitsRef, Block, Error, Header, Material, ParticleFile, limits};

use crate::lattice::set_voxels;
use crate::tiff::TiffWriter;
use crate::volume_fractions::VolumeFractions;

/// Label of a voxel without wood and adhesive.
pub const VOID: u8 = 0;
/// Label of wood.
pub const WOOD: u8 = 128;
/// Label of adhesive.
pub const ADHESIVE: u8 = 255;

/// Labels on one lattice of voxels: void 0, wood 128, adhesive 255. Every picture and export of
/// voxels is drawn from it.
///
/// The lattice spans the blocks. Blocks that lie between each other's voxels, as adherends do
/// during a run, are put on the nearest; the lattice begins where the largest error of that is
/// least, so that of two adherends neither is more than a quarter of a voxel from its place and
/// the middle between them is exact. Liquid points keep their places; they fill as many voxels
/// outside wood as their volume makes ([`VolumeFractions::fullest`]).
pub struct LabelVolume<'a> {
    /// Number of voxels along x, y, z.
    pub dims: [usize; 3],
    /// Low corner, m.
    pub origin_m: [f64; 3],
    /// Voxel edge, m.
    pub voxel_m: f64,
    blocks: Vec<PlacedBlock<'a>>,
    liquid: Option<Liquid<'a>>,
}

#[derive(Clone, Copy)]
struct PlacedBlock<'a> {
    label: u8,
    /// Lattice voxel of its voxel (0, 0, 0).
    at: [usize; 3],
    bits: BitsRef<'a>,
}

impl<'a> PlacedBlock<'a> {
    fn new(block: &Block, at: [usize; 3], bits: BitsRef<'a>) -> Self {
        let label = match block.material {
            Material::Rigid => WOOD,
            Material::Adhesive => ADHESIVE,
        };
        Self { label, at, bits }
    }
}

struct Liquid<'a> {
    voxels: BitGrid,
    position: &'a [[f32; 3]],
    volume: &'a [f32],
    /// Volume of all points in voxels.
    worth: f64,
}

impl<'a> LabelVolume<'a> {
    /// The labels of everything in `file`.
    ///
    /// # Errors
    /// An array is damaged, there are neither blocks nor points, points have no place or no
    /// volume, or the file is too small for as many labels.
    pub fn of(file: &'a ParticleFile) -> Result<Self, Error> {
        let header = file.header();
        if header.blocks.is_empty() && header.particles == 0 {
            return Err(corrupt(file, "has neither blocks nor liquid points".into()));
        }
        let (origin_m, places) = lattice(header);
        let mut blocks = Vec::new();
        for (index, at) in places.into_iter().enumerate() {
            let (block, bits) = file.block(index)?;
            blocks.push(PlacedBlock::new(block, at, bits));
        }
        let dims = dims(file, &blocks)?;
        // Wood is written last, over adhesive.
        blocks.sort_by_key(|placed| placed.label == WOOD);
        let mut labels = Self {
            dims,
            origin_m,
            voxel_m: header.voxel_m,
            blocks,
            liquid: None,
        };
        if header.particles > 0 {
            labels.liquid = Some(labels.liquid_of(file)?);
        }
        Ok(labels)
    }

    /// The labels of one block, exactly where it is.
    pub fn of_block(block: &Block, bits: BitsRef<'a>) -> Self {
        Self {
            dims: bits.dims(),
            origin_m: block.origin_m,
            voxel_m: block.voxel_m,
            blocks: vec![PlacedBlock::new(block, [0; 3], bits)],
            liquid: None,
        }
    }

    fn liquid_of(&self, file: &'a ParticleFile) -> Result<Liquid<'a>, Error> {
        let (position, volume) = file.liquid()?;
        let voxel = self.voxel_m.powi(3);
        let total: f64 = volume.iter().map(|&v| f64::from(v)).sum();
        let room = self.dims.iter().map(|&n| n as f64).product::<f64>() * voxel;
        if total > 8.0 * room {
            let what = format!("has liquid points of {total:e} m3 in a box of {room:e} m3");
            return Err(corrupt(file, what));
        }
        let mut fractions = VolumeFractions::new(self.void());
        for (position, &volume) in position.iter().zip(volume) {
            let place = self.place(*position);
            // Half a voxel: bodies were put on the nearest voxels.
            if (0..3).all(|a| (-0.5..=self.dims[a] as f64 + 0.5).contains(&place[a])) {
                fractions.add(place, f64::from(volume) / voxel);
            }
        }
        Ok(Liquid {
            voxels: fractions.fullest(),
            position,
            volume,
            worth: total / voxel,
        })
    }

    /// The voxels that no block fills.
    fn void(&self) -> BitGrid {
        let mut void = BitGrid::from_fn(self.dims, |_, _, _| true);
        for placed in &self.blocks {
            let [i, j, k] = placed.at;
            let filled = set_voxels(placed.bits);
            filled.for_each(|[x, y, z]| void.set(i + x, j + y, k + z, false));
        }
        void
    }

    /// A position (m) in voxels from the low corner.
    fn place(&self, position: [f32; 3]) -> [f64; 3] {
        std::array::from_fn(|a| (f64::from(position[a]) - self.origin_m[a]) / self.voxel_m)
    }

    /// How many voxels the liquid's volume makes, and how many were found for it.
    pub fn liquid_voxels(&self) -> (f64, u64) {
        let count = |liquid: &Liquid| (liquid.worth, liquid.voxels.count());
        self.liquid.as_ref().map_or((0.0, 0), count)
    }

    /// The label of one voxel.
    pub fn label(&self, voxel: [usize; 3]) -> u8 {
        let mut layers = self.layers().rev();
        let holder = layers.find(|placed| {
            let dims = placed.bits.dims();
            let [x, y, z] = [0, 1, 2].map(|a| voxel[a].wrapping_sub(placed.at[a]));
            x < dims[0] && y < dims[1] && z < dims[2] && placed.bits.get(x, y, z)
        });
        holder.map_or(VOID, |placed| placed.label)
    }

    /// What fills voxels; of two at one the later counts.
    fn layers(&self) -> impl DoubleEndedIterator<Item = PlacedBlock<'_>> {
        let liquid = self.liquid.as_ref().map(|liquid| PlacedBlock {
            label: ADHESIVE,
            at: [0; 3],
            bits: liquid.voxels.view(),
        });
        liquid.into_iter().chain(self.blocks.iter().copied())
    }

    /// Writes the labels of page `z` into `page`, x fastest.
    fn page(&self, z: usize, page: &mut [u8]) {
        page.fill(VOID);
        let nx = self.dims[0];
        for placed in self.layers() {
            let [_, ny, nz] = placed.bits.dims();
            let Some(k) = z.checked_sub(placed.at[2]).filter(|&k| k < nz) else {
                continue;
            };
            for j in 0..ny {
                let row = &mut page[(placed.at[1] + j) * nx + placed.at[0]..];
                (placed.bits.set_in_row(j, k)).for_each(|i| row[i] = placed.label);
            }
        }
    }

    /// Calls `write` with each page of labels.
    ///
    /// # Errors
    /// What `write` says.
    pub fn pages(&self, mut write: impl FnMut(&[u8]) -> io::Result<()>) -> io::Result<()> {
        let mut page = vec![0; self.dims[0] * self.dims[1]];
        (0..self.dims[2]).try_for_each(|z| {
            self.page(z, &mut page);
            write(&page)
        })
    }

    /// Writes a multi-page TIFF with ImageJ's voxel size.
    ///
    /// # Errors
    /// What `out` says.
    pub fn write_tiff(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut tiff = TiffWriter::new(out, self.dims, self.voxel_m, "")?;
        self.pages(|page| tiff.write_page(page))?;
        tiff.finish()
    }

    /// The mean of `values`, one of each liquid point, about the voxels of a layer across `axis`
    /// (0 = x, 1 = y, 2 = z): weighted by volume and by a trilinear hat of two voxels half-width,
    /// which reaches from every point to every voxel that [`LabelVolume::of`] may give it. In
    /// storage order of the two other axes; not a number where no point is near.
    pub fn mean_in_layer(&self, axis: usize, layer: usize, values: &[f32]) -> Vec<f32> {
        const REACH: f64 = 2.0;
        let [u, v] = [[1, 2], [0, 2], [0, 1]][axis];
        let columns = self.dims[u];
        let mut sums = vec![[0.0_f64; 2]; columns * self.dims[v]];
        let Some(liquid) = &self.liquid else {
            return vec![f32::NAN; sums.len()];
        };
        let points = liquid.position.iter().zip(liquid.volume).zip(values);
        for ((position, &volume), &value) in points {
            let place = self.place(*position);
            let hat = |a: usize, i: usize| 1.0 - (i as f64 + 0.5 - place[a]).abs() / REACH;
            let near = |a: usize| {
                let first = (place[a] - 0.5 - REACH).ceil().max(0.0) as usize;
                let end = (place[a] + 0.5 + REACH).floor().max(0.0) as usize;
                first..end.min(self.dims[a])
            };
            let across = hat(axis, layer) * f64::from(volume);
            if across <= 0.0 {
                continue;
            }
            for j in near(v) {
                for i in near(u) {
                    let weight = across * hat(u, i).max(0.0) * hat(v, j).max(0.0);
                    let [sum, of] = &mut sums[j * columns + i];
                    *sum += weight * f64::from(value);
                    *of += weight;
                }
            }
        }
        sums.iter().map(|[sum, of]| (sum / of) as f32).collect()
    }
}

fn corrupt(file: &ParticleFile, what: String) -> Error {
    Error::new(file.name(), what)
}

/// The low corner (m) of the lattice and the voxel of it at which each block begins; without
/// blocks the low corner of the file's box.
fn lattice(header: &Header) -> ([f64; 3], Vec<[usize; 3]>) {
    let voxel = header.voxel_m;
    let mut origin = header.box_min_m;
    let mut places = vec![[0; 3]; header.blocks.len()];
    if header.blocks.is_empty() {
        return (origin, places);
    }
    for a in 0..3 {
        let lows = header.blocks.iter().map(|b| b.origin_m[a]);
        let low = lows.fold(f64::INFINITY, f64::min);
        let (mut least, mut most) = (0.0_f64, 0.0_f64);
        for (place, block) in places.iter_mut().zip(&header.blocks) {
            let exact = (block.origin_m[a] - low) / voxel;
            place[a] = exact.round() as usize;
            let error = exact.round() - exact;
            (least, most) = (least.min(error), most.max(error));
        }
        origin[a] = low - 0.5 * (least + most) * voxel;
    }
    (origin, places)
}

/// Voxels of the lattice that holds all blocks or, without any, the file's box.
fn dims(file: &ParticleFile, blocks: &[PlacedBlock]) -> Result<[usize; 3], Error> {
    /// Bytes of a voxel: a label, and where there are points the volume fraction.
    const LABEL: u64 = 1;
    const FRACTION: u64 = 4;
    /// And which are open, reached and chosen, rounded up.
    const BITS: u64 = 1;
    /// Bytes of the voxels that a liquid point reaches while the fullest are found.
    const RANKS: u64 = 32;
    let header = file.header();
    let dims: [usize; 3] = std::array::from_fn(|a| {
        let ends = blocks
            .iter()
            .map(|b| b.at[a].saturating_add(b.bits.dims()[a]));
        ends.max().unwrap_or_else(|| {
            let edge = header.box_max_m[a] - header.box_min_m[a];
            (edge / header.voxel_m).round().max(1.0) as usize
        })
    });
    let voxels = limits::volume(dims.map(|n| n as u64));
    let what = "labels of its voxels";
    if header.particles == 0 {
        file.is_worth(voxels.saturating_mul(LABEL), what)?;
        return Ok(dims);
    }
    file.is_worth(voxels.saturating_mul(LABEL + FRACTION), what)?;
    // Labels are made page by page; fractions and ranks are not.
    let ranks = header.particles.saturating_mul(RANKS);
    let fractions = voxels.saturating_mul(FRACTION + BITS);
    file.fits(fractions.saturating_add(ranks), what)?;
    Ok(dims)
}
