//! A slice through a state as pixels, with its place, its axes and its colours.

use particle_file::{Kind, ParticleFile};
use plotters::style::RGBAColor;
use units::Axis as Direction;
use voxels::{self, LabelVolume};

use crate::Error;
use crate::axes::Axis;
use crate::closing::time_unit;
use crate::colour::{BLACK, opaque, viridis};
use crate::drawing::{Drawing, Point};
use crate::frame::Frame;
use crate::legend;
use crate::panels::Sheet;
use crate::slice::{Colouring, Cut, Position};

/// A layer of voxels normal to an axis, a pixel for each; of a larger one every second, third ...
#[derive(Clone, Debug)]
pub(crate) struct Section {
    label: String,
    /// Time and place.
    detail: String,
    /// Low ends and edges of the slice across and up, m.
    low: [f64; 2],
    pub(crate) edges: [f64; 2],
    /// What the axes across and up are called.
    titles: [String; 2],
    /// Pixels across and up.
    size: [usize; 2],
    /// Row by row from the top.
    pub(crate) pixels: Vec<Pixel>,
    /// Low corner of the box, across and up, which a run's grid begins at, m.
    corner: [f64; 2],
}

/// What a pixel of a slice shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Pixel {
    Void,
    Wood,
    /// With its pressure (Pa) where that is shown.
    Adhesive(f32),
    /// Brightness in place of the phase.
    Grey(u8),
}

/// Most pixels along an edge of a slice.
const MOST_PIXELS: usize = 2048;
const WOOD: [u8; 3] = [150, 150, 150];
const ADHESIVE: [u8; 3] = [230, 159, 0];
/// Phases by their names in the key; the adhesive's colour is in the bar where it shows a value.
pub(crate) const KEY: [(&str, [u8; 3]); 3] =
    [("wood", WOOD), ("void", [255; 3]), ("adhesive", ADHESIVE)];
/// Lines of a grid.
pub(crate) const GRID: RGBAColor = RGBAColor(0, 60, 140, 0.8);

impl Section {
    /// The slice through what `file` holds or, where there are, the `greys` of its voxels in storage order,
    /// with those that are drawn black and white.
    ///
    /// # Errors
    /// [`Error::Data`] for a file without the pressure that is to be shown, [`Error::Request`] for a
    /// slice beside the box.
    pub(crate) fn of(
        file: &ParticleFile,
        label: &str,
        cut: Cut,
        colouring: Colouring,
        greys: Option<(&[f64], [f64; 2])>,
    ) -> Result<Self, Error> {
        let labels = LabelVolume::of(file)?;
        let header = file.header();
        let normal = cut.axis.index();
        let low = labels.origin_m;
        let high = low[normal] + labels.dims[normal] as f64 * labels.voxel_m;
        let at = match cut.position {
            Position::At(at) => at,
            Position::Share(share) => low[normal] + share * (high - low[normal]),
        };
        if !(low[normal]..=high).contains(&at) {
            return Err(Error::Request(format!(
                "'{}' has no slice at {} = {:.2} um: its box reaches from {:.2} to {:.2} um",
                file.name(),
                cut.axis,
                at * 1e6,
                low[normal] * 1e6,
                high * 1e6
            )));
        }
        let axes = match cut.axis {
            Direction::X => [2, 1],
            Direction::Y => [0, 2],
            Direction::Z => [0, 1],
        };
        let layer = ((at - low[normal]) / labels.voxel_m).max(0.0) as usize;
        let layer = layer.min(labels.dims[normal] - 1);
        let pressures = match colouring {
            Colouring::Pressure if header.particles > 0 => {
                Some(labels.mean_in_layer(normal, layer, file.column::<f32>("pressure")?))
            }
            _ => None,
        };
        let (shades, ends) = greys.map(stretched).unwrap_or_default();
        let (size, pixels) = raster(&labels, axes, layer, pressures.as_deref(), &shades);
        let time = time_of(file).map_or(String::new(), |time| time + ", ");
        Ok(Self {
            label: label.to_owned(),
            detail: format!(
                "{time}{}\u{a0}=\u{a0}{:.1}\u{a0}µm{ends}",
                cut.axis,
                at * 1e6
            ),
            low: axes.map(|a| low[a]),
            corner: axes.map(|a| header.box_min_m[a]),
            edges: axes.map(|a| labels.dims[a] as f64 * labels.voxel_m),
            titles: axes.map(|a| {
                let normal = a == usize::from(header.normal);
                let across = if normal { ", across the bond" } else { "" };
                format!("{}{across} (µm)", ["x", "y", "z"][a])
            }),
            size,
            pixels,
        })
    }

    /// The panel that shows it.
    pub(crate) fn sheet(&self) -> Sheet<'_> {
        Sheet {
            edges: self.edges,
            name: &self.label,
            detail: &self.detail,
            axes: Some(self.axes()),
            beside: matches!(self.pixels[0], Pixel::Grey(_)),
        }
    }

    pub(crate) fn voxel_m(&self) -> f64 {
        self.edges[0] / self.size[0] as f64
    }

    /// Across and up, um.
    fn axes(&self) -> [Axis; 2] {
        [0, 1].map(|i| {
            let ends = [self.low[i], self.low[i] + self.edges[i]].map(|x| x * 1e6);
            Axis::over(&self.titles[i], ends[0], ends[1])
        })
    }

    fn colours(&self, shades: Option<&Axis>) -> Vec<u8> {
        let colour = |pixel: &Pixel| match (pixel, shades) {
            (Pixel::Void, _) => [255; 3],
            (Pixel::Wood, _) => WOOD,
            (Pixel::Grey(grey), _) => [*grey; 3],
            (Pixel::Adhesive(_), None) => ADHESIVE,
            (Pixel::Adhesive(pressure), Some(shades)) => {
                viridis(shades.share(f64::from(*pressure) * 1e-6))
            }
        };
        self.pixels.iter().flat_map(colour).collect()
    }

    /// The part of the slice between these ends across and up, m, in whole voxels.
    ///
    /// # Errors
    /// [`Error::Request`] where it holds no voxel.
    pub(crate) fn part(&self, part: [[f64; 2]; 2]) -> Result<Self, Error> {
        let step = [0, 1].map(|i| self.edges[i] / self.size[i] as f64);
        let [across, up] = [0, 1].map(|i| {
            let count = self.size[i] as f64;
            let ends = part[i].map(|end| (end - self.low[i]) / step[i]);
            let [from, to] = ends.map(|end| end.round().clamp(0.0, count) as usize);
            from..to
        });
        if across.is_empty() || up.is_empty() {
            return Err(Error::Request(format!(
                "the part asked for has no voxel of the slice of '{}'",
                self.label
            )));
        }
        let rows = self.pixels.chunks(self.size[0]);
        let rows = rows.skip(self.size[1] - up.end).take(up.len());
        let starts = [across.start, up.start];
        let size = [across.len(), up.len()];
        Ok(Self {
            pixels: (rows.flat_map(|row| &row[across.clone()]))
                .copied()
                .collect(),
            low: [0, 1].map(|i| self.low[i] + starts[i] as f64 * step[i]),
            edges: [0, 1].map(|i| size[i] as f64 * step[i]),
            size,
            ..self.clone()
        })
    }

    /// Draws the voxels into `frame`, its axes around it, and the lines of a grid of such cells
    /// (m) as far as they are in it.
    pub(crate) fn draw(
        &self,
        drawing: &mut Drawing,
        frame: &Frame,
        shades: Option<&Axis>,
        cell: Option<f64>,
    ) {
        frame.fill(drawing, self.size, self.colours(shades));
        for (i, cell) in [0, 1].into_iter().flat_map(|i| cell.map(|cell| (i, cell))) {
            for place in self.grid(i, cell) {
                let share = (place - self.low[i]) / self.edges[i];
                let at = [
                    frame.left + share * frame.width,
                    frame.bottom() - share * frame.height,
                ];
                let line: [Point; 2] = match i {
                    0 => [[at[0], frame.top], [at[0], frame.bottom()]],
                    _ => [[frame.left, at[1]], [frame.right(), at[1]]],
                };
                drawing.line(line.to_vec(), GRID, 0.8);
            }
        }
        let [across, up] = self.axes();
        frame.draw(drawing, &across, &up, false);
    }

    /// Places of the grid's planes across (0) or up (1), m.
    fn grid(&self, i: usize, cell: f64) -> impl Iterator<Item = f64> {
        let [low, corner] = [self.low[i], self.corner[i]];
        let first = ((low - corner) / cell - 1e-6).ceil() as i64;
        let last = ((low + self.edges[i] - corner) / cell + 1e-6).floor() as i64;
        (first..=last).map(move |plane| corner + plane as f64 * cell)
    }
}

/// Numbers of pixels across and up and the pixels of a layer, normal to the third of the axes.
fn raster(
    labels: &LabelVolume,
    [across, up]: [usize; 2],
    layer: usize,
    pressures: Option<&[f32]>,
    shades: &[u8],
) -> ([usize; 2], Vec<Pixel>) {
    let counts = [across, up].map(|a| labels.dims[a]);
    let every = counts[0].max(counts[1]).div_ceil(MOST_PIXELS);
    let size = counts.map(|count| count.div_ceil(every));
    let pixel = |column: usize, row: usize| {
        let mut voxel = [layer; 3];
        (voxel[across], voxel[up]) = (column * every, row * every);
        // Storage order: x before y before z.
        let [u, v] = [across.min(up), across.max(up)];
        let at = voxel[v] * labels.dims[u] + voxel[u];
        match (shades.get(at), labels.label(voxel)) {
            (Some(shade), _) => Pixel::Grey(*shade),
            (_, voxels::WOOD) => Pixel::Wood,
            (_, voxels::ADHESIVE) => Pixel::Adhesive(pressures.map_or(0.0, |p| p[at])),
            _ => Pixel::Void,
        }
    };
    let places = (0..size[1]).rev();
    let places = places.flat_map(|row| (0..size[0]).map(move |column| (column, row)));
    (
        size,
        places.map(|(column, row)| pixel(column, row)).collect(),
    )
}

/// The brightness of grey values between two of them, and the two in words.
fn stretched((greys, [low, high]): (&[f64], [f64; 2])) -> (Vec<u8>, String) {
    // A number that is none becomes black.
    let shade = |grey: &f64| (255.0 * (grey - low) / (high - low)).clamp(0.0, 255.0) as u8;
    let ends = format!(", grey {} to {}", low as f32, high as f32);
    (greys.iter().map(shade).collect(), ends)
}

/// The time of a state in words.
pub(crate) fn time_of(file: &ParticleFile) -> Option<String> {
    let header = file.header();
    let (unit, name) = time_unit(header.time_s);
    let time = || format!("t\u{a0}=\u{a0}{:.2}\u{a0}{name}", header.time_s / unit);
    (header.kind == Kind::State).then(time)
}

/// The patch of a phase in the key.
pub(crate) fn patch(drawing: &mut Drawing, colour: [u8; 3], ends: [Point; 2]) {
    let mut edge = legend::patch(ends);
    drawing.area(edge.clone(), opaque(colour));
    edge.push(edge[0]);
    drawing.line(edge, BLACK, 1.0);
}
