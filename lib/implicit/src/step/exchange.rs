//! Water that moves in a step: by diffusion between pores, and into walls (docs/methods.md section 3.11). Velocities are those of
//! the solids, relative to which water diffuses at D (1 - F) grad X.

use physics::Water;

use super::Implicit;
use super::water::WaterBalance;
use crate::geometry::Mesh;
use crate::liquid::TRACE;
use crate::water::{AbsorbingWalls, Node, solve};

/// Water moved in a step, and its effect on the viscosity.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct WaterExchange {
    /// Water that each pore gains, and that its walls take up, cells.
    pub(super) gained: Vec<f64>,
    pub(super) taken: Vec<f64>,
    /// Factor of the viscosity of each pore in the middle of the step.
    pub(super) factor: Vec<f64>,
    /// Mean change of ln(viscosity), weighted by the water that pores lose or gain.
    pub(super) change: f64,
    /// Mean of 1/factor over the liquid at the end of the step.
    pub(super) fluidity: f64,
}

impl WaterExchange {
    /// The exchange by which `nodes` reach the water `ratio`, some of them `at_limit`. `pores` is the number of all pores.
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
                // Walls do not release water.
                true => (node.solids * (ratio[n] - node.ratio)).min(flow),
                false => flow - node.demand,
            };
            (found.gained[pore], found.taken[pore]) = (gained, flow - gained);
            let [before, after] = [node.ratio, ratio[n]].map(|ratio| water.factor(ratio));
            found.factor[pore] = (before * after).sqrt();
            moved += gained.abs();
            changed += gained.abs() * (after / before).ln().abs();
            let amount = node.solids * (1.0 + ratio[n]);
            (fluid, volume) = (fluid + amount / after, volume + amount);
        }
        found.change = if moved > 0.0 { changed / moved } else { 0.0 };
        found.fluidity = if volume > 0.0 { fluid / volume } else { 1.0 };
        found
    }
}

impl Implicit {
    /// The water exchange of a step of `dt` (s), in which pores are filled to `fractions` in its middle.
    pub(super) fn exchange(
        &self,
        dt: f64,
        mesh: &Mesh,
        fractions: &[f64],
    ) -> Result<Option<WaterExchange>, String> {
        let (Some(water), Some(walls), Some(balance)) = (
            &self.setup.liquid.water,
            &self.absorbing_walls,
            &self.state.water,
        ) else {
            return Ok(None);
        };
        let nodes = self.nodes(dt, (mesh, fractions), (water, walls, balance));
        let solved = solve(&nodes, water.least()).ok_or(
            "no balance of the water was found: a smaller uptake, a larger diffusivity or a flatter \
             viscosity_by_solids is needed",
        )?;
        let pores = self.mesh.pores.len();
        Ok(Some(WaterExchange::new(&nodes, pores, water, solved)))
    }

    /// The nodes of the water balance: pores with liquid, their demand and conductances.
    fn nodes(
        &self,
        dt: f64,
        (mesh, fractions): (&Mesh, &[f64]),
        (water, walls, balance): (&Water, &AbsorbingWalls, &WaterBalance),
    ) -> Vec<Node> {
        let h = self.setup.units.cell_m;
        // Capacity and uptake of walls per area, cells; and the conductance between whole cells.
        let capacity = water.capacity().map_or(f64::INFINITY, |length| length / h);
        let (uptake, diffusion) = (dt * water.uptake() / h, dt * water.diffusivity() / (h * h));
        let mut number = vec![None; mesh.pores.len()];
        let mut nodes = Vec::new();
        for pore in 0..mesh.pores.len() {
            let solids = self.state.volumes[pore] - balance.water[pore];
            if solids < TRACE {
                continue;
            }
            number[pore] = Some(nodes.len() as u32);
            let area = walls.area(mesh, pore);
            let unsoaked = (capacity * area - balance.soaked[pore]).max(0.0);
            nodes.push(Node {
                pore: pore as u32,
                solids,
                ratio: balance.water[pore] / solids,
                demand: fractions[pore] * unsoaked.min(uptake * area),
                neighbours: Vec::new(),
            });
        }
        for (index, face) in mesh.faces.iter().enumerate() {
            let pores = face.pores();
            let [Some(low), Some(high)] = pores.map(|pore| number[pore]) else {
                continue;
            };
            let filled = fractions[pores[0]].min(fractions[pores[1]]);
            let axis = usize::from(face.axis);
            let area = mesh.area(index);
            let length = |pore: usize, up: bool| {
                mesh.area_share(index, pore, axis, up) * mesh.volume(pore) / area
            };
            let distance = 0.5 * (length(pores[0], true) + length(pores[1], false));
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
