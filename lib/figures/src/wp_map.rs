//! The figure of penetration over the bond plane.

use crate::axes::Axis;
use crate::colour::{NO_DATA, opaque, viridis};
use crate::colour_bar;
use crate::drawing::{Drawing, Image};
use crate::frame::{Frame, most_beside, room_below};
use crate::legend::{self, Legend};
use crate::page::Page;
use crate::panels::{Layout, Panels, Sheet};
use crate::table::Table;
use crate::{Error, Labelled};

/// Weighted penetration over the bond plane, one panel per state with a common colour scale
/// (Figs. 8 and 9 of the paper), from the maps of `wp-metrics --map`.
#[derive(Clone, Debug)]
pub struct WpMap {
    panels: Vec<Panel>,
    page: Page,
}

#[derive(Clone, Debug)]
struct Panel {
    label: String,
    x: Grid,
    z: Grid,
    /// um, x fastest; NaN where there is no adhesive
    wp: Vec<f64>,
}

/// Equally spaced places of the map's cells along one axis, um.
#[derive(Clone, Copy, Debug)]
struct Grid {
    first: f64,
    step: f64,
    count: usize,
}

/// Quantiles of all cells' values that the colour scale covers.
const COVERED: [f64; 2] = [0.0, 0.995];
/// Longest edge of a panel, logical pixels.
const LONGEST: f64 = 300.0;
/// About the least edge of a panel.
const LEAST: f64 = 100.0;
const MARGIN: f64 = 24.0;
/// A map beyond this many cells is not a map of a specimen.
const MOST_CELLS: usize = 1 << 26;

impl WpMap {
    /// Reads one panel per CSV.
    ///
    /// # Errors
    /// [`Error::Data`] for an unreadable file, a missing column, one without numbers, or
    /// places that are not on a grid.
    pub fn read(maps: &[Labelled]) -> Result<Self, Error> {
        let panels = maps.iter().map(Panel::read).collect::<Result<_, _>>()?;
        Ok(Self {
            panels,
            page: Page::default(),
        })
    }

    /// The same for a page.
    pub fn on(self, page: Page) -> Self {
        Self { page, ..self }
    }

    /// The figure.
    pub fn draw(&self) -> Drawing {
        let cells = || {
            self.panels
                .iter()
                .flat_map(|panel| panel.wp.iter().copied())
        };
        let shades = Axis::covering("weighted penetration (µm)", cells(), COVERED);
        let holes = cells().any(|wp| wp.is_nan());
        let names = ["no adhesive"].into_iter().filter(|_| holes);
        let room = self.page.width().unwrap_or(LONGEST) - 2.0 * MARGIN;
        let key = Legend::new(names, Legend::PATCH, room);
        let sheets: Vec<Sheet> = self.panels.iter().map(Panel::sheet).collect();
        let axes = self.panels[0].axes();
        let layout = Layout {
            top: 10.0 + key.height(),
            longest: LONGEST,
            left: most_beside(&axes[1], LEAST) + 4.0,
            below: room_below(&axes[0], LEAST) + 6.0,
            right: colour_bar::width(&shades),
        };
        let panels = Panels::place(&sheets, layout, &self.page);
        let page = (self.page.width())
            .unwrap_or(panels.right + layout.right)
            .max(key.width() + 2.0 * MARGIN);
        let first = &panels.frames[0];
        let (top, height) = (first.top, first.height.max(colour_bar::LEAST));
        let bottom = panels.bottom.max(top + height + MARGIN);
        let mut drawing = Drawing::new(self.page, page, bottom);
        key.draw(&mut drawing, [MARGIN, 8.0], |drawing, _, ends| {
            drawing.area(legend::patch(ends), opaque(NO_DATA));
        });
        panels.draw_captions(&mut drawing);
        for (panel, frame) in self.panels.iter().zip(&panels.frames) {
            panel.draw(&mut drawing, frame, &shades);
        }
        colour_bar::draw(&mut drawing, panels.right, top, height, &shades);
        drawing
    }
}

impl Panel {
    fn read(source: &Labelled) -> Result<Self, Error> {
        let table = Table::read(&source.path)?;
        let (xs, zs) = (table.data("x_um")?, table.data("z_um")?);
        let (wps, volumes) = (table.data("wp_um")?, table.data("volume_um3")?);
        let off_grid = |why: String| Error::Data(format!("'{}': {why}", table.name()));
        let x = Grid::of(&xs, "x_um").map_err(off_grid)?;
        let z = Grid::of(&zs, "z_um").map_err(off_grid)?;
        let cells = x.count.checked_mul(z.count).filter(|n| *n <= MOST_CELLS);
        let cells = cells.ok_or_else(|| {
            off_grid(format!(
                "a map of {} x {} cells is too large",
                x.count, z.count
            ))
        })?;
        let mut wp = vec![f64::NAN; cells];
        for (row, (place, value)) in xs.iter().zip(&zs).zip(&wps).enumerate() {
            let (i, j) = x.index(*place.0).zip(z.index(*place.1)).ok_or_else(|| {
                off_grid(format!("row {} is not on the grid of the others", row + 1))
            })?;
            if volumes[row] > 0.0 {
                wp[j * x.count + i] = *value;
            }
        }
        Ok(Self {
            label: source.label.clone(),
            x,
            z,
            wp,
        })
    }

    fn draw(&self, drawing: &mut Drawing, frame: &Frame, shades: &Axis) {
        let rows = (0..self.z.count).rev();
        let cells = rows.flat_map(|j| &self.wp[j * self.x.count..(j + 1) * self.x.count]);
        let shade = |wp: &f64| {
            if wp.is_finite() {
                viridis(shades.share(*wp))
            } else {
                NO_DATA
            }
        };
        drawing.images.push(Image {
            place: [frame.left, frame.top, frame.width, frame.height],
            size: [self.x.count, self.z.count],
            rgb: cells.flat_map(shade).collect(),
        });
        let [x, z] = self.axes();
        frame.draw(drawing, &x, &z, false);
    }

    fn axes(&self) -> [Axis; 2] {
        let axis =
            |title: &str, grid: &Grid| Axis::exact(title, grid.low(), grid.low() + grid.edge());
        [axis("x (µm)", &self.x), axis("z (µm)", &self.z)]
    }

    fn sheet(&self) -> Sheet<'_> {
        Sheet {
            edges: [self.x.edge(), self.z.edge()],
            name: &self.label,
            detail: "",
        }
    }
}

impl Grid {
    /// The grid that the places in `values` are on: its step is their least distance.
    fn of(values: &[f64], column: &str) -> Result<Self, String> {
        let mut places = values.to_vec();
        if let Some(row) = places.iter().position(|v| !v.is_finite()) {
            return Err(format!(
                "row {}, column {column}: a number is needed",
                row + 1
            ));
        }
        places.sort_by(f64::total_cmp);
        let (first, last) = (places[0], places[places.len() - 1]);
        let least = (last - first) * 1e-6;
        let steps = places.windows(2).map(|pair| pair[1] - pair[0]);
        let step = steps.filter(|s| *s > least).fold(f64::INFINITY, f64::min);
        if !step.is_finite() {
            // One place only: any width does.
            return Ok(Self {
                first,
                step: 1.0,
                count: 1,
            });
        }
        let count = (last - first) / step + 1.0;
        if count > MOST_CELLS as f64 {
            return Err(format!("column {column} is not on a grid"));
        }
        Ok(Self {
            first,
            step,
            count: count.round() as usize,
        })
    }

    fn low(&self) -> f64 {
        self.first - 0.5 * self.step
    }

    fn edge(&self) -> f64 {
        self.count as f64 * self.step
    }

    /// Which cell a place is, if it is within a tenth of a step of one.
    fn index(&self, place: f64) -> Option<usize> {
        let cells = (place - self.first) / self.step;
        let nearest = cells.round();
        let inside = nearest >= 0.0 && nearest < self.count as f64;
        (inside && (cells - nearest).abs() < 0.1).then_some(nearest as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_is_found_from_places_with_holes() {
        let grid = Grid::of(&[4.0, 1.0, 2.5, 1.0, 8.5], "x_um").unwrap();
        assert_eq!((grid.count, grid.step), (6, 1.5));
        assert_eq!(grid.index(8.5), Some(5));
        assert_eq!(grid.index(5.9), None);
        assert_eq!(grid.low(), 0.25);
        assert!(Grid::of(&[1.0, f64::NAN], "x_um").is_err());
        assert_eq!(Grid::of(&[3.0, 3.0], "x_um").unwrap().count, 1);
    }
}
