use particle_file::ParticleFile;
use units::Axis as Direction;
use voxels::LabelVolume;

use crate::axes::Axis;
use crate::closing::time_unit;
use crate::colour::{BLACK, opaque, viridis};
use crate::colour_bar;
use crate::drawing::{Drawing, Image};
use crate::frame::{most_beside, room_below};
use crate::legend::{self, Legend};
use crate::page::Page;
use crate::panels::{Layout, Panels, Sheet};
use crate::raster::{Pixel, Raster};
use crate::{Error, Labelled};

/// Slices through states (specimens, bonds, snapshots of a run), a pixel for each voxel of
/// [`LabelVolume`]: wood grey, void white, adhesive in one colour or by its pressure.
#[derive(Clone, Debug)]
pub struct Slices {
    panels: Vec<Panel>,
    colouring: Colouring,
    page: Page,
}

/// What the adhesive's colour shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colouring {
    /// Where it is.
    Plain,
    /// Its pressure; the states must hold the column.
    Pressure,
}

/// Where to cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// The axis that the slice is normal to.
    pub axis: Direction,
    /// How far along it.
    pub position: Position,
}

/// A place along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Position {
    /// Coordinate, m.
    At(f64),
    /// Share of the box from its low side, 0 to 1.
    Share(f64),
}

#[derive(Clone, Debug)]
struct Panel {
    label: String,
    /// Time and place.
    detail: String,
    /// Low ends and edges of the slice across and up, m.
    low: [f64; 2],
    edges: [f64; 2],
    /// What the axes across and up are called.
    titles: [String; 2],
    size: [usize; 2],
    /// Row by row from the top.
    pixels: Vec<Pixel>,
}

const WOOD: [u8; 3] = [150, 150, 150];
const ADHESIVE: [u8; 3] = [230, 159, 0];
/// Quantiles of the pressures that the colour scale covers: those of single material points
/// are noisy in the explicit scheme.
const COVERED: [f64; 2] = [0.02, 0.98];
/// About the least edge of a panel, logical pixels.
const LEAST: f64 = 100.0;
const MARGIN: f64 = 24.0;
/// Phases by their names in the key; the adhesive's colour is in the bar where it shows a value.
const KEY: [(&str, [u8; 3]); 3] = [("wood", WOOD), ("void", [255; 3]), ("adhesive", ADHESIVE)];

impl Slices {
    /// Reads one panel per particle file.
    ///
    /// # Errors
    /// [`Error::Data`] for an unreadable file or one without the pressure that is to be
    /// shown, [`Error::Request`] for a slice beside the box.
    pub fn read(states: &[Labelled], cut: Cut, colouring: Colouring) -> Result<Self, Error> {
        let read = |state| Panel::read(state, cut, colouring);
        let panels = states.iter().map(read).collect::<Result<_, _>>()?;
        Ok(Self {
            panels,
            colouring,
            page: Page::default(),
        })
    }

    /// The same for a page.
    pub fn on(self, page: Page) -> Self {
        Self { page, ..self }
    }

    /// The figure.
    pub fn draw(&self) -> Drawing {
        let shades = self.shades();
        let phases = if shades.is_some() { &KEY[..2] } else { &KEY };
        let longest = if self.panels.len() > 2 { 340.0 } else { 480.0 };
        let room = self.page.width().unwrap_or(longest) - 2.0 * MARGIN;
        let key = Legend::new(phases.iter().map(|phase| phase.0), Legend::PATCH, room);
        let sheets: Vec<Sheet> = self.panels.iter().map(Panel::sheet).collect();
        let axes: Vec<[Axis; 2]> = self.panels.iter().map(Panel::axes).collect();
        let most = |room: &dyn Fn(&[Axis; 2]) -> f64| axes.iter().map(room).fold(0.0, f64::max);
        let layout = Layout {
            top: 10.0 + key.height(),
            longest,
            left: most(&|axes| most_beside(&axes[1], LEAST)) + 4.0,
            below: most(&|axes| room_below(&axes[0], LEAST)) + 8.0,
            right: shades.as_ref().map_or(0.0, colour_bar::width),
        };
        let panels = Panels::place(&sheets, layout, &self.page);
        let natural = panels.right + layout.right;
        let page = self
            .page
            .width()
            .unwrap_or(natural.max(room + 2.0 * MARGIN));
        let (top, height) = (panels.frames[0].top, panels.frames[0].height);
        let height = height.max(colour_bar::LEAST);
        let bottom = panels.bottom.max(match shades {
            Some(_) => top + height + MARGIN,
            None => 0.0,
        });
        let mut drawing = Drawing::new(self.page, page, bottom);
        key.draw(&mut drawing, [MARGIN, 8.0], |drawing, i, ends| {
            drawing.area(legend::patch(ends), opaque(phases[i].1));
            let mut edge = legend::patch(ends);
            edge.push(edge[0]);
            drawing.line(edge, BLACK, 1.0);
        });
        panels.draw_captions(&mut drawing);
        for ((panel, [across, up]), frame) in self.panels.iter().zip(&axes).zip(&panels.frames) {
            drawing.images.push(Image {
                place: [frame.left, frame.top, frame.width, frame.height],
                size: panel.size,
                rgb: panel.colours(shades.as_ref()).collect(),
            });
            frame.draw(&mut drawing, across, up, false);
        }
        if let Some(shades) = &shades {
            colour_bar::draw(&mut drawing, panels.right, top, height, shades);
        }
        drawing
    }

    /// The scale of the pressures shown, if they are.
    fn shades(&self) -> Option<Axis> {
        let pixels = self.panels.iter().flat_map(|panel| &panel.pixels);
        let pressures = pixels.filter_map(|pixel| match pixel {
            Pixel::Adhesive(pressure) => Some(f64::from(*pressure) * 1e-6),
            _ => None,
        });
        match self.colouring {
            Colouring::Plain => None,
            Colouring::Pressure => Some(Axis::covering(
                "pressure of the adhesive (MPa)",
                pressures,
                COVERED,
            )),
        }
    }
}

impl Panel {
    fn read(state: &Labelled, cut: Cut, colouring: Colouring) -> Result<Self, Error> {
        let file = ParticleFile::open(&state.path).map_err(|e| Error::Data(e.to_string()))?;
        let data = |e: particle_file::Error| Error::Data(e.to_string());
        let labels = LabelVolume::of(&file).map_err(data)?;
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
        let raster = Raster::new(&file, &labels, cut.axis, at, colouring).map_err(data)?;
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
            label: state.label.clone(),
            detail: format!("{time}{}\u{a0}=\u{a0}{:.1}\u{a0}µm", cut.axis, at * 1e6),
            low: raster.axes.map(|a| low[a]),
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

    fn sheet(&self) -> Sheet<'_> {
        Sheet {
            edges: self.edges,
            name: &self.label,
            detail: &self.detail,
        }
    }

    /// Across and up, um.
    fn axes(&self) -> [Axis; 2] {
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
}
