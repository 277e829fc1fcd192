//! Transfer of volumes, pressures and velocities from an old mesh to a new one, and the map of faces between the two.

use std::collections::HashSet;
use std::ops::Range;

use physics::Boundary;
use rayon::prelude::*;

use crate::geometry::{Mesh, Region, RowKind, Rows, STEP_REACH};

/// The mesh row of `old` that is the same as a grid row of `new` below or above the gap; `None` in the gap or outside `old`.
fn same_row(new: &Mesh, old: &Mesh, row: usize) -> Option<usize> {
    let row = match new.rows().kind(row) {
        RowKind::Below => row,
        RowKind::Gap => return None,
        RowKind::Above => row - new.rows().gap + old.rows().gap,
    };
    old.range.contains(&row).then(|| row - old.range.start)
}

/// The active cells of a new mesh with these `rows`, those in `range`: the cells where the `wet` cells of `old` lie, and
/// `margin` cells around them.
pub(crate) fn remapped_region(
    old: &Mesh,
    wet: &Region,
    (rows, range): (&Rows, &Range<usize>),
    margin: usize,
) -> Region {
    let [nx, _, nz] = old.size;
    let mut region = Region::new([nx, range.len(), nz], false);
    for cell in (0..old.size.iter().product()).filter(|&cell| wet.contains(cell)) {
        let [x, _, z] = old.cell_indices(cell);
        let row = old.row(cell);
        // Of a gap that has closed, the rows next to it.
        let rows = match old.rows().kind(row) {
            RowKind::Below => row..row + 1,
            RowKind::Gap if rows.gap == 0 => rows.below.saturating_sub(1)..rows.below + 1,
            RowKind::Gap => rows.below..rows.below + rows.gap,
            RowKind::Above => {
                let row = row - old.rows().gap + rows.gap;
                row..row + 1
            }
        };
        for row in rows.filter(|row| range.contains(row)) {
            region.add(x + nx * (row - range.start + range.len() * z));
        }
    }
    region.grown(margin, old.periodic())
}

/// For each face of a new mesh: the same face of the old one, if any, and whether its surroundings are unchanged.
#[derive(Default)]
pub(crate) struct FaceMap(pub(crate) Vec<Option<(u32, bool)>>);

impl FaceMap {
    /// The map from faces of `new` to those of `old`. Surroundings count as changed next to the gap, at the ends of the rows
    /// and at the boundary of the active cells.
    pub(crate) fn new(new: &Mesh, old: &Mesh) -> Self {
        let in_rows = |mesh: &Mesh, row: usize| {
            let range = &mesh.range;
            (range.start == 0 || row >= range.start + STEP_REACH)
                && (range.end == mesh.rows().len() || row + STEP_REACH < range.end)
        };
        let old_cell = |pore: usize| {
            let [x, _, z] = new.cell_indices(new.cell(pore));
            let row = new.row_of(pore);
            let cell = old.cell_at([x, same_row(new, old, row)?, z]);
            let whole =
                old.inner.contains(cell) && in_rows(new, row) && in_rows(old, old.row(cell));
            Some((cell, whole))
        };
        let old_cells: Vec<_> = (0..new.pores.len()).into_par_iter().map(old_cell).collect();
        let found = |face: usize| {
            let f = new.faces[face];
            let [low, high] = f.pores().map(|pore| old_cells[pore]);
            let (low, high) = low.zip(high)?;
            let (axis, cell) = (usize::from(f.axis), new.cell(f.low as usize));
            let index = face - new.faces_of(cell, axis).start;
            let old_face = old.faces_of(low.0, axis).nth(index)?;
            let touches_gap = new.touches_gap(face) || old.touches_gap(old_face);
            let periodic = new.boundary[1] == Boundary::Periodic;
            Some((
                old_face as u32,
                low.1 && high.1 && !touches_gap && !periodic,
            ))
        };
        Self((0..new.faces.len()).into_par_iter().map(found).collect())
    }

    /// The old face of a face with unchanged surroundings, whose wall coupling and edges can be copied.
    pub(crate) fn unchanged(&self, face: usize) -> Option<usize> {
        let (same, whole) = self.0.get(face).copied().flatten()?;
        whole.then_some(same as usize)
    }
}

/// For each row of `new`: the rows of `old` that it overlaps, and the overlapping fraction of each. Both gaps have the same
/// height.
fn overlapping(new: &Mesh, old: &Mesh) -> Vec<Vec<(usize, f64)>> {
    let part = |row: usize, rows: usize| {
        let first = row as f64 / rows as f64;
        [first, first + 1.0 / rows as f64]
    };
    let of_row = |row: usize| {
        if new.rows().kind(row) != RowKind::Gap {
            let same = same_row(new, old, row).map(|row| (row, 1.0));
            return same.into_iter().collect();
        }
        let [low, high] = part(row - new.rows().below, new.rows().gap);
        (0..old.rows().gap)
            .filter_map(|index| {
                let [l, h] = part(index, old.rows().gap);
                let overlap = (high.min(h) - low.max(l)) * old.rows().gap as f64;
                (overlap > 0.0).then(|| (index + old.rows().below - old.range.start, overlap))
            })
            .collect()
    };
    new.range.clone().map(of_row).collect()
}

/// Volumes of `old` on `new`. Liquid in a gap that has closed goes to the pores above and below.
pub(crate) fn remapped_volumes(new: &Mesh, old: &Mesh, volumes: &[f64]) -> Vec<f64> {
    let sum = |parts: &mut dyn Iterator<Item = (f64, f64)>| parts.map(|(part, of)| part * of).sum();
    let mut remapped = remapped_pores(new, old, volumes, sum);
    if new.rows().gap == 0 && old.rows().gap > 0 {
        for row in old.rows().below..old.rows().below + old.rows().gap {
            let pores = (0..volumes.len()).filter(|&pore| old.row_of(pore) == row);
            for pore in pores.filter(|&pore| volumes[pore] != 0.0) {
                let outlets = pores_beside_closed_gap(new, old, pore);
                let part = volumes[pore] / outlets.len().max(1) as f64;
                for pore in outlets {
                    remapped[pore] += part;
                }
            }
        }
    }
    remapped
}

/// Pressures of `old` on `new`. Those in a gap that has closed are dropped.
pub(crate) fn remapped_pressures(new: &Mesh, old: &Mesh, pressure: &[f64]) -> Vec<f64> {
    remapped_pores(new, old, pressure, mean)
}

/// Weighted mean of values, given as weight and value.
fn mean(parts: &mut dyn Iterator<Item = (f64, f64)>) -> f64 {
    let (all, sum) = parts.fold((0.0, 0.0), |(all, sum), (part, value)| {
        (all + part, sum + part * value)
    });
    if all > 0.0 { sum / all } else { 0.0 }
}

/// Pore values of `old` on `new`. `combine` reduces the values of the overlapping rows, given as overlap fraction and value.
fn remapped_pores(
    new: &Mesh,
    old: &Mesh,
    values: &[f64],
    combine: impl Fn(&mut dyn Iterator<Item = (f64, f64)>) -> f64 + Sync,
) -> Vec<f64> {
    let rows = overlapping(new, old);
    let value = |pore: usize| {
        let cell = new.cell(pore);
        let index = pore - new.pores_of(cell).start;
        let at = |cell: usize| old.pores_of(cell).nth(index);
        combined((new, old, &rows), cell, at, values, &combine)
    };
    (0..new.pores.len()).into_par_iter().map(value).collect()
}

/// The value of a pore or face in a cell of `new`, combined from the cells of `old` in the overlapping `rows`. `at` gives the
/// index of the pore or face in an old cell; without one the value is 0.
fn combined(
    (new, old, rows): (&Mesh, &Mesh, &[Vec<(usize, f64)>]),
    cell: usize,
    at: impl Fn(usize) -> Option<usize>,
    values: &[f64],
    combine: impl Fn(&mut dyn Iterator<Item = (f64, f64)>) -> f64,
) -> f64 {
    let [x, y, z] = new.cell_indices(cell);
    let value = |y: usize| at(old.cell_at([x, y, z])).map_or(0.0, |at| values[at]);
    combine(&mut rows[y].iter().map(|&(y, part)| (part, value(y))))
}

/// The pores above and below a pore of a gap that has closed; if there are none, those of the nearest gap pores that have some.
fn pores_beside_closed_gap(new: &Mesh, old: &Mesh, pore: usize) -> Vec<usize> {
    let in_gap = |pore: usize| old.rows().kind(old.row_of(pore)) == RowKind::Gap;
    let mut visited = HashSet::from([pore]);
    let mut front = vec![pore];
    loop {
        let found: Vec<usize> = (front.iter())
            .flat_map(|&pore| above_and_below(new, old, pore))
            .collect();
        if !found.is_empty() || front.is_empty() {
            return found;
        }
        let beside = front.iter().flat_map(|&pore| old.neighbours(pore));
        front = (beside.map(|neighbour| neighbour.pore))
            .filter(|&pore| in_gap(pore) && visited.insert(pore))
            .collect();
    }
}

/// The pores directly above and below a pore of a gap that has closed, once for each voxel.
fn above_and_below(new: &Mesh, old: &Mesh, pore: usize) -> Vec<usize> {
    let [x, _, z] = old.cell_indices(old.cell(pore));
    let mut found = Vec::new();
    for (row, voxel_row) in [
        (new.rows().below.wrapping_sub(1), new.k - 1),
        (new.rows().below, 0),
    ] {
        if !new.range.contains(&row) {
            continue;
        }
        let cell = new.cell_at([x, row - new.range.start, z]);
        for [a, b, c] in old.voxels(pore) {
            if b == 0 {
                found.extend(new.pore_at(cell, [a, voxel_row, c]));
            }
        }
    }
    found
}

/// Face velocities of `old` on `new`.
pub(crate) fn remapped_velocities(new: &Mesh, old: &Mesh, velocity: &[f64]) -> Vec<f64> {
    let rows = overlapping(new, old);
    let value = |face: usize| {
        let f = new.faces[face];
        let (axis, cell) = (usize::from(f.axis), new.cell(f.low as usize));
        let index = face - new.faces_of(cell, axis).start;
        // No liquid crosses where the bodies have met.
        match axis == 1 && new.row(cell) + 1 == new.rows().below && new.rows().gap == 0 {
            true => 0.0,
            false => {
                let at = |cell: usize| old.faces_of(cell, axis).nth(index);
                combined((new, old, &rows), cell, at, velocity, mean)
            }
        }
    };
    (0..new.faces.len()).into_par_iter().map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Wall couplings within two rows of the end of a mesh are computed anew when the mesh grows there.
    #[test]
    fn faces_near_the_end_of_a_mesh_are_found_anew() {
        let [whole, short] = [0, 4].map(|start| Mesh::column_from([12, 1], 2, start));
        let face_map = FaceMap::new(&whole, &short);
        let rows: Vec<usize> = (0..whole.faces.len())
            .filter(|&face| face_map.unchanged(face).is_some())
            .map(|face| whole.row_of(whole.faces[face].low as usize))
            .collect();
        assert_eq!(rows, [6, 7, 8, 9, 10]);
    }

    #[test]
    fn volumes_add_up_and_pressures_do_not() {
        let values = [7.0, 1.0, 3.0, 5.0, 9.0];
        let [three, two, none] = [3, 2, 0].map(|gap| Mesh::column([1, 1], gap));
        assert_eq!(
            remapped_volumes(&two, &three, &values),
            [7.0, 2.5, 6.5, 9.0]
        );
        let pressures = remapped_pressures(&two, &three, &values);
        let expected = [7.0, 5.0 / 3.0, 13.0 / 3.0, 9.0];
        for (pressure, expected) in pressures.iter().zip(expected) {
            assert!((pressure - expected).abs() < 1e-14, "{pressures:?}");
        }
        assert_eq!(remapped_volumes(&none, &three, &values), [11.5, 13.5]);
        assert_eq!(remapped_pressures(&none, &three, &values), [7.0, 9.0]);
    }
}
