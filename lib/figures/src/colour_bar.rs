//! The key of a colour scale.

use crate::axes::Axis;
use crate::colour::viridis;
use crate::drawing::Drawing;
use crate::frame::{Frame, most_beside, room_beside};

/// Width of the bar itself, and what is free on its right.
const BAR: f64 = 18.0;
const MARGIN: f64 = 14.0;

/// Least height of a colour bar.
pub(crate) const LEAST: f64 = 130.0;

/// Room that a colour bar takes on the right of the panels, logical pixels.
pub(crate) fn width(shades: &Axis) -> f64 {
    most_beside(shades, LEAST) + BAR + MARGIN
}

/// Draws a vertical colour scale with the ticks and title of `shades`.
pub(crate) fn draw(drawing: &mut Drawing, right_of: f64, top: f64, height: f64, shades: &Axis) {
    const STEPS: usize = 256;
    let left = right_of + room_beside(shades, height);
    let frame = Frame::new([left, top], [BAR, height]);
    let colours = (0..STEPS).rev().map(|i| i as f64 / (STEPS - 1) as f64);
    frame.fill(drawing, [1, STEPS], colours.flat_map(viridis).collect());
    frame.draw(drawing, &Axis::none(""), shades, false);
}
