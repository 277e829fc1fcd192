//! A slice through a state with its place, its axes and its colours.

use particle_file::ParticleFile;
use voxels::LabelVolume;

use crate::axes::Axis;
use crate::closing::time_unit;
use crate::colour::{BLACK, opaque, viridis};
use crate::drawing::{Drawing, Image, Point};
use crate::frame::Frame;
use crate::legend;
use crate::panels::Sheet;
use crate::raster::{Pixel, Raster};
use crate::slice::{Colouring, Cut, Position};
use crate::{Error, Labelled};

#[derive(Clone, Debug)]
pub(crate) struct Section {
    pub(crate) label: String,
    /// Time and place.
    pub(crate) detail: String,
    /// Low ends and edges of the slice across and up, m.
    low: [f64; 2],
    pub(crate) edges: [f64; 2],
    /// What the axes across and up are called.
    titles: [String; 2],
    size: [usize; 2],
    /// Row by row from the top.
    pub(crate) pixels: Vec<Pixel>,
    /// Low corner of the box, across and up, which a run's grid begins at, m.
    corner: [f64; 2],
}

const WOOD: [u8; 3] = [150, 150, 150];
const ADHESIVE: [u8; 3] = [230, 159, 0];
/// Phases by their names in the key; the adhesive's colour is in the bar where it shows a value.
pub(crate) const KEY: [(&str, [u8; 3]); 3] =
    [("wood", WOOD), ("void", [255; 3]), ("adhesive", ADHESIVE)];

impl Section {
    pub(crate) fn read(state: &Labelled, cut: Cut, colouring: Colouring) -> Result<Self, Error> {
        let file = ParticleFile::open(&state.path).map_err(|e| Error::Data(e.to_string()))?;
        Self::of(&file, &state.label, cut, colouring)
    }

    pub(crate) fn of(
        file: &ParticleFile,
        label: &str,
        cut: Cut,
        colouring: Colouring,
    ) -> Result<Self, Error> {
        let data = |e: particle_file::Error| Error::Data(e.to_string());
        let labels = LabelVolume::of(file).map_err(data)?;
        let low = labels.origin_m;
        let high: [f64; 3] =
            std::array::from_fn(|a| low[a] + labels.dims[a] as f64 * labels.voxel_m);
        let normal = cut.axis.index();
        let at = match cut.position {
            Position::At(at) => at,
            Position::Share(share) => low[normal] + share * (high[normal] - low[normal]),
        };
        if !(low[normal]..=high[normal]).contains(&at) {
            return Err(Error::Request(format!(
                "'{}' has no slice at {} = {:.2} um: its box reaches from {:.2} to {:.2} um",
                file.name(),
                cut.axis,
                at * 1e6,
                low[normal] * 1e6,
                high[normal] * 1e6
            )));
        }
        let raster = Raster::new(file, &labels, cut.axis, at, colouring).map_err(data)?;
        let (unit, name) = time_unit(file.header().time_s);
        let time = match file.header().kind {
            particle_file::Kind::State => {
                format!(
                    "t\u{a0}=\u{a0}{:.2}\u{a0}{name}, ",
                    file.header().time_s / unit
                )
            }
            _ => String::new(),
        };
        Ok(Self {
            label: label.to_owned(),
            detail: format!("{time}{}\u{a0}=\u{a0}{:.1}\u{a0}µm", cut.axis, at * 1e6),
            low: raster.axes.map(|a| low[a]),
            corner: raster.axes.map(|a| file.header().box_min_m[a]),
            edges: raster.edges,
            titles: raster.axes.map(|a| {
                let normal = a == usize::from(file.header().normal);
                let across = if normal { ", across the bond" } else { "" };
                format!("{}{across} (µm)", ["x", "y", "z"][a])
            }),
            size: raster.size,
            pixels: raster.pixels,
        })
    }

    pub(crate) fn sheet(&self) -> Sheet<'_> {
        Sheet {
            edges: self.edges,
            name: &self.label,
            detail: &self.detail,
        }
    }

    pub(crate) fn voxel_m(&self) -> f64 {
        self.edges[0] / self.size[0] as f64
    }

    /// Across and up, um.
    pub(crate) fn axes(&self) -> [Axis; 2] {
        [0, 1].map(|i| {
            let ends = [self.low[i], self.low[i] + self.edges[i]].map(|x| x * 1e6);
            Axis::exact(self.titles[i].as_str(), ends[0], ends[1])
        })
    }

    fn colours<'a>(&'a self, shades: Option<&'a Axis>) -> impl Iterator<Item = u8> + 'a {
        let colour = move |pixel: &Pixel| match (pixel, shades) {
            (Pixel::Void, _) => [255; 3],
            (Pixel::Wood, _) => WOOD,
            (Pixel::Adhesive(_), None) => ADHESIVE,
            (Pixel::Adhesive(pressure), Some(shades)) => {
                viridis(shades.share(f64::from(*pressure) * 1e-6))
            }
        };
        self.pixels.iter().flat_map(colour)
    }

    /// The part of the slice between these ends across and up, m, in whole voxels.
    ///
    /// # Errors
    /// [`Error::Request`] where it holds no voxel.
    pub(crate) fn part(&self, part: [[f64; 2]; 2]) -> Result<Self, Error> {
        let step = [0, 1].map(|i| self.edges[i] / self.size[i] as f64);
        let range = |i: usize| {
            let [from, to] = part[i].map(|end| (end - self.low[i]) / step[i]);
            let count = self.size[i] as f64;
            let [from, to] = [from.round().clamp(0.0, count), to.round().clamp(0.0, count)];
            from as usize..to as usize
        };
        let (across, up) = (range(0), range(1));
        if across.is_empty() || up.is_empty() {
            return Err(Error::Request(format!(
                "the part asked for has no voxel of the slice of '{}'",
                self.label
            )));
        }
        let rows = (up.clone())
            .rev()
            .map(|row| (self.size[1] - 1 - row) * self.size[0]);
        let pixels = rows.flat_map(|row| &self.pixels[row + across.start..row + across.end]);
        let starts = [across.start, up.start];
        let size = [across.len(), up.len()];
        Ok(Self {
            pixels: pixels.copied().collect(),
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
        drawing.images.push(Image {
            place: [frame.left, frame.top, frame.width, frame.height],
            size: self.size,
            rgb: self.colours(shades).collect(),
        });
        let [across, up] = self.axes();
        for i in [0, 1].into_iter().filter(|_| cell.is_some()) {
            for place in self.grid(i, cell.unwrap_or_default()) {
                let share = (place - self.low[i]) / self.edges[i];
                let line: Vec<Point> = match i {
                    0 => vec![
                        [frame.left + share * frame.width, frame.top],
                        [frame.left + share * frame.width, frame.bottom()],
                    ],
                    _ => vec![
                        [frame.left, frame.bottom() - share * frame.height],
                        [frame.right(), frame.bottom() - share * frame.height],
                    ],
                };
                drawing.line(line, GRID, 0.8);
            }
        }
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

/// Lines of a grid.
pub(crate) const GRID: plotters::style::RGBAColor = plotters::style::RGBAColor(0, 60, 140, 0.8);

/// The patch of a phase in the key.
pub(crate) fn patch(drawing: &mut Drawing, colour: [u8; 3], ends: [Point; 2]) {
    let mut edge = legend::patch(ends);
    drawing.area(edge.clone(), opaque(colour));
    edge.push(edge[0]);
    drawing.line(edge, BLACK, 1.0);
}
