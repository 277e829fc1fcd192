//! A slice through what a particle file holds, as pixels.

use particle_file::ParticleFile;
use units::Axis as Direction;
use voxels::{ADHESIVE, LabelVolume, WOOD};

use crate::slice::Colouring;

/// What a pixel of a slice shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Pixel {
    Void,
    Wood,
    /// With its pressure (Pa) where that is shown.
    Adhesive(f32),
}

/// Most pixels along an edge of a slice.
const MOST_PIXELS: usize = 2048;

/// A layer of voxels normal to an axis, a pixel for each; of a larger one every second, third ...
pub(crate) struct Raster {
    /// Axes across and up: 0 = x, 1 = y, 2 = z.
    pub(crate) axes: [usize; 2],
    /// Edges across and up, m.
    pub(crate) edges: [f64; 2],
    /// Pixels across and up.
    pub(crate) size: [usize; 2],
    /// Row by row from the top.
    pub(crate) pixels: Vec<Pixel>,
}

impl Raster {
    /// The layer of `labels`, those of `file`, that holds coordinate `at` (m).
    ///
    /// # Errors
    /// A file without the pressure that is to be shown.
    pub(crate) fn new(
        file: &ParticleFile,
        labels: &LabelVolume,
        normal: Direction,
        at: f64,
        colouring: Colouring,
    ) -> Result<Self, particle_file::Error> {
        let n = normal.index();
        let [across, up] = match normal {
            Direction::X => [2, 1],
            Direction::Y => [0, 2],
            Direction::Z => [0, 1],
        };
        let layer = ((at - labels.origin_m[n]) / labels.voxel_m).max(0.0) as usize;
        let layer = layer.min(labels.dims[n] - 1);
        let pressures = match colouring {
            Colouring::Pressure if file.header().particles > 0 => {
                Some(labels.mean_in_layer(n, layer, file.column::<f32>("pressure")?))
            }
            _ => None,
        };
        let counts = [across, up].map(|a| labels.dims[a]);
        let every = counts[0].max(counts[1]).div_ceil(MOST_PIXELS);
        let size = counts.map(|count| count.div_ceil(every));
        let pixel = |column: usize, row: usize| {
            let mut voxel = [layer; 3];
            (voxel[across], voxel[up]) = (column * every, row * every);
            match labels.label(voxel) {
                WOOD => Pixel::Wood,
                ADHESIVE => {
                    // Storage order: x before y before z.
                    let [u, v] = [across.min(up), across.max(up)];
                    let at = voxel[v] * labels.dims[u] + voxel[u];
                    Pixel::Adhesive(pressures.as_ref().map_or(0.0, |p| p[at]))
                }
                _ => Pixel::Void,
            }
        };
        let rows = (0..size[1]).rev();
        Ok(Self {
            axes: [across, up],
            edges: counts.map(|count| count as f64 * labels.voxel_m),
            size,
            pixels: rows
                .flat_map(|row| (0..size[0]).map(move |column| (column, row)))
                .map(|(column, row)| pixel(column, row))
                .collect(),
        })
    }
}
