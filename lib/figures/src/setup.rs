//! The figure of how a run is set up.

use particle_file::{Kind, ParticleFile};
use units::Axis;

use crate::axes::SMALL;
use crate::drawing::{Anchor, Drawing};
use crate::legend::Legend;
use crate::page::Page;
use crate::panels::{MARGIN, Plate, Sheet};
use crate::section::{self, KEY, Pixel, Section};
use crate::slice::{Colouring, Cut, Position};
use crate::view::{Direction, Views, Wood};
use crate::{Error, Labelled};

const LONGEST: f64 = 340.0;

/// How a run is set up, in four panels (Fig. 2 of the paper): the specimen, a slice of it halfway
/// along the axis to the viewer, the same slice of the bond made of it without the adhesive, and
/// with the slab between the adherends.
///
/// # Errors
/// As of [`Views::read`] and [`crate::Slices::read`]; [`Error::Request`] for other kinds of files.
pub fn setup(specimen: &Labelled, bond: &Labelled, page: Page) -> Result<Drawing, Error> {
    let open = |file: &Labelled, kind| -> Result<ParticleFile, Error> {
        let opened = ParticleFile::open(&file.path)?;
        match opened.header().kind {
            found if found == kind => Ok(opened),
            found => Err(Error::Request(format!(
                "'{}' holds a {found}, where a {kind} is needed: a specimen and the bond that build-bondline makes of it, in this order",
                file.path.display()
            ))),
        }
    };
    let (whole, pressed) = (open(specimen, Kind::Specimen)?, open(bond, Kind::Bond)?);
    let stack = Views::read(
        std::slice::from_ref(specimen),
        Wood::Whole,
        Direction::default(),
    )?;
    let cut = Cut {
        axis: Axis::ALL[stack.front()],
        position: Position::Share(0.5),
    };
    let slice = |label, file| Section::of(file, label, cut, Colouring::Plain, None);
    let mut parted = slice("c) adherends separated, no adhesive", &pressed)?;
    for pixel in &mut parted.pixels {
        if let Pixel::Adhesive(_) = pixel {
            *pixel = Pixel::Void;
        }
    }
    let slices = [
        slice("b) slice of the specimen", &whole)?,
        parted,
        slice("d) slab of the same volume", &pressed)?,
    ];
    let edges = stack.extent(0).map(|edge| edge * 1e-6);
    let first = Sheet::new(edges, "a) the stack", None);
    let room = page.width().unwrap_or(LONGEST) - 2.0 * MARGIN;
    let plate = Plate {
        sheets: [first]
            .into_iter()
            .chain(slices.iter().map(Section::sheet))
            .collect(),
        key: Legend::new(KEY.map(|phase| phase.0), Legend::PATCH, room),
        shades: None,
        longest: LONGEST,
        apart: 8.0,
    };
    Ok(plate.draw(
        page,
        |drawing, i, ends| section::patch(drawing, KEY[i].1, ends),
        |drawing, i, frame| match i.checked_sub(1) {
            Some(slice) => slices[slice].draw(drawing, frame, None, None),
            None => {
                stack.draw_into(drawing, 0, frame);
                let below = [frame.middle(), frame.bottom() + SMALL];
                drawing.text(stack.axes(), below, Anchor::Centre, SMALL);
            }
        },
    ))
}
