//! A real section of spruce as pixels: cells of which middle, lumen area and wall were measured, at their places.

use std::path::Path;

use crate::Result;

/// Measured cells that are not in the repository (cran/RAPTOR@5704ee0, GPL 2 or newer).
const CELLS: &str = "../shared/data/experiments/spruce/raptor_anatomy.csv";
/// The section, and the last of its rings that lie one on the other (um along the rays).
const SECTION: &str = "LOT_PICEA";
const RINGS: [f64; 2] = [109_050.0, 113_550.0];
/// What is farther than the widest cells from a place does not bear on it, um.
const FAR: f64 = 60.0;
/// A place so far outside the circle of every cell, farther than the corners of wide cells, was not measured, um.
const OUTSIDE: f64 = 20.0;

struct Cell {
    middle: [f64; 2],
    lumen: f64,
    /// Radius of the circle of its lumen's area with its wall.
    radius: f64,
}

/// A strip of the section, its rows along the rings.
pub(super) struct Strip {
    /// Which pixels are lumen, row by row.
    pub(super) lumen: Vec<bool>,
    /// Pixels in each row that no measured cell covers.
    pub(super) uncovered: Vec<usize>,
}

/// A strip of `width` pixels of `edge` (um) across all rings; none where the cells are not here.
pub(super) fn strip(width: usize, edge: f64) -> Result<Option<Strip>> {
    let path = Path::new(CELLS);
    if !path.is_file() {
        return Ok(None);
    }
    let mut cells = read(path)?;
    cells.sort_by(|a, b| a.middle[1].total_cmp(&b.middle[1]));
    let rows = ((RINGS[1] - RINGS[0]) / edge) as usize;
    // Cells are whole beyond both ends of a row.
    let beside = (FAR / edge) as usize;
    let mut uncovered = vec![0; rows];
    let mut own: Vec<Vec<(f64, usize)>> = cells.iter().map(|_| Vec::new()).collect();
    for (row, uncovered) in uncovered.iter_mut().enumerate() {
        let y = RINGS[0] + (row as f64 + 0.5) * edge;
        let from = cells.partition_point(|c| c.middle[1] < y - FAR);
        let near = &cells[from..cells.partition_point(|c| c.middle[1] < y + FAR)];
        for column in 0..width + 2 * beside {
            let x = (column as f64 - beside as f64 + 0.5) * edge;
            let Some(place) = Place::of([x, y], near) else {
                continue;
            };
            let inside = (beside..beside + width).contains(&column);
            *uncovered += usize::from(inside && place.power > OUTSIDE * OUTSIDE);
            let pixel = if inside {
                row * width + column - beside
            } else {
                usize::MAX
            };
            own[from + place.cell].push((place.depth, pixel));
        }
    }
    let mut lumen = vec![false; rows * width];
    for (cell, mut own) in cells.iter().zip(own) {
        own.sort_by(|a, b| b.0.total_cmp(&a.0));
        // The measured area, with a pixel of wall at least.
        let area = (cell.lumen / (edge * edge)).round() as usize;
        for (_, pixel) in own
            .into_iter()
            .take(area)
            .filter(|(depth, _)| *depth >= edge)
        {
            if let Some(pixel) = lumen.get_mut(pixel) {
                *pixel = true;
            }
        }
    }
    Ok(Some(Strip { lumen, uncovered }))
}

/// Where a place lies in the power diagram of cells.
struct Place {
    cell: usize,
    /// Square of its distance from the middle of its cell less that of the radius, um2.
    power: f64,
    /// Distance from the border of its cell, um.
    depth: f64,
}

impl Place {
    fn of(at: [f64; 2], cells: &[Cell]) -> Option<Self> {
        let far = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2);
        let near = |c: &Cell| (at[0] - c.middle[0]).abs() < FAR;
        let powers: Vec<(usize, f64)> = (cells.iter().enumerate())
            .filter(|(_, c)| near(c))
            .map(|(i, c)| (i, far(at, c.middle) - c.radius * c.radius))
            .collect();
        let &(cell, power) = powers.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
        // The border against each other cell is a straight line across the one that joins both middles.
        let border = |&(other, p): &(usize, f64)| {
            let apart = far(cells[cell].middle, cells[other].middle).sqrt();
            0.5 * (p - power) / apart
        };
        let others = powers.iter().filter(|(other, _)| *other != cell);
        let depth = others.map(border).fold(f64::INFINITY, f64::min);
        Some(Self { cell, power, depth })
    }
}

fn read(path: &Path) -> Result<Vec<Cell>> {
    let failed = |e: csv::Error| format!("{}: {e}", path.display());
    let mut reader = csv::Reader::from_path(path).map_err(failed)?;
    let mut cells = Vec::new();
    for row in reader.records() {
        let row = row.map_err(failed)?;
        // ID, CID, YEAR, CA, XCAL, YCAL, CWTALL; a cell without its wall is left out.
        let number = |i: usize| row.get(i).and_then(|text| text.parse::<f64>().ok());
        let all = (number(3), number(4), number(5), number(6));
        if let (Some(SECTION), (Some(lumen), Some(x), Some(y), Some(wall))) = (row.get(0), all) {
            let radius = (lumen / std::f64::consts::PI).sqrt() + wall;
            cells.push(Cell {
                middle: [x, y],
                lumen,
                radius,
            });
        }
    }
    Ok(cells)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Between two cells the border is nearer to the one with the smaller radius.
    #[test]
    fn a_place_belongs_to_the_cell_whose_circle_is_nearer() {
        let cell = |x: f64, radius: f64| Cell {
            middle: [x, 0.0],
            lumen: 1.0,
            radius,
        };
        let cells = [cell(0.0, 12.0), cell(30.0, 6.0)];
        // The border is at 15 + (144 - 36)/60.
        let place = Place::of([16.0, 5.0], &cells).unwrap();
        assert_eq!(place.cell, 0);
        assert!((place.depth - 0.8).abs() < 1e-9);
        assert_eq!(Place::of([17.0, 5.0], &cells).unwrap().cell, 1);
    }
}
