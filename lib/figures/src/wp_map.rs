//! The figure of penetration over the bond plane.

use crate::axes::Axis;
use crate::colour::{NO_DATA, opaque, viridis};
use crate::drawing::Drawing;
use crate::legend::{self, Legend};
use crate::page::Page;
use crate::panels::{MARGIN, Plate, Sheet};
use crate::table::Table;
use crate::{Error, Labelled};

/// A map of one state.
#[derive(Clone, Debug)]
struct WpMap {
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
/// A map beyond this many cells is not a map of a specimen.
const MOST_CELLS: usize = 1 << 26;

/// Weighted penetration over the bond plane, one panel per state with a common colour scale
/// (Figs. 8 and 9 of the paper), from the maps of `wp-metrics --map`.
///
/// # Errors
/// [`Error::Data`] for an unreadable file, a missing column, one without numbers, or
/// places that are not on a grid.
pub fn wp_maps(states: &[Labelled], page: Page) -> Result<Drawing, Error> {
    let maps = states.iter().map(WpMap::read);
    let maps = maps.collect::<Result<Vec<_>, _>>()?;
    let cells = || maps.iter().flat_map(|map| map.wp.iter().copied());
    let holes = cells().any(|wp| wp.is_nan());
    let room = page.width().unwrap_or(LONGEST) - 2.0 * MARGIN;
    let sheets = states.iter().zip(&maps).map(|(state, map)| {
        let edges = [map.x.edge(), map.z.edge()];
        Sheet::new(edges, &state.label, Some(map.axes()))
    });
    let shades = Axis::covering("weighted penetration (µm)", cells(), COVERED);
    let plate = Plate {
        sheets: sheets.collect(),
        key: Legend::new(holes.then_some("no adhesive"), Legend::PATCH, room),
        shades: Some(shades.clone()),
        longest: LONGEST,
        apart: 6.0,
    };
    Ok(plate.draw(
        page,
        |drawing, _, ends| drawing.area(legend::patch(ends), opaque(NO_DATA)),
        |drawing, i, frame| {
            let WpMap { x, z, .. } = &maps[i];
            frame.fill(drawing, [x.count, z.count], maps[i].colours(&shades));
            let [x, z] = maps[i].axes();
            frame.draw(drawing, &x, &z, false);
        },
    ))
}

impl WpMap {
    fn read(source: &Labelled) -> Result<Self, Error> {
        let table = Table::read(&source.path)?;
        let (xs, zs) = (table.numbers("x_um")?, table.numbers("z_um")?);
        let volumes = table.numbers("volume_um3")?;
        let wps = table.some_numbers("wp_um", |row| volumes[row] == 0.0)?;
        let off_grid = |why: String| Error::Data(format!("'{}': {why}", table.name()));
        let x = Grid::of(&xs, "x_um").map_err(off_grid)?;
        let z = Grid::of(&zs, "z_um").map_err(off_grid)?;
        let cells = x.count.checked_mul(z.count).filter(|n| *n <= MOST_CELLS);
        let too_large = || format!("a map of {} x {} cells is too large", x.count, z.count);
        let mut wp = vec![f64::NAN; cells.ok_or_else(|| off_grid(too_large()))?];
        for (row, (place, value)) in xs.iter().zip(&zs).zip(&wps).enumerate() {
            let (i, j) = x.index(*place.0).zip(z.index(*place.1)).ok_or_else(|| {
                off_grid(format!("row {} is not on the grid of the others", row + 1))
            })?;
            if volumes[row] > 0.0 {
                wp[j * x.count + i] = *value;
            }
        }
        Ok(Self { x, z, wp })
    }

    /// Pixels row by row from the top.
    fn colours(&self, shades: &Axis) -> Vec<u8> {
        let colour = |wp: &f64| match wp.is_finite() {
            true => viridis(shades.share(*wp)),
            false => NO_DATA,
        };
        let rows = self.wp.chunks(self.x.count).rev();
        rows.flatten().flat_map(colour).collect()
    }

    fn axes(&self) -> [Axis; 2] {
        [("x (µm)", &self.x), ("z (µm)", &self.z)]
            .map(|(title, grid)| Axis::over(title, grid.low(), grid.low() + grid.edge()))
    }
}

impl Grid {
    /// The grid that the places in `values` are on: its step is their least distance.
    fn of(values: &[f64], column: &str) -> Result<Self, String> {
        let mut places = values.to_vec();
        places.sort_by(f64::total_cmp);
        let (first, last) = (places[0], places[places.len() - 1]);
        let least = (last - first) * 1e-6;
        let steps = places.windows(2).map(|pair| pair[1] - pair[0]);
        let step = steps.filter(|s| *s > least).fold(f64::INFINITY, f64::min);
        // Of one place only any width does.
        let step = if step.is_finite() { step } else { 1.0 };
        let count = (last - first) / step + 1.0;
        if count > MOST_CELLS as f64 {
            return Err(format!("column {column} is not on a grid"));
        }
        let count = count.round() as usize;
        Ok(Self { first, step, count })
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
        assert_eq!(Grid::of(&[3.0, 3.0], "x_um").unwrap().count, 1);
    }
}
