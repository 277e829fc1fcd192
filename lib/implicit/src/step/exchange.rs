//! Water that moves in a step: by diffusion between pores and at a given rate into their walls, until a pore holds no
//! more than walls leave.
//!
//! X, water over solids by volume, obeys in each pore V_s (X - X_0) = sum K (X_n - X) - q, X >= X_min, where V_s is the
//! solids' volume, K = D dt/h^2 A/L (1 - f), f the part of water, A the liquid area and L the distance between two
//! pores, and q what the wetted walls take in the step, all of what they ask for where X > X_min. Velocities are those of
//! the solids, against which water diffuses at D (1 - f) grad X.

use physics::Water;

use super::Implicit;
use super::water::WaterBalance;
use crate::liquid::TRACE;
use crate::water::{Node, Walls, solve};

/// What a step moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct WaterExchange {
    /// Water that each pore gains, and that its walls take, cells.
    pub(super) gained: Vec<f64>,
    pub(super) taken: Vec<f64>,
    /// Factor of the viscosity of each pore in the middle of the step.
    pub(super) factor: Vec<f64>,
    /// Mean of the change of ln(viscosity), weighted by the water that pores give off or take up.
    pub(super) change: f64,
    /// Mean of 1/factor over the liquid at the end of the step.
    pub(super) fluidity: f64,
}

impl WaterExchange {
    /// That of `nodes` among so many `pores` that come to a `ratio` of water to solids, some of them held `at_limit`.
    fn new(
        nodes: &[Node],
        pores: usize,
        water: &Water,
        (ratio, at_limit): (Vec<f64>, Vec<bool>),
    ) -> Self {
        let mut found = Self {
            gained: vec![0.0; pores],
            taken: vec![0.0; pores],
            factor: vec![1.0; pores],
            ..Self::default()
        };
        let (mut moved, mut changed, mut fluid, mut volume) = (0.0, 0.0, 0.0, 0.0);
        for (n, node) in nodes.iter().enumerate() {
            let pore = node.pore as usize;
            let flow = node.inflow(&ratio, n);
            let gained = match at_limit[n] {
                // Walls give nothing back.
                true => (node.solids * (ratio[n] - node.ratio)).min(flow),
                false => flow - node.demand,
            };
            (found.gained[pore], found.taken[pore]) = (gained, flow - gained);
            let [begin, end] = [node.ratio, ratio[n]].map(|ratio| water.factor(ratio));
            found.factor[pore] = (begin * end).sqrt();
            moved += gained.abs();
            changed += gained.abs() * (end / begin).ln().abs();
            let held = node.solids * (1.0 + ratio[n]);
            (fluid, volume) = (fluid + held / end, volume + held);
        }
        found.change = if moved > 0.0 { changed / moved } else { 0.0 };
        found.fluidity = if volume > 0.0 { fluid / volume } else { 1.0 };
        found
    }
}

impl Implicit {
    /// What a step of `dt` (s) moves of the water, in pores filled to `fractions` in its middle.
    pub(super) fn exchange(
        &self,
        dt: f64,
        fractions: &[f64],
    ) -> Result<Option<WaterExchange>, String> {
        let (Some(water), Some(walls), Some(wet)) =
            (&self.setup.liquid.water, &self.walls, &self.state.wet)
        else {
            return Ok(None);
        };
        let nodes = self.nodes(dt, fractions, (water, walls, wet));
        let solved = solve(&nodes, water.least()).ok_or(
            "no balance of the water was found: a smaller uptake, a larger diffusivity or a flatter \
             viscosity_by_solids is needed",
        )?;
        let pores = self.mesh.pores.len();
        Ok(Some(WaterExchange::new(&nodes, pores, water, solved)))
    }

    /// The pores with liquid and what passes between them.
    fn nodes(
        &self,
        dt: f64,
        fractions: &[f64],
        (water, walls, wet): (&Water, &Walls, &WaterBalance),
    ) -> Vec<Node> {
        let (mesh, h) = (&self.mesh, self.setup.units.cell_m);
        // What walls hold per area, and take of it, cells; and what differences of X pass on between cells.
        let capacity = water.capacity().map_or(f64::INFINITY, |length| length / h);
        let (uptake, diffusion) = (dt * water.uptake() / h, dt * water.diffusivity() / (h * h));
        let mut number = vec![None; mesh.pores.len()];
        let mut nodes = Vec::new();
        for pore in 0..mesh.pores.len() {
            let solids = self.state.volumes[pore] - wet.water[pore];
            if solids < TRACE {
                continue;
            }
            number[pore] = Some(nodes.len() as u32);
            let area = walls.area(mesh, pore);
            let unsoaked = (capacity * area - wet.soaked[pore]).max(0.0);
            nodes.push(Node {
                pore: pore as u32,
                solids,
                ratio: wet.water[pore] / solids,
                demand: fractions[pore] * unsoaked.min(uptake * area),
                neighbours: Vec::new(),
            });
        }
        for (index, face) in mesh.faces.iter().enumerate() {
            let ends = face.ends();
            let [Some(low), Some(high)] = ends.map(|pore| number[pore]) else {
                continue;
            };
            let filled = fractions[ends[0]].min(fractions[ends[1]]);
            let axis = usize::from(face.axis);
            let area = mesh.area(index);
            let length = |pore: usize, up: bool| {
                mesh.area_share(index, pore, axis, up) * mesh.volume(pore) / area
            };
            let distance = 0.5 * (length(ends[0], true) + length(ends[1], false));
            let dry = |n: u32| 1.0 / (1.0 + nodes[n as usize].ratio);
            let k = diffusion * filled * area / distance * 0.5 * (dry(low) + dry(high));
            if k > 0.0 {
                nodes[low as usize].neighbours.push((high, k));
                nodes[high as usize].neighbours.push((low, k));
            }
        }
        nodes
    }
}
