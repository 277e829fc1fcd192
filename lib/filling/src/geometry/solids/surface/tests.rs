//! Wetted area of slits, tubes, planes and thin walls.

use physics::VoxelBlock;

use crate::geometry::Surface;
use crate::geometry::tests::{domain, solids, whole};

/// Wetted area of a full lumen one cell long along z, in cells^2.
fn wetted(cells: [usize; 3], axes: usize, blocks: Vec<VoxelBlock>) -> f64 {
    let domain = domain(cells, axes);
    let surface = Surface::new(&solids(domain, vec![blocks.clone()]), |_| true);
    let lattice = whole(solids(domain, vec![blocks]));
    let phi = vec![1.0; lattice.window.sub_len()];
    let areas = surface.wetted(&lattice.solids, &lattice.window, &lattice.open, &phi);
    areas.iter().map(|wet| f64::from(wet.area)).sum::<f64>()
        / if axes == 3 { cells[2] as f64 } else { 1.0 }
}

/// Voxels of `edge` cells in `cells`, offset by `offset`, open where `open` says so of their middles from
/// the middle of the domain.
fn voxels(
    cells: [usize; 3],
    edge: f64,
    offset: [f64; 2],
    open: impl Fn(f64, f64) -> bool,
) -> VoxelBlock {
    let n = cells.map(|n| ((n as f64 + 2.0) / edge) as usize);
    let at = |a: usize, i: usize| offset[a] - 1.0 + (i as f64 + 0.5) * edge - 0.5 * cells[a] as f64;
    VoxelBlock::from_fn(
        [offset[0] - 1.0, offset[1] - 1.0, -1.0],
        [edge; 3],
        n,
        |i, j, _| !open(at(0, i) - offset[0], at(1, j) - offset[1]),
    )
}

#[test]
fn a_slit_wets_its_two_walls_at_any_offset() {
    for offset in [0.0, 0.1, 0.25, 0.5, 0.77] {
        for height in [0.5, 1.0, 3.0] {
            let below = VoxelBlock::solid_box([-1.0; 3], [9.0, 2.0 + offset, 9.0]);
            let roof = [-1.0, 2.0 + offset + height, -1.0];
            let above = VoxelBlock::solid_box(roof, [9.0; 3]);
            for (cells, axes) in [([8, 8, 1], 2), ([8, 8, 4], 3)] {
                let found = wetted(cells, axes, vec![below.clone(), above.clone()]);
                assert!(
                    (found / 16.0 - 1.0).abs() < 1e-6,
                    "{offset} {height}: {found}"
                );
            }
        }
    }
}

/// The stairs themselves are 4/pi times as long as the circle, 27 % too much, and up to 1.41 times as long as
/// a plane; of a square lumen the corners lose a part.
#[test]
fn inclined_walls_have_their_own_area_not_that_of_their_stairs() {
    for (n, most) in [(2, 0.04), (3, 0.08), (6, 0.03), (12, 0.04), (24, 0.04)] {
        for offset in [[0.0, 0.0], [0.25, 0.0], [0.1, 0.37]] {
            let cells = [n + 4, n + 4, 4];
            let radius = 0.5 * n as f64;
            let tube = voxels(cells, 0.5, offset, |x, y| x.hypot(y) < radius);
            let found = wetted(cells, 3, vec![tube]) / (std::f64::consts::PI * n as f64) - 1.0;
            println!("tube of {n} cells at {offset:?}: {:+.1} %", 100.0 * found);
            assert!(found.abs() < most, "{n} {offset:?}: {found}");
        }
    }
    for n in [3, 6, 12] {
        let (cells, half) = ([n + 4, n + 4, 4], 0.5 * n as f64);
        let duct = voxels(cells, 0.5, [0.0; 2], |x, y| x.abs().max(y.abs()) < half);
        let found = wetted(cells, 3, vec![duct]) / (4 * n) as f64 - 1.0;
        println!("square of {n} cells: {:+.1} %", 100.0 * found);
        assert!(-0.25 / (n as f64) < found && found < 0.0, "{n}: {found}");
    }
    for slope in [0.1_f64, 0.3, 0.5, 0.7, 1.0] {
        let (cells, way) = ([24, 24, 4], 24.0 * (1.0 + slope * slope).sqrt());
        let one = voxels(cells, 0.5, [0.0; 2], |x, y| y > slope * x);
        let one = wetted(cells, 3, vec![one]) / way - 1.0;
        let thin = voxels(cells, 0.5, [0.0; 2], |x, y| {
            y > slope * x + 0.6 || y < slope * x
        });
        let thin = wetted(cells, 3, vec![thin]) / (2.0 * way) - 1.0;
        println!(
            "slope {slope}: {:+.1} %, thin {:+.1} %",
            100.0 * one,
            100.0 * thin
        );
        assert!(
            one.abs() < 0.09 && thin.abs() < 0.09,
            "{slope}: {one} {thin}"
        );
    }
}

/// A wall half a cell below the next cell takes from its own one, a wall 0.6 into it from the next.
#[test]
fn a_wall_takes_from_the_cell_just_below_half_a_cell_off_it() {
    for (off, row) in [(0.5, 2), (0.6, 3)] {
        let below = VoxelBlock::solid_box([-1.0; 3], [9.0, 2.0 + off, 9.0]);
        let domain = domain([8, 8, 1], 2);
        let surface = Surface::new(&solids(domain, vec![vec![below.clone()]]), |_| true);
        let lattice = whole(solids(domain, vec![vec![below]]));
        let phi = vec![1.0; lattice.window.sub_len()];
        let wet = surface.wetted(&lattice.solids, &lattice.window, &lattice.open, &phi);
        let window = &lattice.window;
        let found = |cell: u32| window.low[1] + window.coordinates(cell as usize)[1] as i64;
        assert!(!wet.is_empty());
        assert!(wet.iter().all(|wet| found(wet.cell) == row), "{off}");
    }
}

/// A wall across periodic sides, at any place between them and on them, has two faces, not those of its images.
#[test]
fn a_wall_across_periodic_sides_has_two_faces() {
    for axis in 0..3 {
        for low in [0.0, 1.25, 5.5, 6.0] {
            let (mut from, mut to) = ([0.0; 3], [8.0; 3]);
            (from[axis], to[axis]) = (low, low + 2.0);
            let mut domain = domain([8; 3], 3);
            domain.boundary[axis] = physics::Boundary::Periodic;
            let wall = VoxelBlock::from_fn(
                from,
                [0.5; 3],
                [0, 1, 2].map(|a| (2.0 * (to[a] - from[a])) as usize),
                |_, _, _| true,
            );
            let surface = Surface::new(&solids(domain, vec![vec![wall.clone()]]), |_| true);
            let lattice = whole(solids(domain, vec![vec![wall]]));
            let phi = vec![1.0; lattice.window.sub_len()];
            let areas = surface.wetted(&lattice.solids, &lattice.window, &lattice.open, &phi);
            let found: f64 = areas.iter().map(|wet| f64::from(wet.area)).sum();
            assert!((found - 128.0).abs() < 1e-3, "{axis} {low}: {found}");
        }
    }
}
