//! The figure of how a run is set up.

use particle_file::{Kind, ParticleFile};
use units::Axis;

use crate::axes::SMALL;
use crate::drawing::{Anchor, Drawing};
use crate::legend::Legend;
use crate::page::Page;
use crate::panels::{Panels, Sheet};
use crate::raster::Pixel;
use crate::section::{self, KEY, Section};
use crate::slice::{Colouring, Cut, Position, layout};
use crate::view::{Direction, Views, Wood};
use crate::{Error, Labelled};

/// How a run is set up, in four panels (Fig. 2 of the paper): the stack, a slice of it, the same
/// with the adhesive taken out and the adherends parted, and with the slab between them.
pub struct Setup {
    stack: Views,
    slices: [Section; 3],
    page: Page,
}

/// Refuses a file of another kind: every panel would show something else than its caption says.
fn is_a(file: &Labelled, kind: Kind) -> Result<(), Error> {
    let opened = ParticleFile::open(&file.path).map_err(|e| Error::Data(e.to_string()))?;
    let found = opened.header().kind;
    match found == kind {
        true => Ok(()),
        false => Err(Error::Request(format!(
            "'{}' holds a {found}, where a {kind} is needed: a specimen and the bond that build-bondline makes of it, in this order",
            file.path.display()
        ))),
    }
}

const MARGIN: f64 = 24.0;
const LONGEST: f64 = 340.0;

impl Setup {
    /// Reads a specimen and the bond made of it; the slices are halfway along the axis to the
    /// viewer.
    ///
    /// # Errors
    /// As of [`Views::read`] and [`crate::Slices::read`].
    pub fn read(specimen: &Labelled, bond: &Labelled) -> Result<Self, Error> {
        is_a(specimen, Kind::Specimen)?;
        is_a(bond, Kind::Bond)?;
        let from = Direction {
            turn: 35.0,
            tilt: 25.0,
        };
        let named = |label: &str, file: &Labelled| Labelled {
            label: label.into(),
            path: file.path.clone(),
        };
        let stack = Views::read(&[named("a) the stack", specimen)], Wood::Whole, from)?;
        let cut = Cut {
            axis: Axis::ALL[stack.front()],
            position: Position::Share(0.5),
        };
        let slice = |label, file| Section::read(&named(label, file), cut, Colouring::Plain);
        let mut parted = slice("c) adherends parted, no adhesive", bond)?;
        for pixel in &mut parted.pixels {
            if let Pixel::Adhesive(_) = pixel {
                *pixel = Pixel::Void;
            }
        }
        Ok(Self {
            stack,
            slices: [
                slice("b) a slice of it", specimen)?,
                parted,
                slice("d) slab of the same volume", bond)?,
            ],
            page: Page::default(),
        })
    }

    /// The same for a page.
    pub fn on(self, page: Page) -> Self {
        Self {
            page,
            stack: self.stack.on(page),
            ..self
        }
    }

    /// The figure.
    pub fn draw(&self) -> Drawing {
        let room = self.page.width().unwrap_or(LONGEST) - 2.0 * MARGIN;
        let key = Legend::new(KEY.map(|phase| phase.0), Legend::PATCH, room);
        let layout = layout(&self.slices, 10.0 + key.height(), LONGEST, None);
        let first = Sheet {
            edges: self.stack.extent(0).map(|edge| edge * 1e-6),
            name: "a) the stack",
            detail: "",
        };
        let slices = self.slices.iter().map(Section::sheet);
        let sheets: Vec<Sheet> = [first].into_iter().chain(slices).collect();
        let panels = Panels::place(&sheets, layout, &self.page);
        let page = self
            .page
            .width()
            .unwrap_or(panels.right.max(key.width() + 2.0 * MARGIN));
        let mut drawing = Drawing::new(self.page, page, panels.bottom);
        key.draw(&mut drawing, [MARGIN, 8.0], |drawing, i, ends| {
            section::patch(drawing, KEY[i].1, ends);
        });
        panels.draw_captions(&mut drawing);
        self.stack.draw_into(&mut drawing, 0, &panels.frames[0]);
        let below = [panels.frames[0].middle(), panels.frames[0].bottom() + SMALL];
        drawing.text(self.stack.axes(), below, Anchor::Centre, SMALL);
        for (section, frame) in self.slices.iter().zip(&panels.frames[1..]) {
            section.draw(&mut drawing, frame, None, None);
        }
        drawing
    }
}
