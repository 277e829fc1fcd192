use crate::axes::{Axis, Frame};
use crate::colour::viridis;
use crate::drawing::{Drawing, Image};

/// Room that a colour bar takes on the right of the panels, logical pixels.
pub(crate) const WIDTH: f64 = 120.0;

/// Draws a vertical colour scale with the ticks and title of `shades` and gives its frame.
pub(crate) fn draw(
    drawing: &mut Drawing,
    right_of: f64,
    top: f64,
    height: f64,
    shades: &Axis,
) -> Frame {
    const STEPS: usize = 256;
    let frame = Frame {
        left: right_of + 76.0,
        top,
        width: 18.0,
        height,
    };
    let colours = (0..STEPS).rev().map(|i| i as f64 / (STEPS - 1) as f64);
    drawing.images.push(Image {
        place: [frame.left, frame.top, frame.width, frame.height],
        size: [1, STEPS],
        rgb: colours.flat_map(viridis).collect(),
    });
    frame.draw(drawing, &Axis::none(), shades, false);
    frame
}
