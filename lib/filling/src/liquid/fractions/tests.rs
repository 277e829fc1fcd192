//! Liquid fractions: full where liquid is, whatever the offset of the walls and the threads.

use std::collections::BTreeMap;

use physics::{Boundary, VoxelBlock};

use super::*;
use crate::geometry::{Domain, Lattice, tests};
use crate::liquid::tests::{at, sequence};

pub(super) fn lattice(
    cells: [usize; 3],
    boundary: [Boundary; 3],
    axes: usize,
    blocks: Vec<VoxelBlock>,
) -> Lattice {
    let domain = Domain {
        cells,
        boundary,
        axes,
    };
    tests::lattice(domain, vec![blocks])
}

fn liquid(lattice: &Lattice, particles: &mut Particles) -> Fractions {
    let mut bins = Bins::default();
    particles.sort(&lattice.window, &mut bins);
    let mut fractions = Fractions::default();
    fractions.update(particles, &bins, lattice, &[[0.0; 3]; 2]);
    fractions
}

/// Sum over the sub-cells of the cells that are not images of others, cells.
fn total(window: &Window, of: impl Fn(usize) -> f32) -> f64 {
    let home = |c: usize| {
        let cell = window.coordinates(c);
        cell == window.home(cell)
    };
    let cells = (0..window.len()).filter(|&c| home(c));
    let sum: f64 = (cells.flat_map(|c| sub_cells(window, c)))
        .map(|sub| f64::from(of(sub)))
        .sum();
    sum / window.sub_per_cell() as f64
}

/// Particles half a cell apart that fill a box.
pub(super) fn regular(low: [f64; 3], high: [f64; 3], axes: usize) -> Particles {
    let n: [usize; 3] = std::array::from_fn(|a| {
        if a < axes {
            (2.0 * (high[a] - low[a])).round() as usize
        } else {
            1
        }
    });
    let mut points = Vec::new();
    for k in 0..n[2] {
        for j in 0..n[1] {
            for i in 0..n[0] {
                let place = [i, j, k];
                points.push(std::array::from_fn(|a| {
                    low[a] + (high[a] - low[a]) * (place[a] as f64 + 0.5) / n[a] as f64
                }));
            }
        }
    }
    let volume = (0..axes)
        .map(|a| (high[a] - low[a]) / n[a] as f64)
        .product::<f64>();
    at(points, volume as f32)
}

pub(super) const SIDES: [Boundary; 3] = [Boundary::Symmetry; 3];

/// A channel filled wall to wall: full everywhere at any wall offset. The density at the walls is
/// a little high, because regular particles spread less into them than o~ does.
#[test]
fn a_full_channel_is_full_at_any_offset() {
    let (mut mean, mut worst, mut cells) = (0.0, 0.0_f64, 0.0);
    for step in 0..20 {
        let off = 0.05 * f64::from(step);
        let low = VoxelBlock::solid_box([0.0, -9.0, 0.0], [8.0, 2.0 + off, 1.0]);
        let high = VoxelBlock::solid_box([0.0, 8.0 + off, 0.0], [8.0, 19.0, 1.0]);
        let sides = [Boundary::Periodic, Boundary::Symmetry, Boundary::Symmetry];
        let l = lattice([8, 11, 1], sides, 2, vec![low, high]);
        let mut particles = regular([0.0, 2.0 + off, 0.0], [8.0, 8.0 + off, 1.0], 2);
        let f = liquid(&l, &mut particles);
        let w = &l.window;
        let deposited = total(w, |sub| f.deposit[sub]);
        assert!((deposited - 48.0).abs() < 1e-4, "{deposited}");
        for (sub, &o) in l.open.iter().enumerate() {
            assert!(
                o < 0.02 || f.liquid[sub] == 1.0,
                "offset {off}: {}",
                f.liquid[sub]
            );
        }
        let liquid = total(w, |sub| f.liquid[sub] * l.open[sub]);
        assert!((liquid - 48.0).abs() < 1e-3, "{liquid}");
        for cell in (0..w.len()).filter(|&c| f.cell[c] > 0.5) {
            mean += f64::from(f.density[cell]);
            worst = worst.max((f.density[cell] - 1.0).abs().into());
            cells += 1.0;
        }
    }
    println!(
        "density in a full channel: mean {:.4}, worst deviation {worst:.4}",
        mean / cells
    );
    assert!((mean / cells - 1.0).abs() < 0.005 && worst < 0.05);
}

#[test]
fn the_deposited_volume_is_that_of_the_particles() {
    for boundary in [Boundary::Symmetry, Boundary::Periodic] {
        for (axes, cells) in [(2, [9, 7, 1]), (3, [9, 7, 12])] {
            let l = lattice(cells, [boundary; 3], axes, vec![]);
            let mut random = sequence(7);
            let points = (0..4000)
                .map(|_| {
                    std::array::from_fn(|a| {
                        if a < axes {
                            random() * cells[a] as f64
                        } else {
                            0.5
                        }
                    })
                })
                .collect();
            let mut particles = at(points, 0.1);
            for j in &mut particles.j {
                *j = (0.2 * random() - 0.1) as f32;
            }
            let f = liquid(&l, &mut particles);
            let exact = particles.total_volume();
            let found = if boundary == Boundary::Periodic {
                total(&l.window, |sub| f.deposit[sub])
            } else {
                f64::from(f.deposit.iter().sum::<f32>()) / l.window.sub_per_cell() as f64
            };
            println!("{axes}D {boundary:?}: deposited {found:.6} of {exact:.6}");
            assert!((found / exact - 1.0).abs() < 1e-5);
        }
    }
}

/// The same liquid, uniform along z, in plane strain and in three periodic layers.
#[test]
fn plane_strain_is_a_layer_of_three_dimensions() {
    let wall = |depth: f64| VoxelBlock::solid_box([2.3, 1.0, 0.0], [4.0, 5.7, depth]);
    let z_periodic = [Boundary::Symmetry, Boundary::Symmetry, Boundary::Periodic];
    let flat = lattice([8, 9, 1], SIDES, 2, vec![wall(1.0)]);
    let deep = lattice([8, 9, 4], z_periodic, 3, vec![wall(4.0)]);
    let mut random = sequence(11);
    let mut jitter = |i: i32| 0.25 + 0.5 * f64::from(i) + 0.2 * (random() - 0.5);
    let points: Vec<[f64; 2]> = (0..16)
        .flat_map(|i| (0..12).map(move |j| [i, j]))
        .map(|[i, j]| [jitter(i), jitter(j)])
        .filter(|p| !(2.3..4.0).contains(&p[0]) || !(1.0..5.7).contains(&p[1]))
        .collect();
    let mut thin = at(points.iter().map(|p| [p[0], p[1], 0.5]).collect(), 0.25);
    let layers = (0..8).flat_map(|k| {
        points
            .iter()
            .map(move |p| [p[0], p[1], 0.25 + 0.5 * f64::from(k)])
    });
    let mut thick = at(layers.collect(), 0.125);
    let (a, b) = (liquid(&flat, &mut thin), liquid(&deep, &mut thick));
    let mut worst = [0.0_f32; 3];
    for j in 0..9 {
        for i in 0..8 {
            let (s, t) = (flat.window, deep.window);
            let (c, d) = (s.index([i + 3, j + 3, 0]), t.index([i + 3, j + 3, 5]));
            let (p, q) = (
                s.first_sub([i + 3, j + 3, 0]),
                t.first_sub([i + 3, j + 3, 5]),
            );
            worst[0] = worst[0].max((a.liquid[p] - b.liquid[q]).abs());
            worst[1] = worst[1].max((a.density[c] - b.density[d]).abs());
            worst[2] = worst[2].max((a.cell[c] - b.cell[d]).abs());
        }
    }
    println!("plane strain against 3D: {worst:?}");
    assert!(worst.iter().all(|&w| w < 1e-4), "{worst:?}");
}

/// A missing particle cell is a hole and closes; a small pore ahead of the liquid, and a void
/// behind a wall of one voxel, stay empty.
#[test]
fn holes_close_and_pores_stay_empty() {
    // Liquid fills x < 6; the wall x >= 6 has a dead-end pore of 1 x 2 cells open to the
    // liquid, and behind a wall of one voxel a void of 1 x 1 cells.
    let solid = |i: usize, j: usize, k: usize| {
        let pore = i < 4 && (4..6).contains(&j) && (4..6).contains(&k);
        let void = (1..3).contains(&i) && (10..12).contains(&j) && (4..6).contains(&k);
        !(pore || void)
    };
    let wall = VoxelBlock::from_fn([6.0, 0.0, 0.0], [0.5; 3], [12, 20, 12], solid);
    let l = lattice([12, 10, 6], SIDES, 3, vec![wall]);
    let mut particles = regular([0.0; 3], [6.0, 10.0, 6.0], 3);
    let hole = [3.0, 4.0, 3.0];
    particles.retain(|x| (0..3).any(|a| x[a].floor() != hole[a]));
    let f = liquid(&l, &mut particles);
    let cell = |p: [f64; 3]| l.window.index(l.window.local(p).map(|x| x as usize));
    assert_eq!(f.cell[cell(hole)], 1.0);
    let pore = [f.cell[cell([6.5, 2.5, 2.5])], f.cell[cell([7.5, 2.5, 2.5])]];
    let void = f.cell[cell([6.75, 5.25, 2.25])];
    println!("pore {pore:?}, void {void}");
    assert!(pore[0] < 0.5 && pore[1] == 0.0 && void == 0.0);
    assert_eq!(
        f.cell[cell([5.5, 5.5, 2.5])],
        1.0,
        "liquid at the wall of the void"
    );
    assert!(
        f.cell[cell([5.5, 2.5, 2.5])] > 0.9,
        "liquid before the pore"
    );
}

/// Sampling noise and bubble: a row of four cells without particles closes, one of five does not.
#[test]
fn an_air_pocket_of_five_cells_is_none_of_noise() {
    for (cells, closed) in [(4, true), (5, false)] {
        let l = lattice([14, 7, 1], SIDES, 2, vec![]);
        let mut particles = regular([0.0; 3], [14.0, 7.0, 1.0], 2);
        let pocket = 4..4 + cells;
        particles.retain(|x| x[1].floor() != 3.0 || !pocket.contains(&(x[0] as usize)));
        let f = liquid(&l, &mut particles);
        let middle = l.window.local([6.5, 3.5, 0.5]).map(|x| x as usize);
        let phi = f.cell[l.window.index(middle)];
        assert_eq!(phi == 1.0, closed, "{cells} cells: {phi}");
    }
}

/// Half full slits of half and of a quarter of a cell: the wider one has a density, in the narrower
/// one (16 % of the surroundings open) a few particles say nothing.
#[test]
fn next_to_no_room_has_no_density() {
    let density = |width: f64| {
        let wall = |low: f64, high: f64| VoxelBlock::solid_box([0.0, low, 0.0], [8.0, high, 1.0]);
        let blocks = vec![wall(-9.0, 3.0), wall(3.0 + width, 19.0)];
        let l = lattice([8, 7, 1], SIDES, 2, blocks);
        let place = |i: i32| [0.25 + 0.5 * f64::from(i), 3.0 + 0.5 * width, 0.5];
        let mut particles = at((0..16).map(place).collect(), (0.25 * width) as f32);
        let f = liquid(&l, &mut particles);
        let cell = l.window.local(place(7)).map(|x| x as usize);
        f.density[l.window.index(cell)]
    };
    let (wide, narrow) = (density(0.5), density(0.25));
    assert!(wide < 0.7 && narrow == 1.0, "{wide} and {narrow}");
}

/// A full slit of two cells beside an empty or a full one, or wood, behind a wall of half a cell at `low` of the cells: the density
/// of its cells tells nothing of that.
#[test]
fn a_density_does_not_see_through_walls() {
    for low in [3.0, 3.25, 3.5, 3.75] {
        let densities = |second: Option<bool>| {
            let wall =
                |low: f64, high: f64| VoxelBlock::solid_box([0.0, low, 0.0], [8.0, high, 1.0]);
            let mut blocks = vec![
                wall(-9.0, low),
                wall(low + 2.0, low + 2.5),
                wall(low + 4.5, 19.0),
            ];
            if second.is_none() {
                blocks.push(wall(low + 2.0, 19.0));
            }
            let l = lattice([8, 10, 1], SIDES, 2, blocks);
            let mut places = regular([0.0, low, 0.0], [8.0, low + 2.0, 1.0], 2).position;
            if second == Some(true) {
                let more = regular([0.0, low + 2.5, 0.0], [8.0, low + 4.5, 1.0], 2);
                places.extend(more.position);
            }
            let mut points = at(places, 0.25);
            let f = liquid(&l, &mut points);
            let of = |y: f64| {
                let cell = l.window.local([4.5, y, 0.5]).map(|x| x as usize);
                f.density[l.window.index(cell)]
            };
            [of(low + 0.5), of(low + 1.0), of(low + 1.5)]
        };
        let beside = [None, Some(false), Some(true)].map(densities);
        println!("wall at {low}: wood, empty, full beside: {beside:.3?}");
        // A sliver of a quarter of a cell at wood is a third too dense by itself.
        let worst = (beside[1..].as_flattened().iter()).map(|r| (r - 1.0).abs());
        assert!(worst.fold(0.0, f32::max) < 0.03, "{low}: {beside:?}");
    }
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let l = lattice([20, 10, 30], SIDES, 3, vec![]);
    let mut random = sequence(5);
    let points = (0..20_000)
        .map(|_| [20.0 * random(), 10.0 * random(), 30.0 * random()])
        .collect();
    let mut particles = at(points, 0.2);
    for v in &mut particles.velocity {
        *v = [random() as f32, random() as f32, random() as f32];
    }
    let mut found = BTreeMap::new();
    for threads in [1, 2, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let f = pool.expect("a thread pool").install(|| {
            let mut own = particles.clone();
            let mut bins = Bins::default();
            own.sort(&l.window, &mut bins);
            let mut v = Vec::new();
            velocities(&own, &bins, &l.window, 2, &mut v);
            let f = liquid(&l, &mut own);
            let all = [f.liquid, f.cell, f.density, v].concat();
            all.iter().map(|x| x.to_bits()).collect::<Vec<_>>()
        });
        found.insert(threads, f);
    }
    assert!(found[&1] == found[&2] && found[&1] == found[&3]);
}

/// A linear velocity field comes back exactly inside regular particles.
#[test]
fn velocities_of_a_linear_field() {
    let l = lattice([8, 8, 8], SIDES, 3, vec![]);
    let mut particles = regular([0.0; 3], [8.0; 3], 3);
    for (v, x) in particles.velocity.iter_mut().zip(&particles.position) {
        *v = [
            (1.0 + 0.5 * x[1] - 0.25 * x[0]) as f32,
            x[0] as f32,
            (2.0 * x[2]) as f32,
        ];
    }
    let mut bins = Bins::default();
    particles.sort(&l.window, &mut bins);
    let mut worst = 0.0_f32;
    for axis in 0..3 {
        let mut v = Vec::new();
        velocities(&particles, &bins, &l.window, axis, &mut v);
        for at in [[5, 6, 5], [7, 5, 6], [8, 8, 7]] {
            let x = l.window.face_centre(axis, at);
            let exact = [1.0 + 0.5 * x[1] - 0.25 * x[0], x[0], 2.0 * x[2]][axis] as f32;
            worst = worst.max((v[l.window.index(at)] - exact).abs());
        }
    }
    assert!(worst < 1e-4, "{worst}");
}
