//! The figure of slices through states.

use particle_file::ParticleFile;
use units::Axis as Direction;

use crate::axes::Axis;
use crate::drawing::{Drawing, Point};
use crate::legend::Legend;
use crate::page::Page;
use crate::panels::{MARGIN, Plate};
use crate::section::{self, GRID, KEY, Pixel, Section};
use crate::{Error, Labelled};

/// Slices through states (specimens, bonds, snapshots of a run), a pixel for each voxel:
/// wood grey, void white, adhesive in one colour or by its pressure.
#[derive(Clone, Debug)]
pub struct Slices {
    sections: Vec<Section>,
    colouring: Colouring,
    /// Edge of a cell of the grid, m.
    cell: Option<f64>,
}

/// What the adhesive's colour shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::EnumString, strum::VariantNames)]
#[strum(serialize_all = "lowercase")]
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

/// Quantiles of the pressures that the colour scale covers: those of single material points
/// are noisy in the explicit scheme.
const COVERED: [f64; 2] = [0.02, 0.98];
/// Most cells of a grid along an edge.
const MOST_CELLS: f64 = 200.0;

impl Slices {
    /// Reads one panel per particle file.
    ///
    /// # Errors
    /// [`Error::Data`] for an unreadable file or one without the pressure that is to be
    /// shown, [`Error::Request`] for a slice beside the box.
    pub fn read(states: &[Labelled], cut: Cut, colouring: Colouring) -> Result<Self, Error> {
        let section = |state: &Labelled| {
            let file = ParticleFile::open(&state.path)?;
            Section::of(&file, &state.label, cut, colouring, None)
        };
        Self::of(states.iter().map(section), colouring)
    }

    /// A panel for each of several cuts through what `file`, called `label`, holds, beside one of the
    /// grey values in storage order where a cut has such: black and white are the 0.5 and 99.5
    /// percentiles of the finite ones of all cuts, so that a grey is as bright in each.
    ///
    /// # Errors
    /// As [`Slices::read`].
    pub fn through(
        file: &ParticleFile,
        label: &str,
        cuts: &[(Cut, Option<&[f64]>)],
    ) -> Result<Self, Error> {
        let all = cuts.iter().filter_map(|(_, greys)| *greys).flatten();
        let mut all: Vec<f64> = all.copied().filter(|grey| grey.is_finite()).collect();
        all.sort_unstable_by(f64::total_cmp);
        let last = all.len().saturating_sub(1) as f64;
        let at = |share: f64| all.get((share * last).round() as usize);
        let ends = [0.005, 0.995].map(|share| at(share).copied().unwrap_or(0.0));
        let panels = (cuts.iter()).flat_map(|(cut, greys)| {
            let greys = greys.map(|greys| (*cut, Some((greys, ends))));
            greys.into_iter().chain([(*cut, None)])
        });
        let section = |(cut, greys)| Section::of(file, label, cut, Colouring::Plain, greys);
        Self::of(panels.map(section), Colouring::Plain)
    }

    fn of(
        sections: impl Iterator<Item = Result<Section, Error>>,
        colouring: Colouring,
    ) -> Result<Self, Error> {
        Ok(Self {
            sections: sections.collect::<Result<_, _>>()?,
            colouring,
            cell: None,
        })
    }

    /// Edge of a voxel of the first state, m.
    pub fn voxel_m(&self) -> f64 {
        self.sections.first().map_or(f64::NAN, Section::voxel_m)
    }

    /// The same of a part of the slices only: its ends across and up, m.
    ///
    /// # Errors
    /// [`Error::Request`] where a slice has no voxel in it.
    pub fn part(mut self, part: [[f64; 2]; 2]) -> Result<Self, Error> {
        let sections = self.sections.iter().map(|section| section.part(part));
        self.sections = sections.collect::<Result<_, _>>()?;
        Ok(self)
    }

    /// The same with the lines of a run's grid of such cells (m), which begins at the low corner
    /// of the box (Fig. 3 of the paper).
    ///
    /// # Errors
    /// [`Error::Request`] for lines too narrow to be told apart.
    pub fn grid(mut self, cell: f64) -> Result<Self, Error> {
        let edges = self.sections.iter().flat_map(|section| section.edges);
        if edges.fold(0.0, f64::max) / cell > MOST_CELLS {
            return Err(Error::Request(format!(
                "a grid of more than {MOST_CELLS} cells across cannot be seen: ask for a part of the slice"
            )));
        }
        self.cell = Some(cell);
        Ok(self)
    }

    /// The figure.
    pub fn draw(&self, page: Page) -> Drawing {
        let shades = self.shades();
        let phases = self.phases();
        let grid = (self.cell).map(|cell| format!("cells of {} µm", (cell * 1e6) as f32));
        let names = phases.iter().map(|phase| phase.0).chain(grid.as_deref());
        let longest = match self.sections.len() {
            ..=2 => 480.0,
            _ => 340.0,
        };
        let room = page.width().unwrap_or(longest) - 2.0 * MARGIN;
        let plate = Plate {
            sheets: self.sections.iter().map(Section::sheet).collect(),
            key: Legend::new(names, Legend::PATCH, room),
            shades: shades.clone(),
            longest,
            apart: 8.0,
        };
        plate.draw(
            page,
            |drawing, i, ends| match phases.get(i) {
                Some(phase) => section::patch(drawing, phase.1, ends),
                None => cell(drawing, ends),
            },
            |drawing, i, frame| self.sections[i].draw(drawing, frame, shades.as_ref(), self.cell),
        )
    }

    fn pixels(&self) -> impl Iterator<Item = Pixel> {
        let pixels = self.sections.iter().flat_map(|section| &section.pixels);
        pixels.copied()
    }

    /// Entries of the key for the phases that are in the picture; the colour bar stands for adhesive by its pressure.
    fn phases(&self) -> Vec<(&'static str, [u8; 3])> {
        let plain = self.colouring == Colouring::Plain;
        let seen = [
            self.pixels().any(|pixel| pixel == Pixel::Wood),
            self.pixels().any(|pixel| pixel == Pixel::Void),
            plain && (self.pixels()).any(|pixel| matches!(pixel, Pixel::Adhesive(_))),
        ];
        let phases = KEY.into_iter().zip(seen);
        phases
            .filter_map(|(phase, seen)| seen.then_some(phase))
            .collect()
    }

    /// The scale of the pressures shown, if they are.
    fn shades(&self) -> Option<Axis> {
        let pressures = self.pixels().filter_map(|pixel| match pixel {
            Pixel::Adhesive(pressure) => Some(f64::from(pressure) * 1e-6),
            _ => None,
        });
        let title = "pressure of the adhesive (MPa)";
        (self.colouring == Colouring::Pressure).then(|| Axis::covering(title, pressures, COVERED))
    }
}

/// A cell of the grid in the key.
fn cell(drawing: &mut Drawing, [start, end]: [Point; 2]) {
    for i in 0..4 {
        let x = start[0] + (end[0] - start[0]) * f64::from(i) / 3.0;
        drawing.line(vec![[x, start[1] - 7.0], [x, start[1] + 7.0]], GRID, 0.8);
    }
    for y in [-7.0, 0.0, 7.0].map(|y| start[1] + y) {
        drawing.line(vec![[start[0], y], [end[0], y]], GRID, 0.8);
    }
}
