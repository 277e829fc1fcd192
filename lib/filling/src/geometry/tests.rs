//! Geometry on the half-cell lattice: exact volumes and areas, widths, and walls that
//! hold whatever their thickness and offset.

use physics::{Boundary, Motion, RigidBody, VoxelBlock};

use super::*;

/// A domain between symmetry planes.
pub(crate) fn domain(cells: [usize; 3], axes: usize) -> Domain {
    Domain {
        cells,
        boundary: [Boundary::Symmetry; 3],
        axes,
    }
}

/// Bodies of blocks, in cells.
pub(crate) fn solids(domain: Domain, bodies: Vec<Vec<VoxelBlock>>) -> Solids {
    let body = |blocks| RigidBody {
        name: "body".into(),
        blocks,
        motion: Motion::Fixed,
    };
    let bodies = bodies.into_iter().map(body).collect();
    Solids::new(bodies, domain, [0.0; 3], 1.0)
}

/// The lattice of a whole domain with such bodies.
pub(crate) fn lattice(domain: Domain, bodies: Vec<Vec<VoxelBlock>>) -> Lattice {
    whole(solids(domain, bodies))
}

/// The lattice of the whole domain.
pub(crate) fn whole(solids: Solids) -> Lattice {
    let domain = solids.domain;
    let to = domain.cells.map(|n| n as i64);
    Lattice::new(solids, Window::around(domain, [0; 3], to))
}

/// Volume left open in a domain between symmetry planes, beyond which nothing is.
fn open_volume(l: &Lattice) -> f64 {
    let sum: f64 = l.open.iter().map(|&o| f64::from(o)).sum();
    sum / l.window.sub_per_cell() as f64
}

/// Cells reached from `start` through open faces.
fn reached(l: &Lattice, start: [usize; 3]) -> Vec<bool> {
    let w = &l.window;
    let mut seen = vec![false; w.len()];
    let mut stack = vec![w.index(start)];
    while let Some(c) = stack.pop() {
        if std::mem::replace(&mut seen[c], true) {
            continue;
        }
        for axis in 0..w.domain.axes {
            let s = w.stride(axis);
            if l.face(axis, c) == OPEN && c >= s {
                stack.push(c - s);
            }
            if c + s < w.len() && l.face(axis, c + s) == OPEN {
                stack.push(c + s);
            }
        }
    }
    seen
}

#[test]
fn open_volume_is_exact_at_any_offset() {
    for step in 0..20 {
        let off = f64::from(step) * 0.05;
        let slab = VoxelBlock::solid_box([2.0 + off, 1.3, 0.2], [5.5 + off, 4.0 + off, 3.9]);
        let l = lattice(domain([9, 8, 6], 3), vec![vec![slab]]);
        let exact = 9.0 * 8.0 * 6.0 - 3.5 * (2.7 + off) * 3.7;
        let found = open_volume(&l);
        assert!(
            (found - exact).abs() < 1e-4,
            "offset {off}: {found} {exact}"
        );
    }
}

/// A box whose walls are one or two voxels thick, closed on all sides.
fn shell(axes: usize, thickness: usize, offset: [f64; 3]) -> VoxelBlock {
    let n = 14;
    let inside = |i: usize| i >= thickness && i < n - thickness;
    let dims = if axes == 2 { [n, n, 1] } else { [n, n, n] };
    let edge = [0.5, 0.5, if axes == 2 { 1.0 } else { 0.5 }];
    VoxelBlock::from_fn(
        [
            3.0 + offset[0],
            3.0 + offset[1],
            if axes == 2 { 0.0 } else { 3.0 + offset[2] },
        ],
        edge,
        dims,
        |i, j, k| !(inside(i) && inside(j) && (axes == 2 || inside(k))),
    )
}

#[test]
fn closed_lumens_do_not_leak() {
    for axes in [2, 3] {
        for thickness in [1, 2] {
            for step in 0..20 {
                let f = f64::from(step) * 0.05;
                let offset = [f, (f * 7.3).fract(), (f * 3.7 + 0.2).fract()];
                let cells = if axes == 2 { [14, 14, 1] } else { [14, 14, 14] };
                let l = lattice(
                    domain(cells, axes),
                    vec![vec![shell(axes, thickness, offset)]],
                );
                let w = &l.window;
                let mut at = [3.0 + offset[0] + 3.5; 3];
                for a in 0..3 {
                    at[a] = if a < axes { 3.0 + offset[a] + 3.5 } else { 0.5 };
                }
                let centre = w.local(at).map(|x| x as usize);
                let seen = reached(&l, centre);
                let corner: [usize; 3] = w.local([0.5; 3]).map(|x| x as usize);
                assert!(
                    !seen[w.index(corner)],
                    "{axes}D, {thickness} voxels, offset {offset:?}"
                );
                assert!(
                    seen.iter().filter(|&&s| s).count() >= 16,
                    "the lumen is closed"
                );
            }
        }
    }
}

/// Tilted walls one voxel thick, with steps in two directions, wherever they lie on the grid.
#[test]
fn thin_stairs_do_not_leak() {
    let n = 28;
    for rises in [[0.6, 0.33], [1.0, 1.0], [0.5, 0.25], [1.3, 0.2], [0.9, 0.7]] {
        let plane = |i: usize, k: usize| 4 + (rises[0] * i as f64 + rises[1] * k as f64) as usize;
        // A step up is closed by the risers between neighbouring heights.
        let solid = |i: usize, j: usize, k: usize| {
            let top = plane(i, k);
            let low = [(i.wrapping_sub(1), k), (i, k.wrapping_sub(1))]
                .into_iter()
                .filter(|&(a, b)| a < n && b < n)
                .map(|(a, b)| plane(a, b))
                .fold(top, usize::min);
            (low..=top).contains(&j)
        };
        for step in 0..20 {
            let off = f64::from(step) * 0.05;
            // The domain is within the block, so that the wall ends at its sides.
            let origin = [[-0.5, -1.0], [-0.75, -0.6]][step as usize % 2];
            let block =
                VoxelBlock::from_fn([origin[0], off, origin[1]], [0.5; 3], [n, 76, n], solid);
            let l = lattice(domain([12, 40, 12], 3), vec![vec![block]]);
            let w = &l.window;
            let start: [usize; 3] = w.local([0.5, 0.5, 0.5]).map(|x| x as usize);
            let end: [usize; 3] = w.local([0.5, 39.5, 0.5]).map(|x| x as usize);
            let seen = reached(&l, start);
            assert!(!seen[w.index(end)], "rises {rises:?}, offset {off}");
        }
    }
}

/// Open areas of the faces of a duct add up to its cross-section, and covered ones to the rest.
#[test]
fn areas_add_up_to_the_cross_section() {
    for step in 0..20 {
        let off = f64::from(step) * 0.05;
        let (a, b) = (3.0 + off, 2.0 + 0.5 * off);
        let walls = vec![
            VoxelBlock::solid_box([-1.0; 3], [9.0, a, 9.0]),
            VoxelBlock::solid_box([-1.0, a + 4.0, -1.0], [9.0, 12.0, 9.0]),
            VoxelBlock::solid_box([-1.0, a, -1.0], [9.0, a + 4.0, b]),
            VoxelBlock::solid_box([-1.0, a, b + 3.0], [9.0, a + 4.0, 9.0]),
        ];
        let l = lattice(domain([8, 10, 8], 3), vec![walls]);
        let w = &l.window;
        let x: usize = w.local([4.0, 0.0, 0.0])[0] as usize;
        let (mut open, mut body) = (0.0, 0.0);
        for index in 0..w.len() {
            let cell = w.coordinates(index);
            if cell[0] == x && w.in_domain(cell) {
                let aperture = l.aperture(0, cell);
                open += aperture.open;
                body += aperture.bodies.iter().map(|b| b.1).sum::<f64>();
            }
        }
        assert!((open - 12.0).abs() < 1e-3, "offset {off}: open {open}");
        assert!((body - 68.0).abs() < 1e-3, "offset {off}: body {body}");
    }
}

#[test]
fn widths_end_at_walls_and_mirror_at_symmetry_planes() {
    let floor = VoxelBlock::solid_box([0.0, -1.0, 0.0], [8.0, 1.25, 1.0]);
    let roof = VoxelBlock::solid_box([0.0, 5.5, 0.0], [4.0, 7.0, 1.0]);
    let l = lattice(domain([8, 10, 1], 2), vec![vec![floor], vec![roof]]);
    let at = |p: [f64; 3]| l.window.local(p).map(|x| x as usize);
    let column = l.column(0, at([2.0, 2.0, 0.0]), 1, 0);
    assert!((column.distance[0] - 1.25).abs() < 1e-9 && (column.distance[1] - 3.0).abs() < 1e-9);
    assert_eq!(column.body, [0, 1]);
    assert!((column.width() - 4.25).abs() < 1e-9);
    assert!(!column.touches(0));
    let mirrored = l.column(0, at([6.0, 2.0, 0.0]), 1, 1);
    assert!((mirrored.width() - 2.0 * 8.75).abs() < 1e-9, "{mirrored:?}");
}

#[test]
fn free_paths_end_after_64_cells() {
    let wall = |at: f64| {
        let block = VoxelBlock::solid_box([0.0, at, 0.0], [4.0, at + 1.0, 1.0]);
        let l = lattice(domain([4, 90, 1], 2), vec![vec![block]]);
        let cell = l.window.local([2.0, 2.0, 0.0]).map(|x| x as usize);
        l.column(0, cell, 1, 1).distance[1]
    };
    assert!((wall(66.0) - 63.5).abs() < 1e-9, "{}", wall(66.0));
    assert_eq!(wall(67.0), 64.0);
}

/// The velocity at a face between two bodies is that of the one above.
#[test]
fn a_face_between_two_bodies_belongs_to_the_upper_one() {
    let below = VoxelBlock::solid_box([0.0, 0.0, 0.0], [3.0, 6.0, 6.0]);
    let above = VoxelBlock::solid_box([3.0, 0.0, 0.0], [6.0; 3]);
    let l = lattice(domain([6; 3], 3), vec![vec![below], vec![above]]);
    let at = |i: usize| {
        let cell = l.window.local([i as f64, 2.0, 2.0]);
        l.face(0, l.window.index(cell.map(|x| x.round() as usize)))
    };
    assert_eq!([at(2), at(3), at(4)], [0, 1, 1]);
}
