//! What a step moves of the water: by diffusion between the cells and at a given rate into their walls, until a
//! cell holds no more than walls leave.
//!
//! X, water over solids by volume, obeys in each cell V_s (X - X_0) = sum K (X_n - X) - q, X >= X_min, where V_s
//! is the solids' volume, K = D dt/h^2 A (1 - f), f the part of water and A the liquid area between two
//! cells, and q what the wetted walls take in the step, all of what they ask for where X > X_min. Velocities
//! are those of the solids, against which water diffuses at D (1 - f) grad X.

use physics::Water;

use crate::geometry::{Lattice, OPEN, Window};
use crate::liquid::{Bins, Particles};

/// Relative residual of the solution, and iterations to reach it.
const TOLERANCE: f64 = 1e-10;
const MAX_ITERATIONS: usize = 2000;
/// Times that cells change sides between those that still give all that is asked for and those at the
/// limit, at most.
const MAX_TURNS: usize = 30;
/// Part of the limit by which X may fall short of it.
const HAIR: f64 = 1e-9;
/// No cell.
const NONE: u32 = u32::MAX;

/// What holds for a step.
pub(crate) struct Medium<'a> {
    pub(crate) water: &'a Water,
    /// Length of the step times diffusivity over the square of a cell.
    pub(crate) diffusion: f64,
    /// Length of the step times uptake over a cell.
    pub(crate) uptake: f64,
}

/// What a step moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Exchange {
    /// Cells of the window that hold points, and the water that each gains, cells.
    pub(crate) gained: Vec<(u32, f64)>,
    /// Water that goes into walls, cells.
    pub(crate) taken: f64,
    /// Factor of the viscosity in the middle of the step, of each cell of the window.
    pub(crate) factor: Vec<f32>,
    /// Mean of the change of ln(viscosity), weighted by the water that cells give off or take up.
    pub(crate) change: f64,
    /// Mean of 1/factor over the liquid at the end of the step.
    pub(crate) fluidity: f64,
}

/// A cell that holds liquid.
struct Node {
    cell: u32,
    solids: f64,
    /// Water over solids; that of the start without points.
    ratio: f64,
    /// What its walls ask for, cells.
    asked: f64,
    /// K to the neighbours below and above along each axis.
    conductance: [f64; 6],
    neighbour: [u32; 6],
}

impl Exchange {
    /// That of a step in `medium` for the points in `bins`, the liquid `phi` of the sub-cells and the wetted
    /// area (cells^2) of each cell.
    pub(crate) fn new(
        medium: &Medium,
        lattice: &Lattice,
        phi: &[f32],
        particles: &Particles,
        bins: &Bins,
        wetted: &[f64],
    ) -> Self {
        let nodes = nodes(medium, lattice, phi, particles, bins, wetted);
        let (ratio, at_limit) = solve(&nodes, medium.water.least());
        let mut found = Self {
            factor: vec![1.0; lattice.window.len()],
            ..Self::default()
        };
        let (mut moved, mut changed, mut fluid, mut volume) = (0.0, 0.0, 0.0, 0.0);
        for (n, node) in nodes.iter().enumerate() {
            let flow = node.inflow(&ratio, n);
            let gained = match (node.solids > 0.0, at_limit[n]) {
                (false, _) => 0.0,
                // Walls give nothing back.
                (true, true) => (node.solids * (ratio[n] - node.ratio)).min(flow),
                (true, false) => flow - node.asked,
            };
            found.taken += flow - gained;
            let end = medium.water.factor(ratio[n]);
            let begin = match node.solids > 0.0 {
                true => medium.water.factor(node.ratio),
                false => end,
            };
            found.factor[node.cell as usize] = (begin * end).sqrt() as f32;
            if node.solids > 0.0 {
                found.gained.push((node.cell, gained));
                moved += gained.abs();
                changed += gained.abs() * (end / begin).ln().abs();
                let held = node.solids * (1.0 + ratio[n]);
                (fluid, volume) = (fluid + held / end, volume + held);
            }
        }
        images(&lattice.window, &mut found.factor);
        found.change = if moved > 0.0 { changed / moved } else { 0.0 };
        found.fluidity = if volume > 0.0 { fluid / volume } else { 1.0 };
        found
    }

    /// Volume (cells) that each of `cells` loses in the step.
    pub(crate) fn lost(&self, window: &Window, cells: &[u32]) -> Vec<f64> {
        let mut all = vec![0.0; window.len()];
        for &(cell, gained) in &self.gained {
            all[cell as usize] = -gained;
        }
        cells.iter().map(|&cell| all[cell as usize]).collect()
    }
}

impl Node {
    /// Water that comes from the neighbours of node `own`.
    fn inflow(&self, ratio: &[f64], own: usize) -> f64 {
        let each = self.neighbour.iter().zip(self.conductance);
        let each = each.filter(|(n, _)| **n != NONE);
        each.map(|(&n, k)| k * (ratio[n as usize] - ratio[own]))
            .sum()
    }

    fn diagonal(&self) -> f64 {
        self.solids + self.conductance.iter().sum::<f64>()
    }
}

/// The cells with liquid or points.
fn nodes(
    medium: &Medium,
    lattice: &Lattice,
    phi: &[f32],
    particles: &Particles,
    bins: &Bins,
    wetted: &[f64],
) -> Vec<Node> {
    let window = &lattice.window;
    let mut asked = vec![0.0; window.len()];
    for (cell, area) in wetted.iter().enumerate().filter(|(_, area)| **area > 0.0) {
        asked[window.index(window.home(window.coordinates(cell)))] += medium.uptake * area;
    }
    let mut number = vec![NONE; window.len()];
    let mut nodes = Vec::new();
    let start = medium.water.start();
    for cell in 0..window.len() {
        let at = window.coordinates(cell);
        if !window.inner(at) || window.home(at) != at {
            continue;
        }
        let parts = &particles.parts[bins.of(cell)];
        let sum = |which: usize| parts.iter().map(|part| part[which]).sum::<f64>();
        let wet = || crate::liquid::sub_cells(window, cell).any(|s| phi[s] * lattice.open[s] > 0.0);
        if parts.is_empty() && !wet() {
            continue;
        }
        let (solids, held) = (sum(0), sum(1));
        number[cell] = nodes.len() as u32;
        nodes.push(Node {
            cell: cell as u32,
            solids,
            ratio: if solids > 0.0 { held / solids } else { start },
            asked: asked[cell],
            conductance: [0.0; 6],
            neighbour: [NONE; 6],
        });
    }
    for n in 0..nodes.len() {
        let cell = nodes[n].cell as usize;
        for axis in 0..window.domain.axes {
            let high = cell + window.stride(axis);
            let home = window.index(window.home(window.coordinates(high)));
            let other = number[home];
            if other == NONE || lattice.face(axis, high) != OPEN {
                continue;
            }
            let area = passage(lattice, phi, axis, high);
            let dry = |n: usize| 1.0 / (1.0 + nodes[n].ratio);
            let k = medium.diffusion * area * 0.5 * (dry(n) + dry(other as usize));
            let far = other as usize;
            (
                nodes[n].conductance[2 * axis + 1],
                nodes[n].neighbour[2 * axis + 1],
            ) = (k, other);
            (
                nodes[far].conductance[2 * axis],
                nodes[far].neighbour[2 * axis],
            ) = (k, n as u32);
        }
    }
    nodes
}

/// Liquid area of the low face along `axis` of a cell: of each pair of sub-cells at it the lesser.
fn passage(lattice: &Lattice, phi: &[f32], axis: usize, cell: usize) -> f64 {
    let window = &lattice.window;
    let step = window.sub_stride(axis);
    let first = window.first_sub(window.coordinates(cell));
    let low = first / step % window.sub_cells()[axis];
    let wet = |s: usize| f64::from(phi[s] * lattice.open[s]);
    let at_face = |s: &usize| s / step % window.sub_cells()[axis] == low;
    let (sum, count) = (crate::liquid::sub_cells(window, cell).filter(at_face))
        .fold((0.0, 0), |(sum, n), s| {
            (sum + wet(s).min(wet(s - step)), n + 1)
        });
    sum / f64::from(count)
}

/// X of each node, and whether it is held at the least that walls leave.
fn solve(nodes: &[Node], least: f64) -> (Vec<f64>, Vec<bool>) {
    let mut ratio: Vec<f64> = nodes.iter().map(|node| node.ratio).collect();
    // Nothing to hold or to pass on: nothing changes.
    let idle = |node: &Node| node.diagonal() <= 0.0;
    let mut held: Vec<bool> = (nodes.iter())
        .map(|node| node.asked > 0.0 && node.ratio <= least * (1.0 + HAIR))
        .collect();
    for _ in 0..MAX_TURNS {
        for (x, held) in ratio.iter_mut().zip(&held) {
            *x = if *held { least } else { *x };
        }
        let free: Vec<bool> = (nodes.iter().zip(&held))
            .map(|(node, held)| !held && !idle(node))
            .collect();
        gradients(nodes, &free, &mut ratio);
        let mut turned = false;
        for (n, node) in nodes
            .iter()
            .enumerate()
            .filter(|(_, node)| node.asked > 0.0)
        {
            let short = ratio[n] < least * (1.0 - HAIR);
            let supply = node.solids * (node.ratio - ratio[n]) + node.inflow(&ratio, n);
            let turn = match held[n] {
                true => supply > node.asked * (1.0 + HAIR),
                false => short && !idle(node),
            };
            held[n] ^= turn;
            turned |= turn;
        }
        if !turned {
            break;
        }
    }
    (ratio, held)
}

/// Solves V_s (X - X_0) = sum K (X_n - X) - q for the free nodes by conjugate gradients with the diagonal.
fn gradients(nodes: &[Node], free: &[bool], ratio: &mut [f64]) {
    let defect = |ratio: &[f64], n: usize| {
        let node = &nodes[n];
        match free[n] {
            true => node.inflow(ratio, n) - node.asked - node.solids * (ratio[n] - node.ratio),
            false => 0.0,
        }
    };
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let count = nodes.len();
    let mut rest: Vec<f64> = (0..count).map(|n| defect(ratio, n)).collect();
    let scale: f64 = (nodes.iter().zip(free).filter(|(_, free)| **free))
        .map(|(node, _)| (node.diagonal() * node.ratio).powi(2))
        .sum();
    let scaled = |rest: &[f64]| -> Vec<f64> {
        let each = rest.iter().zip(nodes).zip(free);
        each.map(|((r, node), free)| if *free { r / node.diagonal() } else { 0.0 })
            .collect()
    };
    let mut correction = scaled(&rest);
    let mut way = correction.clone();
    let mut size = dot(&rest, &correction);
    for _ in 0..MAX_ITERATIONS {
        if dot(&rest, &rest) <= TOLERANCE * TOLERANCE * scale || size <= 0.0 {
            break;
        }
        let image: Vec<f64> = (0..count)
            .map(|n| match free[n] {
                true => nodes[n].solids * way[n] - nodes[n].inflow(&way, n),
                false => 0.0,
            })
            .collect();
        let step = size / dot(&way, &image);
        for n in 0..count {
            ratio[n] += step * way[n];
            rest[n] -= step * image[n];
        }
        correction = scaled(&rest);
        let last = std::mem::replace(&mut size, dot(&rest, &correction));
        for (w, c) in way.iter_mut().zip(&correction) {
            *w = c + size / last * *w;
        }
    }
}

/// Gives images beyond periodic sides the value of their cell.
fn images(window: &Window, values: &mut [f32]) {
    if (0..window.domain.axes).any(|a| window.domain.periodic(a)) {
        for index in 0..values.len() {
            values[index] = values[window.index(window.home(window.coordinates(index)))];
        }
    }
}

#[cfg(test)]
mod tests {
    use physics::{VoxelBlock, Water, WaterLaw};

    use super::*;
    use crate::geometry::tests::{domain, lattice};
    use crate::liquid::tests::at;
    use crate::water::{fill, give_off};

    fn water() -> Water {
        let law = WaterLaw {
            uptake: 1.0,
            solids: 0.5,
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
        let floor = VoxelBlock::solid_box([-1.0; 3], [9.0, 1.0, 9.0]);
        let lattice = lattice(domain([6, 5, 1], 2), vec![vec![floor]]);
        let points = (0..12 * 8).map(|p| {
            let (i, j) = (p % 12, p / 12);
            [0.5 * f64::from(i) + 0.25, 1.25 + 0.5 * f64::from(j), 0.5]
        });
        let mut particles = at(points.collect(), 0.25);
        let mut bins = Bins::default();
        particles.sort(&lattice.window, &mut bins);
        let water = water();
        fill(&mut particles, &water);
        let phi: Vec<f32> = lattice.open.iter().map(|o| f32::from(*o > 0.0)).collect();
        let mut wetted = vec![0.0; lattice.window.len()];
        for cell in 0..wetted.len() {
            let corner = lattice.window.corner(lattice.window.coordinates(cell));
            let inside = lattice.window.in_domain(lattice.window.coordinates(cell));
            wetted[cell] = if inside && corner[1] == 1.0 { 1.0 } else { 0.0 };
        }
        let medium = Medium {
            water: &water,
            diffusion,
            uptake,
        };
        let exchange = Exchange::new(&medium, &lattice, &phi, &particles, &bins, &wetted);
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
        let least =
            (particles.parts.iter().map(|[solids, held]| held / solids)).fold(9.0, f64::min);
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
}
