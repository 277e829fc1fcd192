//! Films of air between liquid and a wall, thinner than the lattice tells from nothing.
//!
//! Liquid sticks to the walls it has passed, so that no air stays between; but particles next to
//! a wall hardly move, the front leaves few of them there, and a cell that a wall cuts in half can
//! be without any. Counted as air it would take the wall's friction and its own viscosity from its
//! neighbours: liquid would slip through lumens of three cells.

use rayon::prelude::*;

use super::holes::{Kind, neighbours};
use super::sub_cells;
use crate::geometry::{Lattice, OPEN, SIDE};

/// Open volume up to which a cell at a wall can be a film, cells: one layer of sub-cells, and a tenth
/// for walls that are not quite half way.
const THICKEST: f32 = 0.55;

/// The cells that are films: counted as air, open on the side of liquid and cut by a wall on the
/// opposite one that does not move to or from it (a wall that comes nearer closes the film by itself),
/// behind the front. The front has passed where there is no air in the layer of 3^(d-1) cells around
/// the liquid one, other cells of films left out; ahead of that a film may be the free surface.
pub(super) fn find(
    kinds: &[Kind],
    lattice: &Lattice,
    bodies: &[[f64; 3]],
    wanted: impl Fn(usize) -> bool + Sync,
) -> Vec<u32> {
    let window = &lattice.window;
    let narrow = |cell: usize| {
        let open: f32 = sub_cells(window, cell).map(|s| lattice.open[s]).sum();
        open <= THICKEST * window.sub_per_cell() as f32
    };
    let passed = |liquid: usize, axis: usize| {
        let layer = window.coordinates(liquid)[axis];
        neighbours(window, liquid).all(|n| {
            n.is_some_and(|n| {
                window.coordinates(n)[axis] != layer || kinds[n] != Kind::Air || narrow(n)
            })
        })
    };
    // Open part of the half of a cell at its low or high face.
    let half = |cell: usize, axis: usize, high: bool| {
        let end = window.coordinates(cell)[axis] * 2 + usize::from(high);
        let of_half = |&s: &usize| s / window.sub_stride(axis) % window.sub_cells()[axis] == end;
        let open = sub_cells(window, cell).filter(of_half);
        open.map(|s| lattice.open[s]).sum::<f32>()
    };
    let faces = |cell: usize| {
        (0..window.domain.axes).flat_map(move |axis| {
            let high = cell + window.stride(axis);
            let below = cell - window.stride(axis);
            [
                (axis, [cell, high], below, true),
                (axis, [high, cell], high, false),
            ]
        })
    };
    let is_film = |cell: usize| {
        kinds[cell] == Kind::Air
            && wanted(cell)
            && window.inner(window.coordinates(cell))
            && narrow(cell)
            && faces(cell).any(|(axis, [inner, outer], liquid, up)| {
                let wall = lattice.face(axis, outer);
                kinds[liquid] == Kind::Liquid
                    && lattice.face(axis, inner) == OPEN
                    && ![OPEN, SIDE].contains(&wall)
                    && bodies[usize::from(wall)][axis] == 0.0
                    && half(cell, axis, up) < half(cell, axis, !up)
                    && passed(liquid, axis)
            })
    };
    (0..kinds.len())
        .into_par_iter()
        .filter(|&cell| is_film(cell))
        .map(|cell| cell as u32)
        .collect()
}

#[cfg(test)]
mod tests {
    use physics::VoxelBlock;

    use super::super::tests::{SIDES, lattice, regular};
    use super::super::{Bins, Fractions};

    /// A channel of three cells whose walls stand half way in theirs, filled to x = 8 but for the particles
    /// next to the walls. Behind the front the films are liquid; at the front, at a wall that comes nearer, and
    /// where the air is thicker they are air.
    #[test]
    fn films_at_walls_behind_the_front_are_liquid() {
        let films = |off: f64, speed: f64| {
            let wall =
                |low: f64, high: f64| VoxelBlock::solid_box([0.0, low, 0.0], [12.0, high, 1.0]);
            let blocks = vec![wall(-9.0, 2.0 + off), wall(6.0 - off, 19.0)];
            let l = lattice([12, 8, 1], SIDES, 2, blocks);
            let mut particles = regular([0.0, 3.1, 0.0], [8.0, 4.9, 1.0], 2);
            let mut bins = Bins::default();
            particles.sort(&l.window, &mut bins);
            let mut f = Fractions::default();
            f.update(&particles, &bins, &l, &[[0.3, speed, 0.0]]);
            let cell = |x: f64, y: f64| {
                let at = l.window.local([x, y, 0.5]).map(|x| x as usize);
                f.cell[l.window.index(at)]
            };
            assert!(cell(6.5, 3.5) > 0.5 && cell(7.5, 3.5) > 0.5);
            [cell(3.5, 2.9), cell(6.5, 5.1), cell(7.5, 2.9)].map(|phi| phi >= 0.5)
        };
        assert_eq!(films(0.5, 0.0), [true, true, false]);
        assert_eq!(films(0.5, 0.1), [false; 3]);
        assert_eq!(films(0.25, 0.0), [false; 3]);
    }
}
