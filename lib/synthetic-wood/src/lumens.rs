//! Lumens as they are met on a cross-section of labels, measured without the generator's help.

use super::cells::WOOD;
use super::recipe::Plan;

/// Narrower openings (um) are pits and the ends of cells.
const LEAST: f64 = 3.0;
/// Vessels are told apart, and from rays, where they are open to more than this from their
/// walls, um: pits between them and ray cells are narrower.
const CLEAR: f64 = 8.0;

/// What one page of labels (x fastest) across the fibres shows, as a microscopist measures it; 0 where none is met:
/// - vessels per mm2, without those cut by the low x or y side;
/// - median diameter (um) of the circle of a vessel lumen's area, and of the lumens of fibres or tracheids;
/// - mean thickness (um) of the wall between two lumens: twice the wall's area over the length of its border, by lines
///   along x and y (Underwood 1970);
/// - width (um) along y, near the rays' direction, below which a tenth and above which a tenth of the fibres' lumens
///   are: of tracheids late and early wood.
pub(crate) fn measure(page: &[u8], plan: &Plan) -> [f64; 6] {
    let [nx, ny, _] = plan.size;
    let um = f64::from(plan.voxel);
    let open: Vec<bool> = page.iter().map(|&label| label != WOOD).collect();
    // The diameter (um) from which an opening is a vessel: wider than any fibre or cut ray cell.
    let vessel = (plan.timber.vessels.as_ref())
        .map_or(f64::INFINITY, |traits| 0.8 * f64::from(traits.diameter[0]));
    let diameter = |opening: &Opening| opening.diameter() * um;
    let cores = match vessel.is_finite() {
        true => openings(eroded(&open, nx, CLEAR / um), nx),
        false => Vec::new(),
    };
    let cores: Vec<(&Opening, f64)> = (cores.iter())
        .map(|core| (core, diameter(core) + 2.0 * CLEAR))
        .filter(|(_, diameter)| *diameter >= vessel)
        .collect();
    let reach = (CLEAR / um).ceil() as usize + 1;
    let counted = cores.iter().filter(|(core, _)| !core.is_cut_low(reach));
    let whole = cores.iter().filter(|(core, _)| !core.is_cut(reach, nx, ny));
    let mut vessels: Vec<f64> = whole.map(|(_, diameter)| *diameter).collect();

    let lumens = openings(open, nx);
    let fibres: Vec<&Opening> = (lumens.iter())
        .filter(|lumen| !lumen.is_cut(1, nx, ny))
        .filter(|lumen| (LEAST..vessel).contains(&diameter(lumen)))
        .collect();
    let mut diameters: Vec<f64> = fibres.iter().map(|lumen| diameter(lumen)).collect();
    let mut radial: Vec<f64> = (fibres.iter())
        .map(|lumen| (lumen.bounds[3] + 1 - lumen.bounds[2]) as f64 * um)
        .collect();
    let area_mm2 = (nx * ny) as f64 * um * um * 1e-6;
    [
        counted.count() as f64 / area_mm2,
        quantile(&mut vessels, 0.5),
        quantile(&mut diameters, 0.5),
        wall(page, nx) * um,
        quantile(&mut radial, 0.1),
        quantile(&mut radial, 0.9),
    ]
}

/// Diameters (um) of the circles of the areas of whole lumens on a page of labels, x fastest, in order: what a microscopist's table
/// of cells holds. Openings of less than 3 um are left out.
pub fn lumen_diameters(page: &[u8], nx: usize, voxel_um: f64) -> Vec<f64> {
    let open = page.iter().map(|&label| label != WOOD).collect();
    let ny = page.len() / nx;
    let mut found: Vec<f64> = (openings(open, nx).iter())
        .filter(|lumen| !lumen.is_cut(1, nx, ny))
        .map(|lumen| lumen.diameter() * voxel_um)
        .filter(|diameter| *diameter >= LEAST)
        .collect();
    found.sort_by(f64::total_cmp);
    found
}

struct Opening {
    area: usize,
    bounds: [usize; 4],
}

impl Opening {
    fn diameter(&self) -> f64 {
        2.0 * (self.area as f64 / std::f64::consts::PI).sqrt()
    }

    /// Whether it comes nearer than `reach` voxels to the low x or y side of its page.
    fn is_cut_low(&self, reach: usize) -> bool {
        self.bounds[0] < reach || self.bounds[2] < reach
    }

    fn is_cut(&self, reach: usize, nx: usize, ny: usize) -> bool {
        self.is_cut_low(reach) || self.bounds[1] + reach >= nx || self.bounds[3] + reach >= ny
    }
}

/// What of the open part of a page is further than `clear` voxels from the closed part.
fn eroded(open: &[bool], nx: usize, clear: f64) -> Vec<bool> {
    let reach = clear.ceil() as usize;
    // Distance from the nearest closed voxel of the row, at most just beyond reach.
    let mut along = vec![0_usize; open.len()];
    for (row, open) in along.chunks_mut(nx).zip(open.chunks(nx)) {
        for x in 0..nx {
            let before = if x > 0 { row[x - 1] } else { reach };
            row[x] = usize::from(open[x]) * (before + 1).min(reach + 1);
        }
        for x in (1..nx).rev() {
            row[x - 1] = row[x - 1].min(row[x] + 1);
        }
    }
    let rows = open.len() / nx;
    let far = |i: usize| {
        let (x, y) = (i % nx, i / nx);
        let near_rows = y.saturating_sub(reach)..(y + reach + 1).min(rows);
        near_rows.into_iter().all(|row| {
            let (dx, dy) = (along[row * nx + x], row.abs_diff(y));
            ((dx * dx + dy * dy) as f64) > clear * clear
        })
    };
    (0..open.len()).map(far).collect()
}

fn openings(mut open: Vec<bool>, nx: usize) -> Vec<Opening> {
    let mut found = Vec::new();
    for start in 0..open.len() {
        let mut opening = Opening {
            area: 0,
            bounds: [usize::MAX, 0, usize::MAX, 0],
        };
        let mut front = vec![start];
        while let Some(i) = front.pop() {
            if !std::mem::replace(&mut open[i], false) {
                continue;
            }
            let (x, y) = (i % nx, i / nx);
            let [left, right, low, high] = opening.bounds;
            opening.bounds = [left.min(x), right.max(x), low.min(y), high.max(y)];
            opening.area += 1;
            front.extend((x > 0).then(|| i - 1));
            front.extend((x + 1 < nx).then_some(i + 1));
            front.extend(i.checked_sub(nx));
            front.extend((i + nx < open.len()).then_some(i + nx));
        }
        if opening.area > 0 {
            found.push(opening);
        }
    }
    found
}

/// Mean thickness of the walls between lumens, voxels.
fn wall(page: &[u8], nx: usize) -> f64 {
    let is_void = |label: u8| label != WOOD;
    let row_changes = page.chunks(nx).map(|row| {
        let pairs = row.windows(2);
        pairs.filter(|p| is_void(p[0]) != is_void(p[1])).count()
    });
    let column_changes = page.iter().zip(page.iter().skip(nx));
    let column_changes = column_changes.filter(|(a, b)| is_void(**a) != is_void(**b));
    let crossings = row_changes.sum::<usize>() + column_changes.count();
    // Length of the border per area is pi/2 of the crossings per length of line, here of both
    // directions together.
    let border = std::f64::consts::FRAC_PI_2 * 0.5 * crossings as f64;
    let wood = page.iter().filter(|label| !is_void(**label)).count();
    2.0 * wood as f64 / border
}

fn quantile(values: &mut [f64], q: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let index = (q * values.len() as f64) as usize;
    values.get(index).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::super::cells::VOID;
    use super::*;

    /// Square lumens of 6 voxels with walls of 2 between them, off the sides by one.
    #[test]
    fn a_grid_of_lumens_is_measured_as_it_is() {
        let page: Vec<u8> = (0..80 * 80)
            .map(|i| {
                let lumen = [i % 80, i / 80].map(|s: usize| (1..7).contains(&(s % 8)));
                if lumen == [true; 2] { VOID } else { WOOD }
            })
            .collect();
        let open: Vec<bool> = page.iter().map(|&label| label == VOID).collect();
        let found = openings(open.clone(), 80);
        assert_eq!((found.len(), found[0].area), (100, 36));
        assert_eq!(found[0].bounds, [1, 6, 1, 6]);
        // Two voxels further in a square of two is left of each.
        let cores = openings(eroded(&open, 80, 2.0), 80);
        assert_eq!((cores.len(), cores[0].area), (100, 4));
        assert_eq!(cores[0].bounds, [3, 4, 3, 4]);
        // Wood 64 - 36 a cell over a border of 24: lines along the walls' own directions
        // overrate it by 4/pi, isotropic borders would not be.
        let exact = 2.0 * 28.0 / 24.0;
        let error = wall(&page, 80) / exact - 4.0 / std::f64::consts::PI;
        assert!(error.abs() < 0.01, "{error}");
    }
}
