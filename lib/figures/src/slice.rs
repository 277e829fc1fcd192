use particle_file::ParticleFile;
use units::Axis as Direction;
use voxels::LabelVolume;

use crate::axes::{Axis, NORMAL, SMALL};
use crate::closing::time_unit;
use crate::colour::{BLACK, viridis};
use crate::colour_bar;
use crate::drawing::{Anchor, Drawing, Image};
use crate::panels::{Panels, Room};
use crate::raster::{Pixel, Raster};
use crate::{Error, Labelled};

/// Slices through states (specimens, bonds, snapshots of a run), a pixel for each voxel of
/// [`LabelVolume`]: wood grey, void white, adhesive in one colour or by its pressure.
#[derive(Clone, Debug)]
pub struct Slices {
    panels: Vec<Panel>,
    colouring: Colouring,
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
    /// Edges of the slice across and up, m.
    edges: [f64; 2],
    size: [usize; 2],
    /// Row by row from the top.
    pixels: Vec<Pixel>,
}

const WOOD: [u8; 3] = [150, 150, 150];
const ADHESIVE: [u8; 3] = [230, 159, 0];
/// Quantiles of the pressures that the colour scale covers: those of single material points
/// are noisy in the explicit scheme.
const COVERED: [f64; 2] = [0.02, 0.98];
const ROOM: Room = Room {
    left: 24.0,
    above: 54.0,
    below: 46.0,
    column: 220.0,
};

impl Slices {
    /// Reads one panel per particle file.
    ///
    /// # Errors
    /// [`Error::Data`] for an unreadable file or one without the pressure that is to be
    /// shown, [`Error::Request`] for a slice beside the box.
    pub fn read(states: &[Labelled], cut: Cut, colouring: Colouring) -> Result<Self, Error> {
        let read = |state| Panel::read(state, cut, colouring);
        let panels = states.iter().map(read).collect::<Result<_, _>>()?;
        Ok(Self { panels, colouring })
    }

    /// The figure.
    pub fn draw(&self) -> Drawing {
        let edges: Vec<_> = self.panels.iter().map(|panel| panel.edges).collect();
        let longest = if edges.len() > 2 { 340.0 } else { 520.0 };
        let panels = Panels::place(&edges, longest, ROOM);
        let bar = match self.colouring {
            Colouring::Plain => ROOM.left,
            Colouring::Pressure => colour_bar::WIDTH,
        };
        let mut drawing = Drawing::new((panels.right + bar) as u32, panels.bottom as u32);
        let pressures = self.panels.iter().flat_map(|panel| &panel.pixels);
        let pressures = pressures.filter_map(|pixel| match pixel {
            Pixel::Adhesive(pressure) => Some(f64::from(*pressure) * 1e-6),
            _ => None,
        });
        let shades = Axis::covering("pressure (MPa)", pressures, COVERED);
        for (panel, frame) in self.panels.iter().zip(&panels.frames) {
            let colour = |pixel: &Pixel| match (pixel, self.colouring) {
                (Pixel::Void, _) => [255; 3],
                (Pixel::Wood, _) => WOOD,
                (Pixel::Adhesive(_), Colouring::Plain) => ADHESIVE,
                (Pixel::Adhesive(pressure), Colouring::Pressure) => {
                    viridis(shades.share(f64::from(*pressure) * 1e-6))
                }
            };
            drawing.images.push(Image {
                place: [frame.left, frame.top, frame.width, frame.height],
                size: panel.size,
                rgb: panel.pixels.iter().flat_map(colour).collect(),
            });
            frame.draw(&mut drawing, &Axis::none(), &Axis::none(), false);
            let middle = frame.left + 0.5 * frame.width;
            for (text, above, size) in [(&panel.label, 36.0, NORMAL), (&panel.detail, 15.0, SMALL)]
            {
                drawing.text(text, [middle, frame.top - above], Anchor::Centre, size);
            }
            let bar = scale_bar(panel.edges[0]);
            let length = bar / panel.edges[0] * frame.width;
            let (left, y) = (frame.left, frame.bottom() + 18.0);
            drawing.line(vec![[left, y], [left + length, y]], BLACK, 4.0);
            let text = format!("{:.0} µm", bar * 1e6);
            drawing.text(text, [left + length + 10.0, y], Anchor::Left, NORMAL);
        }
        if self.colouring == Colouring::Pressure {
            let (right, height) = (panels.right, panels.height);
            colour_bar::draw(&mut drawing, right, ROOM.above, height, &shades);
        }
        drawing
    }
}

/// The longest of 1, 2, 5, 10 ... um that fits into a third of the width, m.
fn scale_bar(width: f64) -> f64 {
    let steps = (0..9).flat_map(|power| [1.0, 2.0, 5.0].map(|f| f * 10_f64.powi(power) * 1e-6));
    steps
        .take_while(|bar| *bar <= width / 3.0)
        .last()
        .unwrap_or(1e-6)
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
                format!("t = {:.2} {name}, ", file.header().time_s / unit)
            }
            _ => String::new(),
        };
        Ok(Self {
            label: state.label.clone(),
            detail: format!("{time}{} = {:.1} µm", cut.axis, at * 1e6),
            edges: raster.edges,
            size: raster.size,
            pixels: raster.pixels,
        })
    }
}
