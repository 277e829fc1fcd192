//! Water that moves in a step: by diffusion between pores and at a given rate into their walls, until a pore holds no
//! more than walls leave.
//!
//! X, water over solids by volume, obeys in each pore V_s (X - X_0) = sum K (X_n - X) - q, X >= X_min, where V_s is the
//! solids' volume, K = D dt/h^2 A/L (1 - f), f the part of water, A the liquid area and L the distance between two
//! pores, and q what the wetted walls take in the step, all of what they ask for where X > X_min. Velocities are those of
//! the solids, against which water diffuses at D (1 - f) grad X.

use physics::Water;

use super::solve::{Node, solve};
use super::walls::Walls;
use crate::geometry::Mesh;
use crate::liquid::TRACE;

/// What holds for a step.
pub(crate) struct Medium<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) walls: &'a Walls,
    pub(crate) water: &'a Water,
    /// Volume fraction of each pore in the middle of the step, at most 1.
    pub(crate) fractions: &'a [f64],
    /// Length of the step times diffusivity over the square of a cell.
    pub(crate) diffusion: f64,
    /// Length of the step times uptake, and what walls hold per area, cells.
    pub(crate) uptake: f64,
    pub(crate) capacity: f64,
}

/// What a step moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Exchange {
    /// Water that each pore gains, and that its walls take, cells.
    pub(crate) gained: Vec<f64>,
    pub(crate) taken: Vec<f64>,
    /// Factor of the viscosity of each pore in the middle of the step.
    pub(crate) factor: Vec<f64>,
    /// Mean of the change of ln(viscosity), weighted by the water that pores give off or take up.
    pub(crate) change: f64,
    /// Mean of 1/factor over the liquid at the end of the step.
    pub(crate) fluidity: f64,
}

impl Exchange {
    /// That of liquid `volumes` with so much `water` in them, whose walls have `soaked` up so much; `None` where no
    /// balance of the water was found.
    pub(crate) fn new(
        medium: &Medium,
        volumes: &[f64],
        water: &[f64],
        soaked: &[f64],
    ) -> Option<Self> {
        let nodes = medium.nodes(volumes, water, soaked);
        let (ratio, at_limit) = solve(&nodes, medium.water.least())?;
        let mut found = Self {
            gained: vec![0.0; volumes.len()],
            taken: vec![0.0; volumes.len()],
            factor: vec![1.0; volumes.len()],
            ..Self::default()
        };
        let (mut moved, mut changed, mut fluid, mut volume) = (0.0, 0.0, 0.0, 0.0);
        for (n, node) in nodes.iter().enumerate() {
            let pore = node.pore as usize;
            let flow = node.inflow(&ratio, n);
            let gained = match at_limit[n] {
                // Walls give nothing back.
                true => (node.solids * (ratio[n] - node.ratio)).min(flow),
                false => flow - node.asked,
            };
            (found.gained[pore], found.taken[pore]) = (gained, flow - gained);
            let [begin, end] = [node.ratio, ratio[n]].map(|ratio| medium.water.factor(ratio));
            found.factor[pore] = (begin * end).sqrt();
            moved += gained.abs();
            changed += gained.abs() * (end / begin).ln().abs();
            let held = node.solids * (1.0 + ratio[n]);
            (fluid, volume) = (fluid + held / end, volume + held);
        }
        found.change = if moved > 0.0 { changed / moved } else { 0.0 };
        found.fluidity = if volume > 0.0 { fluid / volume } else { 1.0 };
        Some(found)
    }
}

impl Medium<'_> {
    /// The pores with liquid and what passes between them.
    fn nodes(&self, volumes: &[f64], water: &[f64], soaked: &[f64]) -> Vec<Node> {
        let mesh = self.mesh;
        let mut number = vec![None; mesh.pores.len()];
        let mut nodes = Vec::new();
        for pore in 0..mesh.pores.len() {
            let solids = volumes[pore] - water[pore];
            if solids < TRACE {
                continue;
            }
            number[pore] = Some(nodes.len() as u32);
            let area = self.walls.area(mesh, pore);
            let room = (self.capacity * area - soaked[pore]).max(0.0);
            nodes.push(Node {
                pore: pore as u32,
                solids,
                ratio: water[pore] / solids,
                asked: self.fractions[pore] * room.min(self.uptake * area),
                beside: Vec::new(),
            });
        }
        for (index, face) in mesh.faces.iter().enumerate() {
            let ends = face.ends();
            let [Some(low), Some(high)] = ends.map(|pore| number[pore]) else {
                continue;
            };
            let wet = self.fractions[ends[0]].min(self.fractions[ends[1]]);
            let axis = usize::from(face.axis);
            let area = mesh.area(index);
            let length = |pore: usize, up: bool| {
                mesh.share(index, pore, axis, up) * mesh.volume(pore) / area
            };
            let distance = 0.5 * (length(ends[0], true) + length(ends[1], false));
            let dry = |n: u32| 1.0 / (1.0 + nodes[n as usize].ratio);
            let k = self.diffusion * wet * area / distance * 0.5 * (dry(low) + dry(high));
            if k > 0.0 {
                nodes[low as usize].beside.push((high, k));
                nodes[high as usize].beside.push((low, k));
            }
        }
        nodes
    }
}
