use std::io::{self, Write};

use cli::Failure;
use particle_file::{BitGrid, BitsRef, Block, Header, Material, ParticleFile, limits};
use voxels::TiffWriter;

const WOOD: u8 = 128;
const ADHESIVE: u8 = 255;

/// Labels on one lattice of voxels: void 0, wood 128, adhesive 255.
///
/// The lattice spans the blocks and begins at their lowest corner; a block that lies between
/// its voxels is put on the nearest ones. A voxel is adhesive if an adhesive block or the
/// position of a liquid point says so and no wood is there.
pub struct Labels<'a> {
    /// Number of voxels along x, y, z.
    pub dims: [usize; 3],
    /// Low corner, m.
    pub origin_m: [f64; 3],
    /// Voxel edge, m.
    pub voxel_m: f64,
    blocks: Vec<Placed<'a>>,
    liquid: Option<BitGrid>,
}

/// A block on the lattice.
struct Placed<'a> {
    label: u8,
    /// Lattice voxel of its voxel (0, 0, 0).
    at: [usize; 3],
    bits: BitsRef<'a>,
}

impl<'a> Labels<'a> {
    /// The labels of everything in `file`.
    ///
    /// # Errors
    /// Exit 3 when an array is damaged, there are neither blocks nor points, or the file is too
    /// small for as many labels.
    pub fn of(file: &'a ParticleFile) -> Result<Self, Failure> {
        let header = file.header();
        if header.blocks.is_empty() && header.particles == 0 {
            let what = format!("'{}' has neither blocks nor liquid points", file.name());
            return Err(Failure::data(what));
        }
        let low = low_corner(header);
        let mut blocks = (0..header.blocks.len())
            .map(|index| place(file, index, low))
            .collect::<Result<Vec<_>, _>>()?;
        let dims = dims(file, &blocks)?;
        // Wood is written last, over adhesive.
        blocks.sort_by_key(|placed| placed.label == WOOD);
        let mut labels = Self {
            dims,
            origin_m: low,
            voxel_m: header.voxel_m,
            blocks,
            liquid: None,
        };
        if header.particles > 0 {
            let positions = file.vectors("position").map_err(Failure::data)?;
            labels.liquid = Some(labels.voxels_of(positions));
        }
        Ok(labels)
    }

    /// The labels of one block, exactly where it is.
    pub fn of_block(block: &Block, bits: BitsRef<'a>) -> Self {
        let placed = Placed {
            label: label(block),
            at: [0; 3],
            bits,
        };
        Self {
            dims: bits.dims(),
            origin_m: block.origin_m,
            voxel_m: block.voxel_m,
            blocks: vec![placed],
            liquid: None,
        }
    }

    /// The voxels that hold a point.
    fn voxels_of(&self, positions: &[[f32; 3]]) -> BitGrid {
        let mut grid = BitGrid::new(self.dims);
        let mut outside = 0_u64;
        for position in positions {
            let at: [f64; 3] = std::array::from_fn(|a| {
                ((f64::from(position[a]) - self.origin_m[a]) / self.voxel_m).floor()
            });
            if (0..3).all(|a| at[a] >= 0.0 && at[a] < self.dims[a] as f64) {
                let [x, y, z] = at.map(|i| i as usize);
                grid.set(x, y, z, true);
            } else {
                outside += 1;
            }
        }
        if outside > 0 {
            cli::warn(format!(
                "{outside} liquid points lie outside the box and have no voxel"
            ));
        }
        grid
    }

    /// Writes the labels of page `z` into `page`, x fastest.
    pub fn page(&self, z: usize, page: &mut [u8]) {
        page.fill(0);
        let nx = self.dims[0];
        if let Some(liquid) = &self.liquid {
            for y in 0..self.dims[1] {
                (liquid.view().set_in_row(y, z)).for_each(|x| page[y * nx + x] = ADHESIVE);
            }
        }
        for placed in &self.blocks {
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
    pub fn pages(&self, mut write: impl FnMut(&[u8]) -> io::Result<()>) -> io::Result<()> {
        let mut page = vec![0; self.dims[0] * self.dims[1]];
        (0..self.dims[2]).try_for_each(|z| {
            self.page(z, &mut page);
            write(&page)
        })
    }

    /// Writes a multi-page TIFF with ImageJ's voxel size.
    pub fn write_tiff(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut tiff = TiffWriter::new(out, self.dims, self.voxel_m)?;
        self.pages(|page| tiff.write_page(page))?;
        tiff.finish()
    }
}

fn label(block: &Block) -> u8 {
    match block.material {
        Material::Rigid => WOOD,
        Material::Adhesive => ADHESIVE,
    }
}

/// Low corner of the blocks or, without any, of the file's box.
fn low_corner(header: &Header) -> [f64; 3] {
    let lowest = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|i| a[i].min(b[i]));
    let corners = header.blocks.iter().map(|b| b.origin_m);
    corners.reduce(lowest).unwrap_or(header.box_min_m)
}

/// Block `index` on the lattice that begins at `low`.
fn place<'a>(file: &'a ParticleFile, index: usize, low: [f64; 3]) -> Result<Placed<'a>, Failure> {
    let (block, bits) = file.block(index).map_err(Failure::data)?;
    let voxel_m = file.header().voxel_m;
    Ok(Placed {
        label: label(block),
        at: std::array::from_fn(|a| ((block.origin_m[a] - low[a]) / voxel_m).round() as usize),
        bits,
    })
}

/// Voxels of the lattice that holds all blocks or, without any, the file's box.
fn dims(file: &ParticleFile, blocks: &[Placed]) -> Result<[usize; 3], Failure> {
    let header = file.header();
    let end = |placed: &Placed, a: usize| placed.at[a].saturating_add(placed.bits.dims()[a]);
    let dims: [usize; 3] = std::array::from_fn(|a| match blocks {
        [] => {
            let edge = header.box_max_m[a] - header.box_min_m[a];
            (edge / header.voxel_m).round().max(1.0) as usize
        }
        _ => blocks.iter().map(|b| end(b, a)).max().unwrap_or(1),
    });
    let voxels = limits::volume(dims.map(|n| n as u64));
    file.is_worth(voxels, "labels of a byte each")
        .map_err(Failure::data)?;
    Ok(dims)
}
