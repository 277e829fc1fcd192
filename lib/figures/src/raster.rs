use particle_file::{Material, ParticleFile};
use units::Axis as Direction;

use crate::slice::Colouring;

/// What a pixel of a slice shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Pixel {
    Void,
    Wood,
    /// With its pressure (Pa) where that is shown.
    Adhesive(f32),
}

/// Pixels along the edge of a voxel: bodies stand between voxels during a run.
const FINER: f64 = 2.0;
/// Most pixels along an edge of a slice.
const MOST_PIXELS: f64 = 2048.0;
/// How much wider a point is drawn over void.
const WIDER: f64 = 1.35;

/// A slice through a particle file, normal to an axis, as pixels.
pub(crate) struct Raster {
    /// Axes across, up and normal to the slice.
    axes: [usize; 3],
    at: f64,
    low: [f64; 2],
    /// Edges across and up, m.
    pub(crate) edges: [f64; 2],
    pitch: f64,
    /// Pixels across and up.
    pub(crate) size: [usize; 2],
    /// Row by row from the top.
    pub(crate) pixels: Vec<Pixel>,
}

impl Raster {
    pub(crate) fn new(normal: Direction, at: f64, [low, high]: [[f64; 3]; 2], voxel: f64) -> Self {
        let axes = match normal {
            Direction::X => [2, 1, 0],
            Direction::Y => [0, 2, 1],
            Direction::Z => [0, 1, 2],
        };
        let edges = [axes[0], axes[1]].map(|a| high[a] - low[a]);
        let pitch = (voxel / FINER).max(edges[0].max(edges[1]) / MOST_PIXELS);
        let size = edges.map(|edge| ((edge / pitch).round() as usize).max(1));
        Self {
            axes,
            at,
            low: [axes[0], axes[1]].map(|a| low[a]),
            edges,
            pitch,
            size,
            pixels: vec![Pixel::Void; size[0] * size[1]],
        }
    }

    pub(crate) fn add(
        &mut self,
        file: &ParticleFile,
        colouring: Colouring,
    ) -> Result<(), particle_file::Error> {
        for index in 0..file.header().blocks.len() {
            let (block, bits) = file.block(index)?;
            let pixel = match block.material {
                Material::Rigid => Pixel::Wood,
                Material::Adhesive => Pixel::Adhesive(0.0),
            };
            let dims = bits.dims();
            // Low coordinate of a pixel's middle in voxels of this block, along each axis.
            let voxel = |axis: usize, coordinate: f64| {
                let cell = ((coordinate - block.origin_m[axis]) / block.voxel_m).floor();
                (cell >= 0.0 && cell < dims[axis] as f64).then_some(cell as usize)
            };
            let [across, up, normal] = self.axes;
            let mut place = [0; 3];
            let Some(layer) = voxel(normal, self.at) else {
                continue;
            };
            place[normal] = layer;
            for i in 0..self.pixels.len() {
                let [a, b] = self.middle(i);
                if let Some((x, y)) = voxel(across, a).zip(voxel(up, b)) {
                    (place[across], place[up]) = (x, y);
                    if bits.get(place[0], place[1], place[2]) {
                        self.pixels[i] = pixel;
                    }
                }
            }
        }
        if file.header().particles > 0 {
            self.add_points(file, colouring)?;
        }
        Ok(())
    }

    /// Liquid points as squares of their volume's edge where the slice cuts their cube. Void
    /// next to a point is filled too: points are never in perfect order, and the space that
    /// their disorder leaves between them is liquid.
    fn add_points(
        &mut self,
        file: &ParticleFile,
        colouring: Colouring,
    ) -> Result<(), particle_file::Error> {
        let positions = file.vectors("position")?;
        let volumes = file.column::<f32>("volume")?;
        fits_its_box(file, volumes)?;
        let pressures = match colouring {
            Colouring::Plain => None,
            Colouring::Pressure => Some(file.column::<f32>("pressure")?),
        };
        let [across, up, normal] = self.axes;
        for (i, (position, volume)) in positions.iter().zip(volumes).enumerate() {
            let position = position.map(f64::from);
            let half = 0.5 * f64::from(*volume).cbrt();
            if (position[normal] - self.at).abs() > half {
                continue;
            }
            let pixel = Pixel::Adhesive(pressures.map_or(0.0, |p| p[i]));
            let cells = |c: f64, edge: usize| {
                let cell = ((c - self.low[edge]) / self.pitch).round().max(0.0) as usize;
                cell.min(self.size[edge])
            };
            let span = |axis: usize, edge: usize, half: f64| {
                cells(position[axis] - half, edge)..cells(position[axis] + half, edge)
            };
            let (own_columns, own_rows) = (span(across, 0, half), span(up, 1, half));
            let columns = span(across, 0, WIDER * half);
            for row in span(up, 1, WIDER * half) {
                let from_top = (self.size[1] - 1 - row) * self.size[0];
                for column in columns.clone() {
                    let own = own_columns.contains(&column) && own_rows.contains(&row);
                    let place = &mut self.pixels[from_top + column];
                    if own || *place == Pixel::Void {
                        *place = pixel;
                    }
                }
            }
        }
        Ok(())
    }

    /// Coordinates across and up of the middle of pixel `i`, m.
    fn middle(&self, i: usize) -> [f64; 2] {
        let (column, row) = (i % self.size[0], self.size[1] - 1 - i / self.size[0]);
        [
            self.low[0] + (column as f64 + 0.5) * self.pitch,
            self.low[1] + (row as f64 + 0.5) * self.pitch,
        ]
    }
}

/// Refuses points that are far larger than all there is: each is drawn over its whole edge.
fn fits_its_box(file: &ParticleFile, volumes: &[f32]) -> Result<(), particle_file::Error> {
    let [low, high] = file.header().bounds_m();
    let room: f64 = (0..3)
        .map(|a| (high[a] - low[a]).max(file.header().voxel_m))
        .product();
    let liquid: f64 = volumes.iter().map(|&v| f64::from(v)).sum();
    if liquid <= 8.0 * room {
        return Ok(());
    }
    Err(particle_file::Error::Corrupt {
        file: file.name().to_owned(),
        what: format!("has liquid points of {liquid:e} m3 in a box of {room:e} m3"),
    })
}
