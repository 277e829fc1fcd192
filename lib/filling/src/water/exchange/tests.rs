//! What walls take, what diffuses and what stays.

use physics::{VoxelBlock, Water, WaterLaw};

use super::*;
use crate::geometry::tests::{domain, lattice};
use crate::liquid::tests::at;
use crate::water::{fill, give_off};

fn water() -> Water {
    let law = WaterLaw {
        uptake: 1.0,
        solids: 0.5,
        capacity: None,
        limit: Some(0.6),
        diffusivity: 1.0,
        factor: vec![(0.5, 1.0), (0.7, 100.0)],
        walls: Vec::new(),
    };
    Water::new(law, 1200.0).unwrap()
}

/// A box of 6 x 4 cells of liquid on a floor at y = 1; what a step moves where the floor's cells
/// ask for `uptake` cells each.
fn step(diffusion: f64, uptake: f64) -> (Lattice, Particles, Bins, Exchange) {
    step_without(diffusion, uptake, |_| false)
}

/// The same without the points that are `absent`.
fn step_without(
    diffusion: f64,
    uptake: f64,
    absent: impl Fn(&[f64; 3]) -> bool,
) -> (Lattice, Particles, Bins, Exchange) {
    let floor = VoxelBlock::solid_box([-1.0; 3], [9.0, 1.0, 9.0]);
    let lattice = lattice(domain([6, 5, 1], 2), vec![vec![floor]]);
    let points = (0..12 * 8).map(|p| {
        let (i, j) = (p % 12, p / 12);
        [0.5 * f64::from(i) + 0.25, 1.25 + 0.5 * f64::from(j), 0.5]
    });
    let mut particles = at(points.filter(|x| !absent(x)).collect(), 0.25);
    let mut bins = Bins::default();
    particles.sort(&lattice.window, &mut bins);
    let water = water();
    fill(&mut particles, &water);
    let phi: Vec<f32> = lattice.open.iter().map(|o| f32::from(*o > 0.0)).collect();
    let window = &lattice.window;
    let at_floor = |cell: usize| {
        let at = window.coordinates(cell);
        window.in_domain(at) && window.corner(at)[1] == 1.0
    };
    let asked: Vec<f64> = (0..window.len())
        .map(|cell| uptake * f64::from(u8::from(at_floor(cell))))
        .collect();
    let medium = Medium {
        water: &water,
        diffusion,
    };
    let exchange = Exchange::new(&medium, &lattice, &phi, &particles, &bins, &asked).unwrap();
    (lattice, particles, bins, exchange)
}

fn gained(exchange: &Exchange, lattice: &Lattice, row: usize) -> f64 {
    let of_row = |cell: usize| {
        let corner = lattice.window.corner(lattice.window.coordinates(cell));
        corner[1] == row as f64
    };
    let list = exchange.gained.iter();
    list.filter(|(cell, _)| of_row(*cell as usize))
        .map(|(_, gained)| gained)
        .sum()
}

#[test]
fn walls_take_what_they_ask_for_and_nothing_is_lost() {
    for diffusion in [0.0, 1.0, 1e4] {
        let (lattice, mut particles, bins, exchange) = step(diffusion, 0.01);
        assert!((exchange.taken - 0.06).abs() < 1e-12, "{}", exchange.taken);
        let sum: f64 = exchange.gained.iter().map(|gained| gained.1).sum();
        assert!((sum + exchange.taken).abs() < 1e-13, "{sum}");
        let before = particles.water();
        give_off(&mut particles, &bins, &exchange, &water());
        let after = particles.water();
        assert!((before - after - exchange.taken).abs() < 1e-13 * before);
        // Alone at the floor, or alike in all four layers.
        let at_floor = gained(&exchange, &lattice, 1) / sum;
        let exact = if diffusion == 0.0 { 1.0 } else { 0.25 };
        assert!(
            diffusion == 1.0 || (at_floor - exact).abs() < 1e-3,
            "{at_floor}"
        );
        assert!(
            particles
                .volume
                .iter()
                .zip(&particles.parts)
                .all(|(volume, [solids, held])| *volume == (solids + held) as f32)
        );
    }
}

#[test]
fn no_cell_gives_more_than_wood_takes_at_the_limit() {
    let water = water();
    let (lattice, mut particles, bins, exchange) = step(0.0, 10.0);
    let solids = 1.0 / (1.0 + water.start());
    let most = 6.0 * solids * (water.start() - water.least());
    assert!(
        (exchange.taken / most - 1.0).abs() < 1e-9,
        "{}",
        exchange.taken
    );
    assert_eq!(gained(&exchange, &lattice, 2), 0.0);
    give_off(&mut particles, &bins, &exchange, &water);
    let least = (particles.parts.iter().map(|[solids, held]| held / solids)).fold(9.0, f64::min);
    assert!((least / water.least() - 1.0).abs() < 1e-9);
    // With diffusion the layers above feed the floor, which stays at the limit.
    let (_, mut particles, bins, exchange) = step(0.5, 10.0);
    assert!(exchange.taken > 1.2 * most, "{}", exchange.taken);
    give_off(&mut particles, &bins, &exchange, &water);
    let ratios = particles.parts.iter().map(|[solids, held]| held / solids);
    assert!(ratios.clone().all(|x| x > water.least() * (1.0 - 1e-9)));
    assert!(ratios.clone().all(|x| x < water.start() * (1.0 + 1e-9)));
}

/// Half of the way in time: the geometric mean of the factors before and after.
#[test]
fn the_viscosity_is_that_of_the_middle_of_the_step() {
    let water = water();
    let (lattice, _, _, exchange) = step(0.0, 0.01);
    let solids = 1.0 / (1.0 + water.start());
    let end = water.factor(water.start() - 0.01 / solids);
    let cell = lattice.window.local([2.5, 1.5, 0.5]).map(|x| x as usize);
    let found = f64::from(exchange.factor[lattice.window.index(cell)]);
    assert!((found / end.sqrt() - 1.0).abs() < 1e-6, "{found} {end}");
    assert!((exchange.change - end.ln()).abs() < 1e-9);
    assert!((exchange.fluidity - (0.75 + 0.25 / end)).abs() < 1e-2);
}

/// Cells that look wet, without a point that could feed them: the balance was singular, and numbers were none.
#[test]
fn cells_that_no_point_feeds_give_nothing() {
    let (_, _, _, exchange) = step_without(0.0, 0.01, |x| x[0] > 2.0);
    assert!((exchange.taken - 0.02).abs() < 1e-12, "{}", exchange.taken);
    // Fed by diffusion they do.
    let (_, _, _, exchange) = step_without(1.0, 0.01, |x| x[0] > 2.0);
    assert!((exchange.taken - 0.06).abs() < 1e-9, "{}", exchange.taken);
    let gained: f64 = exchange.gained.iter().map(|gained| gained.1).sum();
    assert!((gained + exchange.taken).abs() < 1e-13, "{gained}");
    let (_, _, _, exchange) = step_without(1.0, 0.01, |_| true);
    assert_eq!((exchange.taken, exchange.change), (0.0, 0.0));
}
